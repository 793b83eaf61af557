#include "world/day_clock.h"

#include <gtest/gtest.h>

namespace vitrail {

TEST(DayRunner, ADayTakesTheMinutesItShould) {
    for (u32 minutes : {1u, 7u, 20u, 33u, 1440u}) {
        DayRunner runner;
        u64 ticks = 0, most = 0, least = ~u64(0);
        for (u64 tick = 0; tick < u64(minutes) * 60 * 20; ++tick) {
            const u64 step = runner.step(minutes);
            ticks += step;
            most = std::max(most, step), least = std::min(least, step);
        }
        EXPECT_EQ(ticks, kDayTicks) << minutes;
        EXPECT_LE(most - least, 1u) << "evenly";
    }
    DayRunner still;
    for (int i = 0; i < 1000; ++i)
        ASSERT_EQ(still.step(0), 0u);
}

TEST(DayClock, RunsAtTheRateItIsTold) {
    for (u32 minutes : {1u, 20u, 1440u, 0u}) {
        DayClock clock;
        clock.hear(50000, minutes, 100);
        EXPECT_DOUBLE_EQ(clock.ticks(100), 50000);
        EXPECT_NEAR(clock.ticks(104), 50000 + (minutes ? 1600.0 / minutes : 0), 1e-6);
        EXPECT_EQ(clock.ticks(111), clock.ticks(200)) << "a silent server stops the sun";
    }
}

TEST(DayClock, NeitherJumpsNorTurnsBackWhenMessagesComeUnevenly) {
    DayClock clock;
    double last = 0, at = 0;
    clock.hear(1000, 20, 0);
    last = clock.ticks(0);
    u32 messages = 0;
    for (int i = 1; i < 4000; ++i) {
        at = i * 0.016;
        if (i % 312 == 0) { // each message late or early by up to a quarter of a second
            const double off = (messages++ % 2 ? 0.25 : -0.25);
            clock.hear(u64(1000 + (at + off) * 20), 20, at);
        }
        const double now = clock.ticks(at);
        ASSERT_GE(now, last);
        ASSERT_LT(now - last, 0.32 * 3.5) << "twice or thrice as fast for a while, at most";
        last = now;
    }
    EXPECT_NEAR(last, 1000 + at * 20, 6);
    clock.hear(13000, 20, at); // set by somebody: at once
    EXPECT_DOUBLE_EQ(clock.ticks(at), 13000);
    clock.hear(13000, 0, at + 1);
    EXPECT_NEAR(clock.ticks(at + 9), 13000, 0.5);
    EXPECT_NEAR(clock.ticks(at + 9.016) - clock.ticks(at + 9), 0, 0.05);
}

} // namespace vitrail
