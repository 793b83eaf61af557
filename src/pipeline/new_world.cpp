#include "pipeline/new_world.h"

#include <fmt/format.h>

namespace vitrail {

Result<std::shared_ptr<TerrainGenerator>> open_generator(const std::string& name, u32 version,
                                                         const TerrainDescription* description, u64 seed) {
    if (name.empty()) return std::shared_ptr<TerrainGenerator>();
    if (name != kGeneratorName)
        return fail(ErrorCode::unsupported,
                    fmt::format("the terrain generator '{}' is not known here: the world is left as it is", name));
    if (version != kGeneratorVersion)
        return fail(
            ErrorCode::unsupported,
            fmt::format("the terrain generator '{}' is known here in version {}, not {}: the world is left as it is",
                        name, kGeneratorVersion, version));
    if (!description) return fail(ErrorCode::not_found, "the content describes no terrain");
    return TerrainGenerator::create(*description, seed);
}

Result<TerrainPalette> make_terrain_palette(StateTable& states, BiomeTable& biomes, const TerrainGenerator& generator) {
    TerrainPalette palette;
    for (const std::string& name : generator.block_names()) {
        VX_TRY_ASSIGN(BlockState state, parse_block_state(name));
        VX_TRY_ASSIGN(const StateId id, states.intern_with_defaults(std::move(state)));
        if (states.flags(id) & kUnknownState)
            return fail(ErrorCode::invalid_argument, fmt::format("terrain: '{}' is no block of the content", name));
        palette.blocks.push_back(id);
        palette.takes_light.push_back(states.light_data()[u32(id)].opacity > 0);
    }
    for (const std::string& name : generator.biome_names()) {
        VX_TRY_ASSIGN(const BiomeId id, biomes.intern(name));
        palette.biomes.push_back(id);
    }
    return palette;
}

DimensionInfo new_overworld(bool generated) {
    DimensionInfo info;
    if (generated) info.min_y = kTerrainMinY, info.max_y = kTerrainMaxY, info.sea_level = kTerrainSeaLevel;
    return info;
}

Result<LevelRecord> make_new_level(WorldRecords& records, const std::string& name, u64 seed,
                                   const TerrainGenerator* generator, u64 content_hash) {
    LevelRecord level;
    level.name = name;
    level.seed = seed;
    level.generator = generator ? kGeneratorName : "";
    level.generator_version = generator ? kGeneratorVersion : 0;
    level.content_hash = content_hash;
    level.time_ticks = 1000; // morning
    level.spawn.at = generator ? spawn_point(*generator) : BlockPos{0, 64, 0};
    SaveBatch batch;
    batch.level = level;
    batch.dimensions.push_back(new_overworld(generator != nullptr));
    VX_TRY(records.save(batch));
    return level;
}

} // namespace vitrail
