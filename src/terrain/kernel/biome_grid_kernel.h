// The biome a client draws tints and air by: the strongest one of the surface, and under it of the caves where one reigns (the
// first cave biome stands for none).
#pragma once

#include "terrain/kernel/biome_kernel.h"
#include "terrain/kernel/cave_biome_kernel.h"

namespace vitrail {

// cell: of BiomeTile. Thread a cell on a GPU.
VX_HD u8 grid_biome(const TerrainTables& t, const GroundTile& ground, const CaveTile& caves, i32 cell) {
    using L = ScalarLanes;
    const i32 index = (cell & 3) * 4 + 2 + (((cell >> 2 & 3) * 4 + 2) << 4), y = (cell >> 4) * 4 + 2;
    if (float(y) < ground.land[index] && t.cave_biomes > 1) {
        float attribute[kAttributesMost];
        cave_attributes_at<L>(t, ground, caves, index, y, attribute);
        const u32 cave = strongest_cave_biome<L>(t, attribute);
        if (cave > 0) return u8(t.biomes + cave);
    }
    float attribute[kAttributesMost];
    load_attributes<L>(t, ground, index, attribute);
    return u8(strongest_biome<L>(t, attribute));
}

} // namespace vitrail
