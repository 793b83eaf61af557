// What happens to a path where its ray ends: light is found, rays go straight to lights, a direction is chosen. What is
// counted, and why, stands in path.h. Kernel-safe.
#pragma once

#include "math/color.h"
#include "trace/kernel/bsdf.h"
#include "trace/kernel/lights.h"
#include "trace/kernel/passage.h"
#include "trace/kernel/path_settings.h"
#include "trace/kernel/path_state.h"
#include "trace/kernel/scatter.h"
#include "trace/kernel/sky.h"

namespace vitrail::trace {

// Nothing but exact mirrors and passages: no light is sampled there.
VX_HD bool only_sharp(const SurfacePoint& p) {
    if (p.plant) return false;
    switch (p.optics) {
    case Optics::metal:
    case Optics::dielectric:
    case Optics::water:
        return is_sharp(p);
    case Optics::thin:
        return p.opacity <= 0;
    default:
        return false;
    }
}
// May be left by an exact mirror's way, or by a border's.
VX_HD bool may_mirror(const SurfacePoint& p) {
    return !p.plant && p.optics != Optics::leaf &&
           (is_sharp(p) || p.optics == Optics::thin || p.optics == Optics::water);
}
// Waves too small to be seen: the eye looks on by them, and lights are sampled.
VX_HD bool rough_water(const SurfacePoint& p) {
    return p.optics == Optics::water && !is_sharp(p);
}
VX_HD bool is_border(const SurfacePoint& p) {
    return p.optics == Optics::dielectric || p.optics == Optics::water || p.optics == Optics::thin;
}
VX_HD float power_heuristic(float a, float b) {
    const float a2 = a * a, b2 = b * b;
    return a2 + b2 > 0 ? a2 / (a2 + b2) : 0;
}

// lights.h as calls.
VX_COLD bool find_lamp(const SceneView& scene, Place at, Vec3 side, float choose, Vec2 u, EmitterSample& out) {
    return sample_emitter(scene, at, side, choose, u, out);
}
VX_COLD float chance_of_lamp(const SceneView& scene, Place at, Vec3 side, Vec3 dir, const Hit& hit, Vec3 facing) {
    return emitter_pdf(scene, at, side, dir, hit, facing);
}

// Adds light that scattered on its way to the eye, holding single finds.
VX_HD void add_light(Vec3& sum, Vec3 found, bool indirect, const PathSettings& settings) {
    if (indirect && settings.firefly_limit > 0) {
        const float l = luminance_of(found);
        if (l > settings.firefly_limit) found = found * (settings.firefly_limit / l);
    }
    sum += found;
}
// What a light ray brought; value: what light_passes left of it.
VX_HD void add_arrived(PixelSample& sum, LightRay::Counts counts, Vec3 value, const PathSettings& settings) {
    if (counts == LightRay::Counts::air)
        sum.air += value;
    else
        add_light(sum.light, value, counts == LightRay::Counts::indirect, settings);
}

// The sky as the eye sees it; in mirrors and behind what bends the disc of sun or moon is as bright as it is. disc: how
// much of that counts.
VX_COLD Vec3 eye_sky(const SkyView& sky, Vec3 dir, float pixel, float dither, float disc) {
    const Vec3 drawn = sky_seen(sky, dir, pixel, dither);
    return disc > 0 ? drawn + sun_radiance(sky, dir) * disc : drawn;
}

// What stands where the ray ended, and what the path does there.
struct Event {
    SurfacePoint p;
    BsdfSample next;
    bool samples_light = false; // by rays to sun and lamps
    bool own_side = false;      // a border behind which the straight ray has counted what comes through
    Vec3 side;                  // takes light from this side; 0: from all
};

// The stretch before the event; an overload for other draws may know it already.
template <class Draws>
VX_HD Stretch first_stretch(const SceneView& scene, const SkyView& sky, const PathState& path, float length,
                            Draws& draws) {
    return cross_stretch(scene, sky, path.ray, length, path.medium, next_1d(draws));
}

// What the eye sees by sharp ways needs no filter; what far water mirrors and shows lies on that water, to be filtered.
VX_HD Vec3& sum_of_seen(const PathState& path, PixelSample& sum) {
    return path.since == Since::nothing ? sum.base : sum.light;
}

// Light that the ray finds in the sky.
template <class Draws>
VX_HD void meet_sky(const SkyView& sky, const PathSettings& settings, float pixel, PathState& path, Draws& draws,
                    PixelSample& sum) {
    const bool any_sun = greatest(sky.sun_light) > 0;
    if (path.sharp) {
        const float dither = next_1d(draws);
        // The disc was aimed at from far water.
        float disc = path.since == Since::borders || !path.bent ? 0.0f : 1.0f;
        if (path.since == Since::straight && any_sun) disc = power_heuristic(path.pdf, sun_pdf(sky, path.ray.dir));
        sum_of_seen(path, sum) += path.carried * eye_sky(sky, path.ray.dir, pixel, dither, disc);
        return;
    }
    Vec3 found = sky_light(sky, path.ray.dir);
    if (any_sun && (path.since == Since::straight || path.since == Since::nothing))
        found += sun_radiance(sky, path.ray.dir) *
                 (path.since == Since::nothing ? 1 : power_heuristic(path.pdf, sun_pdf(sky, path.ray.dir)));
    add_light(sum.light, path.carried * found, true, settings);
}

// Light that what was hit sends by itself.
VX_HD void meet_emission(const SceneView& scene, const PathSettings& settings, const Hit& hit, const SurfacePoint& p,
                         bool any_lamp, const PathState& path, PixelSample& sum) {
    if (path.sharp) {
        sum_of_seen(path, sum) += path.carried * seen_emission(scene.states[hit.state], p.emission);
        return;
    }
    float weight = 1;
    if (path.since == Since::straight && any_lamp)
        weight = power_heuristic(path.pdf,
                                 chance_of_lamp(scene, path.ray.from, path.scatter_side, path.ray.dir, hit, p.face));
    else if (path.since == Since::borders && any_lamp && (hit.kind == HitKind::cube || hit.kind == HitKind::quad))
        weight = find_emitter(scene.lights, hit.cell) != kNoEmitter ? 0.0f : 1.0f;
    if (weight > 0) add_light(sum.light, path.carried * p.emission * weight, true, settings);
}

// The first surface that the eye does not see through sharply: it guides the filter. Of water its level.
VX_HD void note_guides(const SurfacePoint& p, const PathState& path, PixelSample& sum) {
    const Vec3 albedo = path.carried * p.albedo;
    sum.albedo = {std::fmax(albedo.x, 0.01f), std::fmax(albedo.y, 0.01f), std::fmax(albedo.z, 0.01f)};
    sum.normal = p.optics == Optics::water ? p.face : p.normal;
    sum.distance = path.way;
    sum.roughness = p.roughness;
    sum.surface = p.surface;
}

// From the surface straight to the sun, by u, or to a point that was found of a lamp. False: nothing comes from there.
VX_HD bool aim_light(const SceneView& scene, const SkyView& sky, bool lamp, const EmitterSample& found, Vec2 u,
                     const Event& e, const PathState& path, LightRay& out) {
    const SurfacePoint& p = e.p;
    out.ray.from = p.at;
    out.medium = path.medium;
    float pdf;
    if (!lamp) {
        const SunSample sun = sample_sun(sky, u);
        out.ray.dir = sun.dir, pdf = sun.pdf, out.value = sun.radiance;
    } else {
        out.ray.dir = found.dir, pdf = found.pdf, out.distance = found.distance;
    }
    const bool behind = dot(p.face, out.ray.dir) < 0;
    if (behind && e.own_side) return false;
    const BsdfValue v = bsdf_at(p, -path.ray.dir, out.ray.dir);
    if (!(greatest(v.value) > 0)) return false;
    if (behind && (p.optics == Optics::leaf || p.optics == Optics::dielectric || p.optics == Optics::water))
        out.ray.from = other_side(p), out.medium = p.medium_behind;
    if (lamp) out.value = lamp_emission(scene, out.ray.from, found);
    const float painted = p.optics == Optics::thin ? 1 / p.opacity : 1.0f;
    out.value = out.value * v.value * path.carried * (painted * power_heuristic(pdf, v.pdf) / pdf);
    out.counts = path.bounces > 0 ? LightRay::Counts::indirect : LightRay::Counts::direct;
    return greatest(out.value) > 0;
}

// From a floating speck.
template <class Draws>
VX_HD bool aim_from_air(const SceneView& scene, const SkyView& sky, bool any_lamp, const Speck& speck,
                        const PathState& path, Draws& draws, LightRay& out) {
    const float choose = next_1d(draws), which = next_1d(draws);
    out.medium = path.medium;
    out.counts = LightRay::Counts::air;
    return aim_speck(scene, sky, any_lamp, path.ray, path.medium, speck, choose, which, next_2d(draws), out.ray.from,
                     out.ray.dir, out.distance, out.value);
}

// How much wider a cone is, a block, that waves mirror or bend: by a standard deviation of their slopes each way. A
// mirror turns a ray by twice what it turns itself, a border by what it bends.
VX_HD float spread_by_waves(const SurfacePoint& p, bool through) {
    const float turned = through ? std::fabs(1 - 1 / p.ior) : 2.0f;
    return 2 * turned * std::sqrt(0.5f * (p.waves.xx + p.waves.zz));
}

// Sets the ray that the path goes on with. False: it ends.
template <class Draws>
VX_HD bool go_on(const PathSettings& settings, const Event& e, PathState& path, Draws& draws) {
    const SurfacePoint& p = e.p;
    path.carried = path.carried * e.next.weight;
    if (e.next.through) {
        path.ray.from = other_side(p);
        if (is_border(p)) path.medium = p.medium_behind;
    } else {
        path.ray.from = p.at;
    }
    path.ray.dir = e.next.dir;
    if (e.next.delta) {
        const bool passage = e.next.through;
        if (path.since != Since::nothing)
            path.since = passage && path.since != Since::mirrors ? Since::borders : Since::mirrors;
        if (!passage || p.optics != Optics::thin) path.bent = true;
    } else {
        // A scattering without direct light (of metal as good as a mirror) finds lamps by itself.
        path.since = !e.samples_light               ? Since::mirrors
                     : e.own_side && e.next.through ? Since::borders
                                                    : Since::straight;
        path.pdf = e.next.pdf;
        path.scatter_side = e.side;
        if (path.sharp) { // rough water: its waves spread what a pixel sees
            path.bent = true;
            path.spread += spread_by_waves(p, e.next.through);
        } else if (++path.bounces >= settings.roulette_from) {
            const float stay = clamp(greatest(path.carried), 0.05f, 1.0f);
            if (next_1d(draws) >= stay) return false;
            path.carried = path.carried * (1 / stay);
        }
    }
    return path.events < settings.events_most;
}

// hit: of path.ray, as closest_hit tells. pixel: blocks that a pixel is wide at distance 1. sum: of the path, see
// finish_path; send(const LightRay&) is called for each ray to a light, at most three; what arrives belongs into `sum`
// before the next event's. Where send has later(const Event&, const PathState&, float which, Vec2 u), that is called
// instead of choosing a lamp: who has many to choose does it then, as below (find_lamp, aim_light). draws:
// path.sampler, or something that next_1d and next_2d give the same numbers of. True: path.ray is to be traced, and its
// hit to be told.
template <class Draws, class Send>
VX_HD bool path_event(const SceneView& scene, const SkyView& sky, const PathSettings& settings, float pixel,
                      const Hit& hit, PathState& path, Draws& draws, PixelSample& sum, Send&& send) {
    if (hit.kind == HitKind::unknown) return false;
    const bool met = hit.kind != HitKind::nothing;
    const bool any_sun = greatest(sky.sun_light) > 0, any_lamp = settings.direct_lamps && scene.lights.count > 0;
    ++path.events;

    Speck floating{};
    if (path.sharp && settings.fog) {
        const Stretch stretch = first_stretch(scene, sky, path, met ? hit.t : kFar, draws);
        floating = stretch.speck;
        floating.weight = floating.weight * path.carried;
        path.carried = path.carried * stretch.left;
    } else if (path.medium != 0) {
        path.carried = path.carried * medium_left(scene, path.ray.from, met ? hit.t : kFar, path.medium);
    }

    Event e;
    if (!met) {
        meet_sky(sky, settings, pixel, path, draws, sum);
    } else {
        SurfacePoint& p = e.p;
        path.way += hit.t;
        path.wide += path.spread * hit.t;
        p = surface_at(scene, path.ray, hit, path.sharp ? path.wide : 0.0f);
        if (path.sharp && sky.open) { // far land fades into the sky behind it
            const float faded = far_share(sky, path.way);
            if (faded > 0) sum_of_seen(path, sum) += path.carried * sky_dome(sky, path.ray.dir) * faded;
            path.carried = path.carried * (1 - faded);
        }
        if (greatest(p.emission) > 0) meet_emission(scene, settings, hit, p, any_lamp, path, sum);
        const float choose = next_1d(draws);
        const Vec2 where = next_2d(draws);
        const bool last = path.bounces >= settings.bounces;
        // After the last scattering an exact mirror's share alone goes on.
        if (!last || may_mirror(p)) e.next = sample_bsdf(p, -path.ray.dir, choose, where);
        // Thin glass that is painted in part, and came out as glass, is glass.
        e.samples_light = !only_sharp(p) && !(e.next.delta && p.optics == Optics::thin);
        const bool first = path.sharp;
        if (e.samples_light && first) {
            if (path.since == Since::nothing) note_guides(p, path, sum);
            path.sharp = rough_water(p);
        }
        if (e.samples_light && last && !rough_water(p)) {
            e.samples_light = false;
            if (!e.next.delta) e.next.weight = {};
        }
        // Behind a rough border that is not the first scattering the straight ray has counted what comes through.
        e.own_side = is_border(p) && !first && (path.since == Since::straight || path.since == Since::borders);
        const bool all_sides = p.plant || p.optics == Optics::leaf || p.optics == Optics::water ||
                               (p.optics == Optics::dielectric && !e.own_side);
        if (!all_sides) e.side = p.face;
    }
    for (u32 k = 0; k < 3; ++k) {
        LightRay to;
        bool sent = false;
        if (k == 2) {
            sent = floating.scatters && aim_from_air(scene, sky, any_lamp, floating, path, draws, to) &&
                   greatest(to.value) > 0;
        } else if (e.samples_light && (k == 0 ? any_sun : any_lamp && !rough_water(e.p))) {
            const float which = k == 0 ? 0 : next_1d(draws);
            const Vec2 u = next_2d(draws);
            EmitterSample found;
            if constexpr (requires { send.later(e, path, which, u); }) {
                if (k == 1) {
                    send.later(e, path, which, u);
                    continue;
                }
            } else if (k == 1 && !find_lamp(scene, e.p.at, e.side, which, u, found)) {
                continue;
            }
            sent = aim_light(scene, sky, k == 1, found, u, e, path, to);
        }
        if (sent) send(static_cast<const LightRay&>(to));
    }
    return met && greatest(e.next.weight) > 0 && go_on(settings, e, path, draws);
}

template <class Send>
VX_HD bool path_event(const SceneView& scene, const SkyView& sky, const PathSettings& settings, float pixel,
                      const Hit& hit, PathState& path, PixelSample& sum, Send&& send) {
    return path_event(scene, sky, settings, pixel, hit, path, path.sampler, sum, send);
}

} // namespace vitrail::trace
