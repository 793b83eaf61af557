// Turns a TerrainDescription into the flat tables that kernels read, for one seed. The same description and seed give the
// same tables on every machine and compiler.
#pragma once

#include "base/result.h"
#include "terrain/description.h"
#include "terrain/tables.h"

#include <memory>
#include <string>
#include <vector>

namespace vitrail {

struct CompiledTerrain {
    std::unique_ptr<TerrainTables> tables;
    std::vector<std::string> block_names; // by Block; state texts
    std::vector<std::string> biome_names; // surface biomes, then cave biomes
    std::vector<std::string> layer_names; // strata, then loose layers
    std::vector<std::string> feature_names;
};

// Errors: invalid_argument with the row's name and what was expected (unknown names, wrong wants, bad expressions, reach or
// bounds beyond what stages allow), limit (too many rows).
Result<CompiledTerrain> compile_terrain(const TerrainDescription& description, u64 seed);

} // namespace vitrail
