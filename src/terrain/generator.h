// The terrain generator: a pure function of (seed, column), the same bit for bit whatever the compiler, thread count,
// order of columns or device. Knows no block names: the caller interns kTerrainBlockNames / kTerrainBiomeNames and
// passes plain ids. How to use it:
//   TerrainPalette palette; for each role: palette.blocks[i] = intern(kTerrainBlockNames[i]); ... takes_light[i] =
//   opacity > 0; GeneratedColumn column = generate_column(seed, {x, z}, palette); for each i: dimension.put({x,
//   kTerrainMinY / 16 + i, z}, make_shared<Chunk>(move(column.chunks[i])));
#pragma once

#include "voxel/chunk.h"
#include "voxel/coords.h"

#include <array>
#include <vector>

namespace vitrail {

inline constexpr i32 kTerrainMinY = -64, kTerrainMaxY = 320; // blocks are made for min <= y < max
inline constexpr i32 kTerrainSeaLevel = 63;                  // the highest water block of the sea lies at 62
inline constexpr i32 kTerrainSections = (kTerrainMaxY - kTerrainMinY) / kChunkSize;

// The blocks terrain is made of, by role.
enum class TerrainBlock : u8 {
    air,
    bedrock,
    stone,
    deepslate,
    granite,
    diorite,
    andesite,
    tuff,
    dirt,
    coarse_dirt,
    grass_block,
    snowy_grass_block,
    podzol,
    sand,
    sandstone,
    red_sand,
    gravel,
    clay,
    water,
    lava,
    ice,
    packed_ice,
    snow_block,
    snow,
    coal_ore,
    iron_ore,
    copper_ore,
    gold_ore,
    redstone_ore,
    lapis_ore,
    diamond_ore,
    emerald_ore,
    deepslate_coal_ore,
    deepslate_iron_ore,
    deepslate_copper_ore,
    deepslate_gold_ore,
    deepslate_redstone_ore,
    deepslate_lapis_ore,
    deepslate_diamond_ore,
    deepslate_emerald_ore,
    oak_log,
    oak_log_x,
    oak_log_z,
    oak_leaves,
    birch_log,
    birch_leaves,
    spruce_log,
    spruce_leaves,
    short_grass,
    tall_grass_lower,
    tall_grass_upper,
    fern,
    large_fern_lower,
    large_fern_upper,
    dead_bush,
    dandelion,
    poppy,
    cornflower,
    oxeye_daisy,
    azure_bluet,
    allium,
    lily_of_the_valley,
    red_tulip,
    brown_mushroom,
    red_mushroom,
    sugar_cane,
    pumpkin,
    cactus,
    seagrass,
    mossy_cobblestone,
    lily_pad,
    moss_block,
    glow_lichen_down,
    count
};
inline constexpr u32 kTerrainBlockCount = u32(TerrainBlock::count);
// Block state texts (world/block_state.h), in enum order.
extern const std::array<const char*, kTerrainBlockCount> kTerrainBlockNames;

enum class TerrainBiome : u8 {
    plains,
    forest,
    birch_forest,
    taiga,
    snowy_plains,
    snowy_taiga,
    desert,
    meadow,
    stony_peaks,
    snowy_slopes,
    jagged_peaks,
    beach,
    snowy_beach,
    river,
    ocean,
    deep_ocean,
    count
};
inline constexpr u32 kTerrainBiomeCount = u32(TerrainBiome::count);
extern const std::array<const char*, kTerrainBiomeCount> kTerrainBiomeNames;

struct TerrainPalette {
    std::array<StateId, kTerrainBlockCount> blocks{};
    std::array<BiomeId, kTerrainBiomeCount> biomes{};
    // Whether a block takes sky light (opacity above 0), for GeneratedColumn::heights. All but air and plants by
    // default.
    std::array<bool, kTerrainBlockCount> takes_light = default_takes_light();
    static std::array<bool, kTerrainBlockCount> default_takes_light();
};

struct GeneratedColumn {
    std::vector<Chunk> chunks; // kTerrainSections of them, lowest first; all-air ones too, unlit
    // As ColumnHeights (world/dimension.h): index x | z << 4, the y above the highest block that takes sky light.
    std::array<i32, 256> heights{};
};

GeneratedColumn generate_column(u64 seed, ColumnPos at, const TerrainPalette& palette);

// Height of the ground (the y above the highest ground block, caves and plants left out) and the biome at a block
// column.
struct TerrainSurface {
    i32 ground_y = 0;
    TerrainBiome biome = TerrainBiome::plains;
    bool under_water = false;
};
TerrainSurface terrain_surface(u64 seed, i32 x, i32 z);

// A pretty, dry, open place near the origin: where the feet stand.
BlockPos spawn_point(u64 seed);

// Hash of all block states, for `generate --hash` and tests: equal columns have equal hashes.
u64 column_hash(const GeneratedColumn& column);

} // namespace vitrail
