// The walk of sight lines against rays cast block by block: whatever a ray passes has to be in the set.
#include "voxel/sight.h"

#include "base/rng.h"
#include "bench/voxel/sample_maze.h"
#include "voxel/ray_walk.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace vitrail {
namespace {

const u8 kFlags[] = {0, 1, 1};
const OpaqueStates kOpaque{kFlags, 1};
constexpr float kSlack = 0.125f;

struct Scene {
    explicit Scene(bench::SampleMaze m)
        : maze(std::move(m)) {
        box = {{0, 0, 0}, maze.size()};
        flood.reset(box);
        maze.each_section([&](ChunkPos at) {
            const SectionSight sight = section_sight(maze.blocks(at), kOpaque);
            connections.push_back(sight.connections);
            flood.set(at, sight);
        });
    }
    bench::SampleMaze maze;
    SightBox box;
    std::vector<u64> connections;
    SightFlood flood;
    std::vector<u8> seen; // by rays

    std::size_t walked() const { // by reachable_sections, from the last eye
        return walked_from.size();
    }
    std::vector<ChunkPos> walked_from;

    WorldPos eye_in(Rng& rng) const {
        const BlockPos b = maze.open_block(rng);
        WorldPos p = corner_of(b);
        // Now and then exactly on a boundary of blocks, which may be one of sections.
        const auto part = [&] { return rng.below(4) == 0 ? i64(0) : i64(rng.unit() * 0.999f * float(kFixedOne)); };
        p.x += part(), p.y += part(), p.z += part();
        return p;
    }
    void look_around(WorldPos eye, Rng& rng, u32 rays) {
        flood.run(eye, kSlack);
        seen.assign(box.count(), 0);
        for (u32 i = 0; i < rays; ++i) {
            Vec3 d{rng.unit() * 2 - 1, rng.unit() * 2 - 1, rng.unit() * 2 - 1};
            if (i % 16 == 0) d.x = 0; // along planes and axes too
            if (i % 24 == 0) d.z = 0;
            if (i % 2 == 1) d = view_from(eye, maze.open_block(rng, 50)).v; // through openings rather than at walls
            for (RayWalk walk(eye, d, 2000); walk.valid(); walk.step()) {
                const BlockPos at = walk.cell();
                if (!maze.inside(at)) break;
                seen[box.index(chunk_of(at))] = 1; // the section whose face is hit counts as seen
                if (maze.rock(at)) break;
            }
        }
        const SectionBounds bounds{{0, 0, 0}, {box.size.x - 1, box.size.y - 1, box.size.z - 1}};
        walked_from = reachable_sections(
            chunk_of(block_of(eye)), [&](ChunkPos p) { return connections[box.index(p)]; }, bounds);
    }
    void expect_nothing_lost(const char* what) {
        for (std::size_t i = 0; i < seen.size(); ++i) {
            const ChunkPos at = box.at(i);
            ASSERT_TRUE(!seen[i] || flood.reached()[i])
                << what << ": a ray sees section " << at.x << " " << at.y << " " << at.z;
        }
        // Nor does it find what not even the walk through open faces does.
        std::vector<u8> may(box.count());
        for (ChunkPos p : walked_from)
            may[box.index(p)] = 1;
        for (std::size_t i = 0; i < may.size(); ++i)
            ASSERT_TRUE(may[i] || !flood.reached()[i]) << what;
    }
};

std::size_t count(const std::vector<u8>& set) {
    return std::size_t(std::count(set.begin(), set.end(), u8(1)));
}

TEST(Sight, LosesNothingThatRaysFindInMazes) {
    std::size_t rays = 0, flood = 0, walk = 0;
    for (u64 seed = 1; seed <= 6; ++seed) {
        Rng rng(seed);
        bench::SampleMaze maze({8, 5, 7});
        maze.carve_maze(rng, u32(seed * 20));
        Scene scene(std::move(maze));
        for (u32 i = 0; i < 6; ++i) {
            scene.look_around(scene.eye_in(rng), rng, 8000);
            ASSERT_NO_FATAL_FAILURE(scene.expect_nothing_lost("maze"));
            rays += count(scene.seen);
            flood += scene.flood.reached_count(), walk += scene.walked();
        }
    }
    EXPECT_GE(flood, rays);
    EXPECT_LT(flood * 4, walk); // worth its while
}

// Halls joined by few narrow doors: long lines through openings.
TEST(Sight, LosesNothingThatRaysFindThroughDoors) {
    std::size_t rays = 0, flood = 0, walk = 0;
    for (u64 seed = 1; seed <= 8; ++seed) {
        Rng rng(40 + seed);
        bench::SampleMaze maze({7, 4, 7});
        maze.each_section([&](ChunkPos at) {
            const BlockPos o = origin_of(at);
            if (rng.below(4) == 0) return;
            maze.carve({o.x + 1, o.y + 1, o.z + 1}, {o.x + 14, o.y + 14, o.z + 14});
            for (i32 door = 0; door < 3; ++door) {
                const i32 u = 1 + i32(rng.below(10)), v = 1 + i32(rng.below(10)), w = i32(rng.below(5));
                if (door == 0) maze.carve({o.x + 15, o.y + u, o.z + v}, {o.x + 16, o.y + u + w, o.z + v + 1});
                if (door == 1) maze.carve({o.x + u, o.y + 15, o.z + v}, {o.x + u + w, o.y + 16, o.z + v + 1});
                if (door == 2) maze.carve({o.x + u, o.y + v, o.z + 15}, {o.x + u + w, o.y + v + 1, o.z + 16});
            }
        });
        Scene scene(std::move(maze));
        for (u32 i = 0; i < 4; ++i) {
            scene.look_around(scene.eye_in(rng), rng, 12000);
            ASSERT_NO_FATAL_FAILURE(scene.expect_nothing_lost("doors"));
            rays += count(scene.seen);
            flood += scene.flood.reached_count(), walk += scene.walked();
        }
    }
    EXPECT_GT(rays, 32u * 3);
    EXPECT_LT(flood * 4, walk);
    EXPECT_LT(flood, rays * 2); // nearly as good as the rays
}

TEST(Sight, LosesNothingThatRaysFindInCaves) {
    std::size_t rays = 0, flood = 0, walk = 0;
    for (u64 seed = 1; seed <= 10; ++seed) {
        Rng rng(100 + seed);
        bench::SampleMaze maze({7, 6, 7});
        maze.carve_caves(rng, 60 + 40 * u32(seed), seed % 2 ? 24 : 12);
        Scene scene(std::move(maze));
        for (u32 i = 0; i < 4; ++i) {
            scene.look_around(scene.eye_in(rng), rng, 8000);
            ASSERT_NO_FATAL_FAILURE(scene.expect_nothing_lost("caves"));
            rays += count(scene.seen);
            flood += scene.flood.reached_count(), walk += scene.walked();
        }
    }
    EXPECT_GE(flood, rays);
    EXPECT_LT(flood * 3, walk * 2);
}

// An eye that moves less than the slack keeps its set.
TEST(Sight, HoldsForEyesWithinTheSlack) {
    Rng rng(5);
    bench::SampleMaze maze({6, 4, 6});
    maze.carve_maze(rng, 60);
    Scene scene(std::move(maze));
    for (u32 i = 0; i < 12; ++i) {
        const WorldPos eye = scene.eye_in(rng);
        const auto by = [&] { return (rng.unit() * 2 - 1) * kSlack * 0.99f; };
        const WorldPos moved = offset_by(eye, {by(), by(), by()});
        if (!(chunk_of(block_of(moved)) == chunk_of(block_of(eye))) || scene.maze.rock(block_of(moved))) continue;
        scene.look_around(moved, rng, 8000);
        scene.flood.run(eye, kSlack);
        ASSERT_NO_FATAL_FAILURE(scene.expect_nothing_lost("moved"));
    }
}

// Far from the world's middle and in the open: everything in the box is seen; closed sections are entered, not passed.
TEST(Sight, OpenSpaceAndWalls) {
    const ChunkPos far{134217000, -1000, -134217000};
    SightFlood flood;
    flood.reset({{far.x - 12, far.y - 3, far.z - 12}, {25, 7, 25}});
    WorldPos eye = corner_of(origin_of(far));
    eye.x += 5 * kFixedOne, eye.y += 7 * kFixedOne;
    flood.run(eye, kSlack);
    EXPECT_EQ(flood.reached_count(), flood.box().count());
    for (i32 z = -12; z <= 12; ++z)
        for (i32 y = -3; y <= 3; ++y)
            flood.set({far.x + 2, far.y + y, far.z + z}, {0, kWholeFaces});
    flood.run(eye, kSlack);
    EXPECT_TRUE(flood.reached({far.x + 2, far.y, far.z}));
    for (i32 x = 3; x <= 12; ++x)
        EXPECT_FALSE(flood.reached({far.x + x, far.y, far.z})) << x;
    EXPECT_TRUE(flood.reached({far.x - 12, far.y + 3, far.z - 12}));
    // One hole in the wall, straight ahead: a cone behind it.
    flood.set({far.x + 2, far.y, far.z}, {});
    flood.run(eye, kSlack);
    EXPECT_TRUE(flood.reached({far.x + 12, far.y, far.z}));
    EXPECT_TRUE(flood.reached({far.x + 12, far.y, far.z + 4})); // 16 / 27 * 155 + ... blocks aside
    EXPECT_FALSE(flood.reached({far.x + 4, far.y, far.z + 3}));
    EXPECT_FALSE(flood.reached({far.x + 12, far.y, far.z + 8}));
    // An eye outside sees all.
    eye.y += 1000 * kFixedOne;
    flood.run(eye, kSlack);
    EXPECT_EQ(flood.reached_count(), flood.box().count());
}

} // namespace
} // namespace vitrail
