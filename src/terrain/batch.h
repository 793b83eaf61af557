// ColumnBatchMaker: whole rectangles of columns at once, several under way at a time; what a GPU wants to be asked.
// Made by open_cuda_batches (cuda/device.h).
#pragma once

#include "terrain/generator.h"

namespace vitrail {

struct ColumnRect {
    ColumnPos first;
    i32 width = 0, depth = 0; // columns along x and z
    u32 count() const { return u32(width) * u32(depth); }
};

struct BatchTimes {
    double stage_ms[u32(TerrainStage::count)] = {}; // on the device
    double copy_ms = 0, pack_ms = 0;                // to the host; chunks made there, summed over threads
    u64 columns = 0;
};

class ColumnBatchMaker {
public:
    virtual ~ColumnBatchMaker() = default;
    // Starts a rectangle of at most max_columns_a_side() squared and returns its number; at most max_batches() are
    // under way. Errors: limit (too large, too many), io (the device failed; it is then of no more use).
    virtual Result<u32> submit(ColumnRect rect) = 0;
    // Waits for it. Columns row by row. Errors: io; invalid_argument (no such number).
    virtual Result<std::vector<GeneratedColumn>> collect(u32 number, const TerrainPalette& palette) = 0;
    virtual u32 max_columns_a_side() const = 0;
    virtual u32 max_batches() const = 0;
    virtual std::string device_name() const = 0;
    virtual BatchTimes times() const = 0; // of all collected batches together
};

} // namespace vitrail
