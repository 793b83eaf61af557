// Surfaces of liquids: heights by the rule that the mesher draws, hits against marching.
#include "tests/trace/content_scene.h"
#include "trace/kernel/liquid.h"

#include "base/rng.h"

#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

OneChunkScene with_levels() {
    OneChunkScene s;
    for (const u32 height : {228u, 192u, 128u, 32u, 256u}) { // states 1..5; 5 falls
        StateRecord r;
        r.kind = CellKind::liquid, r.medium = 1, r.liquid_height = u8(height - 1);
        s.states.push_back(r);
    }
    StateRecord stone;
    stone.kind = CellKind::cube;
    s.states.push_back(stone); // 6
    return s;
}

TEST(TraceLiquid, CornersAreMeansOfTheCellsAround) {
    OneChunkScene s = with_levels();
    s.set(4, 4, 4, 1); // a source, flowing east and into the south
    s.set(5, 4, 4, 2);
    s.set(4, 4, 5, 3);
    s.set(3, 4, 3, 5), s.set(3, 5, 3, 1); // a fall with the fluid above it
    s.set(4, 4, 3, 6);
    const SceneView& v = s.finish();
    const LiquidTop top = liquid_top(v, {4, 4, 4}, 1);
    EXPECT_FALSE(top.full);
    EXPECT_EQ(top.slope.h00, 256) << "beside a fall";
    EXPECT_EQ(top.slope.h10, 212) << "(228 + 192) / 2 = 210, to the next 4";
    EXPECT_EQ(top.slope.h01, 180) << "(228 + 128) / 2 = 178";
    EXPECT_EQ(top.slope.h11, 184) << "(228 + 192 + 128) / 3 = 182";
    EXPECT_FALSE(top.level());
    EXPECT_TRUE(liquid_top(v, {3, 4, 3}, 1).full);
    const LiquidTop alone = liquid_top(v, {3, 5, 3}, 1);
    EXPECT_TRUE(alone.level());
    EXPECT_EQ(alone.slope.h00, 228);
    EXPECT_EQ(liquid_height_at(alone, 0.3f, 0.9f), 228.0f / 256);
}

TEST(TraceLiquid, HitsEqualMarching) {
    Rng rng(7);
    u32 hits = 0;
    for (u32 i = 0; i < 4000; ++i) {
        LiquidTop top;
        if (i % 8) top.slope = {i32(rng.below(257)), i32(rng.below(257)), i32(rng.below(257)), i32(rng.below(257))};
        const auto coordinate = [&] { return rng.unit() * 2 - 0.5f; };
        const Vec3 from{i % 3 ? rng.unit() : coordinate(), coordinate(), i % 3 ? rng.unit() : coordinate()};
        const Vec3 dir{rng.unit() - 0.5f, rng.unit() - 0.5f, rng.unit() - 0.5f};
        const bool leaving = i & 1;
        float t = -1;
        const bool found = hit_liquid_top(top, from, dir, 0, 8, leaving, t);
        // Marching in small steps over the cell.
        const auto above = [&](float at) {
            const Vec3 p = from + dir * at;
            return p.y - liquid_height_at(top, p.x, p.z);
        };
        const auto inside = [&](float at) {
            const Vec3 p = from + dir * at;
            return p.x > 0 && p.x < 1 && p.z > 0 && p.z < 1;
        };
        constexpr float kStep = 1.0f / 256;
        float expected = -1;
        bool near_rim = false;
        for (float at = kStep; at < 8 && expected < 0; at += kStep) {
            const bool crosses =
                leaving ? above(at - kStep) < 0 && above(at) >= 0 : above(at - kStep) > 0 && above(at) <= 0;
            if (!crosses) continue;
            if (inside(at) && inside(at - kStep))
                expected = at;
            else
                near_rim |= inside(at) || inside(at - kStep);
        }
        if (near_rim) continue;
        ASSERT_EQ(found, expected >= 0) << i;
        if (!found) continue;
        ++hits;
        EXPECT_NEAR(t, expected, kStep * 1.01f) << i;
        EXPECT_NEAR(above(t), 0, 1e-5f) << i;
    }
    EXPECT_GT(hits, 250u);
}

TEST(TraceLiquid, NormalsFollowTheHeights) {
    Rng rng(3);
    for (u32 i = 0; i < 200; ++i) {
        LiquidTop top;
        top.slope = {i32(rng.below(257)), i32(rng.below(257)), i32(rng.below(257)), i32(rng.below(257))};
        const float x = rng.unit(), z = rng.unit(), e = 0.01f;
        if (std::abs(x + z - 1) < 3 * e) continue;
        const float gx = (liquid_height_at(top, x + e, z) - liquid_height_at(top, x - e, z)) / (2 * e),
                    gz = (liquid_height_at(top, x, z + e) - liquid_height_at(top, x, z - e)) / (2 * e);
        const Vec3 n = liquid_normal(top, x, z), expected = normalized({-gx, 1, -gz});
        EXPECT_NEAR(dot(n, expected), 1, 1e-5f);
        EXPECT_NEAR(length(n), 1, 1e-5f);
    }
}

} // namespace
} // namespace vitrail::trace
