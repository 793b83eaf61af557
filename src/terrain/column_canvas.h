// ColumnCanvas: the column being made, as roles, and what is known of the land under and around it. Stages draw on it
// one after another; each says how far beyond the column it looks (its reach), and clips what falls outside.
#pragma once

#include "terrain/generator.h"
#include "terrain/surface_kernel.h"

#include <memory>

namespace vitrail {

struct ColumnCanvas {
    static constexpr i32 kMargin = 8; // blocks of land known around the column
    static constexpr i32 kSpan = kChunkSize + 2 * kMargin;

    struct Land {
        float height = 0;
        float slope = 0;                           // largest difference to the four neighbors, blocks
        i32 ground_y = 0;                          // first y above the ground
        TerrainBiome biome = TerrainBiome::plains; // this and `cold` known one block beyond the column only
        bool cold = false;                         // snow lies here
        float mountain = 0, river = 0, continent = 0;
    };

    TerrainKeys keys;
    i32 base_x = 0, base_z = 0; // blocks of the column's least corner
    std::array<Land, kSpan * kSpan> land;
    std::array<TerrainBlock, std::size_t(kChunkSize* kChunkSize*(kTerrainMaxY - kTerrainMinY))>
        blocks;             // x | z << 4 | y << 8
    i32 top = kTerrainMinY; // no block at or above

    // x, z relative to the column, -kMargin <= x, z < 16 + kMargin
    const Land& land_at(i32 x, i32 z) const { return land[std::size_t((z + kMargin) * kSpan + x + kMargin)]; }
    Land& land_at(i32 x, i32 z) { return land[std::size_t((z + kMargin) * kSpan + x + kMargin)]; }
    static std::size_t index(i32 x, i32 y, i32 z) { return std::size_t(x | z << 4 | (y - kTerrainMinY) << 8); }
    static bool inside(i32 x, i32 y, i32 z) { return ((x | z) & ~15) == 0 && y >= kTerrainMinY && y < kTerrainMaxY; }
    TerrainBlock get(i32 x, i32 y, i32 z) const { return blocks[index(x, y, z)]; }
    void put(i32 x, i32 y, i32 z, TerrainBlock b) {
        blocks[index(x, y, z)] = b;
        if (b != TerrainBlock::air && y >= top) top = y + 1;
    }
    // Draws only into the column.
    void draw(i32 x, i32 y, i32 z, TerrainBlock b, bool over_solid = false) {
        if (!inside(x, y, z)) return;
        const TerrainBlock old = get(x, y, z);
        if (over_solid || old == TerrainBlock::air || old == TerrainBlock::oak_leaves ||
            old == TerrainBlock::birch_leaves || old == TerrainBlock::spruce_leaves)
            put(x, y, z, b);
    }
};

// Stages in order (reach in blocks beyond the column).
void survey_land(ColumnCanvas& canvas);  // 1: heights, slopes, biomes with the margin
void fill_ground(ColumnCanvas& canvas);  // 0: rock, soil, water
void carve_caves(ColumnCanvas& canvas);  // kMargin: keeps away from water
void place_veins(ColumnCanvas& canvas);  // 16: ores and other rock
void place_trees(ColumnCanvas& canvas);  // kMargin
void place_plants(ColumnCanvas& canvas); // 1
void lay_snow(ColumnCanvas& canvas);     // 0

TerrainBiome biome_of(const TerrainKeys& keys, const LandPoint& land, i32 x, i32 z);
bool snow_lies(const TerrainKeys& keys, const LandPoint& land, i32 x, i32 z);
// Whether a cave takes this block, as carve_caves decides it but for the water nearby.
bool in_cave(const TerrainKeys& keys, i32 x, i32 y, i32 z, i32 ground_y);
// Whether a tree's trunk stands at this block column.
bool tree_stands_at(const TerrainKeys& keys, i32 x, i32 z);

} // namespace vitrail
