// Fills one tile with blocks, row by row (kernel/fill_kernel.h).
#pragma once

#include "terrain/kernel/fill_kernel.h"

namespace vitrail {

template <class L>
void fill_stage(const TerrainTables& t, ColumnPos at, const GroundTile& ground, const CaveTile& caves, BlockTile& out) {
    float highest = float(kTerrainSeaLevel);
    for (const float top : ground.top)
        highest = top > highest ? top : highest;
    out.top = block_above<OneLane<L>>(highest);
    CoarseFields fields;
    for (i32 row = 0; row < 16; ++row)
        fill_row<L>(t, wide_row<L>(at, row), ground, caves, &fields.strata, &fields, out.top, out);
    __builtin_memset(out.block + (out.top << 8), kAir, u64(kTerrainMaxY - out.top) << 8);
}

} // namespace vitrail
