// The whole generator: the same blocks whatever asks for them.
#include "base/rng.h"
#include "jobs/thread_pool.h"
#include "tests/terrain/world_fixture.h"

#include <algorithm>
#include <atomic>

namespace vitrail {
namespace {

// Each column's part of the sum.
std::vector<u64> hashes_of(const TerrainGenerator& generator, const std::vector<ColumnPos>& columns, unsigned threads) {
    const TerrainPalette palette = plain_palette(generator);
    std::vector<u64> out(columns.size());
    ThreadPool pool(threads);
    pool.parallel_for(u32(columns.size()),
                      [&](u32 i) { out[i] = place_hash(columns[i], generator.generate(columns[i], palette)); });
    return out;
}
u64 hash_of(const TerrainGenerator& generator, const std::vector<ColumnPos>& columns, unsigned threads) {
    u64 sum = 0;
    for (const u64 h : hashes_of(generator, columns, threads))
        sum += h;
    return sum;
}

std::vector<std::size_t> shuffled(std::size_t count) {
    std::vector<std::size_t> order(count);
    for (std::size_t i = 0; i < count; ++i)
        order[i] = i;
    Rng rng(5);
    for (std::size_t i = count - 1; i > 0; --i)
        std::swap(order[i], order[rng.below(u32(i + 1))]);
    return order;
}

TEST(Generator, PinnedHashOf1024ColumnsWithAnyThreadsInAnyOrder) {
    const auto columns = sample_columns();
    ASSERT_EQ(columns.size(), 1024u);
    const auto in_order = hashes_of(*base_generator(kSampleSeed), columns, 0);
    u64 sum = 0;
    for (const u64 h : in_order)
        sum += h;
    EXPECT_EQ(sum, kSampleHash);
    // Two threads (the pool's and this one), shuffled; all of them where time does not matter.
    auto order = shuffled(columns.size());
    if (!long_tests()) order.resize(128);
    std::vector<ColumnPos> some;
    for (const std::size_t i : order)
        some.push_back(columns[i]);
    const auto seen = hashes_of(*base_generator(kSampleSeed), some, 1);
    for (std::size_t i = 0; i < some.size(); ++i)
        EXPECT_EQ(seen[i], in_order[order[i]]) << some[i].x << ' ' << some[i].z;
}

void same_for(Isa isa, std::size_t step) {
    if (u8(isa) > u8(best_isa())) GTEST_SKIP() << "this machine lacks the instructions";
    std::vector<ColumnPos> columns;
    const auto all = sample_columns();
    for (std::size_t i = 0; i < all.size(); i += step)
        columns.push_back(all[i]);
    const auto best = base_generator(kSampleSeed), other = base_generator(kSampleSeed, {.isa = isa});
    EXPECT_EQ(hash_of(*best, columns, 1), hash_of(*other, columns, 1));
}

TEST(Generator, SameBitsPortable) {
    same_for(Isa::portable, 97);
}
TEST(Generator, SameBitsAvx2) {
    same_for(Isa::avx2, 31);
}
TEST(Generator, SameBitsOfAll1024ColumnsLong) {
    if (!long_tests()) GTEST_SKIP() << "VITRAIL_LONG is not set";
    for (const Isa isa : {Isa::portable, Isa::avx2, Isa::avx512}) {
        if (u8(isa) > u8(best_isa())) continue;
        EXPECT_EQ(hash_of(*base_generator(kSampleSeed, {.isa = isa}), sample_columns(), 1), kSampleHash) << int(isa);
    }
}

// A cache so small that everything is dropped at once changes nothing but the time.
TEST(Generator, ForgettingChangesNothing) {
    const auto wide = base_generator(3), tiny = base_generator(3, {.cache_bytes_most = 8u << 20});
    const TerrainPalette palette = plain_palette(*wide);
    for (const ColumnPos at : {ColumnPos{0, 0}, ColumnPos{40, -3}, ColumnPos{0, 1}, ColumnPos{-25, 12}})
        EXPECT_EQ(column_hash(wide->generate(at, palette)), column_hash(tiny->generate(at, palette)));
    EXPECT_LE(tiny->cache_stats().bytes, 16u << 20);
    EXPECT_GT(tiny->cache_stats().dropped, 0u);
}

TEST(Generator, MissingPartsRunInTheirOrder) {
    const auto generator = base_generator(4);
    std::vector<TerrainTask> tasks;
    generator->missing({100, 100}, tasks);
    ASSERT_FALSE(tasks.empty());
    for (const TerrainTask& task : tasks) {
        const auto before = generator->cache_stats().misses;
        generator->run(task);
        EXPECT_LE(generator->cache_stats().misses, before + 1) << "a part ran another that should have stood before it";
    }
    tasks.clear();
    generator->missing({100, 100}, tasks);
    EXPECT_TRUE(tasks.empty());
    const auto before = generator->cache_stats().misses;
    generator->generate({100, 100}, plain_palette(*generator));
    EXPECT_EQ(generator->cache_stats().misses, before);
}

TEST(Generator, SeedsDiffer) {
    const auto a = base_generator(1), b = base_generator(2);
    const TerrainPalette palette = plain_palette(*a);
    EXPECT_NE(column_hash(a->generate({5, 5}, palette)), column_hash(b->generate({5, 5}, palette)));
}

TEST(Generator, ColumnsAreWhole) {
    const auto generator = base_generator(9);
    const TerrainPalette palette = plain_palette(*generator);
    for (i32 i = 0; i < 24; ++i) {
        const ColumnPos at{i * 37 - 400, i * 53 - 600};
        const auto tile = generator->blocks(at);
        const auto column = generator->generate(at, palette);
        ASSERT_EQ(column.chunks.size(), std::size_t(kTerrainSections));
        for (i32 k = 0; k < kColumnCells; ++k) {
            EXPECT_EQ(tile->block[k], kBedrock);
            i32 top = kTerrainMaxY;
            while (top > 0 && tile->block[(top - 1) << 8 | k] == kAir)
                --top;
            EXPECT_EQ(column.heights[std::size_t(k)], top);
            EXPECT_LE(top, tile->top);
        }
        for (i32 y = 0; y < kTerrainMaxY; y += 7)
            for (i32 k = 0; k < kColumnCells; k += 5)
                EXPECT_EQ(u32(column.chunks[std::size_t(y >> 4)].blocks.get(LocalPos(k & 15, y & 15, k >> 4))),
                          tile->block[y << 8 | k]);
    }
}

// Two blocks of the content that are one state share a palette entry.
TEST(Generator, StatesWithTwoNamesArePackedOnce) {
    const auto generator = base_generator(9);
    const TerrainPalette plain = plain_palette(*generator);
    TerrainPalette doubled = plain;
    const auto tile = generator->blocks({0, 0});
    Block most = 0;
    for (i32 i = 0; i < kChunkVolume; ++i)
        most = std::max(most, tile->block[i]);
    ASSERT_GT(most, kBedrock);
    doubled.blocks[most] = doubled.blocks[kBedrock];
    const BiomeTile biomes{};
    const BlockStorage own = pack_column(*tile, biomes, plain).chunks[0].blocks,
                       seen = pack_column(*tile, biomes, doubled).chunks[0].blocks;
    for (u32 i = 0; i < kChunkVolume; ++i) {
        const StateId state = own.get(LocalPos(i));
        EXPECT_EQ(seen.get(LocalPos(i)), u32(state) == most ? doubled.blocks[kBedrock] : state);
    }
    EXPECT_EQ(seen.palette().size() + 1, own.palette().size());
}

TEST(Generator, SpawnIsDryAndOpen) {
    for (const u64 seed : {1, 2, 3, 4}) {
        const auto generator = base_generator(seed);
        const BlockPos feet = spawn_point(*generator);
        const auto tile = generator->blocks(column_of(chunk_of(feet)));
        const i32 index = (feet.x & 15) | (feet.z & 15) << 4;
        EXPECT_GE(feet.y, kTerrainSeaLevel);
        EXPECT_NE(tile->block[(feet.y - 1) << 8 | index], kAir);
        EXPECT_NE(tile->block[(feet.y - 1) << 8 | index], kWater);
        EXPECT_EQ(tile->block[feet.y << 8 | index], kAir);
        EXPECT_EQ(tile->block[(feet.y + 1) << 8 | index], kAir);
    }
}

} // namespace
} // namespace vitrail
