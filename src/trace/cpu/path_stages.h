// What streams of paths do between their rays, as plain loops; included once a vector set. The tag keeps their
// instances apart.
#pragma once

#include "trace/cpu/path_stream.h"
#include "trace/cpu/row.h"

namespace vitrail::trace::stream {

// What a light ray brings if nothing takes it; its ray lies beside.
struct Carried {
    Vec3 value;
    float distance;
    u32 path;
    LightRay::Counts counts;
};

// A surface that a lamp is still to be chosen for.
struct WaitingLamp {
    Event event;
    PathState state; // as it was at the event
    Vec2 u;
    u32 path;
};

inline constexpr u32 kBlock = 64; // paths whose numbers are made and whose lamps are chosen at once

// Room for `most` paths, of which each sends three light rays at most. Rays, media and hits are those of live paths, in
// the order of `live`; sums and paths stay where they are.
struct PathArrays {
    PathState* paths;
    u32* live;
    Ray* rays;
    u8* media;
    Hit* hits;
    Ray* light_rays;
    float* light_reach;
    u8* light_media;
    Lit* lit;
    Carried* carried;
    WaitingLamp* waiting; // kBlock
    u32 alive = 0, lights = 0;
};
inline constexpr u32 kLightsAnEvent = 3;

struct PathFrame {
    const SceneView* scene;
    const SkyView* sky;
    const Camera* camera;
    const PathSettings* settings;
};

struct PathStages {
    void (*start)(const PathFrame&, const PathStart*, u32 count, PixelSample* sums, PathArrays&);
    void (*events)(const PathFrame&, PixelSample* sums, PathArrays&); // fills light_*, keeps those that go on alive
    void (*arrive)(const PathFrame&, PixelSample* sums, PathArrays&); // what `lit` says of the light rays
};

// ---- Numbers of many paths at once: a path's next draws, made ahead. What is not drawn is lost, what is drawn beyond
// is made then.

inline constexpr u32 kAheadMost = 10; // draws

struct alignas(64) BlockDraws {
    u32 sample[kBlock] = {}, place[kBlock] = {}, frame[kBlock] = {}, pixel[kBlock] = {}, drawn[kBlock] = {};
    float x[kAheadMost][kBlock], y[kAheadMost][kBlock];
    float above[kBlock] = {}, rise[kBlock] = {}, length[kBlock] = {}; // stretches of air
    float left[kBlock], t[kBlock], weight[kBlock];
};
VX_HD void put_sampler(BlockDraws& b, u32 lane, const Sampler& s) {
    b.sample[lane] = s.sample, b.place[lane] = s.place, b.frame[lane] = s.frame, b.pixel[lane] = s.pixel,
    b.drawn[lane] = s.drawn;
}
VX_HD void make_draws(BlockDraws& b, u32 lanes, u32 draws) {
    for (u32 k = 0; k < draws; ++k) {
        float *const to_x = b.x[k], *const to_y = b.y[k];
        VX_ROW for (u32 i = 0; i < lanes; ++i) {
            const Vec2 u = point_of_draw({b.sample[i], b.place[i], b.frame[i], b.pixel[i], 0}, b.drawn[i] + k);
            to_x[i] = u.x, to_y[i] = u.y;
        }
    }
}

// By each lane's first draw.
VX_HD void cross_stretches(const SkyView& sky, BlockDraws& b, u32 lanes) {
    const SkyView s = sky;
    VX_ROW for (u32 i = 0; i < lanes; ++i) {
        AirCrossing air;
        cross_air(s, b.above[i], b.rise[i], b.length[i], b.x[0][i], air);
        b.left[i] = air.left, b.t[i] = air.t, b.weight[i] = air.weight;
    }
}

// Stands for a path's sampler.
struct DrawsAhead {
    Sampler& sampler;
    const BlockDraws& block;
    u32 lane, count;
};
VX_HD Vec2 next_2d(DrawsAhead& d) {
    const u32 k = d.sampler.drawn - d.block.drawn[d.lane];
    if (k >= d.count) return trace::next_2d(d.sampler);
    ++d.sampler.drawn;
    return {d.block.x[k][d.lane], d.block.y[k][d.lane]};
}
VX_HD float next_1d(DrawsAhead& d) {
    const u32 k = d.sampler.drawn - d.block.drawn[d.lane];
    if (k >= d.count) return trace::next_1d(d.sampler);
    ++d.sampler.drawn;
    return d.block.x[k][d.lane];
}

VX_HD Stretch first_stretch(const SceneView& scene, const SkyView& sky, const PathState& path, float length,
                            DrawsAhead& d) {
    const float u = next_1d(d);
    if (path.medium != 0) return cross_stretch(scene, sky, path.ray, length, path.medium, u);
    return stretch_of({d.block.left[d.lane], d.block.t[d.lane], d.block.weight[d.lane]});
}

// ----

// As start_path, many at once.
template <int Tag>
void start_paths(const PathFrame& f, const PathStart* starts, u32 count, PixelSample* sums, PathArrays& a) {
    const Camera camera = *f.camera; // in this function's hands: nothing written changes it
    const PathSettings settings = *f.settings;
    const float pixel = pixel_width(camera);
    BlockDraws draws;
    alignas(64) u32 x[kBlock] = {}, y[kBlock] = {};
    alignas(64) float dir[3][kBlock];
    for (u32 from = 0; from < count; from += kBlock) {
        const u32 lanes = count - from < kBlock ? count - from : kBlock;
        for (u32 i = 0; i < lanes; ++i) {
            const PathStart& s = starts[from + i];
            x[i] = s.x, y[i] = s.y, draws.sample[i] = s.sample;
        }
        VX_ROW for (u32 i = 0; i < lanes; ++i) {
            const Sampler s = sampler_of_path(settings, x[i], y[i], draws.sample[i]);
            draws.sample[i] = s.sample, draws.place[i] = s.place, draws.frame[i] = s.frame, draws.pixel[i] = s.pixel;
        }
        make_draws(draws, lanes, 1);
        VX_ROW for (u32 i = 0; i < lanes; ++i) {
            const Vec3 d = start_direction(camera, x[i], y[i], {draws.x[0][i], draws.y[0][i]});
            dir[0][i] = d.x, dir[1][i] = d.y, dir[2][i] = d.z;
        }
        for (u32 i = 0; i < lanes; ++i) {
            const u32 path = from + i;
            PathState& p = a.paths[path];
            p = PathState{};
            p.sampler = {draws.sample[i], draws.place[i], draws.frame[i], draws.pixel[i], 1};
            p.ray = {camera.eye, {dir[0][i], dir[1][i], dir[2][i]}};
            p.medium = camera.medium;
            p.spread = pixel;
            sums[path] = {};
            a.live[path] = path;
            a.rays[path] = p.ray;
            a.media[path] = u8(p.medium);
        }
    }
    a.alive = settings.events_most > 0 ? count : 0;
}

// Light rays of a block of paths, and surfaces for which lamps are still to be chosen.
struct LightSender {
    const PathArrays& a;
    u32& lights;
    struct alignas(64) Choices {
        float place[3][kBlock], normal[3][kBlock], choose[kBlock], chance[kBlock];
        u32 node[kBlock], open[kBlock]; // open: not at a leaf yet
    };
    Choices& choices;
    u32 path = 0, count = 0;

