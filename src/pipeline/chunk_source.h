// ChunkSource: where the columns of a world come from: the store where they were saved (or imported), else the
// generator. Thread-safe and without state of its own, so workers ask it for many columns at once.
#pragma once

#include "pipeline/column_batches.h"
#include "store/save_queue.h"
#include "terrain/generator.h"
#include "world/dimension.h"

#include <atomic>
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
    std::shared_ptr<ColumnBatches> device = nullptr; // makes the columns instead, the same ones; null: the CPU does
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

    // Whether stages are to be run one by one on the CPU before `finish`.
    bool in_stages() const { return !options_.device; }

    const ChunkSourceOptions& options() const { return options_; }

private:
    ChunkSource(WorldRecords& records, SaveQueue& saves, ChunkSourceOptions options);
    WorldRecords& records_;
    SaveQueue& saves_;
    GeneratedColumn generate(ColumnPos at) const;
    ChunkSourceOptions options_;
    TerrainPalette palette_;
    mutable std::atomic<bool> device_failed_{false};
};

} // namespace vitrail
