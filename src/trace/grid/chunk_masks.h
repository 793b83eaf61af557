// Which cells of a chunk stop rays, as bit masks a brick of 4^3 (trace/kernel/grid_view.h).
#pragma once

#include "trace/kernel/scene_view.h"
#include "voxel/cell_mask.h"

#include <array>

namespace vitrail::trace {

// What the masks need of a state.
enum StateClass : u8 {
    kStopsAir = 1,   // anything but air
    kOpaque = 2,     // an opaque cube and no more
    kWaterCell = 4,  // a liquid of water: without a surface where there is water above
    kHoldsWater = 8, // that, or a model that stands in water
    kOddWater = 16,  // that whose surface, where it is flat, is not the highest, as that of sources is
};
inline constexpr u32 kStateClasses = 5;

// water: the medium of kind 1, 0: there is none; top: its MediumRecord::liquid_top.
u8 state_class(const StateRecord& state, u32 water, u32 top);

using BrickMasks = std::array<u64, 64>; // a word a brick

// Cells of one layer, a row of z each, bit x.
using LayerMask = std::array<u16, 16>;

// Cells of kWaterCell, kHoldsWater, kOddWater.
struct WaterCells {
    CellMask liquid, holds, odd;
};

struct ChunkMasks {
    BrickMasks stops; // rays through air
    BrickMasks opaque;
    WaterCells water;
};

// class_of: a class for each palette entry of `blocks`.
void make_chunk_masks(const BlockStorage& blocks, const u8* class_of, ChunkMasks& out);

// Cells in LocalPos order to bricks.
BrickMasks bricks_of(const CellMask& cells);

} // namespace vitrail::trace
