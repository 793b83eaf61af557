#pragma once

#include "terrain/kernel/land_kernel.h"

namespace vitrail {

template <class L>
void land_stage(const TerrainTables& t, ColumnPos at, LandTile& out) {
    for (i32 z = 0; z < 16; ++z)
        land_row<L>(t, wide_row<L>(at, z), out);
}

} // namespace vitrail
