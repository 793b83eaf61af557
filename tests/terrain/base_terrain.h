// The base game's terrain and its generator, for tests and benchmarks that want the real one.
#pragma once

#include "script/content_loader.h"
#include "terrain/generator.h"

#include <filesystem>
#include <stdexcept>

namespace vitrail {

// content/base of the source tree, read once. Throws where it does not load.
inline const TerrainDescription& base_terrain() {
    static const std::shared_ptr<const TerrainDescription> terrain = [] {
        const std::filesystem::path roots[] = {std::filesystem::path(VITRAIL_SOURCE_DIR) / "content" / "base"};
        auto content = load_content(roots);
        if (!content) throw std::runtime_error(content.error().message);
        if (!content->terrain) throw std::runtime_error("content/base says nothing about terrain");
        return content->terrain;
    }();
    return *terrain;
}

inline std::shared_ptr<TerrainGenerator> base_generator(u64 seed, TerrainGeneratorOptions options = {}) {
    auto made = TerrainGenerator::create(base_terrain(), seed, options);
    if (!made) throw std::runtime_error(made.error().message);
    return *made;
}

// Ids that are the generator's own numbers.
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

} // namespace vitrail