    VX_HD void operator()(const LightRay& to) {
        a.light_rays[lights] = to.ray;
        a.light_reach[lights] = light_reach(to.distance);
        a.light_media[lights] = u8(to.medium);
        a.carried[lights] = {to.value, to.distance, path, to.counts};
        ++lights;
    }
    VX_HD void later(const Event& e, const PathState& state, float which, Vec2 u) {
        const u32 i = count++;
        a.waiting[i] = {e, state, u, path};
        choices.choose[i] = which;
    }
};

// As choose_emitter, many at once: all go down the tree together.
VX_HD void choose_emitters(const LightView& lights, u32 count, LightSender::Choices& choices) {
    const LightView l = lights; // in this function's hands, as below
    float *const px = choices.place[0], *const py = choices.place[1], *const pz = choices.place[2];
    float *const nx = choices.normal[0], *const ny = choices.normal[1], *const nz = choices.normal[2];
    float *const choose = choices.choose, *const chance = choices.chance;
    u32 *const node = choices.node, *const open = choices.open;
    u32 any = !is_leaf(l.nodes[0]);
    for (u32 i = 0; i < count; ++i)
        node[i] = 0, chance[i] = 1, open[i] = any;
    while (any != 0) {
        VX_ROW for (u32 i = 0; i < count; ++i) {
            if (open[i] != 0) {
                u32 at = node[i];
                float left = choose[i], sofar = chance[i];
                choose_child(l, {px[i], py[i], pz[i]}, {nx[i], ny[i], nz[i]}, at, left, sofar);
                node[i] = at, choose[i] = left, chance[i] = sofar;
                open[i] = sofar > 0 && !is_leaf(l.nodes[at]);
            }
        }
        any = 0;
        for (u32 i = 0; i < count; ++i)
            any |= open[i];
    }
}

// A call, as lamps are seldom: what follows the choice.
VX_COLD void aim_lamps(const PathFrame& f, LightSender& send) {
    const SceneView& scene = *f.scene;
    const PathArrays& a = send.a;
    LightSender::Choices& c = send.choices;
    for (u32 i = 0; i < send.count; ++i) {
        const Vec3 p = light_place(scene.lights, a.waiting[i].event.p.at), n = a.waiting[i].event.side;
        c.place[0][i] = p.x, c.place[1][i] = p.y, c.place[2][i] = p.z;
        c.normal[0][i] = n.x, c.normal[1][i] = n.y, c.normal[2][i] = n.z;
    }
    choose_emitters(scene.lights, send.count, c);
    for (u32 i = 0; i < send.count; ++i) {
        if (!(c.chance[i] > 0)) continue;
        const WaitingLamp& w = a.waiting[i];
        EmitterSample found;
        LightRay to;
        send.path = w.path;
        if (sample_chosen(scene, w.event.p.at, w.event.side, scene.lights.nodes[c.node[i]].first, c.choose[i],
                          c.chance[i], w.u, found) &&
            aim_light(scene, *f.sky, true, found, w.u, w.event, w.state, to))
            send(to);
    }
    send.count = 0;
}

template <int Tag>
void meet_events(const PathFrame& f, PixelSample* sums, PathArrays& arrays) {
    const PathArrays a = arrays;
    const float pixel = pixel_width(*f.camera);
    const u32 usual = f.scene->lights.count > 0 ? 6 : 4; // direction, sun, lamp, roulette
    BlockDraws draws;
    u32 on = 0, lights = 0;
    LightSender::Choices choices;
    LightSender send{a, lights, choices};
    for (u32 from = 0; from < a.alive; from += kBlock) {
        const u32 end = a.alive - from < kBlock ? a.alive : from + kBlock;
        u32 lanes = 0;
        bool any_sharp = false;
        u8 lane_of[kBlock];
        for (u32 i = from; i < end; ++i) { // whoever scatters nowhere draws nothing
            const PathState& p = a.paths[a.live[i]];
            if (a.hits[i].kind == HitKind::nothing && !p.sharp) continue;
            any_sharp |= p.sharp;
            lane_of[i - from] = u8(lanes);
            draws.above[lanes] = above_sea(*f.sky, p.ray.from), draws.rise[lanes] = p.ray.dir.y;
            draws.length[lanes] = a.hits[i].kind == HitKind::nothing ? kFar : a.hits[i].t;
            put_sampler(draws, lanes++, p.sampler);
        }
        const u32 ahead = any_sharp ? kAheadMost : usual; // what floats in air takes three more
        make_draws(draws, lanes, ahead);
        if (any_sharp && f.settings->fog) cross_stretches(*f.sky, draws, lanes);
        for (u32 i = from; i < end; ++i) {
            const u32 path = send.path = a.live[i];
            PathState& p = a.paths[path];
            const bool none = a.hits[i].kind == HitKind::nothing && !p.sharp;
            DrawsAhead own{p.sampler, draws, none ? 0u : lane_of[i - from], none ? 0 : ahead};
            if (!path_event(*f.scene, *f.sky, *f.settings, pixel, a.hits[i], p, own, sums[path], send)) continue;
            a.live[on] = path;
            a.rays[on] = p.ray;
            a.media[on] = u8(p.medium);
            ++on;
        }
        if (send.count > 0) aim_lamps(f, send);
    }
    arrays.alive = on, arrays.lights = lights;
}

template <int Tag>
void add_lights(const PathFrame& f, PixelSample* sums, PathArrays& arrays) {
    const PathArrays a = arrays;
    for (u32 i = 0; i < a.lights; ++i) {
        const Carried& c = a.carried[i];
        Vec3 value = c.value;
        if (a.light_reach[i] > 0) {
            if (a.lit[i] == Lit::shadow) continue;
            if (a.lit[i] == Lit::open)
                cross_last(*f.scene, a.light_rays[i], c.distance, 0, a.light_media[i], value);
            else if (!light_passes(*f.scene, a.light_rays[i], c.distance, a.light_media[i], value))
                continue;
        }
        add_arrived(sums[c.path], c.counts, value, *f.settings);
    }
}

template <int Tag>
PathStages make_path_stages() {
    return {start_paths<Tag>, meet_events<Tag>, add_lights<Tag>};
}

PathStages path_stages_avx512();

} // namespace vitrail::trace::stream
