#include "client/frame_builder.h"

#include <gtest/gtest.h>

using namespace vitrail;

static Dimension pond() {
    auto registry = std::make_shared<BlockRegistry>();
    BlockDef water;
    water.name = "minecraft:water";
    water.look.shape = ShapeKind::liquid;
    water.look.collision = false;
    registry->add_block(water);
    BlockDef kelp;
    kelp.name = "minecraft:kelp_plant";
    kelp.look.shape = ShapeKind::cross;
    kelp.look.collision = false;
    registry->add_block(kelp);
    auto states = std::make_shared<StateTable>(registry);
    const StateId id = *states->intern(*parse_block_state("water[level=0]"));
    Dimension dimension({}, states);
    auto chunk = std::make_shared<Chunk>();
    chunk->blocks.set({1, 1, 1}, id);
    chunk->blocks.set({1, 2, 1}, id);
    chunk->blocks.set({5, 1, 1}, *states->intern(*parse_block_state("kelp_plant")));
    dimension.put({0, 0, 0}, chunk);
    return dimension;
}

TEST(FrameBuilder, TheEyeIsUnderWaterOnlyBelowItsSurface) {
    const Dimension d = pond();
    EXPECT_TRUE(client::eye_in_liquid(d, world_pos_from_numbers(1.5, 1.99, 1.5))); // water above: full to the top
    EXPECT_TRUE(client::eye_in_liquid(d, world_pos_from_numbers(1.5, 2.5, 1.5)));
    EXPECT_FALSE(client::eye_in_liquid(d, world_pos_from_numbers(1.5, 2.97, 1.5)));
    EXPECT_FALSE(client::eye_in_liquid(d, world_pos_from_numbers(3.5, 1.5, 1.5)));
    EXPECT_TRUE(client::eye_in_liquid(d, world_pos_from_numbers(5.5, 1.5, 1.5))); // kelp stands in water
    EXPECT_FALSE(client::eye_in_liquid(d, world_pos_from_numbers(5.5, 1.97, 1.5)));
}

TEST(FrameBuilder, InterpolationIsExactAtBothEndsAndJumpsOverTeleports) {
    const WorldPos a = world_pos_from_numbers(2147482000.25, 5, -3), b = world_pos_from_numbers(2147482001.25, 5.5, -3);
    EXPECT_EQ(client::interpolate(a, b, 0), a);
    EXPECT_EQ(client::interpolate(a, b, 1), b);
    EXPECT_NEAR(view_from(a, client::interpolate(a, b, 0.5f)).v.x, 0.5, 1e-6);
    const WorldPos far = world_pos_from_numbers(0, 5, -3);
    EXPECT_EQ(client::interpolate(a, far, 0.3f), far);
}

TEST(FrameBuilder, TheFrameSpeaksInBlocksAndRadians) {
    const Dimension d = pond();
    const auto frame = client::build_frame({{DimensionId::overworld, {}}, 90, 0, 60}, d, 100, 50, 6000, 8, 1);
    ASSERT_EQ(frame.views.size(), 1u);
    EXPECT_NEAR(frame.views[0].fov_y, 1.0472f, 1e-3);
    EXPECT_EQ(frame.view_distance, 128);
}
