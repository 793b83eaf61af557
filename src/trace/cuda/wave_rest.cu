// What is left after the wave's rounds: few paths, each followed to its end by a thread.
#include "trace/cuda/warp.cuh"
#include "trace/cuda/wave_launch.h"
#include "trace/cuda/wave_steps.h"

namespace vitrail::trace::cuda {

namespace {

constexpr u32 kBlock = 64;

__global__ void __launch_bounds__(kBlock) rest_kernel(const __grid_constant__ WaveJob j) {
    WaveRound& left = j.wave.rounds[j.rounds];
    const u32 count = left.rays.n, lane = threadIdx.x % 32;
    u32 rays = 0;
    for (u32 base = take_32(left.taken.n); base < count; base = take_32(left.taken.n)) {
        if (base + lane < count) rays += rest_step(j, j.wave.going[j.rounds & 1][base + lane]);
        __syncwarp();
    }
    add_count(&j.job.counts->rays, rays);
}

} // namespace

void launch_rest(const WaveJob& j, cudaStream_t stream) {
    static const u32 blocks = blocks_at_once(rest_kernel, kBlock);
    rest_kernel<<<blocks, kBlock, 0, stream>>>(j);
}

} // namespace vitrail::trace::cuda
