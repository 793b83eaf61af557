#include "voxel/coords.h"

#include "base/rng.h"

#include <gtest/gtest.h>

using namespace vitrail;

TEST(Coords, ChunkAndLocalRoundTripOnBothSidesOfZero) {
    for (i32 v : {-kWorldEdge, -17, -16, -1, 0, 1, 15, 16, kWorldEdge - 1}) {
        const BlockPos p{v, -v - 1, v};
        EXPECT_EQ(block_at(chunk_of(p), local_of(p)), p);
        EXPECT_TRUE(in_world(p));
    }
    EXPECT_FALSE(in_world(BlockPos{kWorldEdge, 0, 0}));
    EXPECT_FALSE(in_world(BlockPos{0, -kWorldEdge - 1, 0}));
}

TEST(Coords, ViewIsTheSameAtTheOriginAndAtTheEdge) {
    Rng rng(3);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 offset{rng.unit() * 200 - 100, rng.unit() * 200 - 100, rng.unit() * 200 - 100};
        const BlockPos block{i32(rng.below(400)) - 200, i32(rng.below(400)) - 200, i32(rng.below(400)) - 200};
        const WorldPos eye = offset_by(WorldPos{}, offset);
        const Vec3 near = view_from(eye, block).v;
        for (i32 far : {2147483647 - 999, -(2147483647 - 999)}) {
            const BlockPos shifted{block.x + far, block.y + far, block.z + far};
            const WorldPos corner = corner_of(BlockPos{far, far, far});
            const WorldPos far_eye{corner.x + eye.x, corner.y + eye.y, corner.z + eye.z};
            EXPECT_EQ(view_from(far_eye, shifted).v, near);
        }
    }
}

TEST(Coords, OffsetStopsAtTheEdgeOfTheWorld) {
    const WorldPos edge = corner_of({kWorldEdge - 1, 0, -kWorldEdge});
    const WorldPos moved = offset_by(edge, {100, 0, -100});
    EXPECT_EQ(block_of(moved), (BlockPos{kWorldEdge - 1, 0, -kWorldEdge}));
}

TEST(Coords, NumbersOutsideTheWorldAreHeldInside) {
    EXPECT_EQ(block_of(world_pos_from_numbers(1e300, -1e300, 0.5)), (BlockPos{kWorldEdge - 1, -kWorldEdge, 0}));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(block_of(world_pos_from_numbers(nan, 1.25, -0.25)), (BlockPos{0, 1, -1}));
}
