// The base game's generator with ids that are the generator's own numbers.
#pragma once

#include "terrain/generator.h"
#include "tests/terrain/base_terrain.h"

#include <gtest/gtest.h>

namespace vitrail {

inline std::shared_ptr<TerrainGenerator> base_generator(u64 seed, TerrainGeneratorOptions options = {}) {
    auto made = TerrainGenerator::create(base_terrain(), seed, options);
    if (!made) throw std::runtime_error(made.error().message);
    return *made;
}

inline TerrainPalette plain_palette(const TerrainGenerator& generator) {
    TerrainPalette palette;
    for (u32 i = 0; i < generator.block_names().size(); ++i) {
        palette.blocks.push_back(StateId(i));
        palette.takes_light.push_back(i != kAir);
    }
    for (u32 i = 0; i < generator.biome_names().size(); ++i)
        palette.biomes.push_back(BiomeId(i));
    return palette;
}

// Order-free sum over columns, as `vitrail generate --hash` prints it.
inline u64 place_hash(ColumnPos at, const GeneratedColumn& column) {
    return hash_combine(hash_combine(u32(at.x), u32(at.z)), column_hash(column));
}

inline bool long_tests() {
    return std::getenv("VITRAIL_LONG") != nullptr;
}

} // namespace vitrail
