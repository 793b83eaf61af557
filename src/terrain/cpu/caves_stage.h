// Cave fields on their lattice, and the caves of one column (terrain/tiles.h says what the stages read and make).
#pragma once

#include "terrain/kernel/cave_kernel.h"

namespace vitrail {

template <class L>
void lattice_stage(const TerrainTables& t, ColumnPos at, LatticeTile& out) {
    const LatticePoints<L> points = wide_points<L>(at);
    for (i32 level = 0; level < kLatticeLevels; ++level)
        lattice_level<L>(t, points, level, out);
}

// Which levels can hold open blocks at all: bit l for y = 4 l to 4 l + 3, by the bounds of the points around.
template <class L>
u64 cave_levels(const LatticeTile* const lattices[4]) {
    u64 levels = 0;
    float least_closeness[kLatticeLevels], most_width[kLatticeLevels];
    for (i32 level = 0; level < kLatticeLevels; ++level) {
        float c = kClosenessMost, w = 0;
        const auto take = [&](i32 tile, i32 first, i32 count, i32 step) {
            for (i32 i = 0; i < count; ++i) {
                c = least(c, lattices[tile]->closeness[level][first + i * step]);
                w = greatest(w, lattices[tile]->width[level][first + i * step]);
            }
        };
        take(0, 0, 16, 1);
        take(1, 0, 4, 4);
        take(2, 0, 4, 1);
        take(3, 0, 1, 1);
        least_closeness[level] = c;
        most_width[level] = w;
    }
    for (i32 level = 0; level + 1 < kLatticeLevels; ++level)
        if (least(least_closeness[level], least_closeness[level + 1]) <
            greatest(most_width[level], most_width[level + 1]) * 1.001f)
            levels |= u64(1) << level;
    return levels;
}

template <class L>
void caves_stage(const TerrainTables& t, ColumnPos at, const GroundTile& ground, const LatticeTile* const lattices[4],
                 CaveTile& out) {
    const u64 levels = cave_levels<L>(lattices);
    for (i32 row = 0; row < 16; ++row)
        cave_row<L>(t, ground, lattices, wide_row<L>(at, row), levels, out);
}

} // namespace vitrail
