// Rays that start in a cell with a model: what lies behind the start is not met.
#include "trace/grid/grid.h"
#include "trace/kernel/traverse.h"

#include <gtest/gtest.h>

namespace vitrail::test {
namespace {

using namespace trace;

TEST(TraverseStart, NothingBehindTheStart) {
    constexpr u32 kPost = 2;
    std::vector<StateRecord> states(3);
    std::vector<MediumRecord> media(1);
    TraceQuad quad{}; // an upright sheet at x = 0.5, its front to the east
    quad.corner = {0.5f, 0, 1}, quad.edge_a = {0, 0, -1}, quad.edge_b = {0, 1, 0}, quad.normal = {1, 0, 0};
    states[kPost].kind = CellKind::model;
    states[kPost].quads = 1;
    Grid grid({2, 2, 2});
    grid.set_states(states, media);
    grid.center_on({0, 0, 0});
    Chunk chunk;
    chunk.blocks.set(LocalPos(4, 4, 4), StateId(kPost));
    grid.set_chunk({0, 0, 0}, &chunk);
    SceneView s;
    s.grid = grid.view();
    s.states = states.data(), s.state_count = 3;
    s.quads = &quad;
    s.media = media.data();
    const Vec3 east = normalized({1, 0.1f, 0.2f});
    Hit hit;
    EXPECT_FALSE(closest_hit(s, {{{4, 4, 4}, {0.7f, 0.5f, 0.5f}}, east}, kFar, 0, hit)); // before it, looking away
    EXPECT_FALSE(closest_hit(s, {{{4, 4, 4}, {0.2f, 0.5f, 0.5f}}, east}, kFar, 0, hit)); // its back
    ASSERT_TRUE(closest_hit(s, {{{4, 4, 4}, {0.7f, 0.5f, 0.5f}}, -east}, kFar, 0, hit));
    EXPECT_NEAR(hit.t, 0.2f / east.x, 1e-4);
    ASSERT_TRUE(closest_hit(s, {{{6, 4, 4}, {0.7f, 0.5f, 0.5f}}, {-1, 0, 0}}, kFar, 0, hit));
    EXPECT_NEAR(hit.t, 2.2f, 1e-5);
    const auto pass = [](const Hit&) { return false; };
    EXPECT_FALSE(shadowed(s, {{{4, 4, 4}, {0.7f, 0.5f, 0.5f}}, east}, kFar, 0, pass));
    EXPECT_TRUE(shadowed(s, {{{4, 4, 4}, {0.7f, 0.5f, 0.5f}}, -east}, kFar, 0, pass));
}

} // namespace
} // namespace vitrail::test
