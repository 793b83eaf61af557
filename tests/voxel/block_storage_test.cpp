#include "voxel/block_storage.h"

#include "base/rng.h"

#include <array>
#include <gtest/gtest.h>

using namespace vitrail;

TEST(BlockStorage, SetAndGetAgreeWithAPlainArrayAtEveryPaletteSize) {
    for (u32 kinds : {1u, 2u, 3u, 4u, 5u, 16u, 17u, 256u, 257u, 4096u}) {
        Rng rng(kinds);
        BlockStorage storage;
        std::array<StateId, kChunkVolume> truth{};
        for (int i = 0; i < 12000; ++i) {
            const LocalPos at(rng.below(kChunkVolume));
            const StateId state = StateId(rng.below(kinds) * 7);
            storage.set(at, state);
            truth[at.index] = state;
        }
        for (u32 i = 0; i < kChunkVolume; ++i)
            ASSERT_EQ(storage.get(LocalPos(i)), truth[i]);
        std::array<StateId, kChunkVolume> out;
        storage.unpack(out);
        EXPECT_EQ(out, truth);
        const BlockStorage made = BlockStorage::from_states(truth);
        EXPECT_TRUE(made == storage);
        storage.compact();
        EXPECT_TRUE(made == storage);
        EXPECT_LE(storage.bits(), bits_for_palette(kinds + 1));
    }
}

TEST(BlockStorage, UniformTakesNoWords) {
    BlockStorage storage(StateId(9));
    EXPECT_TRUE(storage.uniform());
    storage.set(LocalPos(1, 2, 3), StateId(4));
    EXPECT_FALSE(storage.uniform());
    storage.set(LocalPos(1, 2, 3), StateId(9));
    storage.compact();
    EXPECT_TRUE(storage.uniform());
    EXPECT_EQ(storage.get(LocalPos(4095u)), StateId(9));
}

TEST(BlockStorage, FromIndicesDropsUnusedAndDoubledEntries) {
    const std::array<StateId, 4> palette{StateId(5), StateId(6), StateId(5), StateId(7)};
    std::array<u16, kChunkVolume> indices{};
    indices[10] = 2;
    indices[11] = 1;
    const BlockStorage storage = BlockStorage::from_indices(palette, indices);
    EXPECT_EQ(storage.palette().size(), 2u);
    EXPECT_EQ(storage.get(LocalPos(10u)), StateId(5));
    EXPECT_EQ(storage.get(LocalPos(11u)), StateId(6));
}
