// Cubes and media: hits equal those of brute force.
#include "grid_world.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

Hit brute_cubes(const GridWorld& world, const Ray& ray) {
    Hit best;
    Crossing first{std::numeric_limits<double>::infinity(), 3};
    const IVec3 o = world.corner();
    for (i32 y = 0; y < GridWorld::kSize; ++y)
        for (i32 z = 0; z < GridWorld::kSize; ++z)
            for (i32 x = 0; x < GridWorld::kSize; ++x) {
                const IVec3 cell{i32(u32(o.x) + u32(x)), i32(u32(o.y) + u32(y)), i32(u32(o.z) + u32(z))};
                const u32 state = world.state(cell);
                if (state == 0) continue;
                const IVec3 r{i32(u32(cell.x) - u32(ray.from.cell.x)), i32(u32(cell.y) - u32(ray.from.cell.y)),
                              i32(u32(cell.z) - u32(ray.from.cell.z))};
                if (r == IVec3{}) continue;
                const Passage p = passage(ray, r);
                if (!p.passed || !p.in.before(first)) continue;
                first = p.in;
                const float d = p.in.axis == 0 ? ray.dir.x : p.in.axis == 1 ? ray.dir.y : ray.dir.z;
                best.t = float(p.in.t), best.cell = cell, best.state = state, best.kind = HitKind::cube;
                best.face = u8(p.in.axis * 2 + (d > 0 ? 0 : 1));
            }
    return best;
}

std::string text(const Hit& h) {
    return fmt::format("kind {} t {} cell {} {} {} state {} face {} leaving {}", int(h.kind), h.t, h.cell.x, h.cell.y,
                       h.cell.z, h.state, h.face, h.leaving);
}

void compare_cubes(GridWorld& world, Rng& rng, u32 rays) {
    const SceneView s = world.scene();
    for (u32 i = 0; i < rays; ++i) {
        const Ray ray = test_ray(rng, world, i);
        Hit hit;
        const bool any = closest_hit(s, ray, kFar, 0, hit);
        const Hit right = brute_cubes(world, ray);
        ASSERT_EQ(any, right.kind != HitKind::nothing) << i;
        ASSERT_EQ(text(hit), text(right)) << i;
        ASSERT_EQ(shadowed(s, ray, kFar, 0, [](const Hit&) { return false; }), any) << i;
        if (!any) continue;
        // No hit beyond t_max; just before it there is one.
        ASSERT_FALSE(closest_hit(s, ray, right.t * 0.999f, 0, hit));
        ASSERT_TRUE(closest_hit(s, ray, right.t * 1.001f + 1e-6f, 0, hit));
    }
}

TEST(TraverseCubes, EqualsBruteForceAtAllDensities) {
    Rng rng(1);
    for (double density : {0.0002, 0.01, 0.1, 0.35, 0.7, 0.99}) {
        GridWorld world;
        world.scatter(rng, t_stone, density);
        world.upload();
        compare_cubes(world, rng, 36);
    }
}

TEST(TraverseCubes, EqualsBruteForceInSparseStructures) {
    Rng rng(2);
    for (i32 side : {4, 16, 32}) {
        GridWorld world;
        world.scatter(rng, t_stone, 0.1, side);
        world.upload();
        compare_cubes(world, rng, 48);
    }
}

TEST(TraverseCubes, EqualsBruteForceFarFromTheMiddle) {
    Rng rng(3);
    constexpr i32 edge = kWorldEdge / 16;
    for (ChunkPos first : {ChunkPos{0, 0, 0}, ChunkPos{edge - 4, edge - 4, edge - 4}, ChunkPos{-edge, -edge, -edge},
                           ChunkPos{-edge, 8, edge - 4}}) {
        GridWorld world(first);
        world.scatter(rng, t_stone, 0.02, 2);
        world.upload();
        compare_cubes(world, rng, 48);
    }
}

TEST(TraverseCubes, RaysComeInFromOutsideOfTheWindow) {
    Rng rng(4);
    GridWorld world;
    world.scatter(rng, t_stone, 0.05);
    world.upload();
    const SceneView s = world.scene();
    u32 hits = 0;
    for (u32 i = 0; i < 120; ++i) {
        Ray ray = test_ray(rng, world, i);
        const auto away = [&](i32 c) { return c + i32(rng.below(400)) - 200; };
        const IVec3 aim = ray.from.cell;
        ray.from.cell = {away(aim.x), away(aim.y), away(aim.z)};
        if (i % 2) ray.dir = normalized(offset(ray.from, {aim, {0.5f, 0.5f, 0.5f}}));
        Hit hit;
        const bool any = closest_hit(s, ray, kFar, 0, hit);
        hits += any;
        ASSERT_EQ(text(hit), text(brute_cubes(world, ray))) << i;
    }
    EXPECT_GT(hits, 30u);
}

