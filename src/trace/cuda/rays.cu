// Rays by themselves: a thread a ray.
#include "trace/cuda/launch.h"
#include "trace/kernel/traverse.h"

#include <cuda_runtime.h>

namespace vitrail::trace::cuda {

namespace {

constexpr u32 kBlock = 128;

__global__ void __launch_bounds__(kBlock)
    closest_kernel(const __grid_constant__ SceneView scene, const Ray* rays, u32 count, u32 medium, Hit* hits) {
    const u32 i = blockIdx.x * kBlock + threadIdx.x;
    if (i >= count) return;
    Hit hit;
    closest_hit(scene, rays[i], kFar, medium, hit);
    hits[i] = hit;
}

__global__ void __launch_bounds__(kBlock)
    shadows_kernel(const __grid_constant__ SceneView scene, const Ray* rays, u32 count, u32 medium, u8* lit) {
    const u32 i = blockIdx.x * kBlock + threadIdx.x;
    if (i >= count) return;
    lit[i] = !shadowed(scene, rays[i], kFar, medium, [](const Hit&) { return false; });
}

u32 blocks_of(u32 count) {
    return (count + kBlock - 1) / kBlock;
}

} // namespace

void launch_closest(const SceneView& scene, const Ray* rays, u32 count, u32 medium, Hit* hits, cudaStream_t stream) {
    if (count) closest_kernel<<<blocks_of(count), kBlock, 0, stream>>>(scene, rays, count, medium, hits);
}

void launch_shadows(const SceneView& scene, const Ray* rays, u32 count, u32 medium, u8* lit, cudaStream_t stream) {
    if (count) shadows_kernel<<<blocks_of(count), kBlock, 0, stream>>>(scene, rays, count, medium, lit);
}

} // namespace vitrail::trace::cuda
