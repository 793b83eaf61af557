// Events of the wave: of paths that met something, and of those that see the sky.
#define VITRAIL_INLINE_CALLS 1
#include "trace/cuda/warp.cuh"
#include "trace/cuda/wave_launch.h"
#include "trace/cuda/wave_steps.h"

namespace vitrail::trace::cuda {

namespace {

constexpr u32 kBlock = 128;

__global__ void __launch_bounds__(kBlock, 2) surfaces_kernel(const __grid_constant__ WaveJob j, u32 round) {
    const u32 count = j.wave.rounds[round].met.n;
    for (u32 i = blockIdx.x * kBlock + threadIdx.x; i < count; i += gridDim.x * kBlock)
        event_step<true>(j, round, j.wave.ends[i], Append{});
}

__global__ void __launch_bounds__(kBlock) skies_kernel(const __grid_constant__ WaveJob j, u32 round) {
    const u32 count = j.wave.rounds[round].missed.n;
    for (u32 i = blockIdx.x * kBlock + threadIdx.x; i < count; i += gridDim.x * kBlock)
        event_step<false>(j, round, j.wave.ends[j.wave.paths - 1 - i], Append{});
}

} // namespace

void launch_surfaces(const WaveJob& j, u32 round, cudaStream_t stream) {
    static const u32 blocks = blocks_at_once(surfaces_kernel, kBlock);
    surfaces_kernel<<<blocks, kBlock, 0, stream>>>(j, round);
}

void launch_skies(const WaveJob& j, u32 round, cudaStream_t stream) {
    static const u32 blocks = blocks_at_once(skies_kernel, kBlock);
    skies_kernel<<<blocks, kBlock, 0, stream>>>(j, round);
}

} // namespace vitrail::trace::cuda
