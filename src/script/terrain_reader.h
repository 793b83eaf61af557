// Reads define_terrain, define_terrain_layer, define_terrain_biome, define_cave_biome, define_terrain_feature and
// define_decorator (docs/terrain.md) into a TerrainDescription. Types, ranges, block names and references between rows
// are checked here; expressions and what shapes want are checked where the description is compiled
// (terrain/compile/compile.h).
#pragma once

#include "base/result.h"
#include "lua/value.h"
#include "terrain/description.h"
#include "world/block_registry.h"

#include <memory>
#include <span>

namespace vitrail {

class TerrainReader {
public:
    // One call of a script each. A row of a name already there takes the old one's place. Errors: invalid_argument with
    // the row's name, the key and what was expected; limit.
    Result<> define_terrain(std::span<const lua::Value> arguments);
    Result<> define_layer(std::span<const lua::Value> arguments);
    Result<> define_biome(std::span<const lua::Value> arguments);
    Result<> define_cave_biome(std::span<const lua::Value> arguments);
    Result<> define_feature(std::span<const lua::Value> arguments);
    Result<> define_decorator(std::span<const lua::Value> arguments);

    // Once all scripts have run; null if none said anything. Wants that are shorter than the list of attributes are
    // filled up with "does not matter". Errors: invalid_argument, naming the row whose block, layer, biome or attribute
    // is none.
    Result<std::shared_ptr<const TerrainDescription>> finish(const BlockRegistry& registry);

private:
    TerrainDescription description_;
    bool any_ = false;
};

} // namespace vitrail
