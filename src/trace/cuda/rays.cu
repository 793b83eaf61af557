// Rays by themselves: those with an easy way in one kernel, the others listed for a second one.
#include "trace/cuda/launch.h"
#include "trace/cuda/lean_rays.cuh"
#include "trace/cuda/words.h"
#include "trace/kernel/traverse.h"

namespace vitrail::trace::cuda {

namespace {

__device__ Ray ray_at(const RayJob& j, u32 i) {
    return ray_of(j.rays[i], j.rays[i + j.count], j.rays[i + 2 * j.count]);
}

// What is asked of a ray. end: false where it is not known; hard: by all means.
struct Nearest {
    static __device__ bool end(const RayJob& j, u32 i, LeanEnd end, const AirWalk& w) {
        Hit hit;
        if (end == LeanEnd::hard || (end == LeanEnd::stopped && !lean_hit(j.scene, w, hit))) return false;
        put(j, i, hit);
        return true;
    }
    static __device__ void hard(const RayJob& j, u32 i) {
        Hit hit;
        closest_hit(j.scene, ray_at(j, i), kFar, j.medium, hit);
        put(j, i, hit);
    }
    static __device__ void put(const RayJob& j, u32 i, const Hit& hit) {
        words_of(hit, j.hits[i], j.hits[i + j.count]);
    }
};
struct Shadow {
    static __device__ bool end(const RayJob& j, u32 i, LeanEnd end, const AirWalk& w) {
        if (end == LeanEnd::hard || (end == LeanEnd::stopped && !opaque_in(j.scene.grid, w))) return false;
        j.lit[i] = end == LeanEnd::passed;
        return true;
    }
    static __device__ void hard(const RayJob& j, u32 i) {
        j.lit[i] = !shadowed(j.scene, ray_at(j, i), kFar, j.medium, [](const Hit&) { return false; });
    }
};

template <class Asked>
struct Rays {
    const RayJob& j;
    u32 id = 0;

    __device__ float most() const { return kFar; }
    __device__ Ray ray() const { return ray_at(j, id); }
    __device__ bool start(u32 n, AirWalk& w) {
        id = n;
        if (lean_start(j.scene, ray(), kFar, j.medium, w)) return true;
        end(LeanEnd::hard, w);
        return false;
    }
    __device__ void end(LeanEnd end, const AirWalk& w) const {
        if (!Asked::end(j, id, end, w)) j.hard[Append{}(j.counters[0])] = id;
    }
    __device__ void fetch(u32 first, u32 count) const {
        for (u32 plane = 0; plane < kRayWords; ++plane)
            fetch_lines(j.rays + plane * j.count + first, count * u32(sizeof(Word4)));
    }
};

// 80 registers a thread: more rays under way make it no faster (docs/measurements.md).
constexpr u32 kBlock = 128, kLeanBlocks = 6, kHardBlocks = 4;

template <class Asked>
__global__ void __launch_bounds__(kBlock, kLeanBlocks) alike_kernel(const __grid_constant__ RayJob j) {
    const u32 i = blockIdx.x * kBlock + threadIdx.x;
    if (i >= j.count) return;
    AirWalk w;
    const LeanEnd end = lean_walk(j.scene, ray_at(j, i), kFar, j.medium, w, device_boxes());
    Rays<Asked>{j, i}.end(end, w);
}
template <class Asked>
__global__ void __launch_bounds__(kBlock, kLeanBlocks) scattered_kernel(const __grid_constant__ RayJob j) {
    Rays<Asked> ways{j};
    lean_rays(j.scene.grid, Share{j.count, &j.counters[1]}, ways, block_boxes());
}
template <class Asked>
__global__ void __launch_bounds__(kBlock, kHardBlocks) hard_kernel(const __grid_constant__ RayJob j) {
    const u32 count = j.counters[0];
    for (u32 n = blockIdx.x * kBlock + threadIdx.x; n < count; n += gridDim.x * kBlock)
        Asked::hard(j, j.hard[n]);
}

template <class Asked>
void launch(const RayJob& j, cudaStream_t stream) {
    if (j.count == 0) return;
    static const u32 scattered = blocks_at_once(scattered_kernel<Asked>, kBlock),
                     hard = blocks_at_once(hard_kernel<Asked>, kBlock);
    cudaMemsetAsync(j.counters, 0, kRayCounters * sizeof(u32), stream);
    if (j.alike)
        alike_kernel<Asked><<<(j.count + kBlock - 1) / kBlock, kBlock, 0, stream>>>(j);
    else
        scattered_kernel<Asked><<<scattered, kBlock, 0, stream>>>(j);
    hard_kernel<Asked><<<hard, kBlock, 0, stream>>>(j);
}

} // namespace

void launch_closest(const RayJob& job, cudaStream_t stream) {
    launch<Nearest>(job, stream);
}
void launch_shadows(const RayJob& job, cudaStream_t stream) {
    launch<Shadow>(job, stream);
}

} // namespace vitrail::trace::cuda
