// Rays of the wave: to what paths meet next, and straight to lights.
#include "trace/cuda/warp.cuh"
#include "trace/cuda/wave_launch.h"
#include "trace/cuda/wave_steps.h"

namespace vitrail::trace::cuda {

namespace {

// Of a multiprocessor. Hard rays: 96 registers a thread; with 64 more rays are under way, but what they spill takes
// longer. Easy ones: 128; more under way make it no faster (measured on an H200, docs/measurements.md).
constexpr u32 kBlock = 128, kEasyBlocks = 4, kHardBlocks = 5;

// Warps take 32 of `count` in turns. do_one: number -> nothing.
template <class DoOne>
__device__ __forceinline__ void share_out(u32 count, u32& taken, DoOne&& do_one) {
    const u32 lane = threadIdx.x % 32;
    for (u32 base = take_32(taken); base < count; base = take_32(taken)) {
        if (base + lane < count) do_one(base + lane);
        __syncwarp();
    }
}

__global__ void __launch_bounds__(kBlock, kEasyBlocks)
    easy_closest_kernel(const __grid_constant__ WaveJob j, u32 round) {
    WaveRound& now = j.wave.rounds[round];
    share_out(now.rays.n, now.taken.n,
              [&](u32 n) { easy_closest_step(j, round, j.wave.going[round & 1][n], Append{}); });
}
__global__ void __launch_bounds__(kBlock, kHardBlocks)
    hard_closest_kernel(const __grid_constant__ WaveJob j, u32 round) {
    WaveRound& now = j.wave.rounds[round];
    share_out(now.hard.n, now.hard_taken.n,
              [&](u32 n) { closest_step(j, round, j.wave.going[(round + 1) & 1][n], Append{}); });
}

__global__ void __launch_bounds__(kBlock, kEasyBlocks)
    easy_lights_kernel(const __grid_constant__ WaveJob j, u32 round) {
    WaveRound& now = j.wave.rounds[round];
    share_out(now.lights.n, now.lights_taken.n, [&](u32 n) { easy_light_step(j, round, n, Append{}); });
}
__global__ void __launch_bounds__(kBlock, kHardBlocks)
    hard_lights_kernel(const __grid_constant__ WaveJob j, u32 round) {
    WaveRound& now = j.wave.rounds[round];
    share_out(now.hard_lights.n, now.hard_lights_taken.n, [&](u32 n) { light_step(j, j.wave.hard_lights[n]); });
}

} // namespace

void launch_wave_closest(const WaveJob& j, u32 round, cudaStream_t stream) {
    static const u32 easy = blocks_at_once(easy_closest_kernel, kBlock),
                     hard = blocks_at_once(hard_closest_kernel, kBlock);
    easy_closest_kernel<<<easy, kBlock, 0, stream>>>(j, round);
    hard_closest_kernel<<<hard, kBlock, 0, stream>>>(j, round);
}

void launch_wave_lights(const WaveJob& j, u32 round, cudaStream_t stream) {
    static const u32 easy = blocks_at_once(easy_lights_kernel, kBlock),
                     hard = blocks_at_once(hard_lights_kernel, kBlock);
    easy_lights_kernel<<<easy, kBlock, 0, stream>>>(j, round);
    hard_lights_kernel<<<hard, kBlock, 0, stream>>>(j, round);
}

} // namespace vitrail::trace::cuda
