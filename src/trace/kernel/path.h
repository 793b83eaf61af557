// One path from the eye: what light it finds, and by which ways. Kernel-safe: one loop, no recursion.
//
// What is meant to be counted, once each (tests/trace/reference/ counts the same by other means):
//   - Light that has scattered at most `bounces` times at matte and glossy surfaces. Mirrors, and straight or bent
//     passages through clear borders, do not count; all events together are bounded by `events_most`.
//   - At each scattering the sun (or moon) and the lamps are sampled directly, and found by chance, and both weighted
//     (Veach and Guibas 1995, power heuristic); the sky is found by chance alone.
//   - Light on its way from sun or lamp to where it scatters goes straight through water, thin glass and other media:
//     it loses what they mirror, tint and absorb, but is not bent. This is the declared approximation; so after a
//     scattering, a lamp or the sun's disc found by chance behind nothing but borders (clear or rough) since that
//     scattering is not counted: the straight ray has counted it. A lamp found by a mirror is counted; the sun's disc
//     is not: light that water or polished metal throws onto walls from so small a source would be nothing but specks.
//   - A rough border (frosted glass) scatters for light from all sides when it is the first scattering; later ones
//     leave what comes through them to the straight ray, and take light from their own side alone.
//   - Mist and what floats in water scatter light once, on the way that the eye sees sharply: the first stretch, and
//     those behind mirrors and clear borders. Other stretches lose light to a medium's absorption, none to mist.
//   - Land that the eye sees sharply fades into the sky at the end of the view.
//   - The eye sees the discs of sun and moon as they are drawn, in mirrors and water as bright as they are.
#pragma once

#include "trace/kernel/bsdf.h"
#include "trace/kernel/camera.h"
#include "trace/kernel/lights.h"
#include "trace/kernel/passage.h"
#include "trace/kernel/path_settings.h"
#include "trace/kernel/pixel.h"
#include "trace/kernel/sampler.h"
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
VX_HD bool is_border(const SurfacePoint& p) {
    return p.optics == Optics::dielectric || p.optics == Optics::water || p.optics == Optics::thin;
}
VX_HD float power_heuristic(float a, float b) {
    const float a2 = a * a, b2 = b * b;
    return a2 + b2 > 0 ? a2 / (a2 + b2) : 0;
}

// How the ray came here since the last scattering at which lamps were sampled.
enum class Since : u8 {
    nothing,  // there was none
    straight, // right after it
    borders,  // through borders alone
    mirrors,  // by a mirror
};

struct PathState {
    Ray ray;
    u32 medium = 0;
    Vec3 carried{1, 1, 1}; // light found ahead counts so much
    Vec3 scatter_side;     // geometric normal at the last scattering; 0 where it takes light from all sides
    float pdf = 0;         // of the ray's direction there
    float way = 0;         // blocks since the eye, while all is sharp
    u32 bounces = 0;
    Since since = Since::nothing;
    bool sharp = true; // the eye sees this stretch sharply
    bool bent = false; // by a mirror or a border that bends
};

VX_HD float luminance(Vec3 c) {
    return 0.2126f * c.x + 0.7152f * c.y + 0.0722f * c.z;
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
        const float l = luminance(found);
        if (l > settings.firefly_limit) found = found * (settings.firefly_limit / l);
    }
    sum += found;
}

// The sky as the eye sees it; in mirrors and behind what bends the disc of sun or moon is as bright as it is.
VX_COLD Vec3 eye_sky(const SkyView& sky, Vec3 dir, float pixel, float dither, bool bent) {
    const Vec3 drawn = sky_seen(sky, dir, pixel, dither);
    return bent ? drawn + sun_radiance(sky, dir) : drawn;
}

