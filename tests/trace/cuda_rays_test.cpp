// Rays on a CUDA device meet what they meet on the CPU; a mirror follows edits. Without a device they are skipped.
#include "grid_world.h"
#include "trace/cuda/probe.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

using cuda::MirrorSource;
using cuda::RayProbe;

#define OPEN_OR_SKIP(probe)                                                                                            \
    auto opened = RayProbe::open();                                                                                    \
    if (!opened) GTEST_SKIP() << opened.error().message;                                                               \
    RayProbe& probe = **opened

MirrorSource source_of(GridWorld& world) {
    MirrorSource s;
    world.grid.refresh();
    s.view = world.scene();
    s.grid = &world.grid;
    s.quads = world.content.quads.size();
    s.media = world.content.media.size();
    s.box_nodes = world.boxes.nodes();
    s.boxes = world.boxes.generation();
    return s;
}

std::string what(const Hit& h) {
    return fmt::format("kind {} cell {} {} {} state {} face {} leaving {} quad {}", int(h.kind), h.cell.x, h.cell.y,
                       h.cell.z, h.state, h.face, h.leaving, h.quad);
}

// Where two things lie a rounding apart either may come first; all else is equal.
void compare(RayProbe& probe, GridWorld& world, u32 medium, u64 seed, std::size_t count) {
    Rng rng(seed);
    std::vector<Ray> rays;
    for (std::size_t i = 0; i < count; ++i)
        rays.push_back(test_ray(rng, world, u32(i)));
    ASSERT_TRUE(probe.update(source_of(world)));
    ASSERT_TRUE(probe.set_rays(rays, true));
    ASSERT_TRUE(probe.closest(medium));
    ASSERT_TRUE(probe.shadows(medium));
    const std::vector<Hit> alike_hits = probe.hits().value();
    const std::vector<u8> alike_lit = probe.lit().value();
    ASSERT_TRUE(probe.set_rays(rays));
    ASSERT_TRUE(probe.closest(medium));
    ASSERT_TRUE(probe.shadows(medium));
    const std::vector<Hit> hits = probe.hits().value();
    const std::vector<u8> lit = probe.lit().value();
    EXPECT_EQ(lit, alike_lit);
    for (std::size_t i = 0; i < rays.size(); ++i)
        ASSERT_TRUE(hits[i].t == alike_hits[i].t && what(hits[i]) == what(alike_hits[i])) << i;
    const SceneView scene = world.scene();
    u32 near = 0;
    for (std::size_t i = 0; i < rays.size(); ++i) {
        Hit hit;
        closest_hit(scene, rays[i], kFar, medium, hit);
        const bool dark = shadowed(scene, rays[i], kFar, medium, [](const Hit&) { return false; });
        ASSERT_NEAR(hits[i].t, hit.t, 1e-4f * (1 + hit.t)) << i << " " << what(hit);
        if (what(hits[i]) != what(hit) || (lit[i] != 0) == dark) ++near;
    }
    EXPECT_LE(near, count / 1000);
}

TEST(CudaRays, MeetCubesAsOnTheCpu) {
    OPEN_OR_SKIP(probe);
    Rng rng(1);
    for (double density : {0.001, 0.05, 0.5}) {
        GridWorld world;
        world.scatter(rng, t_stone, density);
        world.upload();
        compare(probe, world, 0, 2, 20000);
    }
}

TEST(CudaRays, MeetAllKindsOfCellsAsOnTheCpu) {
    OPEN_OR_SKIP(probe);
    Rng rng(3);
    GridWorld world;
    for (u32 state = t_stone; state < t_states; ++state)
        world.scatter(rng, state, 0.03);
    world.scatter(rng, t_water, 0.1, 8);
    world.scatter(rng, t_glass, 0.05, 4);
    world.upload();
    compare(probe, world, 0, 4, 20000);
    compare(probe, world, 1, 5, 5000);
    compare(probe, world, 2, 6, 5000);
}

TEST(CudaRays, FollowEntities) {
    OPEN_OR_SKIP(probe);
    Rng rng(9);
    GridWorld world;
    world.fill(rng, {{t_stone, 0.001}});
    u64 seed = 30;
    for (u32 boxes : {12u, 400u, 399u, 3u, 0u, 50u}) { // few go where many were, and none
        world.scatter_boxes(rng, boxes);
        compare(probe, world, 0, ++seed, 2000);
    }
}

TEST(CudaRays, FollowEdits) {
    OPEN_OR_SKIP(probe);
    Rng rng(7);
    GridWorld world;
    world.scatter(rng, t_stone, 0.02);
    world.upload();
    compare(probe, world, 0, 8, 2000);
    const u64 whole = probe.sent_bytes();
    u64 before = whole;
    for (u32 round = 0; round < 4; ++round) {
        EditBatch edits;
        for (u32 i = 0; i < 5; ++i) {
            const i32 x = i32(rng.below(64)), y = i32(rng.below(64)), z = i32(rng.below(64));
            const u32 state = rng.below(2) ? u32(t_stone) : u32(t_air);
            world.at(x, y, z) = state;
            const IVec3 o = world.corner();
            edits.edits.push_back({{o.x + x, o.y + y, o.z + z}, StateId(state)});
        }
        world.grid.apply(edits);
        compare(probe, world, 0, 9 + round, 2000);
        EXPECT_LT(probe.sent_bytes() - before, whole / 4) << "only what changed is sent";
        before = probe.sent_bytes();
    }
    // Chunks that come and go.
    world.grid.set_chunk(world.chunk_pos(1, 2, 1), nullptr);
    for (i32 i = 0; i < 4096; ++i)
        world.at(16 + i % 16, 32 + i / 256, 16 + i / 16 % 16) = t_air;
    compare(probe, world, 0, 20, 2000);
    world.scatter(rng, t_glass, 0.1);
    world.upload();
    compare(probe, world, 0, 21, 2000);
}

} // namespace
} // namespace vitrail::trace
