// Rays by themselves: those with an easy way in one kernel, the others listed for a second one.
#include "trace/cuda/launch.h"
#include "trace/cuda/warp.cuh"
#include "trace/kernel/lean_walk.h"
#include "trace/kernel/traverse.h"

namespace vitrail::trace::cuda {

namespace {

// 128 registers a thread: more rays under way make it no faster (docs/measurements.md).
constexpr u32 kBlock = 128, kLeanBlocks = 4, kHardBlocks = 4;

__global__ void __launch_bounds__(kBlock, kLeanBlocks)
    closest_kernel(const __grid_constant__ SceneView scene, const Ray* rays, u32 count, u32 medium, Hit* hits,
                   const RayList hard) {
    const u32 i = blockIdx.x * kBlock + threadIdx.x;
    if (i >= count) return;
    Hit hit;
    if (lean_closest(scene, rays[i], medium, hit))
        hits[i] = hit;
    else
        hard.ids[Append{}(*hard.count)] = i;
}

__global__ void __launch_bounds__(kBlock, kLeanBlocks)
    shadows_kernel(const __grid_constant__ SceneView scene, const Ray* rays, u32 count, u32 medium, u8* lit,
                   const RayList hard) {
    const u32 i = blockIdx.x * kBlock + threadIdx.x;
    if (i >= count) return;
    const LeanEnd end = lean_shadow(scene, rays[i], kFar, medium);
    if (end == LeanEnd::hard)
        hard.ids[Append{}(*hard.count)] = i;
    else
        lit[i] = end == LeanEnd::passed;
}

__global__ void __launch_bounds__(kBlock, kHardBlocks)
    hard_closest_kernel(const __grid_constant__ SceneView scene, const Ray* rays, u32 medium, Hit* hits,
                        const RayList hard) {
    const u32 count = *hard.count;
    for (u32 n = blockIdx.x * kBlock + threadIdx.x; n < count; n += gridDim.x * kBlock) {
        Hit hit;
        closest_hit(scene, rays[hard.ids[n]], kFar, medium, hit);
        hits[hard.ids[n]] = hit;
    }
}

__global__ void __launch_bounds__(kBlock, kHardBlocks)
    hard_shadows_kernel(const __grid_constant__ SceneView scene, const Ray* rays, u32 medium, u8* lit,
                        const RayList hard) {
    const u32 count = *hard.count;
    for (u32 n = blockIdx.x * kBlock + threadIdx.x; n < count; n += gridDim.x * kBlock)
        lit[hard.ids[n]] = !shadowed(scene, rays[hard.ids[n]], kFar, medium, [](const Hit&) { return false; });
}

u32 blocks_of(u32 count) {
    return (count + kBlock - 1) / kBlock;
}

} // namespace

void launch_closest(const SceneView& scene, const Ray* rays, u32 count, u32 medium, Hit* hits, const RayList& hard,
                    cudaStream_t stream) {
    if (count == 0) return;
    static const u32 blocks = blocks_at_once(hard_closest_kernel, kBlock);
    cudaMemsetAsync(hard.count, 0, sizeof(u32), stream);
    closest_kernel<<<blocks_of(count), kBlock, 0, stream>>>(scene, rays, count, medium, hits, hard);
    hard_closest_kernel<<<blocks, kBlock, 0, stream>>>(scene, rays, medium, hits, hard);
}

void launch_shadows(const SceneView& scene, const Ray* rays, u32 count, u32 medium, u8* lit, const RayList& hard,
                    cudaStream_t stream) {
    if (count == 0) return;
    static const u32 blocks = blocks_at_once(hard_shadows_kernel, kBlock);
    cudaMemsetAsync(hard.count, 0, sizeof(u32), stream);
    shadows_kernel<<<blocks_of(count), kBlock, 0, stream>>>(scene, rays, count, medium, lit, hard);
    hard_shadows_kernel<<<blocks, kBlock, 0, stream>>>(scene, rays, medium, lit, hard);
}

} // namespace vitrail::trace::cuda
