#include "rules/pick.h"

#include "rules_world.h"

#include <cmath>
#include <gtest/gtest.h>

namespace vitrail {
namespace {

TEST(Pick, HitsBoxesNotCells) {
    RulesWorld world;
    world.open(-16, -16, -16, 15, 15, 15);
    world.set(3, 0, 0, "slab");
    world.set(5, 0, 0, "stone");
    auto hit = pick_block(world.dimension(), world.position(0.5, 0.25, 0.5), {1, 0, 0}, 10);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->block, (BlockPos{3, 0, 0}));
    EXPECT_EQ(hit->face, Face::west);
    EXPECT_FLOAT_EQ(hit->t, 2.5f);
    hit = pick_block(world.dimension(), world.position(0.5, 0.75, 0.5), {1, 0, 0}, 10);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->block, (BlockPos{5, 0, 0}));
    EXPECT_FALSE(pick_block(world.dimension(), world.position(0.5, 0.75, 0.5), {1, 0, 0}, 4.4f));
    hit = pick_block(world.dimension(), world.position(3.5, 2.5, 0.5), {0, -1, 0}, 5);
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->face, Face::up);
    EXPECT_FLOAT_EQ(hit->point.y, 0.5f);
    EXPECT_FALSE(pick_block(world.dimension(), world.position(3.5, 2.5, 0.5), {0, 0, 0}, 5));
    EXPECT_FALSE(pick_block(world.dimension(), world.position(3.5, 2.5, 0.5), {NAN, 0, 0}, 5));
    world.set(3, 0, 0, "water");
    EXPECT_FALSE(pick_block(world.dimension(), world.position(3.5, 2.5, 0.5), {0, -1, 0}, 5)); // through liquids
    world.set(3, 0, 0, "vitrail:hidden");
    EXPECT_TRUE(pick_block(world.dimension(), world.position(3.5, 2.5, 0.5), {0, -1, 0}, 5));
}

// Every box of the world asked one by one, near the middle and near the edge.
TEST(Pick, AgainstBruteForce) {
    constexpr i32 far = kWorldEdge - 1024;
    for (const BlockPos origin : {BlockPos{0, 0, 0}, BlockPos{far, 0, -far}}) {
        Rng rng(6);
        RulesWorld world(origin);
        world.open(-16, -16, -16, 15, 15, 15);
        const char* names[] = {
            "stone", "slab", "stairs[facing=east]", "torch", "fence[east=true]", "wall_torch[facing=south]", "poppy",
            "door",  "water"};
        std::vector<BlockPos> placed;
        for (int i = 0; i < 500; ++i) {
            const i32 x = i32(rng.below(14)) - 7, y = i32(rng.below(14)) - 7, z = i32(rng.below(14)) - 7;
            world.set(x, y, z, names[rng.below(std::size(names))]);
            placed.push_back({x, y, z});
        }
        int hits = 0;
        for (int round = 0; round < 2000; ++round) {
            const double eye[3] = {rng.unit() * 14.0 - 7, rng.unit() * 14.0 - 7, rng.unit() * 14.0 - 7};
            Vec3 direction{rng.unit() * 2 - 1, rng.unit() * 2 - 1, rng.unit() * 2 - 1};
            if (rng.below(4) == 0) direction = {0, rng.below(2) ? 1.0f : -1.0f, 0};
            const double length = std::sqrt(double(dot(direction, direction)));
            const double d[3] = {direction.x / length, direction.y / length, direction.z / length};
            double best = 8;
            bool any = false;
            for (const BlockPos p : placed) {
                const StateId id = world.dimension().state_at(world.at(p.x, p.y, p.z));
                for (const ShapeBox& b : world.dimension().states().info(id).shape.pick) {
                    const double c[3] = {double(p.x), double(p.y), double(p.z)};
                    double t0 = 0, t1 = 8;
                    for (int a = 0; a < 3; ++a) {
                        const double lo = c[a] + b.min[a] / 64.0, hi = c[a] + b.max[a] / 64.0;
                        if (d[a] == 0) {
                            if (eye[a] < lo || eye[a] > hi) t0 = 1e9;
                            continue;
                        }
                        t0 = std::max(t0, std::min((lo - eye[a]) / d[a], (hi - eye[a]) / d[a]));
                        t1 = std::min(t1, std::max((lo - eye[a]) / d[a], (hi - eye[a]) / d[a]));
                    }
                    if (t0 <= t1 && t0 < best) best = t0, any = true;
                }
            }
            const auto hit = pick_block(world.dimension(), world.position(eye[0], eye[1], eye[2]), direction, 8);
            ASSERT_EQ(hit.has_value(), any);
            if (!any) continue;
            ++hits;
            EXPECT_NEAR(hit->t, best, 1e-4);
            // The point lies on the face that is named, unless the eye was inside.
            if (best > 0) {
                const StateId id = world.dimension().state_at(hit->block);
                const int axis = int(hit->face) / 2;
                bool on_face = false;
                for (const ShapeBox& b : world.dimension().states().info(id).shape.pick)
                    on_face |= std::abs((&hit->point.x)[axis] -
                                        float(int(hit->face) % 2 ? b.max[axis] : b.min[axis]) / 64) < 1e-4f;
                EXPECT_TRUE(on_face);
            }
        }
        EXPECT_GT(hits, 200);
    }
}

} // namespace
} // namespace vitrail
