// What device.cpp (the host's compiler) and stages.cu (nvcc) share: where a batch's tiles lie on the device, and one
// launch a stage. No launch waits for another stream.
#pragma once

#include "terrain/tiles.h"

struct CUstream_st; // cudaStream_t points to it

namespace vitrail {
struct DecoratorIndex;
}
namespace vitrail::cuda {

// Wanted: width x depth columns from `first`. Around them lie the reaches: tiles row by row, each array from its own
// corner.
inline constexpr i32 kLandRing = kFeatureReach + kGroundReach;
struct BatchView {
    const TerrainTables* tables = nullptr;
    const DecoratorIndex* decorators = nullptr;
    ColumnPos first;
    i32 width = 0, depth = 0;
    LandTile* lands = nullptr; // ring kLandRing
    float *floor = nullptr, *surface[2] = {},
          *loose = nullptr;          // planes over the land tiles, blocks; loose: t.loose planes
    GroundTile* grounds = nullptr;   // ring kFeatureReach, as caves and features
    LatticeTile* lattices = nullptr; // the same ring, and one more column to +x and +z
    CaveTile* caves = nullptr;
    FeatureTile* features = nullptr;
    BlockTile* blocks = nullptr; // none
    BiomeTile* biomes = nullptr; // none

    VX_HD i32 columns(i32 ring) const { return (width + 2 * ring) * (depth + 2 * ring); }
    VX_HD i32 plane_stride() const { return (width + 2 * kLandRing) * 16; }
    VX_HD i32 plane_rows() const { return (depth + 2 * kLandRing) * 16; }
    VX_HD i32 plane_size() const { return plane_stride() * plane_rows(); }
    // The tile-th column of an array with that ring.
    VX_HD ColumnPos column(i32 tile, i32 ring, i32 extra = 0) const {
        const i32 span = width + 2 * ring + extra;
        return {i32(u32(first.x) + u32(tile % span - ring)), i32(u32(first.z) + u32(tile / span - ring))};
    }
};

// The numbers of the tables that the host needs to launch.
struct BatchRows {
    u32 loose = 0, passes = 0;
    float repose[kLooseMost] = {};
};

u64 decorator_index_bytes();
void launch_decorator_index(const TerrainTables* tables, DecoratorIndex* out, CUstream_st* stream); // once
void launch_land(const BatchView& v, CUstream_st* stream);
void launch_ground(const BatchView& v, const BatchRows& rows, CUstream_st* stream);
void launch_lattice(const BatchView& v, CUstream_st* stream);
void launch_caves(const BatchView& v, CUstream_st* stream);
void launch_features(const BatchView& v, CUstream_st* stream);
void launch_blocks(const BatchView& v, CUstream_st* stream);

} // namespace vitrail::cuda
