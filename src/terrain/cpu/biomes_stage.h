// The grid of biomes of one column (kernel/biome_grid_kernel.h).
#pragma once

#include "terrain/kernel/biome_grid_kernel.h"

namespace vitrail {

template <class L>
void biomes_stage(const TerrainTables& t, const GroundTile& ground, const CaveTile& caves, BiomeTile& out) {
    float land[16], attributes[kAttributesMost][16], offsets[kAttributesMost][16];
    for (i32 cell = 0; cell < 16; ++cell) {
        const i32 index = grid_index(cell);
        land[cell] = ground.land[index];
        for (u32 i = 0; i < t.attributes; ++i)
            attributes[i][cell] = ground.attribute[i][index];
        for (u32 i = 0; i < t.cave_attributes; ++i)
            offsets[i][cell] = caves.offset[i][index];
    }
    typename L::F attribute[kAttributesMost], offset[kAttributesMost];
    for (u32 i = 0; i < t.attributes; ++i)
        attribute[i] = L::load(attributes[i]);
    for (u32 i = 0; i < t.cave_attributes; ++i)
        offset[i] = L::load(offsets[i]);
    const auto surface = strongest_biome<L>(t, attribute);
    for (i32 level = 0; level < kTerrainHeight / 4; ++level)
        L::store_bytes(out.biome + level * 16, grid_biome_level<L>(t, L::load(land), offset, surface, level));
}

} // namespace vitrail
