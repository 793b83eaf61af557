// Keeps a world that was built whole in memory, e.g. by a script, in a world folder.
#pragma once

#include "store/world_records.h"

#include <string>

namespace vitrail {

struct BuiltWorldFigures {
    u64 columns = 0, chunks = 0; // chunks that hold anything
};

// Makes a world without a generator of the dimension's chunks; outside them there is open air. States and biomes are
// numbered anew. level: name, spawn, time, source; until all is kept, the world calls itself unfinished. Light is found
// when the world is played. Errors: the store's; denied, where the folder holds a world already: it is left as it is.
Result<BuiltWorldFigures> keep_built_world(const std::string& folder, const Dimension& dimension,
                                           const BiomeTable& biomes, const LevelRecord& level);

} // namespace vitrail