// Fractions that doubles hold exactly, compared as integers: where no two planes are met at once the cell is the one
// that exact arithmetic finds.
TEST(TraverseCubes, EqualsExactArithmetic) {
    Rng rng(5);
    GridWorld world;
    world.scatter(rng, t_stone, 0.03);
    world.upload();
    const SceneView s = world.scene();
    constexpr i64 kUnit = 1 << 20;
    struct Exact {
        i64 n = 0, d = 1; // distance n / d, d > 0
        bool operator<(const Exact& o) const { return n * o.d < o.n * d; }
        bool operator==(const Exact& o) const { return n * o.d == o.n * d; }
    };
    u32 compared = 0;
    for (u32 i = 0; i < 150; ++i) {
        Ray ray = test_ray(rng, world, 0);
        i64 at[3], dir[3];
        for (u32 a = 0; a < 3; ++a)
            at[a] = rng.below(u32(kUnit) + 1), dir[a] = i64(rng.below(u32(kUnit))) - kUnit / 2;
        ray.from.at = {float(at[0]) / kUnit, float(at[1]) / kUnit, float(at[2]) / kUnit};
        ray.dir = {float(dir[0]) / kUnit, float(dir[1]) / kUnit, float(dir[2]) / kUnit};
        Exact best{1 << 30, 1};
        IVec3 best_cell;
        bool tie = false;
        const IVec3 o = world.corner();
        for (i32 c = 0; c < GridWorld::kSize * GridWorld::kSize * GridWorld::kSize; ++c) {
            const IVec3 cell{o.x + c % 64, o.y + c / 4096, o.z + c / 64 % 64};
            if (world.state(cell) == 0) continue;
            const i64 r[3] = {cell.x - ray.from.cell.x, cell.y - ray.from.cell.y, cell.z - ray.from.cell.z};
            if (r[0] == 0 && r[1] == 0 && r[2] == 0) continue;
            Exact in{-1, 1}, out{1 << 30, 1};
            bool misses = false;
            for (u32 a = 0; a < 3; ++a) {
                if (dir[a] == 0) {
                    misses |= r[a] != 0;
                    continue;
                }
                const bool up = dir[a] > 0;
                misses |= up ? r[a] < 0 : r[a] > 0;
                const auto plane = [&](i64 k) {
                    const i64 n = k * kUnit - at[a];
                    return up ? Exact{n, dir[a]} : Exact{-n, -dir[a]};
                };
                const Exact x = plane(r[a] + (up ? 1 : 0));
                if (x < out) out = x;
                if (r[a] == 0) continue;
                const Exact e = plane(r[a] + (up ? 0 : 1));
                if (in < e) in = e;
            }
            if (misses || out < in) continue;
            if (in == out) {
                tie = true;
                break;
            }
            if (in < best) best = in, best_cell = cell;
        }
        if (tie) continue;
        Hit hit;
        const bool any = closest_hit(s, ray, kFar, 0, hit);
        ASSERT_EQ(any, best.n != 1 << 30) << i;
        if (!any) continue;
        ASSERT_EQ(hit.cell, best_cell) << i;
        ASSERT_FLOAT_EQ(hit.t, float(double(best.n) / double(best.d)));
        ++compared;
    }
    EXPECT_GT(compared, 80u);
}

// Planes of cubes that touch along edges only: nothing gets through them in any direction across.
TEST(TraverseCubes, NothingLeaksThroughDiagonals) {
    GridWorld world;
    for (i32 y = 0; y < 64; ++y)
        for (i32 z = 0; z < 64; ++z)
            for (i32 x = 0; x < 64; ++x)
                if (x + z == 64 || x + y == 40) world.at(x, y, z) = t_stone;
    world.upload();
    const SceneView s = world.scene();
    const IVec3 o = world.corner();
    Rng rng(6);
    for (u32 i = 0; i < 3000; ++i) {
        Ray ray;
        ray.from.cell = {o.x + 4 + i32(rng.below(8)), o.y + 4 + i32(rng.below(8)), o.z + 4 + i32(rng.below(8))};
        ray.from.at = {0.25f * float(rng.below(5)), 0.25f * float(rng.below(5)), 0.25f * float(rng.below(5))};
        // Diagonals are met exactly on edges.
        ray.dir = {1, float(rng.below(3)) * 0.5f, 1};
        if (i % 2) ray.dir = normalized({1 + float(rng.unit()), float(rng.unit()), 1 + float(rng.unit())});
        Hit hit;
        ASSERT_TRUE(closest_hit(s, ray, kFar, 0, hit)) << i;
        const i32 x = hit.cell.x - o.x, y = hit.cell.y - o.y, z = hit.cell.z - o.z;
        ASSERT_TRUE(x + z == 64 || x + y == 40);
    }
}

} // namespace
} // namespace vitrail::trace
