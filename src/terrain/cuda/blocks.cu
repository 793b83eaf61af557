// Blocks on a GPU: fill, draw, decorate and the grid of biomes; a block of threads a column, a thread a block column.
#include "terrain/cuda/launch.h"
#include "terrain/kernel/biome_grid_kernel.h"
#include "terrain/kernel/decorate_kernel.h"
#include "terrain/kernel/draw_kernel.h"
#include "terrain/kernel/fill_kernel.h"

#include <cuda_runtime.h>

namespace vitrail::cuda {

namespace {

using L = ScalarLanes;

// The tile of a wanted column among those with the features' ring.
__device__ i32 ringed(const BatchView& v, i32 column) {
    return (column / v.width + kFeatureReach) * (v.width + 2 * kFeatureReach) + column % v.width + kFeatureReach;
}

__global__ void fill_kernel(BatchView v) {
    __shared__ i32 top;
    __shared__ __align__(16) u8 shared_strata[sizeof(CoarseStrata)];
    CoarseStrata& strata = *reinterpret_cast<CoarseStrata*>(shared_strata);
    const i32 column = i32(blockIdx.x), index = i32(threadIdx.x);
    const GroundTile& ground = v.grounds[ringed(v, column)];
    if (index == 0) {
        top = kTerrainSeaLevel;
        strata.ready = ~0u;
    }
    // The points between which the strata's noise is interpolated, one a thread.
    const Row<L> own = thread_row(v.column(column, 0), index);
    for (i32 i = index; i < i32(v.tables->strata) * kCoarsePoints; i += i32(blockDim.x)) {
        const i32 s = i / kCoarsePoints, p = i % kCoarsePoints;
        const Spot<L> at{own.x, own.z, float(p % 5 * kCoarseStep), 0.0f, float(p / 5 * kCoarseStep)};
        strata.plane[s].point[p] = coarse_sample<L>(*v.tables, v.tables->stratum[s].noise, at, true);
    }
    __syncthreads();
    atomicMax(&top, block_above<L>(ground.top[index]));
    __syncthreads();
    BlockTile& out = v.blocks[column];
    fill_row<L>(*v.tables, own, ground, v.caves[ringed(v, column)], &strata, nullptr, top, out);
    for (i32 y = top; y < kTerrainMaxY; ++y)
        out.block[y << 8 | index] = kAir;
    if (index == 0) out.top = top;
}

__global__ void decorate_kernel(BatchView v, const DecoratorIndex* rows) {
    __shared__ i32 top;
    const i32 column = i32(blockIdx.x), index = i32(threadIdx.x), tile = ringed(v, column);
    BlockTile& out = v.blocks[column];
    if (index == 0) top = out.top;
    __syncthreads();
    const i32 end =
        decorate_row<L>(*v.tables, *rows, thread_row(v.column(column, 0), index), v.grounds[tile], v.caves[tile], out);
    if (end > 0) atomicMax(&top, end);
    __syncthreads();
    if (index == 0) out.top = top;
}

// Solids in the order of draw_stage; each thread keeps which of its voxels a solid has taken.
__global__ void draw_kernel(BatchView v) {
    __shared__ i32 top;
    const TerrainTables& t = *v.tables;
    const i32 column = i32(blockIdx.x), index = i32(threadIdx.x), span = v.width + 2 * kFeatureReach;
    const ColumnPos at = v.column(column, 0);
    const Row<L> row = thread_row(at, index);
    const i32 x = index & 15, z = index >> 4;
    Block* own = v.blocks[column].block + index;
    if (index == 0) top = v.blocks[column].top;
    __syncthreads();
    u32 taken[kTerrainHeight / 32] = {};
    i32 highest = -1;
    for (i32 near = 0; near < 49; ++near) {
        const FeatureTile& tile = v.features[(column / v.width + near / 7) * span + column % v.width + near % 7];
        for (u32 p = 0; p < tile.placements; ++p) {
            const Placement& place = tile.placement[p];
            if (draw_span(place, place.low, place.high, at).empty()) continue;
            const RandomKey key = t.feature[place.feature].key;
            for (u32 k = place.first; k < u32(place.first) + place.count; ++k) {
                const Primitive& s = tile.primitive[k];
                const DrawSpan box = draw_span(place, s.low, s.high, at);
                if (box.empty() || x < box.first_x || x > box.last_x || z < box.first_z || z > box.last_z) continue;
                const SolidFrame frame = solid_frame(s);
                for (i32 y = box.first_y; y <= box.last_y; ++y) {
                    if (taken[y >> 5] >> (y & 31) & 1) continue;
                    Block& here = own[y << 8];
                    u32 block = 0;
                    if (!draw_row<L>(t, s, frame, box, key, row, y, voxel_room<L>(u32(here)), block)) continue;
                    here = Block(block);
                    taken[y >> 5] |= 1u << (y & 31);
                    highest = y > highest ? y : highest;
                }
            }
        }
    }
    if (highest >= 0) atomicMax(&top, highest + 1);
    __syncthreads();
    if (index == 0) v.blocks[column].top = top;
}

__global__ void biome_kernel(BatchView v) {
    const i32 column = i32(blockIdx.x), tile = ringed(v, column);
    for (i32 cell = i32(threadIdx.x); cell < i32(sizeof(BiomeTile::biome)); cell += i32(blockDim.x))
        v.biomes[column].biome[cell] = grid_biome(*v.tables, v.grounds[tile], v.caves[tile], cell);
}

__global__ void decorator_index_kernel(const TerrainTables* tables, DecoratorIndex* out) {
    make_decorator_index<L>(*tables, *out);
}

} // namespace

u64 decorator_index_bytes() {
    return sizeof(DecoratorIndex);
}
void launch_decorator_index(const TerrainTables* tables, DecoratorIndex* out, cudaStream_t stream) {
    decorator_index_kernel<<<1, 1, 0, stream>>>(tables, out);
}

void launch_blocks(const BatchView& v, cudaStream_t stream) {
    const u32 columns = u32(v.columns(0));
    fill_kernel<<<columns, 256, 0, stream>>>(v);
    draw_kernel<<<columns, 256, 0, stream>>>(v);
    decorate_kernel<<<columns, 256, 0, stream>>>(v, v.decorators);
    biome_kernel<<<columns, 256, 0, stream>>>(v);
}

} // namespace vitrail::cuda
