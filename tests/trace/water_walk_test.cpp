// Rays along water: what the grid knows of it makes their ways short and changes nothing of what they meet.
#include "grid_world.h"
#include "trace/kernel/surface.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

void expect_equal(const Hit& a, const Hit& b, const std::string& what) {
    ASSERT_EQ(a.kind, b.kind) << what;
    ASSERT_EQ(a.t, b.t) << what;
    ASSERT_EQ(a.cell, b.cell) << what;
    ASSERT_EQ(a.state, b.state) << what;
    ASSERT_EQ(a.face, b.face) << what;
    ASSERT_EQ(a.leaving, b.leaving) << what;
    ASSERT_EQ(a.quad, b.quad) << what;
    ASSERT_EQ(a.u, b.u) << what;
    ASSERT_EQ(a.v, b.v) << what;
}

struct Met {
    u32 far = 0, panes = 0; // hits beyond 20 blocks; borders on ways to lights
    Met& operator+=(const Met& o) {
        far += o.far, panes += o.panes;
        return *this;
    }
};

// Many kinds of rays near a surface, told apart from the same where each cell of water is looked into. Near y, in cells
// from the corner; half of the rays start in water.
Met compare(GridWorld& world, Rng& rng, i32 y, u32 rays) {
    const SceneView quick = world.scene(), slow = world.slow_scene();
    EXPECT_EQ(quick.grid.water, 1u);
    const IVec3 o = world.corner();
    EXPECT_EQ(quick.grid.first.y * 16, o.y);
    Met all;
    for (i32 i = 0; i < 64 * 64; ++i) {
        const IVec3 cell{o.x + i % 64, o.y + y + i32(rng.below(3)) - 1, o.z + i / 64};
        if (world.content.states[world.state(cell)].medium != 1) continue;
        const LiquidTop a = liquid_top(quick, cell, 1), b = liquid_top(slow, cell, 1);
        EXPECT_EQ(a.full, b.full);
        EXPECT_EQ(a.covered, b.covered);
        const scene::LiquidSlope &p = a.slope, &q = b.slope;
        EXPECT_TRUE(p.h00 == q.h00 && p.h10 == q.h10 && p.h11 == q.h11 && p.h01 == q.h01) << i;
    }
    const auto pick = [&](std::initializer_list<float> values) {
        return values.begin()[rng.below(u32(values.size()))];
    };
    for (u32 i = 0; i < rays; ++i) {
        Ray ray;
        ray.from.cell = {o.x + i32(rng.below(64)), o.y + y + i32(rng.below(4)) - 2, o.z + i32(rng.below(64))};
        ray.from.at = {rng.unit(), rng.unit(), rng.unit()};
        if (i % 3 != 0) // at the surface, or a hair beside it
            ray.from.cell.y = o.y + y, ray.from.at.y = pick({0.890625f, 0.8905f, 0.8907f, 0.89062f, 0.5f, 1, 0});
        const float turn = rng.unit() * 6.2831853f,
                    rise = (rng.unit() - 0.5f) * pick({0.004f, 0.02f, 0.1f, 0.5f, 2, 1e-5f});
        ray.dir = normalized({std::cos(turn), rise, std::sin(turn)});
        if (i % 16 == 7) ray.dir = {0, pick({1e-9f, -1e-9f, 0}), pick({-1, 1})};
        if (i % 16 == 15) ray.dir = normalized({pick({-1, 1}), pick({0, 0.01f, -0.01f}), pick({-1, 1, 0})});
        const u32 medium = i % 8 == 1 ? 1 : medium_at(slow, ray.from.cell, ray.from.at); // who says so is believed
        const std::string what = fmt::format("ray {}", i);
        const float t_max = i % 5 == 0 ? 4 + 40 * rng.unit() : kFar;
        Hit a, b;
        EXPECT_EQ(closest_hit(quick, ray, t_max, medium, a), closest_hit(slow, ray, t_max, medium, b)) << what;
        expect_equal(a, b, what);
        std::vector<Hit> panes[2];
        bool dark[2];
        for (u32 k = 0; k < 2; ++k)
            dark[k] = shadowed(k ? slow : quick, ray, t_max, medium, [&](const Hit& hit) {
                panes[k].push_back(hit);
                return false;
            });
        EXPECT_EQ(dark[0], dark[1]) << what;
        EXPECT_EQ(panes[0].size(), panes[1].size()) << what;
        for (std::size_t k = 0; k < std::min(panes[0].size(), panes[1].size()); ++k)
            expect_equal(panes[0][k], panes[1][k], what);
        if (testing::Test::HasFailure()) return all;
        all.far += a.kind != HitKind::nothing && a.t > 20;
        all.panes += u32(panes[0].size());
    }
    return all;
}

void fill_sea(GridWorld& world, i32 bottom, i32 top) {
    for (i32 i = 0; i < 64 * 64 * 64; ++i) {
        const i32 y = i / 4096;
        world.at(i % 64, y, i / 64 % 64) = y < bottom ? t_stone : y <= top ? t_water : t_air;
    }
}

