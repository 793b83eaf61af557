// Sets the small plants and crystals of one tile (kernel/decorate_kernel.h).
#pragma once

#include "terrain/kernel/decorate_kernel.h"

namespace vitrail {

template <class L>
void decorate_stage(const TerrainTables& t, ColumnPos at, const GroundTile& ground, const CaveTile& caves,
                    BlockTile& blocks) {
    DecoratorIndex index;
    make_decorator_index<L>(t, index);
    for (i32 row = 0; row < 16; ++row) {
        const i32 end = decorate_row<L>(t, index, wide_row<L>(at, row), ground, caves, blocks);
        if (end > blocks.top) blocks.top = end;
    }
}

} // namespace vitrail
