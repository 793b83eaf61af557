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

// What the store holds of a column.
struct StoredColumn {
    std::vector<WorldRecords::ColumnChunk> chunks;
    bool recorded = false; // as made: chunks that are absent are air
    bool whole = false;    // nothing is to be generated
};

struct ChunkSourceOptions {
    std::shared_ptr<const TerrainGenerator> generator; // null: none
    DimensionId generated_dimension = DimensionId::overworld;
};

class ChunkSource {
public:
    // Numbers the generator's blocks and biomes. Errors: those of make_terrain_palette.
    static Result<std::unique_ptr<ChunkSource>> create(WorldRecords& records, SaveQueue& saves,
                                                       ChunkSourceOptions options);

    // Errors: the store's; the caller may ask again later.
    Result<ColumnData> load(const DimensionInfo& dimension, ColumnPos at) const;

    // The two halves of `load`, between which a scheduler runs the stages that the generator still misses.
    Result<StoredColumn> read(const DimensionInfo& dimension, ColumnPos at) const;
    ColumnData finish(const DimensionInfo& dimension, ColumnPos at, StoredColumn stored) const;
    // Null where this dimension's columns come from the store alone.
    const TerrainGenerator* generator_of(const DimensionInfo& dimension) const;

    const ChunkSourceOptions& options() const { return options_; }

private:
    ChunkSource(WorldRecords& records, SaveQueue& saves, ChunkSourceOptions options);
    WorldRecords& records_;
    SaveQueue& saves_;
    ChunkSourceOptions options_;
    TerrainPalette palette_;
};

} // namespace vitrail
