#include "scene/resolution.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace vitrail::scene {

namespace {

// A machine whose frames take fixed_ms and pixels_ms where all pixels are drawn.
struct Machine {
    double fixed_ms = 5, pixels_ms = 40;
    float frame_ms(float share) const { return float(fixed_ms + pixels_ms * double(share) * double(share)); }
};

struct Playing {
    ResolutionControl control;
    ResolutionWish wish;
    float last_ms = 0;
    std::vector<float> shares;
    void go(const Machine& machine, double seconds) {
        for (double t = 0; t < seconds;) {
            const float share = control.next(last_ms, wish);
            shares.push_back(share);
            last_ms = machine.frame_ms(share);
            t += double(last_ms) * 1e-3;
        }
    }
    u32 changes() const {
        u32 n = 0;
        for (std::size_t i = 1; i < shares.size(); ++i)
            n += shares[i] != shares[i - 1];
        return n;
    }
};

} // namespace

TEST(Resolution, AFastMachineDrawsEverything) {
    Playing run;
    run.go({5, 20}, 60);
    EXPECT_EQ(*std::min_element(run.shares.begin(), run.shares.end()), 1.0f);
}

TEST(Resolution, ASlowOneSettlesWhereTheRateHolds) {
    for (const Machine machine : {Machine{5, 40}, Machine{12, 30}, Machine{2, 60}, Machine{0, 34.9}}) {
        Playing run;
        run.go(machine, 3);
        const float settled = run.shares.back();
        EXPECT_LE(machine.frame_ms(settled), run.wish.frame_ms * 1.06f);
        // Not less than is needed: two steps more would take too long.
        const float step = std::pow(run.wish.least / run.wish.most, 1.0f / float(ResolutionControl::kSteps));
        EXPECT_GT(machine.frame_ms(std::min(settled / (step * step), 1.0f)), run.wish.frame_ms * 0.95f);
        // Tries for more grow rare: a change is seen once in 15 s at most in the end.
        run.go(machine, 120);
        run.shares.clear();
        run.go(machine, 120);
        EXPECT_LE(run.changes(), 16u);
        u32 held = 0;
        for (float share : run.shares)
            held += machine.frame_ms(share) <= run.wish.frame_ms * 1.06f;
        EXPECT_GT(double(held), 0.95 * double(run.shares.size()));
    }
}

TEST(Resolution, ItNeverLeavesItsBounds) {
    Playing run;
    run.wish = {10, 0.6f, 0.9f};
    run.go({50, 500}, 60);
    EXPECT_FLOAT_EQ(run.shares.back(), 0.6f);
    for (float share : run.shares)
        EXPECT_TRUE(share >= 0.6f - 1e-6f && share <= 0.9f) << share;
    Playing one;
    one.wish = {10, 0.7f, 0.7f};
    one.go({50, 500}, 5);
    for (float share : one.shares)
        EXPECT_FLOAT_EQ(share, 0.7f);
}

TEST(Resolution, OneLongFrameChangesNothing) {
    ResolutionControl control;
    const ResolutionWish wish;
    for (int i = 0; i < 600; ++i)
        EXPECT_EQ(control.next(i % 20 == 7 ? 400.0f : 25.0f, wish), 1.0f);
}

TEST(Resolution, ItRisesAgainWhereThereIsTime) {
    Playing run;
    run.go({5, 80}, 10);
    EXPECT_LT(run.shares.back(), 0.75f);
    run.go({5, 10}, 12);
    EXPECT_EQ(run.shares.back(), 1.0f);
}

// Waiting for the screen makes every frame as long as wanted, however fast the machine is.
TEST(Resolution, ItRisesThoughFramesWaitForTheScreen) {
    Playing run;
    run.wish.frame_ms = 1000.0f / 60;
    run.go({5, 80}, 10);
    EXPECT_LT(run.shares.back(), 0.7f);
    for (int i = 0; i < 60 * 60; ++i)
        run.shares.push_back(run.control.next(run.wish.frame_ms, run.wish));
    EXPECT_EQ(run.shares.back(), 1.0f);
}

TEST(Resolution, AnotherWishBeginsAnew) {
    Playing run;
    run.go({5, 80}, 10);
    EXPECT_LT(run.shares.back(), 0.75f);
    run.wish.most = 0.9f;
    EXPECT_EQ(run.control.next(90, run.wish), 0.9f);
}

TEST(Resolution, DrawnSizesAreRoundedAndNeverNothing) {
    EXPECT_EQ(drawn_size(854, 480, 1), std::pair(854u, 480u));
    EXPECT_EQ(drawn_size(854, 480, 0.6f), std::pair(512u, 288u));
    EXPECT_EQ(drawn_size(1, 2, 0.1f), std::pair(1u, 1u));
}

} // namespace vitrail::scene
