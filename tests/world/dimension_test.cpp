#include "world/dimension.h"

#include "base/rng.h"

#include <gtest/gtest.h>

using namespace vitrail;

namespace {

struct World {
    std::shared_ptr<StateTable> states = std::make_shared<StateTable>(std::make_shared<BlockRegistry>());
    StateId stone = *states->intern(BlockState{"mod:stone", {}});
    Dimension dimension{DimensionInfo{.min_y = -32, .max_y = 64}, states};
    World() {
        for (i32 x = -1; x <= 1; ++x)
            for (i32 z = -1; z <= 1; ++z) {
                for (i32 y = -2; y < 4; ++y)
                    dimension.put({x, y, z}, std::make_shared<Chunk>(Chunk{
                                                 BlockStorage(y < 0 ? stone : StateId::air), {}, {}, {}, {}, {}, 0}));
                dimension.put_heights({x, z}, compute_heights(dimension, {x, z}));
            }
    }
};

} // namespace

TEST(Dimension, ApplyPublishesNewSnapshotsAndLeavesOldOnes) {
    World w;
    const ChunkPtr old = w.dimension.find({0, 0, 0});
    const ChangeSet changes = apply(w.dimension, {{{{1, 1, 1}, w.stone}, {{2, 1, 1}, w.stone}, {{-1, 0, 0}, w.stone}}});
    EXPECT_EQ(changes.blocks.size(), 3u);
    EXPECT_EQ(changes.block_chunks.size(), 2u);
    EXPECT_EQ(old->blocks.get({1, 1, 1}), StateId::air);
    EXPECT_EQ(w.dimension.state_at({1, 1, 1}), w.stone);
    EXPECT_EQ(w.dimension.find({0, 0, 0})->revision, 1u);
}

TEST(Dimension, ChangesThatCancelOutAndEditsOutsideAreLeftOut) {
    World w;
    const ChangeSet changes = apply(w.dimension, {{{{1, 1, 1}, w.stone},
                                                   {{1, 1, 1}, StateId::air},
                                                   {{0, 64, 0}, w.stone},
                                                   {{0, -33, 0}, w.stone},
                                                   {{500, 0, 0}, w.stone},
                                                   {{0, -1, 0}, w.stone}}});
    EXPECT_TRUE(changes.empty());
    EXPECT_EQ(w.dimension.find({0, 0, 0})->revision, 0u);
}

TEST(Dimension, HeightsFollowEdits) {
    World w;
    Rng rng(11);
    for (int i = 0; i < 3000; ++i) {
        const BlockPos at{i32(rng.below(48)) - 16, i32(rng.below(96)) - 32, i32(rng.below(48)) - 16};
        apply(w.dimension, {{{at, rng.below(2) ? w.stone : StateId::air}}});
        const ColumnPos column = column_of(chunk_of(at));
        if (i % 50 == 0) ASSERT_EQ(w.dimension.heights(column)->above, compute_heights(w.dimension, column).above) << i;
    }
}
