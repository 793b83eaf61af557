// What a generated world begins with; one place for the server and for `vitrail generate`.
#pragma once

#include "store/world_records.h"
#include "terrain/generator.h"

#include <string>

namespace vitrail {

// The generator's blocks and biomes, numbered in these tables. Errors: limit.
Result<TerrainPalette> make_terrain_palette(StateTable& states, BiomeTable& biomes);

// Saves the level and the overworld of a new world, durable when it returns. generator: "hills", or "" for none.
// Errors: the store's.
Result<LevelRecord> make_new_level(WorldRecords& records, const std::string& name, u64 seed, const std::string& generator,
                                   u64 content_hash);

} // namespace vitrail