// Surfaces in a chunk's highest layer, its lowest, a brick's, and between.
TEST(WaterWalk, ALevelSea) {
    Rng rng(31);
    Met all;
    for (const i32 top : {15, 16, 19, 22}) {
        GridWorld world({0, -4, 4});
        fill_sea(world, top - 6, top);
        world.upload();
        all += compare(world, rng, top, 700);
        if (HasFailure()) return;
    }
    EXPECT_GT(all.far, 600u);
    EXPECT_GT(all.panes, 800u);
}

// Drops on it and holes in it, flows, plants, stones, ice and leaves, also above it.
TEST(WaterWalk, ASeaWithAllKindsOfThings) {
    Rng rng(32);
    Met all;
    for (const i32 top : {15, 17, 31}) {
        GridWorld world({-4, 0, -4});
        fill_sea(world, top - 5, top);
        constexpr u32 kStates[] = {t_air, t_water, t_flow, t_sunken, t_stone, t_glass, t_thin, t_plant, t_leaves};
        for (u32 i = 0; i < 120; ++i)
            world.at(i32(rng.below(64)), top - 1 + i32(rng.below(3)), i32(rng.below(64))) = kStates[i % 9];
        world.upload();
        all += compare(world, rng, top, 700);
        if (HasFailure()) return;
    }
    EXPECT_GT(all.far, 300u);
    EXPECT_GT(all.panes, 1000u);
}

// Terraces, walls of water and falls between them: boxes of calm water with surfaces and deep water side by side.
TEST(WaterWalk, SeasOfSeveralHeights) {
    Rng rng(33);
    GridWorld world({4, 4, 4});
    Met all;
    for (u32 round = 0; round < 4; ++round) {
        for (i32 z = 0; z < 64; ++z)
            for (i32 x = 0; x < 64; ++x) {
                const i32 top = 14 + 2 * ((x + i32(round) * 3) / 20 % 2) + 3 * (z / 28);
                for (i32 y = 0; y < 64; ++y)
                    world.at(x, y, z) = y < 8 ? t_stone : y <= top ? t_water : t_air;
                if (round == 3 && rng.below(40) == 0) world.at(x, top, z) = t_flow;
            }
        world.upload();
        all += compare(world, rng, 14 + 2 * i32(round % 2) + (round == 2 ? 3 : 0), 500);
        if (HasFailure()) return;
    }
    EXPECT_GT(all.far, 300u);
    EXPECT_GT(all.panes, 800u);
}

// Edits beside and above water, with rays between them.
TEST(WaterWalk, AfterEdits) {
    Rng rng(34);
    GridWorld world({-4, -4, -8});
    const i32 top = 16;
    fill_sea(world, 13, top);
    world.upload();
    const IVec3 o = world.corner();
    u32 panes = 0;
    for (u32 round = 0; round < 25; ++round) {
        EditBatch batch;
        for (u32 i = 0; i < 8; ++i) {
            const i32 x = i32(rng.below(64)), y = top - 1 + i32(rng.below(3)), z = i32(rng.below(64));
            constexpr u32 kStates[] = {t_air, t_water, t_flow, t_sunken, t_stone};
            world.at(x, y, z) = kStates[rng.below(5)];
            batch.edits.push_back({{o.x + x, o.y + y, o.z + z}, StateId(world.at(x, y, z))});
        }
        world.grid.apply(batch);
        panes += compare(world, rng, top, 60).panes;
        if (HasFailure()) return;
    }
    EXPECT_GT(panes, 500u);
}

// Rays below a surface, in water, and above it, in air, cross a chunk in a step or two and stop nowhere.
TEST(WaterWalk, ALevelSeaIsCrossedInFewSteps) {
    GridWorld world;
    fill_sea(world, 12, 20);
    world.upload();
    const SceneView s = world.scene();
    const IVec3 o = world.corner();
    for (const float rise : {0.001f, -0.001f}) {
        const Ray below{{{o.x + 1, o.y + 20, o.z + 1}, {0.5f, 0.7f, 0.5f}}, normalized({1, rise, 0.9f})};
        Walk w = start_walk(below);
        u32 steps = 12;
        EXPECT_EQ(next_in_water(s.grid, below, w, 1e30, steps), Walked::stopped);
        EXPECT_FALSE(in_window_cell(s.grid, w.cell())); // at the window's end
        const Ray above{{{o.x + 1, o.y + 20, o.z + 1}, {0.5f, rise > 0 ? 0.9f : 0.999f, 0.5f}}, below.dir};
        w = start_walk(above);
        EXPECT_EQ(next_look(s.grid, above, w, Seek::air, kFar, steps), Walked::ended);
    }
    // What rises through the surface is looked at where it does.
    const Ray out{{{o.x + 1, o.y + 18, o.z + 1}, {0.5f, 0.5f, 0.5f}}, normalized({1, 0.05f, 0.3f})};
    Walk w = start_walk(out);
    u32 steps = 40;
    EXPECT_EQ(next_in_water(s.grid, out, w, 1e30, steps), Walked::stopped);
    EXPECT_EQ(w.cell().y, o.y + 20);
    EXPECT_NEAR(double(w.cell().x), double(o.x) + 1.5 + (2.390625 / 0.05), 1);
    EXPECT_GT(steps, 15u);
}

} // namespace
} // namespace vitrail::trace
