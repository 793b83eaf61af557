// ColumnBatches: one column at a time out of a maker of many (a GPU): squares of columns are made whole, and kept until
// their columns are taken or others crowd them out. Thread-safe.
#pragma once

#include "terrain/batch.h"

#include <condition_variable>
#include <list>
#include <memory>
#include <mutex>
#include <optional>

namespace vitrail {

class ColumnBatches {
public:
    static constexpr i32 kSide = 8;             // columns of a square
    static constexpr std::size_t kSquares = 16; // kept at most

    // The maker takes batches of at least kSide a side.
    explicit ColumnBatches(std::unique_ptr<ColumnBatchMaker> maker)
        : maker_(std::move(maker)) {}

    // The column, made with its square where it is not at hand; the palette is always the same one. Errors: the
    // maker's.
    Result<GeneratedColumn> take(ColumnPos at, const TerrainPalette& palette);
    std::string device_name() const { return maker_->device_name(); }

private:
    struct Square {
        ColumnPos first;
        bool making = true;
        std::optional<GeneratedColumn> columns[kSide * kSide];
    };
    std::unique_ptr<ColumnBatchMaker> maker_;
    std::mutex mutex_;       // of the squares
    std::mutex maker_mutex_; // held alone while one is made
    std::condition_variable made_;
    std::list<Square> squares_; // the latest first
};

} // namespace vitrail
