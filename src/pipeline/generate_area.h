// Whole rectangles of generated columns, for `vitrail generate`, benchmarks and tests: on a CPU's threads or through a
// device's batches, handed over in any order.
#pragma once

#include "terrain/batch.h"

#include <array>
#include <atomic>
#include <functional>

namespace vitrail {

struct AreaOptions {
    unsigned threads = 1;                    // of the CPU, the calling one among them; at least 1
    bool stage_times = false;                // measure every stage: costs about a percent
    const std::atomic<bool>* stop = nullptr; // where it turns true, no further column begins
};

struct AreaStats {
    struct Stage {
        u64 count = 0;      // parts; a part of ground is a zone on a CPU
        double seconds = 0; // processor time of all threads; on a device its own time
    };
    std::array<Stage, u32(TerrainStage::count)> stages;
    u64 columns = 0, chunks = 0;               // chunks that hold anything
    double seconds = 0;                        // on the wall
    double copy_seconds = 0, pack_seconds = 0; // of a device
};

// Takes a column; on the CPU from several threads at once. An error ends the work.
using ColumnTaker = std::function<Result<>(ColumnPos at, GeneratedColumn& column)>;

// Errors: the taker's first one.
Result<AreaStats> generate_area(const TerrainGenerator& generator, const TerrainPalette& palette, ColumnRect area,
                                const AreaOptions& options, const ColumnTaker& take);
// Errors: the maker's, the taker's.
Result<AreaStats> generate_area(ColumnBatchMaker& maker, const TerrainPalette& palette, ColumnRect area,
                                const AreaOptions& options, const ColumnTaker& take);

// The columns of a rectangle as the CPU makes them: zone by zone, in bands as wide as the caches keep, so that what
// neighbors share is made once.
std::vector<ColumnPos> columns_by_zone(ColumnRect area);

// A hash of many columns whatever their order: the sum over columns of this.
u64 placed_column_hash(ColumnPos at, const GeneratedColumn& column);

} // namespace vitrail
