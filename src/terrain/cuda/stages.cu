// The stages on a GPU: thin wrappers around the kernels that the CPU runs too. One thread is one block column (lattice:
// one point; features: one column) unless it is said otherwise.
#include "terrain/cuda/launch.h"
#include "terrain/kernel/biome_grid_kernel.h"
#include "terrain/kernel/cave_kernel.h"
#include "terrain/kernel/erosion_kernel.h"
#include "terrain/kernel/placement_kernel.h"

#include <cuda_runtime.h>

namespace vitrail::cuda {

namespace {

using L = ScalarLanes;

__global__ void land_kernel(BatchView v) {
    const i32 tile = i32(blockIdx.x);
    land_row<L>(*v.tables, thread_row(v.column(tile, kLandRing), i32(threadIdx.x)), v.lands[tile]);
}

// Ground: planes over all land tiles, then passes, then the tiles that are wanted.

__device__ i32 plane_index(const BatchView& v, i32 x, i32 z) {
    return z * v.plane_stride() + x;
}

// surface[0] holds heights.
__global__ void gather_heights(BatchView v) {
    const i32 span = v.width + 2 * kLandRing, tile = i32(blockIdx.x), i = i32(threadIdx.x);
    v.surface[0][plane_index(v, (tile % span) * 16 + (i & 15), (tile / span) * 16 + (i >> 4))] =
        v.lands[tile].height[i];
}

__global__ void lay_kernel(BatchView v) {
    const TerrainTables& t = *v.tables;
    const i32 span = v.width + 2 * kLandRing, tile = i32(blockIdx.x), i = i32(threadIdx.x);
    const i32 x = (tile % span) * 16 + (i & 15), z = (tile / span) * 16 + (i >> 4), at = plane_index(v, x, z);
    const float height = v.surface[0][at];
    float loose[kLooseMost] = {};
    // The outermost ring has no neighbors to tell its slope, and nobody feels it.
    if (x > 0 && z > 0 && x < v.plane_stride() - 1 && z < v.plane_rows() - 1) {
        float attribute[kAttributesMost];
        load_attributes<L>(t, v.lands[tile], i, attribute);
        lay_loose<L>(t, attribute, slope_at<L>(v.surface[0] + at, v.plane_stride()), loose);
    }
    v.floor[at] = rock_below<L>(t, height, loose);
    for (u32 l = 0; l < t.loose; ++l)
        v.loose[i32(l) * v.plane_size() + at] = loose[l];
    const i32 gx = (tile % span) - kGroundReach, gz = (tile / span) - kGroundReach, gspan = v.width + 2 * kFeatureReach;
    if (gx >= 0 && gz >= 0 && gx < gspan && gz < v.depth + 2 * kFeatureReach) {
        GroundTile& out = v.grounds[gz * gspan + gx];
        out.rock[i] = v.floor[at];
        out.land[i] = height;
        for (u32 a = 0; a < t.attributes; ++a)
            out.attribute[a][i] = v.lands[tile].attribute[a][i];
    }
}

__global__ void raise_kernel(BatchView v, u32 layer) {
    const i32 at = i32(blockIdx.x * blockDim.x + threadIdx.x);
    if (at >= v.plane_size()) return;
    const float s = v.floor[at] + v.loose[i32(layer) * v.plane_size() + at];
    v.surface[0][at] = s;
    v.surface[1][at] = s; // the outermost ring stays as it is
}

// Where the layer is absent a pass is the identity, and both planes hold the floor since the layer was raised.
__global__ void erode_kernel(BatchView v, u32 layer, i32 from, Repose repose) {
    const i32 x = i32(blockIdx.x * blockDim.x + threadIdx.x), z = i32(blockIdx.y * blockDim.y + threadIdx.y);
    if (x < 1 || z < 1 || x >= v.plane_stride() - 1 || z >= v.plane_rows() - 1) return;
    const i32 at = plane_index(v, x, z), stride = v.plane_stride();
    if (v.loose[i32(layer) * v.plane_size() + at] == 0.0f) return;
    const float* here = v.surface[from] + at;
    v.surface[from ^ 1][at] = eroded<L>(here - stride, here, here + stride, v.floor[at], repose);
}

__global__ void settle_kernel(BatchView v, u32 layer, i32 from) {
    const i32 at = i32(blockIdx.x * blockDim.x + threadIdx.x);
    if (at >= v.plane_size()) return;
    const float floor = v.floor[at], left = v.surface[from][at] - floor;
    v.loose[i32(layer) * v.plane_size() + at] = left;
    v.floor[at] = floor + left;
}

__global__ void ground_kernel(BatchView v) {
    const i32 span = v.width + 2 * kFeatureReach, tile = i32(blockIdx.x), i = i32(threadIdx.x);
    const i32 at =
        plane_index(v, (tile % span + kGroundReach) * 16 + (i & 15), (tile / span + kGroundReach) * 16 + (i >> 4));
    GroundTile& out = v.grounds[tile];
    for (u32 l = 0; l < v.tables->loose; ++l)
        out.loose[l][i] = v.loose[i32(l) * v.plane_size() + at];
    out.top[i] = v.floor[at];
}

// Thread a point and level.
__global__ void lattice_kernel(BatchView v) {
    const i32 tile = i32(blockIdx.x);
    for (i32 i = i32(threadIdx.x); i < kLatticeLevels * 16; i += i32(blockDim.x))
        lattice_level<L>(*v.tables, thread_point(v.column(tile, kFeatureReach, 1), i & 15), i >> 4, v.lattices[tile]);
}

__global__ void caves_kernel(BatchView v) {
    const i32 tile = i32(blockIdx.x), span = v.width + 2 * kFeatureReach;
    const LatticeTile* own = v.lattices + (tile / span) * (span + 1) + tile % span;
    const LatticeTile* lattices[4] = {own, own + 1, own + span + 1, own + span + 2};
    cave_row<L>(*v.tables, v.grounds[tile], lattices, thread_row(v.column(tile, kFeatureReach), i32(threadIdx.x)),
                ~u64(0), v.caves[tile]);
}

// Thread a column: a chain of few, long decisions.
__global__ void features_kernel(BatchView v) {
    const i32 tile = i32(blockIdx.x * blockDim.x + threadIdx.x);
    if (tile >= v.columns(kFeatureReach)) return;
    place_features<L>(*v.tables, v.column(tile, kFeatureReach), v.grounds[tile], v.caves[tile], v.features[tile]);
}

u32 blocks_of(i32 count, u32 size) {
    return (u32(count) + size - 1) / size;
}

} // namespace

void launch_land(const BatchView& v, cudaStream_t stream) {
    land_kernel<<<u32(v.columns(kLandRing)), 256, 0, stream>>>(v);
}

void launch_ground(const BatchView& v, const BatchRows& rows, cudaStream_t stream) {
    const u32 tiles = u32(v.columns(kLandRing)), flat = blocks_of(v.plane_size(), 256);
    const dim3 size(32, 8), grid(blocks_of(v.plane_stride(), 32), blocks_of(v.plane_rows(), 8));
    gather_heights<<<tiles, 256, 0, stream>>>(v);
    lay_kernel<<<tiles, 256, 0, stream>>>(v);
    for (u32 l = 0; l < rows.loose; ++l) {
        raise_kernel<<<flat, 256, 0, stream>>>(v, l);
        i32 from = 0;
        for (u32 pass = 0; pass < rows.passes; ++pass, from ^= 1)
            erode_kernel<<<grid, size, 0, stream>>>(v, l, from, Repose{rows.repose[l], rows.repose[l] * kDiagonal});
        settle_kernel<<<flat, 256, 0, stream>>>(v, l, from);
    }
    ground_kernel<<<u32(v.columns(kFeatureReach)), 256, 0, stream>>>(v);
}

void launch_lattice(const BatchView& v, cudaStream_t stream) {
    lattice_kernel<<<u32((v.width + 2 * kFeatureReach + 1) * (v.depth + 2 * kFeatureReach + 1)), 128, 0, stream>>>(v);
}

void launch_caves(const BatchView& v, cudaStream_t stream) {
    caves_kernel<<<u32(v.columns(kFeatureReach)), 256, 0, stream>>>(v);
}

void launch_features(const BatchView& v, cudaStream_t stream) {
    features_kernel<<<blocks_of(v.columns(kFeatureReach), 32), 32, 0, stream>>>(v);
}

} // namespace vitrail::cuda
