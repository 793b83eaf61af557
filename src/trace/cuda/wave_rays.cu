// Rays of the wave: to what paths meet next, and straight to lights.
#include "trace/cuda/warp.cuh"
#include "trace/cuda/wave_launch.h"
#include "trace/cuda/wave_steps.h"

namespace vitrail::trace::cuda {

namespace {

// Of a multiprocessor: 96 registers a thread. With 64 more rays are under way, but what they spill takes longer (measured
// on an H200, docs/measurements.md).
constexpr u32 kBlock = 128, kBlocksAtOnce = 5;

__global__ void __launch_bounds__(kBlock, kBlocksAtOnce)
    wave_closest_kernel(const __grid_constant__ WaveJob j, u32 round) {
    WaveRound& now = j.wave.rounds[round];
    const u32 count = now.rays.n, lane = threadIdx.x % 32;
    for (u32 base = take_32(now.taken.n); base < count; base = take_32(now.taken.n)) {
        if (base + lane < count) closest_step(j, round, j.wave.going[round & 1][base + lane], Append{});
        __syncwarp();
    }
}

__global__ void __launch_bounds__(kBlock, kBlocksAtOnce)
    wave_lights_kernel(const __grid_constant__ WaveJob j, u32 round) {
    WaveRound& now = j.wave.rounds[round];
    const u32 count = now.lights.n, lane = threadIdx.x % 32;
    for (u32 base = take_32(now.lights_taken.n); base < count; base = take_32(now.lights_taken.n)) {
        if (base + lane < count) light_step(j, base + lane);
        __syncwarp();
    }
}

} // namespace

void launch_wave_closest(const WaveJob& j, u32 round, cudaStream_t stream) {
    static const u32 blocks = blocks_at_once(wave_closest_kernel, kBlock);
    wave_closest_kernel<<<blocks, kBlock, 0, stream>>>(j, round);
}

void launch_wave_lights(const WaveJob& j, u32 round, cudaStream_t stream) {
    static const u32 blocks = blocks_at_once(wave_lights_kernel, kBlock);
    wave_lights_kernel<<<blocks, kBlock, 0, stream>>>(j, round);
}

} // namespace vitrail::trace::cuda
