#include "pipeline/column_batches.h"

#include "jobs/thread_pool.h"

#include <atomic>
#include <gtest/gtest.h>

namespace vitrail {
namespace {

// Columns that carry their place in their heights.
class PlaceMaker : public ColumnBatchMaker {
public:
    explicit PlaceMaker(std::atomic<u32>& made, bool broken = false)
        : made_(made)
        , broken_(broken) {}
    Result<u32> submit(ColumnRect rect) override {
        if (broken_) return fail(ErrorCode::io, "the device is gone");
        EXPECT_FALSE(busy_.exchange(true)) << "two at once";
        rect_ = rect;
        return ++made_;
    }
    Result<std::vector<GeneratedColumn>> collect(u32, const TerrainPalette&) override {
        std::vector<GeneratedColumn> out(rect_.count());
        for (u32 i = 0; i < rect_.count(); ++i) {
            out[i].heights[0] = rect_.first.x + i32(i) % rect_.width;
            out[i].heights[1] = rect_.first.z + i32(i) / rect_.width;
        }
        busy_ = false;
        return out;
    }
    u32 max_columns_a_side() const override { return 8; }
    u32 max_batches() const override { return 1; }
    std::string device_name() const override { return "test"; }
    BatchTimes times() const override { return {}; }

private:
    std::atomic<u32>& made_;
    std::atomic<bool> busy_{false};
    bool broken_;
    ColumnRect rect_;
};

TEST(ColumnBatches, GivesEachColumnOfASquareOnce) {
    std::atomic<u32> made{0};
    ColumnBatches batches(std::make_unique<PlaceMaker>(made));
    for (i32 z = -16; z < 16; ++z)
        for (i32 x = -16; x < 16; ++x) {
            const auto column = batches.take({x, z}, {});
            ASSERT_TRUE(column);
            EXPECT_EQ(column->heights[0], x);
            EXPECT_EQ(column->heights[1], z);
        }
    EXPECT_EQ(made, 16u);
    ASSERT_TRUE(batches.take({3, 3}, {})); // taken before: made again
    EXPECT_EQ(made, 17u);
}

TEST(ColumnBatches, ManyThreadsAndMoreSquaresThanAreKept) {
    std::atomic<u32> made{0};
    ColumnBatches batches(std::make_unique<PlaceMaker>(made));
    ThreadPool pool(3);
    std::atomic<u32> wrong{0};
    pool.parallel_for(64 * 64, [&](u32 i) {
        const ColumnPos at{i32(i * 37 % 64) * 3, i32(i / 64) * 5};
        const auto column = batches.take(at, {});
        if (!column || column->heights[0] != at.x || column->heights[1] != at.z) ++wrong;
    });
    EXPECT_EQ(wrong, 0u);
}

TEST(ColumnBatches, AnErrorIsSaidAndNothingStays) {
    std::atomic<u32> made{0};
    ColumnBatches batches(std::make_unique<PlaceMaker>(made, true));
    for (int i = 0; i < 3; ++i) {
        const auto column = batches.take({1, 1}, {});
        ASSERT_FALSE(column);
        EXPECT_EQ(column.error().code, ErrorCode::io);
    }
}

} // namespace
} // namespace vitrail
