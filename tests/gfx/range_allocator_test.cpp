#include "base/rng.h"
#include "gfx/range_allocator.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace vitrail::gfx {

TEST(RangeAllocator, JoinsWhatIsFreed) {
    RangeAllocator a(100);
    const u32 x = *a.allocate(40), y = *a.allocate(40), z = *a.allocate(20);
    EXPECT_FALSE(a.allocate(1));
    a.free(x, 40);
    a.free(z, 20);
    EXPECT_EQ(a.largest_free(), 40u);
    EXPECT_EQ(a.free_ranges(), 2u);
    a.free(y, 40);
    EXPECT_EQ(a.free_ranges(), 1u);
    EXPECT_EQ(*a.allocate(100), 0u);
}

TEST(RangeAllocator, TakesTheTightestRange) {
    RangeAllocator a(100);
    const u32 x = *a.allocate(30);
    (void)a.allocate(10);
    const u32 y = *a.allocate(12);
    (void)a.allocate(5);
    a.free(x, 30);
    a.free(y, 12);
    EXPECT_EQ(*a.allocate(11), y);
}

TEST(RangeAllocator, GrowsAtTheEnd) {
    RangeAllocator a(10);
    (void)a.allocate(6);
    EXPECT_FALSE(a.allocate(8));
    a.grow(14);
    EXPECT_EQ(*a.allocate(8), 6u); // the old rest and the new end are one
    EXPECT_EQ(a.used(), 14u);
}

// Against a plain map of who owns each unit.
TEST(RangeAllocator, EqualsBruteForceOnRandomUse) {
    Rng rng(3);
    for (int round = 0; round < 20; ++round) {
        u32 capacity = 200;
        RangeAllocator a(capacity);
        std::vector<int> owner(capacity, 0);
        std::vector<std::pair<u32, u32>> held;
        for (int step = 1; step < 600; ++step) {
            const u32 what = rng.below(100);
            if (what < 2 && capacity < 800) {
                capacity += 1 + rng.below(50);
                a.grow(capacity);
                owner.resize(capacity, 0);
            } else if (what < 55 || held.empty()) {
                const u32 count = 1 + rng.below(24);
                u32 longest = 0, run = 0;
                for (int o : owner)
                    run = o ? 0 : run + 1, longest = std::max(longest, run);
                ASSERT_EQ(a.largest_free(), longest);
                const auto at = a.allocate(count);
                ASSERT_EQ(at.has_value(), longest >= count);
                if (!at) continue;
                for (u32 i = *at; i < *at + count; ++i) {
                    ASSERT_EQ(owner[i], 0);
                    owner[i] = step;
                }
                held.emplace_back(*at, count);
            } else {
                const u32 i = rng.below(u32(held.size()));
                const auto [offset, count] = held[i];
                held[i] = held.back();
                held.pop_back();
                a.free(offset, count);
                std::fill_n(owner.begin() + offset, count, 0);
            }
            ASSERT_EQ(a.used(), u32(std::count_if(owner.begin(), owner.end(), [](int o) { return o != 0; })));
        }
    }
}

} // namespace vitrail::gfx
