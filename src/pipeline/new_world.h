// What a generated world begins with; one place for the server and for the commands.
#pragma once

#include "store/world_records.h"
#include "terrain/generator.h"

#include <memory>
#include <string>

namespace vitrail {

// The generator's name in the level record. The version grows when the same description and seed give other blocks.
inline constexpr const char* kGeneratorName = "endless";
inline constexpr u32 kGeneratorVersion = 1;

// The generator that a level names; null where it names none. Errors: unsupported (a generator or version that this
// build does not have: the world is left as it is), not_found (the content describes no terrain), those of
// TerrainGenerator::create.
Result<std::shared_ptr<TerrainGenerator>> open_generator(const std::string& name, u32 version,
                                                         const TerrainDescription* description, u64 seed);

// The generator's blocks and biomes, numbered in these tables. Errors: invalid_argument (a name that is no block of the
// content), limit.
Result<TerrainPalette> make_terrain_palette(StateTable& states, BiomeTable& biomes, const TerrainGenerator& generator);

// The overworld of a new world: as high as the generator makes it.
DimensionInfo new_overworld(bool generated);

// Saves the level and the overworld of a new world, durable when it returns. generator: null for none (`seed` is kept
// all the same). Errors: the store's.
Result<LevelRecord> make_new_level(WorldRecords& records, const std::string& name, u64 seed,
                                   const TerrainGenerator* generator, u64 content_hash);

} // namespace vitrail
