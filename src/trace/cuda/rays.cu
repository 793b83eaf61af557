// Rays by themselves.
#include "trace/cuda/launch.h"
#include "trace/cuda/ray_loops.cuh"

#include <cuda_runtime.h>

#include <iterator>

namespace vitrail::trace::cuda {

namespace {

constexpr u32 kBlock = 128;

// Rays of an array, in one medium; panes are passed.
struct ArrayJob {
    const Ray* rays;
    u32 in;
    Hit* hits;
    u8* lit;

    __device__ __forceinline__ Ray ray(u32 id) const { return rays[id]; }
    __device__ __forceinline__ float t_max(u32) const { return kFar; }
    __device__ __forceinline__ u32 medium(u32) const { return in; }
    __device__ __forceinline__ void met(u32 id, bool, const Hit& hit) const { hits[id] = hit; }
    __device__ __forceinline__ bool pane(u32, const Hit&) const { return false; }
    __device__ __forceinline__ void shaded(u32 id, bool dark) const { lit[id] = !dark; }
};

template <class Feed, u32 kBlocks>
__global__ void __launch_bounds__(kBlock, kBlocks)
    closest_kernel(const __grid_constant__ SceneView scene, const __grid_constant__ ArrayJob job, const Feed feed,
                   u32 wait) {
    closest_rays(scene, feed, wait, job);
}

template <class Feed, u32 kBlocks>
__global__ void __launch_bounds__(kBlock, kBlocks)
    shadows_kernel(const __grid_constant__ SceneView scene, const __grid_constant__ ArrayJob job, const Feed feed,
                   u32 wait) {
    shadow_rays(scene, feed, wait, job);
}

__global__ void __launch_bounds__(kBlock)
    closest_alone_kernel(const __grid_constant__ SceneView scene, const ArrayJob job, u32 count) {
    const u32 i = blockIdx.x * kBlock + threadIdx.x;
    if (i >= count) return;
    Hit hit;
    closest_hit(scene, job.rays[i], kFar, job.in, hit);
    job.hits[i] = hit;
}

__global__ void __launch_bounds__(kBlock)
    shadows_alone_kernel(const __grid_constant__ SceneView scene, const ArrayJob job, u32 count) {
    const u32 i = blockIdx.x * kBlock + threadIdx.x;
    if (i >= count) return;
    job.lit[i] = !shadowed(scene, job.rays[i], kFar, job.in, [](const Hit&) { return false; });
}

u32 blocks_of(u32 count) {
    return (count + kBlock - 1) / kBlock;
}

struct Launch {
    const SceneView& scene;
    ArrayJob job;
    u32 count;
    u32* counter;
    bool shadow;
    u32 wait;
    cudaStream_t stream;
};

void launch_alone(const Launch& l) {
    if (l.shadow)
        shadows_alone_kernel<<<blocks_of(l.count), kBlock, 0, l.stream>>>(l.scene, l.job, l.count);
    else
        closest_alone_kernel<<<blocks_of(l.count), kBlock, 0, l.stream>>>(l.scene, l.job, l.count);
}

template <u32 kBlocks>
void launch_threads(const Launch& l) {
    const PerThread feed{l.count};
    if (l.shadow)
        shadows_kernel<PerThread, kBlocks><<<blocks_of(l.count), kBlock, 0, l.stream>>>(l.scene, l.job, feed, l.wait);
    else
        closest_kernel<PerThread, kBlocks><<<blocks_of(l.count), kBlock, 0, l.stream>>>(l.scene, l.job, feed, l.wait);
}

// As many blocks as the device holds at once.
u32 resident_blocks(const void* kernel) {
    int device = 0, processors = 1, blocks = 1;
    cudaGetDevice(&device);
    cudaDeviceGetAttribute(&processors, cudaDevAttrMultiProcessorCount, device);
    cudaOccupancyMaxActiveBlocksPerMultiprocessor(&blocks, kernel, int(kBlock), 0);
    return u32(processors * (blocks > 0 ? blocks : 1));
}

template <u32 kBlocks>
void launch_warps(const Launch& l) {
    const FromCounter feed{l.count, l.counter};
    static const u32 blocks[2] = {
        resident_blocks(reinterpret_cast<const void*>(&closest_kernel<FromCounter, kBlocks>)),
        resident_blocks(reinterpret_cast<const void*>(&shadows_kernel<FromCounter, kBlocks>))};
    cudaMemsetAsync(l.counter, 0, sizeof(u32), l.stream);
    const u32 most = blocks_of(l.count), n = blocks[l.shadow] < most ? blocks[l.shadow] : most;
    if (l.shadow)
        shadows_kernel<FromCounter, kBlocks><<<n, kBlock, 0, l.stream>>>(l.scene, l.job, feed, l.wait);
    else
        closest_kernel<FromCounter, kBlocks><<<n, kBlock, 0, l.stream>>>(l.scene, l.job, feed, l.wait);
}

struct Variant {
    const char* name;
    void (*launch)(const Launch&);
    u32 wait = 0;
};
constexpr Variant kVariants[] = {
    {"alone", launch_alone},
    {"threads, 6 blocks, wait 8", launch_threads<6>, 8},
    {"threads, 6 blocks, wait 32", launch_threads<6>, 32},
    {"threads, 8 blocks, wait 8", launch_threads<8>, 8},
    {"threads, 8 blocks, wait 32", launch_threads<8>, 32},
    {"threads, 10 blocks, wait 8", launch_threads<10>, 8},
    {"threads, 10 blocks, wait 32", launch_threads<10>, 32},
    {"warps, 6 blocks, wait 4", launch_warps<6>, 4},
    {"warps, 6 blocks, wait 8", launch_warps<6>, 8},
    {"warps, 6 blocks, wait 12", launch_warps<6>, 12},
    {"warps, 6 blocks, wait 16", launch_warps<6>, 16},
    {"warps, 8 blocks, wait 4", launch_warps<8>, 4},
    {"warps, 8 blocks, wait 8", launch_warps<8>, 8},
    {"warps, 8 blocks, wait 12", launch_warps<8>, 12},
    {"warps, 8 blocks, wait 16", launch_warps<8>, 16},
    {"warps, 10 blocks, wait 4", launch_warps<10>, 4},
    {"warps, 10 blocks, wait 8", launch_warps<10>, 8},
    {"warps, 10 blocks, wait 12", launch_warps<10>, 12},
    {"warps, 10 blocks, wait 16", launch_warps<10>, 16},
};
} // namespace

u32 ray_variants() {
    return u32(std::size(kVariants));
}
const char* ray_variant_name(u32 variant) {
    return kVariants[variant].name;
}

void launch_closest(const SceneView& scene, const Ray* rays, u32 count, u32 medium, Hit* hits, u32* counter,
                    cudaStream_t stream, u32 variant) {
    if (count)
        kVariants[variant].launch(
            {scene, {rays, medium, hits, nullptr}, count, counter, false, kVariants[variant].wait, stream});
}

void launch_shadows(const SceneView& scene, const Ray* rays, u32 count, u32 medium, u8* lit, u32* counter,
                    cudaStream_t stream, u32 variant) {
    if (count)
        kVariants[variant].launch(
            {scene, {rays, medium, nullptr, lit}, count, counter, true, kVariants[variant].wait, stream});
}

} // namespace vitrail::trace::cuda
