// What streams of paths do between their rays, as plain loops; included once a vector set. The tag keeps their
// instances apart.
#pragma once

#include "trace/cpu/path_stream.h"

namespace vitrail::trace::stream {

// What a light ray brings if nothing takes it; its ray lies beside.
struct Carried {
    Vec3 value;
    float distance;
    u32 path;
    LightRay::Counts counts;
};

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

template <int Tag>
void start_paths(const PathFrame& f, const PathStart* starts, u32 count, PixelSample* sums, PathArrays& a) {
    for (u32 i = 0; i < count; ++i) {
        a.paths[i] = start_path(*f.camera, *f.settings, starts[i].x, starts[i].y, starts[i].sample, sums[i]);
        a.live[i] = i;
        a.rays[i] = a.paths[i].ray;
        a.media[i] = u8(a.paths[i].medium);
    }
    a.alive = f.settings->events_most > 0 ? count : 0;
}

template <int Tag>
void meet_events(const PathFrame& f, PixelSample* sums, PathArrays& arrays) {
    const PathArrays a = arrays; // in this function's hands: nothing written changes them
    const float pixel = pixel_width(*f.camera);
    u32 on = 0, lights = 0;
    for (u32 i = 0; i < a.alive; ++i) {
        const u32 path = a.live[i];
        const auto send = [&](const LightRay& to) {
            a.light_rays[lights] = to.ray;
            a.light_reach[lights] = light_reach(to.distance);
            a.light_media[lights] = u8(to.medium);
            a.carried[lights] = {to.value, to.distance, path, to.counts};
            ++lights;
        };
        PathState& p = a.paths[path];
        if (!path_event(*f.scene, *f.sky, *f.settings, pixel, a.hits[i], p, sums[path], send)) continue;
        a.live[on] = path;
        a.rays[on] = p.ray;
        a.media[on] = u8(p.medium);
        ++on;
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
