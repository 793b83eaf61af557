// ChunkSource: where the columns of a world come from: the store where they were saved (or imported), else the
// generator. Thread-safe and without state of its own, so workers ask it for many columns at once.
#pragma once

#include "store/save_queue.h"
#include "terrain/generator.h"
#include "world/dimension.h"

#include <memory>
#include <string>
#include <vector>

namespace vitrail {

struct ColumnData {
    ColumnPos at;
    std::vector<WorldRecords::ColumnChunk> chunks; // bottom first; not lit; absent ones are air where `made`
    ColumnHeights heights;
    bool made = false;   // absent chunks are air (also beyond the end of an imported world); false: not readable
    bool stored = false; // the store holds all of it already
};

struct ChunkSourceOptions {
    u64 seed = 0;
    std::string generator; // "hills", or "" for none
    DimensionId generated_dimension = DimensionId::overworld;
};

class ChunkSource {
public:
    // Interns the generator's blocks and biomes. Errors: invalid_argument (unknown generator), limit.
    static Result<std::unique_ptr<ChunkSource>> create(WorldRecords& records, SaveQueue& saves,
                                                       ChunkSourceOptions options);

    // Errors: the store's; the caller may ask again later.
    Result<ColumnData> load(const DimensionInfo& dimension, ColumnPos at) const;

    const ChunkSourceOptions& options() const { return options_; }
    // Of the generator, 0 where there is none.
    static u32 generator_version(const std::string& generator);
    static bool known_generator(const std::string& generator) { return generator.empty() || generator == "hills"; }

private:
    ChunkSource(WorldRecords& records, SaveQueue& saves, ChunkSourceOptions options);
    WorldRecords& records_;
    SaveQueue& saves_;
    ChunkSourceOptions options_;
    TerrainPalette palette_;
};

} // namespace vitrail
