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
};

// water: the medium of kind 1; 0: there is none.
u8 state_class(const StateRecord& state, u32 water);

using BrickMasks = std::array<u64, 64>; // a word a brick

// Cells of one layer, a row of z each, bit x.
using LayerMask = std::array<u16, 16>;

struct ChunkMasks {
    BrickMasks stops[2]; // by Through; water: as if there was no water above the chunk
    BrickMasks opaque;
    LayerMask water_floor{};   // cells of the lowest layer that hold water
    LayerMask water_ceiling{}; // liquids of the highest layer: full where the chunk above has water over them
};

// class_of: a class for each palette entry of `blocks`.
void make_chunk_masks(const BlockStorage& blocks, const u8* class_of, ChunkMasks& out);

// Liquids under the water of the chunk above are full: takes them out of the water masks' highest layer, and puts those
// in that are not.
void apply_water_above(BrickMasks& stops_water, const LayerMask& ceiling, const LayerMask& floor_above);

// Cells in LocalPos order to bricks.
BrickMasks bricks_of(const CellMask& cells);

} // namespace vitrail::trace
