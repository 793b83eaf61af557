// The biome a client draws tints and air by: the strongest one of the surface, and under it of the caves where one
// reigns (the first cave biome stands for none). Lanes are the 16 cells of one level of BiomeTile.
#pragma once

#include "terrain/kernel/biome_kernel.h"
#include "terrain/kernel/cave_biome_kernel.h"

namespace vitrail {

// The block column that stands for a cell.
VX_HD i32 grid_index(i32 cell) {
    return (cell & 3) * 4 + 2 + (((cell >> 2 & 3) * 4 + 2) << 4);
}

// land: height before erosion; offset: of the cave attributes; surface: the strongest surface biome. level: y / 4.
template <class L>
VX_HD_FN typename L::U grid_biome_level(const TerrainTables& t, typename L::F land, const typename L::F* offset,
                                        typename L::U surface, i32 level) {
    using F = typename L::F;
    const float y = float(level * 4 + 2);
    const auto under = land > L::f(y);
    if (t.cave_biomes < 2 || !L::any(under)) return surface;
    F attribute[kAttributesMost];
    for (u32 i = 0; i < t.cave_attributes; ++i) {
        const CaveAttributeRow& a = t.cave_attribute[i];
        attribute[i] = step_between<L>(a.low, a.high, (land - y) * a.with_depth + offset[i]);
    }
    const typename L::U cave = strongest_cave_biome<L>(t, attribute);
    return select(under & (cave > L::u(0)), cave + t.biomes, surface);
}

// One cell; a thread of a GPU.
VX_HD u8 grid_biome(const TerrainTables& t, const GroundTile& ground, const CaveTile& caves, i32 cell) {
    using L = ScalarLanes;
    const i32 index = grid_index(cell);
    float attribute[kAttributesMost], offset[kAttributesMost];
    load_attributes<L>(t, ground, index, attribute);
    for (u32 i = 0; i < t.cave_attributes; ++i)
        offset[i] = caves.offset[i][index];
    return u8(grid_biome_level<L>(t, ground.land[index], offset, strongest_biome<L>(t, attribute), cell >> 4));
}

} // namespace vitrail
