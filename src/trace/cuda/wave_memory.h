// How many paths go on together, and their memory. Host only; tests lay it out in the host's memory.
#pragma once

#include "base/result.h"
#include "trace/cuda/wave.h"

namespace vitrail::trace::cuda {

// How a job's pixels are cut into batches: each of `pixels` (the last one: of those that are left), a multiple of a
// warp, with all of their samples.
struct WavePlan {
    u32 all = 0;         // pixels in tiles
    u32 pixels = 0;      // of a batch; 0: there is nothing to trace
    u32 paths = 0;       // of a batch
    u32 lights_each = 0; // see Wave
    u32 rounds = 0;
    u32 batches() const { return pixels ? (all + pixels - 1) / pixels : 0; }
};
// most: paths of a batch, at least 32 times the job's samples.
WavePlan plan_wave(const PathJob& job, u32 most = kWaveMost);

u64 wave_bytes(const WavePlan& plan);

inline constexpr u32 kWaveLeast = 1u << 16; // paths of a batch that a device must have room for

// The plan whose memory `take` (Result<>(u64 bytes)) could give; where that is more than there is (ErrorCode::limit) a
// batch has half as many paths, and so on. most: where to begin; then where it ended, for the next time. Pictures do
// not depend on it. Errors: the last one of take.
template <class Take>
Result<WavePlan> fit_wave(const PathJob& job, u32& most, Take&& take) {
    for (;; most /= 2) {
        const WavePlan plan = plan_wave(job, most);
        auto taken = take(wave_bytes(plan));
        if (taken) return plan;
        if (taken.error().code != ErrorCode::limit || most <= kWaveLeast) return tl::unexpected(taken.error());
    }
}

// memory: aligned to 256 bytes.
Wave lay_out_wave(const WavePlan& plan, void* memory);

// Number k of the plan's batches.
WaveJob wave_batch(const PathJob& job, const WavePlan& plan, const Wave& wave, u32 k);

} // namespace vitrail::trace::cuda
