// What the wave's kernels do with one path or one ray; the order of path.h's steps over many paths. A kernel brings
// `append`: u32(u32& counter) -> the number before it grew by one, all different.
#pragma once

#include "trace/cuda/wave.h"
#include "trace/kernel/lean_walk.h"

// The compiler leaves out what follows from the opposite.
#ifdef __CUDA_ARCH__
#define VX_ASSUME(what) __builtin_assume(what)
#else
#define VX_ASSUME(what) ((void)0)
#endif

namespace vitrail::trace::cuda {

// Number n of a batch's paths begins. First of all.
template <class Append>
VX_HD void start_step(const WaveJob& j, u32 path, Append&& append) {
    const TilePixel at = tile_pixel(j.job, j.first + path % j.pixels);
    const u32 sample = path / j.pixels;
    if (sample >= samples_at(j.job, at)) return;
    PixelSample sum;
    const PathState state = start_path(j.job.frame.now, j.job.settings, at.x, at.y, sample, sum);
    clear_sum(j.wave, path);
    store_path(j.wave, path, state, at.x, at.y);
    j.wave.going[0][append(j.wave.rounds[0].rays.n)] = path;
}

// The path's ray was traced. Those that were lost end here.
template <class Append>
VX_HD void sort_hit(const WaveJob& j, u32 round, u32 path, const Hit& hit, Append&& append) {
    const Wave& w = j.wave;
    if (hit.kind == HitKind::nothing) {
        w.ends[w.paths - 1 - append(w.rounds[round].missed.n)] = path;
    } else if (hit.kind != HitKind::unknown) {
        store_hit(w, path, hit);
        w.ends[append(w.rounds[round].met.n)] = path;
    }
}
template <class Append>
VX_HD void closest_step(const WaveJob& j, u32 round, u32 path, Append&& append) {
    u32 medium;
    const Ray ray = load_ray(j.wave, path, medium);
    Hit hit;
    closest_hit(j.job.scene, ray, kFar, medium, hit);
    sort_hit(j, round, path, hit, append);
}

// The same for rays with an easy way, in two parts with the walk between them; the others go to a list for
// closest_step. Events will put the next round's paths where the list lies.
VX_HD bool easy_closest_start(const WaveJob& j, u32 path, AirWalk& w) {
    u32 medium;
    const Ray ray = load_ray(j.wave, path, medium);
    return lean_start(j.job.scene, ray, kFar, medium, w);
}
template <class Append>
VX_HD void easy_closest_end(const WaveJob& j, u32 round, u32 path, LeanEnd end, const AirWalk& w, Append&& append) {
    Hit hit;
    if (end == LeanEnd::passed || (end == LeanEnd::stopped && lean_hit(j.job.scene, w, hit)))
        sort_hit(j, round, path, hit, append);
    else
        j.wave.going[(round + 1) & 1][append(j.wave.rounds[round].hard.n)] = path;
}
template <class Append, class Boxes>
VX_HD void easy_closest_step(const WaveJob& j, u32 round, u32 path, Append&& append, Boxes&& boxes) {
    u32 medium;
    const Ray ray = load_ray(j.wave, path, medium);
    AirWalk w;
    const LeanEnd end = lean_walk(j.job.scene, ray, kFar, medium, w, boxes);
    easy_closest_end(j, round, path, end, w, append);
}

// Event of a path whose ray met something, or nothing: by kernels of their own, each with half of path_event.
template <bool Met, class Append>
VX_HD void event_step(const WaveJob& j, u32 round, u32 path, Append&& append) {
    const Wave& w = j.wave;
    u32 x, y;
    PathState state = load_path(j, path, x, y);
    Hit hit;
    if constexpr (Met) {
        hit = load_hit(w, path);
        VX_ASSUME(hit.kind != HitKind::nothing);
    }
    PixelSample found;
    u32 sent = 0;
    const auto send = [&](const LightRay& to) {
        const Purse purse = to.counts == LightRay::Counts::air ? Purse::air : Purse(u8(sent++));
        store_light(w, append(w.rounds[round].lights.n), path, to, purse);
    };
    const bool on =
        path_event(j.job.scene, j.job.sky, settings_at(j.job, x, y), j.pixel_width, hit, state, found, send);
    add_event(w, path, found);
    if (on) {
        store_path(w, path, state, x, y);
        w.going[(round + 1) & 1][append(w.rounds[round + 1].rays.n)] = path;
    }
}

VX_HD void light_step(const WaveJob& j, u32 place) {
    u32 path;
    Purse purse;
    LightRay r = load_light(j.wave, place, path, purse);
    if (light_passes(j.job.scene, r.ray, r.distance, r.medium, r.value))
        add_light_ray(j.wave, path, purse, r.counts, r.value, j.job.settings);
}

// The same for rays with an easy way; the others go to a list for light_step. most: how far they go.
VX_HD bool easy_light_start(const WaveJob& j, u32 place, AirWalk& w, float& most) {
    u32 path;
    Purse purse;
    const LightRay r = load_light(j.wave, place, path, purse);
    most = light_reach(r.distance);
    return most > 0 && lean_start(j.job.scene, r.ray, most, r.medium, w);
}
template <class Append>
VX_HD void easy_light_end(const WaveJob& j, u32 round, u32 place, LeanEnd end, const AirWalk& w, Append&& append) {
    if (end == LeanEnd::passed) {
        u32 path;
        Purse purse;
        const LightRay r = load_light(j.wave, place, path, purse);
        add_light_ray(j.wave, path, purse, r.counts, r.value, j.job.settings);
    } else if (end == LeanEnd::hard || !opaque_in(j.job.scene.grid, w)) {
        j.wave.hard_lights[append(j.wave.rounds[round].hard_lights.n)] = place;
    }
}
template <class Append, class Boxes>
VX_HD void easy_light_step(const WaveJob& j, u32 round, u32 place, Append&& append, Boxes&& boxes) {
    u32 path;
    Purse purse;
    const LightRay r = load_light(j.wave, place, path, purse);
    const float most = light_reach(r.distance);
    AirWalk w;
    const LeanEnd end = most > 0 ? lean_walk(j.job.scene, r.ray, most, r.medium, w, boxes) : LeanEnd::hard;
    easy_light_end(j, round, place, end, w, append);
}

// A path that needs more rounds than there are goes on to its end. Returns the rays that were traced.
VX_HD u32 rest_step(const WaveJob& j, u32 path) {
    u32 x, y, rays = 0;
    PathState state = load_path(j, path, x, y);
    const PathSettings settings = settings_at(j.job, x, y);
    for (bool on = true; on;) {
        Hit hit;
        closest_hit(j.job.scene, state.ray, kFar, state.medium, hit);
        ++rays;
            PixelSample found;
        u32 sent = 0;
        const auto send = [&](const LightRay& to) {
            ++rays;
            const Purse purse = to.counts == LightRay::Counts::air ? Purse::air : Purse(u8(sent++));
            Vec3 value = to.value;
            if (light_passes(j.job.scene, to.ray, to.distance, to.medium, value))
                add_light_ray(j.wave, path, purse, to.counts, value, settings);
        };
        on = path_event(j.job.scene, j.job.sky, settings, j.pixel_width, hit, state, found, send);
        add_event(j.wave, path, found);
    }
    return rays;
}

// All samples of a pixel of the batch have ended. Returns how many were dropped.
VX_HD u32 finish_step(const WaveJob& j, u32 pixel) {
    const TilePixel at = tile_pixel(j.job, j.first + pixel);
    const u32 samples = samples_at(j.job, at);
    if (samples == 0) return 0;
    SampleMean mean;
    for (u32 s = 0; s < samples; ++s) {
        PixelSample sample = load_sum(j.wave, s * j.pixels + pixel);
        finish_path(sample);
        add_sample(mean, sample);
    }
    if (!j.job.means) return put_samples(j.job.film, j.job.frame, at.x, at.y, mean);
    j.job.means[u64(at.row) * j.job.film.width + at.x] = mean;
    return 0;
}

} // namespace vitrail::trace::cuda
