// Tiles: what each stage makes of one column of 16 x 16 blocks; plain arrays, the same on a CPU and a GPU (kernel-safe). The index of a
// block column is x | z << 4.
//
// stage      reach (columns)  reads                                  makes
// land       0                -                                      LandTile
// ground     6                land of the ring                       GroundTile (loose layers laid and eroded)
// lattice    0                -                                      LatticeTile (cave fields every 4 blocks)
// caves      1 (+x, +z)       lattice of 4, own ground               CaveTile
// features   0                own ground, caves                      FeatureTile (placements and their solids)
// blocks     3                own ground, caves; features of 7 x 7   BlockTile (fill, draw, decorate), BiomeTile
#pragma once

#include "math/vec.h"
#include "terrain/tables.h"
#include "voxel/coords.h"

namespace vitrail {

inline constexpr i32 kGroundReach = 6, kFeatureReach = 3; // columns
inline constexpr i32 kZoneColumns = 12;                   // a CPU erodes zones of 12 x 12 columns at once

struct LandTile {
    float attribute[kAttributesMost][kColumnCells]; // 0..1
    float height[kColumnCells];                     // of the land before erosion: blocks with y < height are ground
};

struct GroundTile {
    float attribute[kAttributesMost][kColumnCells];
    float land[kColumnCells];              // the height before erosion
    float rock[kColumnCells];              // where the loose layers begin
    float loose[kLooseMost][kColumnCells]; // what is left of each, blocks
    float top[kColumnCells];               // rock + loose: blocks with y < top are ground
};

inline constexpr i32 kLatticeStep = 4;
inline constexpr i32 kLatticeLevels = 37; // y = 0, 4, ... 144: no cave reaches higher
struct LatticeTile {
    // point x / 4 | z / 4 << 2
    float closeness[kLatticeLevels][16]; // F3 / F1 - 1
    float width[kLatticeLevels][16];     // theta without what depends on height and sea
};

struct CaveTile {
    u32 open[kTerrainHeight / 32][kColumnCells];   // bit y & 31 of word y >> 5: air (or lava) of a cave or ravine
    float offset[kAttributesMost][kColumnCells];   // of the cave attributes
};

// Which solids a feature consists of. Positions are blocks relative to the placement's corner (its block's centre is
// .5, .5, .5); a voxel is inside where the signed distance of its centre is below 0.
enum class Solid : u8 {
    ball,      // centre a, radii b (an ellipsoid)
    dome,      // the upper half of a ball, flat below
    cone,      // capsule from a (radius ra) to b (radius rb), round ends
    cylinder,  // from a (ra) to b (rb), flat ends square to its axis
    prism,     // six-sided, from a (ra) to b (rb)
    box,       // from a to b
};
enum SolidFlag : u8 {
    solid_over_ground = 1,  // replaces ground, else only what is open
    solid_in_water = 2,     // replaces water too
    solid_only_water = 4,   // replaces nothing but water
    solid_hollow = 8,       // only within ra of the surface (ball, dome)
};
struct Primitive {
    Vec3 a, b;
    float ra = 0, rb = 0;
    float wobble = 0;       // blocks of noise added to the distance
    u16 noise = 0;          // table index of that noise (3-D fractal), where wobble > 0
    Solid solid = Solid::ball;
    u8 flags = 0;
    Block block = kAir, other = kAir;
    u8 other_share = 0;     // of 255: voxels that take `other`
    u8 missing_share = 0;   // of 255: voxels left as they are
    i16 low[3] = {}, high[3] = {}; // box of all its voxels, inclusive, relative to the placement's block
};

struct Placement {
    i32 x = 0, z = 0;
    i16 y = 0;           // of the block the feature stands in (surface: the first above ground; ceiling: the last open one)
    u16 feature = 0;     // row
    u32 bits = 0;        // random, of this placement
    u16 first = 0, count = 0; // primitives
    i16 room = 0;        // height of the cave layer, depth of the water
    i16 low[3] = {}, high[3] = {}; // box of all primitives, relative
};

// Caps are part of the result: who finds no room is not placed.
inline constexpr u32 kPlacementsMost = 96, kPrimitivesMost = 768;
struct FeatureTile {
    u32 placements = 0, primitives = 0;
    Placement placement[kPlacementsMost];
    Primitive primitive[kPrimitivesMost];
};

struct BlockTile {
    Block block[kTerrainHeight * kColumnCells]; // x | z << 4 | y << 8
    i32 top = 0;                                // nothing but air at or above
};

// Strongest biomes on the grid of 4 blocks, by index into the surface biomes, then the cave biomes: cell x / 4 | z / 4 << 2 |
// y / 4 << 4.
struct BiomeTile {
    u8 biome[kTerrainHeight / 4 * 16];
};

// A row of a tile: lane l is the block column (x + l, z + row). On a GPU each thread is one lane and `index` its own.
template <class L>
struct Row {
    i32 x = 0, z = 0;    // least corner of the column, blocks
    i32 index = 0;       // of lane 0 (GPU: of the lane) in the tile
    typename L::F dx;    // lane
    float dz = 0;        // row
    VX_HD Spot<L> spot(typename L::F y) const { return {x, z, dx, y, L::f(dz)}; }
    VX_HD typename L::U block_x() const { return as_uint(to_int(dx)) + u32(x); }
    VX_HD typename L::U block_z() const { return L::u(u32(z + i32(dz))); }
};

#ifndef __CUDACC__
template <class L>
VX_HD Row<L> wide_row(ColumnPos at, i32 row) {
    Row<L> r;
    r.x = i32(u32(at.x) << 4);
    r.z = i32(u32(at.z) << 4);
    r.index = row << 4;
    r.dz = float(row);
    for (int l = 0; l < 16; ++l) r.dx[l] = float(l);
    return r;
}
#endif
VX_HD Row<ScalarLanes> thread_row(ColumnPos at, i32 index) {
    Row<ScalarLanes> r;
    r.x = i32(u32(at.x) << 4);
    r.z = i32(u32(at.z) << 4);
    r.index = index;
    r.dx = float(index & 15);
    r.dz = float(index >> 4);
    return r;
}

} // namespace vitrail
