#include "voxel/ray_walk.h"

#include "base/rng.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace vitrail {
namespace {

struct Visit {
    BlockPos cell;
    Face entry;
    double t;
};

std::vector<Visit> walk_all(WorldPos origin, Vec3 direction, float distance) {
    std::vector<Visit> out;
    for (RayWalk walk(origin, direction, distance); walk.valid(); walk.step())
        out.push_back({walk.cell(), walk.entry(), walk.t()});
    return out;
}

WorldPos at(BlockPos block, double fx, double fy, double fz) {
    const WorldPos corner = corner_of(block);
    return {corner.x + i64(fx * 4294967296.0), corner.y + i64(fy * 4294967296.0), corner.z + i64(fz * 4294967296.0)};
}

Vec3 random_direction(Rng& rng) {
    switch (rng.below(6)) {
    case 0: { // along an axis
        Vec3 v;
        (&v.x)[rng.below(3)] = rng.below(2) ? 1.0f : -1.0f;
        return v;
    }
    case 1:
        return {float(int(rng.below(3)) - 1), float(int(rng.below(3)) - 1),
                float(int(rng.below(3)) - 1)}; // diagonals, nothing
    default:
        return {rng.unit() * 2 - 1, rng.unit() * 2 - 1, rng.unit() * 2 - 1};
    }
}

TEST(RayWalk, StraightAlongAnAxis) {
    const auto visits = walk_all(at({0, 64, 0}, 0.25, 0.5, 0.5), {1, 0, 0}, 3);
    ASSERT_EQ(visits.size(), 4u);
    for (int i = 0; i < 4; ++i)
        EXPECT_EQ(visits[std::size_t(i)].cell, (BlockPos{i, 64, 0}));
    EXPECT_EQ(visits[1].entry, Face::west);
    EXPECT_DOUBLE_EQ(visits[1].t, 0.75);
    EXPECT_DOUBLE_EQ(visits[3].t, 2.75);
    const auto back = walk_all(at({0, 64, 0}, 0, 0.5, 0.5), {-2, 0, 0}, 1);
    ASSERT_EQ(back.size(), 3u); // from a boundary the cell behind begins at once
    EXPECT_EQ(back[1].t, 0);
    EXPECT_EQ(back[1].entry, Face::east);
}

TEST(RayWalk, NoDirectionStaysInItsCell) {
    EXPECT_EQ(walk_all(at({3, 4, 5}, 0.5, 0.5, 0.5), {0, 0, 0}, 100).size(), 1u);
    EXPECT_EQ(walk_all(at({3, 4, 5}, 0.5, 0.5, 0.5), {NAN, 1, 0}, 100).size(), 1u);
    EXPECT_EQ(walk_all(at({3, 4, 5}, 0.5, 0.5, 0.5), {INFINITY, 1, 0}, 100).size(), 1u);
    EXPECT_EQ(walk_all(at({3, 4, 5}, 0.5, 0.5, 0.5), {1, 1, 0}, NAN).size(), 1u);
    EXPECT_EQ(walk_all(at({3, 4, 5}, 0.5, 0.5, 0.5), {1, 1, 0}, -1).size(), 1u);
}

// Every cell whose inside the ray passes is visited, in order, and every visited one is touched; successive ones share
// a face.
TEST(RayWalk, AgainstBruteForce) {
    Rng rng(3);
    for (int round = 0; round < 4000; ++round) {
        const double f[3] = {rng.below(3) ? rng.unit() : 0.0, rng.below(3) ? rng.unit() : 0.5,
                             rng.below(3) ? rng.unit() : 0.0};
        const Vec3 direction = random_direction(rng);
        const float distance = rng.unit() * 9;
        const auto visits = walk_all(at({0, 0, 0}, f[0], f[1], f[2]), direction, distance);
        const double length = std::sqrt(double(direction.x) * direction.x + double(direction.y) * direction.y +
                                        double(direction.z) * direction.z);
        const double d[3] = {direction.x, direction.y, direction.z};
        for (std::size_t i = 1; i < visits.size(); ++i) {
            const BlockPos a = visits[i - 1].cell, b = visits[i].cell;
            EXPECT_EQ(std::abs(a.x - b.x) + std::abs(a.y - b.y) + std::abs(a.z - b.z), 1);
            EXPECT_EQ(neighbor(b, visits[i].entry), a);
            EXPECT_GE(visits[i].t, visits[i - 1].t);
            EXPECT_LE(visits[i].t, distance);
        }
        std::size_t found = 0;
        for (int x = -10; x <= 10; ++x)
            for (int y = -10; y <= 10; ++y)
                for (int z = -10; z <= 10; ++z) {
                    // The stretch of the ray within this cell.
                    const double lo[3] = {double(x), double(y), double(z)};
                    double t0 = 0, t1 = distance;
                    bool touched = true;
                    for (int a = 0; a < 3; ++a) {
                        const double speed = length > 0 ? d[a] / length : 0;
                        if (speed == 0)
                            touched &= f[a] >= lo[a] - 1e-9 && f[a] <= lo[a] + 1 + 1e-9;
                        else {
                            double enter = (lo[a] - f[a]) / speed, leave = (lo[a] + 1 - f[a]) / speed;
                            if (enter > leave) std::swap(enter, leave);
                            t0 = std::max(t0, enter);
                            t1 = std::min(t1, leave);
                        }
                    }
                    const bool visited = std::any_of(visits.begin(), visits.end(), [&](const Visit& v) {
                        return v.cell == BlockPos{x, y, z};
                    });
                    found += visited;
                    const bool inside_axis = [&] { // a ray in a boundary plane belongs to the upper cell
                        for (int a = 0; a < 3; ++a)
                            if (d[a] == 0 && !(f[a] >= lo[a] && f[a] < lo[a] + 1)) return false;
                        return true;
                    }();
                    if (touched && inside_axis && t1 - t0 > 1e-6 && length > 0) {
                        EXPECT_TRUE(visited) << x << ' ' << y << ' ' << z;
                    }
                    if (visited && length > 0) {
                        EXPECT_TRUE(touched && t1 - t0 > -1e-6) << x << ' ' << y << ' ' << z;
                    }
                }
        EXPECT_EQ(found, visits.size());
    }
}

TEST(RayWalk, TheSameEverywhere) {
    Rng rng(4);
    constexpr i32 far = kWorldEdge - 1000;
    for (int round = 0; round < 500; ++round) {
        const double f[3] = {rng.unit(), rng.unit(), rng.below(2) ? rng.unit() : 0.0};
        const Vec3 direction = random_direction(rng);
        const auto near = walk_all(at({0, 0, 0}, f[0], f[1], f[2]), direction, 50);
        for (const BlockPos o : {BlockPos{far, -far, far}, BlockPos{-far, far, -far}}) {
            const auto there = walk_all(at(o, f[0], f[1], f[2]), direction, 50);
            ASSERT_EQ(there.size(), near.size());
            for (std::size_t i = 0; i < near.size(); ++i) {
                EXPECT_EQ(there[i].cell, (BlockPos{near[i].cell.x + o.x, near[i].cell.y + o.y, near[i].cell.z + o.z}));
                EXPECT_EQ(there[i].t, near[i].t);
            }
        }
    }
}

TEST(RayWalk, EndsAtTheEdgeOfTheWorld) {
    const auto visits = walk_all(at({kWorldEdge - 3, 0, 0}, 0.5, 0.5, 0.5), {1, 0, 0}, 100);
    ASSERT_EQ(visits.size(), 3u);
    EXPECT_EQ(visits.back().cell.x, kWorldEdge - 1);
    EXPECT_EQ(walk_all(at({-kWorldEdge, 0, 0}, 0, 0.5, 0.5), {-1, 0, 0}, 100).size(), 1u);
    EXPECT_EQ(walk_all(at({0, 0, 0}, 0.5, 0.5, 0.5), {1, 1, 1}, 1e30f).size(),
              1u + 3u * u32((1 << 20) / std::sqrt(3.0) + 0.5));
}

} // namespace
} // namespace vitrail
