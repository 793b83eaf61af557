#include "pipeline/new_world.h"

#include "pipeline/chunk_source.h"

namespace vitrail {

Result<TerrainPalette> make_terrain_palette(StateTable& states, BiomeTable& biomes) {
    TerrainPalette palette;
    for (u32 i = 0; i < kTerrainBlockCount; ++i) {
        VX_TRY_ASSIGN(BlockState state, parse_block_state(kTerrainBlockNames[i]));
        VX_TRY_ASSIGN(palette.blocks[i], states.intern_with_defaults(std::move(state)));
        palette.takes_light[i] = states.light_data()[u32(palette.blocks[i])].opacity > 0;
    }
    for (u32 i = 0; i < kTerrainBiomeCount; ++i) {
        VX_TRY_ASSIGN(palette.biomes[i], biomes.intern(kTerrainBiomeNames[i]));
    }
    return palette;
}

Result<LevelRecord> make_new_level(WorldRecords& records, const std::string& name, u64 seed, const std::string& generator,
                                   u64 content_hash) {
    LevelRecord level;
    level.name = name;
    level.seed = seed;
    level.generator = generator;
    level.generator_version = ChunkSource::generator_version(generator);
    level.content_hash = content_hash;
    level.time_ticks = 1000; // morning
    level.spawn.at = generator.empty() ? BlockPos{0, 64, 0} : spawn_point(seed);
    SaveBatch batch;
    batch.level = level;
    batch.dimensions.push_back(DimensionInfo{});
    VX_TRY(records.save(batch));
    return level;
}

} // namespace vitrail
