#pragma once

#include "base/result.h"
#include "terrain/generator.h"

namespace vitrail::apps {

// Prints all that the description and its generator hold: stages, attributes, layers, biomes, rules, features,
// decorators, blocks.
Result<> list_terrain(const TerrainDescription& description, const TerrainGenerator& generator);

} // namespace vitrail::apps
