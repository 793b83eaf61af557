#include "trace/cuda/wave_memory.h"

#include <algorithm>

namespace vitrail::trace::cuda {

namespace {

// Planes one after the other; a null start counts bytes alone.
struct Layout {
    u8* start;
    u64 used = 0;
    template <class T>
    T* take(u64 count) {
        const u64 at = used;
        used += (count * sizeof(T) + 255) & ~u64(255);
        return start ? reinterpret_cast<T*>(start + at) : nullptr;
    }
};

Wave lay_out(const WavePlan& plan, Layout& to) {
    Wave w;
    w.paths = plan.paths, w.lights_each = plan.lights_each;
    const u64 n = plan.paths;
    w.rounds = to.take<WaveRound>(kRoundsMost + 1);
    w.path = to.take<Word4>(n * Wave::kPathWords);
    w.hit = to.take<Word4>(n * Wave::kHitWords);
    w.sum = to.take<Word4>(n * Wave::kSumWords);
    w.light = to.take<Word4>(n * plan.lights_each * Wave::kLightWords);
    w.going[0] = to.take<u32>(n), w.going[1] = to.take<u32>(n), w.ends = to.take<u32>(n);
    w.hard_lights = to.take<u32>(n * plan.lights_each);
    return w;
}

} // namespace

WavePlan plan_wave(const PathJob& job, u32 most) {
    WavePlan plan;
    const u32 warp = kTileWide * kTileHigh;
    plan.all = tile_pixels(job.film.width, rows_of_bands(job.film.height, job.band, job.bands));
    if (plan.all == 0) return plan;
    plan.pixels = std::min(plan.all, std::max(most / job.samples / warp, 1u) * warp);
    plan.paths = plan.pixels * job.samples;
    plan.lights_each = u32(greatest(job.sky.sun_light) > 0) +
                       u32(job.settings.direct_lamps && job.scene.lights.count > 0) + u32(job.settings.fog);
    // Mirrors, water and glass on the way take some more rounds than bounces and the ray from the eye.
    plan.rounds = std::min(job.settings.bounces, kRoundsMost - 3) + 3;
    return plan;
}

u64 wave_bytes(const WavePlan& plan) {
    Layout bytes{nullptr};
    lay_out(plan, bytes);
    return bytes.used;
}

Wave lay_out_wave(const WavePlan& plan, void* memory) {
    Layout to{static_cast<u8*>(memory)};
    return lay_out(plan, to);
}

WaveJob wave_batch(const PathJob& job, const WavePlan& plan, const Wave& wave, u32 k) {
    WaveJob j;
    j.job = job;
    j.job.settings.events_most = std::clamp(job.settings.events_most, 1u, kEventsMost);
    j.wave = wave;
    j.pixel_width = pixel_width(job.frame.now);
    j.first = k * plan.pixels;
    j.pixels = std::min(plan.pixels, plan.all - j.first);
    j.rounds = plan.rounds;
    return j;
}

} // namespace vitrail::trace::cuda