// x, y: the pixel; sample: of this frame. rays grows by the rays that were traced.
VX_HD PixelSample trace_path(const SceneView& scene, const SkyView& sky, const Camera& camera,
                             const PathSettings& settings, u32 x, u32 y, u32 sample, u32& rays) {
    Sampler sampler = make_sampler(x, y, settings.first_sample + sample, settings.seed);
    const Vec2 inside = next_2d(sampler);
    const bool held = camera.jitter.x != 0 || camera.jitter.y != 0; // the film says where
    PathState path;
    path.ray = {camera.eye, direction_through(camera, float(x) + (held ? 0.5f + camera.jitter.x : inside.x),
                                              float(y) + (held ? 0.5f + camera.jitter.y : inside.y))};
    path.medium = camera.medium;
    const float pixel = 2 * length(camera.up) / float(camera.height); // blocks at distance 1

    PixelSample out{};
    out.albedo = {1, 1, 1};
    Vec3 light{};
    const bool any_sun = greatest(sky.sun_light) > 0, any_lamp = settings.direct_lamps && scene.lights.count > 0;

    for (u32 event = 0; event < settings.events_most; ++event) {
        Hit hit;
        const bool met = closest_hit(scene, path.ray, kFar, path.medium, hit);
        ++rays;
        const Vec3 to_eye = -path.ray.dir;
        bool ends = !met;
        if (!met && hit.kind == HitKind::unknown) break;

        // The stretch up to there.
        Speck floating{};
        if (path.sharp && settings.fog) {
            floating = sample_speck(scene, sky, path.ray, met ? hit.t : kFar, path.medium, next_1d(sampler));
            floating.weight = floating.weight * path.carried;
            path.carried = path.carried * stretch_left(scene, sky, path.ray, met ? hit.t : kFar, path.medium);
        } else if (path.medium != 0) {
            path.carried = path.carried * medium_left(scene, path.ray.from, met ? hit.t : kFar, path.medium);
        }

        SurfacePoint p;
        BsdfSample next{};
        bool samples_light = false;
        if (!met) {
            if (path.sharp) {
                out.base += path.carried * eye_sky(sky, path.ray.dir, pixel, inside.x, path.bent);
            } else {
                Vec3 found = sky_light(sky, path.ray.dir);
                if (any_sun && (path.since == Since::straight || path.since == Since::nothing))
                    found += sun_radiance(sky, path.ray.dir) *
                             (path.since == Since::nothing ? 1 : power_heuristic(path.pdf, sun_pdf(sky, path.ray.dir)));
                add_light(light, path.carried * found, true, settings);
            }
        } else {
            p = surface_at(scene, path.ray, hit, path.sharp ? (path.way + hit.t) * pixel : 0.0f);
            path.way += hit.t;
            if (path.sharp && sky.open) { // far land fades into the sky behind it
                const float faded = far_share(sky, path.way);
                out.base += path.carried * sky_dome(sky, path.ray.dir) * faded;
                path.carried = path.carried * (1 - faded);
            }
            if (greatest(p.emission) > 0) {
                float weight = 1;
                if (path.since == Since::straight && any_lamp)
                    weight = power_heuristic(
                        path.pdf, chance_of_lamp(scene, path.ray.from, path.scatter_side, path.ray.dir, hit, p.face));
                else if (path.since == Since::borders && any_lamp &&
                         (hit.kind == HitKind::cube || hit.kind == HitKind::quad))
                    weight = find_emitter(scene.lights, hit.cell) != kNoEmitter ? 0.0f : 1.0f;
                if (path.sharp)
                    out.base += path.carried * p.emission;
                else if (weight > 0)
                    add_light(light, path.carried * p.emission * weight, true, settings);
            }
            const float choose = next_1d(sampler);
            next = sample_bsdf(p, to_eye, choose, next_2d(sampler));
            // Thin glass that is painted in part, and came out as glass, is glass.
            samples_light = !only_sharp(p) && !(next.delta && p.optics == Optics::thin);
            if (samples_light && path.sharp) {
                path.sharp = false;
                out.albedo = path.carried * p.albedo;
                out.albedo = {std::fmax(out.albedo.x, 0.01f), std::fmax(out.albedo.y, 0.01f),
                              std::fmax(out.albedo.z, 0.01f)};
                out.normal = p.normal;
                out.distance = path.way;
                out.roughness = p.roughness;
                out.surface = p.surface;
            }
            if (samples_light && path.bounces >= settings.bounces) {
                // Only an exact mirror's share goes on from here.
                samples_light = false;
                ends = !next.delta;
            }
        }
        // Behind a rough border that is not the first scattering the straight ray has counted what comes through.
        const bool own_side = met && is_border(p) && (path.since == Since::straight || path.since == Since::borders);
        const bool all_sides = p.plant || p.optics == Optics::leaf || (p.optics == Optics::dielectric && !own_side);
        const Vec3 side = all_sides ? Vec3{} : p.face;
        const float painted = met && p.optics == Optics::thin && samples_light ? 1 / p.opacity : 1.0f;

        // Straight to the lights: 0 the sun, 1 a lamp, 2 from a floating speck.
        for (u32 k = 0; k < 3; ++k) {
            Place from;
            Vec3 dir, value;
            float distance = kFar;
            u32 medium = path.medium;
            if (k < 2) {
                if (!samples_light || !(k == 0 ? any_sun : any_lamp)) continue;
                from = p.at;
                float pdf;
                EmitterSample lamp;
                if (k == 0) {
                    const SunSample sun = sample_sun(sky, next_2d(sampler));
                    dir = sun.dir, pdf = sun.pdf, value = sun.radiance;
                } else {
                    const float which = next_1d(sampler);
                    if (!find_lamp(scene, from, side, which, next_2d(sampler), lamp)) continue;
                    dir = lamp.dir, pdf = lamp.pdf, distance = lamp.distance;
                    value = {1, 1, 1};
                }
                const bool behind = dot(p.face, dir) < 0;
                if (behind && own_side) continue;
                const BsdfValue v = bsdf_at(p, to_eye, dir);
                if (!(greatest(v.value) > 0)) continue;
                if (behind && (p.optics == Optics::leaf || p.optics == Optics::dielectric))
                    from = other_side(p), medium = p.medium_behind;
                if (k == 1) value = lamp_emission(scene, from, lamp);
                value = value * v.value * path.carried * (painted * power_heuristic(pdf, v.pdf) / pdf);
            } else {
                if (!floating.scatters) continue;
                const float choose = next_1d(sampler), which = next_1d(sampler);
                if (!aim_speck(scene, sky, any_lamp, path.ray, path.medium, floating, choose, which, next_2d(sampler),
                               from, dir, distance, value))
                    continue;
            }
            if (!(greatest(value) > 0)) continue;
            ++rays;
            if (!light_passes(scene, {from, dir}, distance, medium, value)) continue;
            if (k < 2)
                add_light(light, value, path.bounces > 0, settings);
            else
                out.air += value;
        }
        if (ends || !(greatest(next.weight) > 0)) break;

        // On from here.
        path.carried = path.carried * next.weight;
        if (next.through) {
            path.ray.from = other_side(p);
            if (is_border(p)) path.medium = p.medium_behind;
        } else {
            path.ray.from = p.at;
        }
        path.ray.dir = next.dir;
        if (next.delta) {
            const bool passage = next.through;
            if (path.since != Since::nothing)
                path.since = passage && path.since != Since::mirrors ? Since::borders : Since::mirrors;
            if (!passage || p.optics != Optics::thin) path.bent = true;
        } else {
            // A scattering without direct light (of metal as good as a mirror) finds lamps by itself.
            path.since = !samples_light ? Since::mirrors : own_side && next.through ? Since::borders : Since::straight;
            path.pdf = next.pdf;
            path.scatter_side = side;
            if (++path.bounces >= settings.roulette_from) {
                const float stay = clamp(greatest(path.carried), 0.05f, 1.0f);
                if (next_1d(sampler) >= stay) break;
                path.carried = path.carried * (1 / stay);
            }
        }
    }
    out.light = {light.x / out.albedo.x, light.y / out.albedo.y, light.z / out.albedo.z};
    const Vec3 all = radiance_of(out);
    if (!(std::isfinite(all.x) && std::isfinite(all.y) && std::isfinite(all.z))) {
        out.base = out.light = out.air = {};
        out.albedo = {1, 1, 1};
        out.normal = {};
        out.distance = 0;
    }
    return out;
}

} // namespace vitrail::trace
