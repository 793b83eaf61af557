// The walk through air in float goes the way of the walk in double, step by step.
#include "grid_world.h"
#include "trace/kernel/air_walk.h"

#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

const BrickBoxes kTable = make_brick_boxes();
const auto kBoxes = [](u32 i) { return kTable.of[i]; };

struct Counts {
    u64 steps = 0, unsure = 0, stops = 0, cells = 0;
};

// Walks to where the ray leaves what holds anything, through the cells that stop it too.
void compare(const GridView& g, const Ray& ray, Counts& counts) {
    AirPlace p{{0, 0, 0}, 3, true};
    if (!in_air_range(g, ray.from.cell)) p = step_exactly(g, ray, p, kFar);
    if (!p.inside) return;
    AirWalk a = start_air(g, ray, p.r, p.axis, kFar);
    Walk w = walk_in(ray, p.r, p.axis);
    for (;;) {
        const IVec3 cell = w.cell();
        const u32 word = g.skips[skip_index(g, {cell.x >> 2, cell.y >> 2, cell.z >> 2})];
        const bool stops = stops_air(g, cell);
        const Walk before = w;
        if (word & kBrickStops)
            step_cell(w);
        else
            leave_box(w, ray, skip_planes(w, cell, word));
        const bool leaves = !in_air_range(g, w.cell());
        ++counts.steps;
        ASSERT_EQ(stops_here(g, a), stops);
        counts.stops += stops;
        if (step_air(g, a, kBoxes)) {
            // Boxes of empty cells in a brick, a cell at a time.
            const IVec3 to = cell_of(a);
            w = before;
            if (word & kBrickStops) {
                const auto there = [&] { return to == IVec3{w.x, w.y, w.z}; };
                for (u32 steps = 0; !there() && steps < 12; ++steps) {
                    ASSERT_FALSE(stops_air(g, w.cell()));
                    step_cell(w);
                    ++counts.cells;
                }
            } else {
                leave_box(w, ray, skip_planes(w, cell, word));
            }
            ASSERT_FALSE(stops || !in_air_range(g, w.cell()));
            ASSERT_LT(w.t, 1e28);
            ASSERT_EQ(cell_of(a), (IVec3{w.x, w.y, w.z}));
            ASSERT_EQ(a.axis, w.axis);
            ASSERT_EQ(face_of(a), w.face());
            ASSERT_EQ(stop_distance(ray, cell_of(a), a.axis), w.t);
            continue;
        }
        if (leaves || w.t >= 1e28) return;
        counts.unsure += !stops && a.t < a.end;
        const AirPlace q = step_exactly(g, ray, {cell_of(a), a.axis, true}, kFar);
        ASSERT_TRUE(q.inside);
        ASSERT_EQ(q.r, (IVec3{w.x, w.y, w.z}));
        ASSERT_EQ(q.axis, w.axis);
        put_cell(g, a, q.r, q.axis);
    }
}

TEST(AirWalk, EqualsTheWalkInDouble) {
    Rng rng(41);
    constexpr i32 edge = kWorldEdge / 16;
    Counts usual, all;
    for (const ChunkPos first : {ChunkPos{-4, -4, -4}, ChunkPos{0, 4, 8}, ChunkPos{edge - 4, edge - 4, -edge}})
        for (const double density : {0.0003, 0.01, 0.2}) {
            GridWorld world(first);
            world.scatter(rng, t_stone, density);
            world.at(0, 0, 0) = world.at(63, 63, 63) = t_stone; // all of the window counts
            world.upload();
            const GridView g = world.grid.view();
            for (u32 i = 0; i < 6000; ++i) {
                Ray ray = test_ray(rng, world, i);
                compare(g, ray, i % 6 == 0 ? usual : all);
                if (HasFatalFailure()) FAIL() << "ray " << i;
                // From outside, near and far.
                const i32 away = i32(2u << rng.below(18)), half = GridWorld::kSize / 2;
                const IVec3 aim = ray.from.cell, o = world.corner();
                const auto off = [&](i32 c) { return i32(u32(c) + u32(half) + rng.below(u32(away) * 2) - u32(away)); };
                ray.from.cell = {off(o.x), off(o.y), off(o.z)};
                if (i % 2) ray.dir = normalized(offset(ray.from, {aim, {0.5f, 0.5f, 0.5f}}));
                compare(g, ray, all);
                if (HasFatalFailure()) FAIL() << "ray " << i << " from outside";
            }
        }
    EXPECT_GT(usual.steps, 100000u);
    EXPECT_GT(usual.stops, 1000u);
    EXPECT_LT(usual.unsure, usual.steps / 1000) << "float is nearly always sure";
    EXPECT_GT(all.steps, 1000000u);
    EXPECT_GT(all.unsure, 1000u);
}

// A window as wide as they get, and ways through all of it.
TEST(AirWalk, EqualsTheWalkInDoubleOnLongWays) {
    Rng rng(42);
    Grid grid(GridShape{6, 3, 6});
    TestContent content;
    grid.set_states(content.states, content.media);
    grid.center_on({0, 0, 0});
    Chunk chunk;
    for (u32 i = 0; i < 40; ++i)
        chunk.blocks.set(LocalPos(rng.below(16), rng.below(16), rng.below(16)), StateId(t_stone));
    for (u32 i = 0; i < 300; ++i)
        grid.set_chunk({i32(rng.below(64)) - 32, i32(rng.below(8)) - 4, i32(rng.below(64)) - 32}, &chunk);
    const GridView g = grid.view();
    Counts counts;
    for (u32 i = 0; i < 12000; ++i) {
        Ray ray;
        ray.from.cell = {i32(rng.below(1000)) - 500, i32(rng.below(120)) - 60, i32(rng.below(1000)) - 500};
        ray.from.at = {float(rng.unit()), float(rng.unit()), float(rng.unit())};
        ray.dir = normalized({float(rng.unit()) - 0.5f, 0.2f * (float(rng.unit()) - 0.5f), float(rng.unit()) - 0.5f});
        compare(g, ray, counts);
        if (HasFatalFailure()) FAIL() << "ray " << i;
    }
    EXPECT_GT(counts.steps, 100000u);
    EXPECT_LT(counts.unsure, counts.steps / 500);
}

} // namespace
} // namespace vitrail::trace
