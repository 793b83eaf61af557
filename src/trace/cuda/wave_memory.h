// How many paths go on together, and their memory. Host only; tests lay it out in the host's memory.
#pragma once

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
// memory: aligned to 256 bytes.
Wave lay_out_wave(const WavePlan& plan, void* memory);

// Number k of the plan's batches.
WaveJob wave_batch(const PathJob& job, const WavePlan& plan, const Wave& wave, u32 k);

} // namespace vitrail::trace::cuda
