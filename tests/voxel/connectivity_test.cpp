#include "voxel/connectivity.h"

#include "base/rng.h"
#include "voxel/cell_mask.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

namespace vitrail {
namespace {

const u8 kFlags[] = {0, 1, 1};
const OpaqueStates kOpaque{kFlags, 1};

BlockStorage random_blocks(Rng& rng, u32 open_percent) {
    std::vector<StateId> cells(kChunkVolume);
    for (auto& c : cells)
        c = StateId(rng.below(100) < open_percent ? 0 : 2);
    return BlockStorage::from_states(std::span<const StateId, kChunkVolume>(cells));
}

u64 slow_connections(const BlockStorage& blocks) {
    std::vector<bool> seen(kChunkVolume);
    u64 out = 0;
    for (u32 start = 0; start < kChunkVolume; ++start) {
        if (seen[start] || kOpaque(blocks.get(LocalPos(start)))) continue;
        std::vector<u32> stack{start};
        seen[start] = true;
        u32 faces = 0;
        while (!stack.empty()) {
            const LocalPos p(stack.back());
            stack.pop_back();
            for (u32 f = 0; f < 6; ++f) {
                const i32 x = p.x() + kFaceNormal[f].x, y = p.y() + kFaceNormal[f].y, z = p.z() + kFaceNormal[f].z;
                if ((x | y | z) & ~15) {
                    faces |= 1u << f;
                    continue;
                }
                const u32 next = LocalPos(x, y, z).index;
                if (seen[next] || kOpaque(blocks.get(LocalPos(next)))) continue;
                seen[next] = true;
                stack.push_back(next);
            }
        }
        for (u32 a = 0; a < 6; ++a)
            for (u32 b = 0; b < 6; ++b)
                if ((faces >> a & 1) && (faces >> b & 1)) out |= u64(1) << (a * 6 + b);
    }
    return out;
}

TEST(Connectivity, SameAsSlowFlood) {
    Rng rng(11);
    for (u32 i = 0; i < 150; ++i) {
        const BlockStorage b = random_blocks(rng, i % 50);
        ASSERT_EQ(face_connections(b, kOpaque), slow_connections(b)) << "open percent " << i % 50;
    }
    EXPECT_EQ(face_connections(BlockStorage{}, kOpaque), kAllConnected);
    EXPECT_EQ(face_connections(BlockStorage{StateId(2)}, kOpaque), 0u);
}

TEST(Connectivity, OpeningsHoldTheOpenCellsOfFaces) {
    Rng rng(12);
    for (u32 i = 0; i < 60; ++i) {
        const BlockStorage b = random_blocks(rng, i % 12 == 0 ? 0 : i % 12);
        const SectionSight sight = section_sight(b, kOpaque);
        EXPECT_EQ(sight.connections, face_connections(b, kOpaque));
        for (u32 f = 0; f < 6; ++f) {
            const u32 axis = f >> 1, u = (axis + 1) % 3, v = (axis + 2) % 3;
            u32 least[2] = {15, 15}, most[2] = {0, 0};
            bool any = false;
            for (u32 c = 0; c < u32(kChunkVolume); ++c) {
                const LocalPos p(c);
                const u32 at[3] = {u32(p.x()), u32(p.y()), u32(p.z())};
                if (at[axis] != (f & 1 ? 15u : 0u) || kOpaque(b.get(p))) continue;
                any = true;
                least[0] = std::min(least[0], at[u]), most[0] = std::max(most[0], at[u]);
                least[1] = std::min(least[1], at[v]), most[1] = std::max(most[1], at[v]);
            }
            const u32 want = any ? least[0] | most[0] << 4 | least[1] << 8 | most[1] << 12 : u32(kWholeFace);
            ASSERT_EQ(sight.openings[f], want) << "face " << f << " of " << i;
        }
    }
    EXPECT_EQ(section_sight(BlockStorage{}, kOpaque), SectionSight{});
}

TEST(CellMasks, SameAsCellByCell) {
    Rng rng(4);
    for (const u32 entries : {1u, 2u, 3u, 4u, 9u, 16u, 40u, 256u, 700u}) {
        std::vector<StateId> cells(kChunkVolume);
        for (auto& c : cells)
            c = StateId(rng.below(entries));
        const BlockStorage b = BlockStorage::from_states(std::span<const StateId, kChunkVolume>(cells));
        std::vector<u8> classes(b.palette().size());
        for (auto& c : classes)
            c = u8(rng.next());
        std::vector<CellMask> masks(8);
        classify_cells(b, classes.data(), 8, masks.data());
        std::vector<u8> mapped(kChunkVolume);
        map_cells(b, classes.data(), mapped.data());
        std::map<StateId, u8> by_state;
        for (std::size_t p = 0; p < classes.size(); ++p)
            by_state[b.palette()[p]] = classes[p];
        for (u32 i = 0; i < kChunkVolume; ++i) {
            const u8 want = by_state[cells[i]];
            ASSERT_EQ(mapped[i], want);
            for (u32 k = 0; k < 8; ++k)
                ASSERT_EQ(test_cell(masks[k], LocalPos(i)), (want >> k & 1) != 0);
        }
    }
}

// All walks that never turn back, one by one.
void walk(ChunkPos start, ChunkPos at, u32 in, const std::map<std::tuple<i32, i32, i32>, u64>& world,
          SectionBounds bounds, std::set<std::tuple<i32, i32, i32>>& out) {
    out.insert({at.x, at.y, at.z});
    for (u32 f = 0; f < 6; ++f) {
        const i32 gone[3] = {at.x - start.x, at.y - start.y, at.z - start.z};
        if (f & 1 ? gone[f / 2] < 0 : gone[f / 2] > 0) continue;
        if (in < 6 && !connected(world.at({at.x, at.y, at.z}), Face(in), Face(f))) continue;
        const ChunkPos next = neighbor(at, Face(f));
        if (bounds.contains(next)) walk(start, next, f ^ 1, world, bounds, out);
    }
}

TEST(ReachableSections, SameAsAllWalks) {
    for (u64 seed = 1; seed <= 20; ++seed) {
        Rng rng(seed);
        const SectionBounds bounds{{-3, -2, -3}, {3, 2, 3}};
        std::map<std::tuple<i32, i32, i32>, u64> world;
        for (i32 x = -3; x <= 3; ++x)
            for (i32 y = -2; y <= 2; ++y)
                for (i32 z = -3; z <= 3; ++z) {
                    u64 c = 0;
                    for (u32 a = 0; a < 6; ++a)
                        for (u32 b = 0; b <= a; ++b)
                            if (rng.below(100) < 30) c |= u64(1) << (a * 6 + b) | u64(1) << (b * 6 + a);
                    world[{x, y, z}] = c;
                }
        std::set<std::tuple<i32, i32, i32>> want, got;
        walk({0, 0, 0}, {0, 0, 0}, 6, world, bounds, want);
        const auto found = reachable_sections(
            {0, 0, 0},
            [&](ChunkPos p) {
                return world.at({p.x, p.y, p.z});
            },
            bounds);
        for (const ChunkPos p : found)
            EXPECT_TRUE(got.insert({p.x, p.y, p.z}).second) << "twice";
        ASSERT_EQ(got, want) << "seed " << seed;
    }
    EXPECT_TRUE(reachable_sections({9, 0, 0}, [](ChunkPos) { return kAllConnected; }, {{0, 0, 0}, {1, 1, 1}}).empty());
}

// The same tests once more on the portable paths, in a process of its own because the choice is made once.
TEST(Portable, SameWithoutWideInstructions) {
    if (std::getenv("VITRAIL_PORTABLE")) GTEST_SKIP() << "this is that process";
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command =
        "VITRAIL_PORTABLE=1 '" + self + "' --gtest_filter='CellMasks.*:Connectivity.*:Surface.*' > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0);
}

} // namespace
} // namespace vitrail
