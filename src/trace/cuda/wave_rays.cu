// Rays of the wave: to what paths meet next, and straight to lights.
#include "trace/cuda/lean_rays.cuh"
#include "trace/cuda/wave_launch.h"
#include "trace/cuda/wave_steps.h"

namespace vitrail::trace::cuda {

namespace {

// Of a multiprocessor. Hard rays: 96 registers a thread; with 64 more rays are under way, but what they spill takes
// longer. Easy ones: 80; more under way make it no faster (measured on an H200, docs/measurements.md).
constexpr u32 kBlock = 128, kEasyBlocks = 6, kHardBlocks = 5;

// Warps take 32 of `count` in turns. do_one: number -> nothing.
template <class DoOne>
__device__ __forceinline__ void share_out(u32 count, u32& taken, DoOne&& do_one) {
    const u32 lane = threadIdx.x % 32;
    for (u32 base = take_32(taken); base < count; base = take_32(taken)) {
        if (base + lane < count) do_one(base + lane);
        __syncwarp();
    }
}

struct EasyPaths {
    const WaveJob& j;
    u32 round, path = 0;

    __device__ float most() const { return kFar; }
    __device__ Ray ray() const {
        u32 medium;
        return load_ray(j.wave, path, medium);
    }
    __device__ bool start(u32 n, AirWalk& w) {
        path = j.wave.going[round & 1][n];
        if (easy_closest_start(j, path, w)) return true;
        end(LeanEnd::hard, w);
        return false;
    }
    __device__ void end(LeanEnd end, const AirWalk& w) const { easy_closest_end(j, round, path, end, w, Append{}); }
    __device__ void fetch(u32 first, u32 count) const {
        fetch_lines(j.wave.going[round & 1] + first, count * u32(sizeof(u32)));
    }
};
struct EasyLights {
    const WaveJob& j;
    u32 round, place = 0;
    float reach = 0;

    __device__ float most() const { return reach; }
    __device__ Ray ray() const {
        u32 path;
        Purse purse;
        return load_light(j.wave, place, path, purse).ray;
    }
    __device__ bool start(u32 n, AirWalk& w) {
        place = n;
        if (easy_light_start(j, place, w, reach)) return true;
        end(LeanEnd::hard, w);
        return false;
    }
    __device__ void end(LeanEnd end, const AirWalk& w) const { easy_light_end(j, round, place, end, w, Append{}); }
    __device__ void fetch(u32 first, u32 count) const {
        for (u32 plane = 0; plane < 3; ++plane)
            fetch_lines(j.wave.light + plane * j.wave.paths * j.wave.lights_each + first, count * u32(sizeof(Word4)));
    }
};

// Rays of a camera, which are alike.
__global__ void __launch_bounds__(kBlock, kEasyBlocks)
    alike_closest_kernel(const __grid_constant__ WaveJob j, u32 round) {
    WaveRound& now = j.wave.rounds[round];
    share_out(now.rays.n, now.taken.n,
              [&](u32 n) { easy_closest_step(j, round, j.wave.going[round & 1][n], Append{}, device_boxes()); });
}
__global__ void __launch_bounds__(kBlock, kEasyBlocks)
    easy_closest_kernel(const __grid_constant__ WaveJob j, u32 round) {
    WaveRound& now = j.wave.rounds[round];
    EasyPaths ways{j, round};
    lean_rays(j.job.scene.grid, Share{now.rays.n, &now.taken.n}, ways, block_boxes());
}
__global__ void __launch_bounds__(kBlock, kHardBlocks)
    hard_closest_kernel(const __grid_constant__ WaveJob j, u32 round) {
    WaveRound& now = j.wave.rounds[round];
    share_out(now.hard.n, now.hard_taken.n,
              [&](u32 n) { closest_step(j, round, j.wave.going[(round + 1) & 1][n], Append{}); });
}

__global__ void __launch_bounds__(kBlock, kEasyBlocks)
    alike_lights_kernel(const __grid_constant__ WaveJob j, u32 round) {
    WaveRound& now = j.wave.rounds[round];
    share_out(now.lights.n, now.lights_taken.n, [&](u32 n) { easy_light_step(j, round, n, Append{}, device_boxes()); });
}
__global__ void __launch_bounds__(kBlock, kEasyBlocks)
    easy_lights_kernel(const __grid_constant__ WaveJob j, u32 round) {
    WaveRound& now = j.wave.rounds[round];
    EasyLights ways{j, round};
    lean_rays(j.job.scene.grid, Share{now.lights.n, &now.lights_taken.n}, ways, block_boxes());
}
__global__ void __launch_bounds__(kBlock, kHardBlocks)
    hard_lights_kernel(const __grid_constant__ WaveJob j, u32 round) {
    WaveRound& now = j.wave.rounds[round];
    share_out(now.hard_lights.n, now.hard_lights_taken.n, [&](u32 n) { light_step(j, j.wave.hard_lights[n]); });
}

// Rays of the first round are alike.
template <class Alike, class Scattered, class Hard>
void launch(Alike* alike, Scattered* scattered, Hard* hard, const u32 (&blocks)[3], const WaveJob& j, u32 round,
            cudaStream_t stream) {
    if (round == 0)
        alike<<<blocks[0], kBlock, 0, stream>>>(j, round);
    else
        scattered<<<blocks[1], kBlock, 0, stream>>>(j, round);
    hard<<<blocks[2], kBlock, 0, stream>>>(j, round);
}

} // namespace

void launch_wave_closest(const WaveJob& j, u32 round, cudaStream_t stream) {
    static const u32 blocks[3] = {blocks_at_once(alike_closest_kernel, kBlock),
                                  blocks_at_once(easy_closest_kernel, kBlock),
                                  blocks_at_once(hard_closest_kernel, kBlock)};
    launch(alike_closest_kernel, easy_closest_kernel, hard_closest_kernel, blocks, j, round, stream);
}

void launch_wave_lights(const WaveJob& j, u32 round, cudaStream_t stream) {
    static const u32 blocks[3] = {blocks_at_once(alike_lights_kernel, kBlock),
                                  blocks_at_once(easy_lights_kernel, kBlock),
                                  blocks_at_once(hard_lights_kernel, kBlock)};
    launch(alike_lights_kernel, easy_lights_kernel, hard_lights_kernel, blocks, j, round, stream);
}

} // namespace vitrail::trace::cuda
