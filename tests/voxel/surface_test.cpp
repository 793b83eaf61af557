#include "voxel/surface.h"

#include "base/rng.h"

#include <gtest/gtest.h>

#include <map>

namespace vitrail {
namespace {

// 0 air, 1 hidden, 2 stone, 3 ore, 4 glass
const u8 kFlags[] = {0, 1, 1, 1, 0};
const OpaqueStates kOpaque{kFlags, 1};

BlockStorage random_blocks(Rng& rng, u32 open_per_mille) {
    std::vector<StateId> cells(kChunkVolume);
    for (auto& c : cells)
        c = StateId(rng.below(1000) < open_per_mille ? rng.below(2) * 4 : 2 + rng.below(2));
    return BlockStorage::from_states(std::span<const StateId, kChunkVolume>(cells));
}

TEST(Surface, SameAsBruteForce) {
    for (u64 seed = 0; seed < 40; ++seed) {
        Rng rng(seed + 1);
        const BlockStorage center = random_blocks(rng, seed % 4 == 0 ? 0 : 20 + rng.below(300));
        std::array<BlockStorage, 6> sides;
        std::array<const BlockStorage*, 6> around{};
        const bool absent_opaque = seed & 1;
        for (u32 f = 0; f < 6; ++f) {
            sides[f] = random_blocks(rng, rng.below(3) * 100);
            around[f] = rng.below(4) ? &sides[f] : nullptr;
        }
        const BlockStorage got = make_surface(center, around, kOpaque, absent_opaque);
        const auto opaque_at = [&](i32 x, i32 y, i32 z) {
            const LocalPos local(x & 15, y & 15, z & 15);
            if (x >= 0 && x < 16 && y >= 0 && y < 16 && z >= 0 && z < 16) return kOpaque(center.get(local));
            const u32 f = x < 0 ? 0 : x > 15 ? 1 : y < 0 ? 2 : y > 15 ? 3 : z < 0 ? 4 : 5;
            return around[f] ? kOpaque(around[f]->get(local)) : absent_opaque;
        };
        for (u32 i = 0; i < kChunkVolume; ++i) {
            const LocalPos p(i);
            bool hidden = true;
            for (const IVec3& n : kFaceNormal)
                hidden &= opaque_at(p.x() + n.x, p.y() + n.y, p.z() + n.z);
            ASSERT_EQ(got.get(p), hidden ? StateId::hidden : center.get(p)) << "seed " << seed << " cell " << i;
        }
    }
}

TEST(Surface, WholeRockIsUniform) {
    const BlockStorage rock{StateId(2)};
    const std::array<const BlockStorage*, 6> all{&rock, &rock, &rock, &rock, &rock, &rock};
    const BlockStorage got = make_surface(rock, all, kOpaque, false);
    EXPECT_TRUE(got.uniform());
    EXPECT_EQ(got.get(LocalPos()), StateId::hidden);
    EXPECT_FALSE(make_surface(rock, {}, kOpaque, false).uniform());
}

TEST(Surface, ChunkLosesWhatIsHidden) {
    Chunk chunk;
    chunk.blocks = BlockStorage(StateId(2));
    chunk.block_entities = {{LocalPos(8, 8, 8), {}}, {LocalPos(0, 3, 3), {}}};
    chunk.ticks = {{LocalPos(8, 8, 8), 1, 0, StateId(2)}};
    chunk.revision = 9;
    const Chunk got = make_surface_chunk(chunk, {}, kOpaque, false);
    ASSERT_EQ(got.block_entities.size(), 1u);
    EXPECT_EQ(got.block_entities[0].at, LocalPos(0, 3, 3));
    EXPECT_TRUE(got.ticks.empty());
    EXPECT_EQ(got.revision, 9u);
}

TEST(Surface, EditsKeepTheSurfaceEqual) {
    Rng rng(3);
    std::map<std::tuple<i32, i32, i32>, StateId> blocks;
    constexpr i32 n = 10;
    const auto at = [&](BlockPos p) {
        const auto it = blocks.find({p.x, p.y, p.z});
        return it == blocks.end() ? StateId(2) : it->second;
    };
    for (i32 i = 0; i < n * n * n; ++i)
        blocks[{i % n, i / n % n, i / n / n}] = StateId(rng.below(10) == 0 ? 0 : 2 + rng.below(2));
    std::map<std::tuple<i32, i32, i32>, StateId> client;
    const auto surface = [&] {
        std::map<std::tuple<i32, i32, i32>, StateId> out;
        for (i32 x = -1; x <= n; ++x)
            for (i32 y = -1; y <= n; ++y)
                for (i32 z = -1; z <= n; ++z)
                    out[{x, y, z}] = is_hidden({x, y, z}, at, kOpaque) ? StateId::hidden : at({x, y, z});
        return out;
    };
    client = surface();
    for (u32 round = 0; round < 60; ++round) {
        ChangeSet changes;
        for (u32 i = 0; i < 1 + rng.below(6); ++i) {
            const BlockPos p{i32(rng.below(n)), i32(rng.below(n)), i32(rng.below(n))};
            const StateId after = StateId(rng.below(3) == 0 ? 2 + rng.below(2) : rng.below(2) * 4);
            bool twice = false;
            for (const BlockChange& c : changes.blocks)
                twice |= c.at == p;
            if (twice || at(p) == after) continue;
            changes.blocks.push_back({p, at(p), after});
            blocks[{p.x, p.y, p.z}] = after;
        }
        for (const Edit& e : surface_edits(changes, at, kOpaque))
            client[{e.at.x, e.at.y, e.at.z}] = e.state;
        ASSERT_EQ(client, surface()) << "round " << round;
    }
}

} // namespace
} // namespace vitrail
