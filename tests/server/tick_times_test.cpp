#include "server/tick_times.h"

#include <gtest/gtest.h>

namespace vitrail {
namespace {

using server::TickDistribution;
using server::TickTimes;

TEST(TickTimes, NothingYet) {
    const TickDistribution none = TickTimes().distribution();
    EXPECT_EQ(none.ticks, 0u);
    EXPECT_EQ(none.wall_ms_longest, 0.0f);
}

TEST(TickTimes, PercentilesOfAHundredInAnyOrder) {
    TickTimes times;
    for (u32 i = 0; i < 100; ++i)
        times.add(float(i * 37 % 100 + 1), float(i * 61 % 100 + 1) * 0.5f);
    const TickDistribution d = times.distribution();
    EXPECT_EQ(d.ticks, 100u);
    EXPECT_EQ(d.wall_ms_p50, 50.0f);
    EXPECT_EQ(d.wall_ms_p99, 99.0f);
    EXPECT_EQ(d.wall_ms_longest, 100.0f);
    EXPECT_EQ(d.cpu_ms_p50, 25.0f);
    EXPECT_EQ(d.cpu_ms_p99, 49.5f);
    EXPECT_EQ(d.cpu_ms_longest, 50.0f);
}

TEST(TickTimes, OneTickIsAllPercentiles) {
    TickTimes times;
    times.add(7, 3);
    const TickDistribution d = times.distribution();
    EXPECT_EQ(d.wall_ms_p50, 7.0f);
    EXPECT_EQ(d.wall_ms_p99, 7.0f);
    EXPECT_EQ(d.cpu_ms_p99, 3.0f);
}

TEST(TickTimes, OldOnesGo) {
    TickTimes times;
    times.add(1000, 1000);
    for (std::size_t i = 0; i + 1 < TickTimes::kKept; ++i)
        times.add(1, 1);
    EXPECT_EQ(times.distribution().wall_ms_longest, 1000.0f);
    times.add(2, 1);
    const TickDistribution d = times.distribution();
    EXPECT_EQ(d.ticks, u32(TickTimes::kKept));
    EXPECT_EQ(d.wall_ms_longest, 2.0f);
    EXPECT_EQ(d.cpu_ms_longest, 1.0f);
}

} // namespace
} // namespace vitrail
