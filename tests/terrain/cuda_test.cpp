// The CUDA backend against the CPU, bit for bit. Skips where there is no device.
#include "terrain/cuda/device.h"
#include "tests/terrain/world_fixture.h"

namespace vitrail {
namespace {

void compare(const TerrainGenerator& cpu, ColumnBatchMaker& gpu, ColumnRect rect) {
    const TerrainPalette palette = plain_palette(cpu);
    auto number = gpu.submit(rect);
    ASSERT_TRUE(number) << number.error().message;
    auto columns = gpu.collect(*number, palette);
    ASSERT_TRUE(columns) << columns.error().message;
    ASSERT_EQ(columns->size(), rect.count());
    u32 wrong = 0;
    for (u32 i = 0; i < rect.count() && wrong < 3; ++i) {
        const ColumnPos at{rect.first.x + i32(i) % rect.width, rect.first.z + i32(i) / rect.width};
        const GeneratedColumn own = cpu.generate(at, palette);
        const GeneratedColumn& other = (*columns)[i];
        ASSERT_EQ(own.chunks.size(), other.chunks.size());
        for (std::size_t s = 0; s < own.chunks.size(); ++s) {
            for (u32 cell = 0; cell < kChunkVolume && wrong < 3; ++cell)
                if (own.chunks[s].blocks.get(LocalPos(cell)) != other.chunks[s].blocks.get(LocalPos(cell))) {
                    ++wrong;
                    const LocalPos p(cell);
                    ADD_FAILURE() << "column " << at.x << ' ' << at.z << " block " << p.x() << ' '
                                  << s * 16 + u32(p.y()) << ' ' << p.z() << ": cpu "
                                  << cpu.block_names()[u32(own.chunks[s].blocks.get(p))] << ", cuda "
                                  << cpu.block_names()[u32(other.chunks[s].blocks.get(p))];
                }
            EXPECT_EQ(own.chunks[s].biomes, other.chunks[s].biomes) << at.x << ' ' << at.z << " section " << s;
        }
        EXPECT_EQ(own.heights, other.heights);
    }
}

TEST(CudaTerrain, EqualsTheCpu) {
    const auto generator = base_generator(7);
    auto gpu = open_cuda_batches(generator, {.columns_most = 1024});
    if (!gpu) GTEST_SKIP() << gpu.error().message;
    compare(*generator, **gpu, {{-16, -16}, 32, 32});
    compare(*generator, **gpu, {{1000, -3000}, 17, 5});
    compare(*generator, **gpu, {{-134217696, 134217680}, 8, 8}); // the far corner
    for (u64 seed : {1, 2, 3}) {
        const auto other = base_generator(seed);
        auto device = open_cuda_batches(other, {.columns_most = 256});
        ASSERT_TRUE(device) << device.error().message;
        compare(*other, **device, {{i32(seed) * 400, 0}, 16, 16});
    }
}

TEST(CudaTerrain, PinnedHashOf1024Columns) {
    const auto generator = base_generator(kSampleSeed);
    auto gpu = open_cuda_batches(generator, {.columns_most = 576, .pack_threads = 3});
    if (!gpu) GTEST_SKIP() << gpu.error().message;
    const TerrainPalette palette = plain_palette(*generator);
    u64 sum = 0;
    for (const SampleRect& r : kSampleRects) {
        const auto number = (*gpu)->submit({r.first, r.side, r.side});
        ASSERT_TRUE(number) << number.error().message;
        const auto columns = (*gpu)->collect(*number, palette);
        ASSERT_TRUE(columns) << columns.error().message;
        for (i32 i = 0; i < r.side * r.side; ++i)
            sum += place_hash({r.first.x + i % r.side, r.first.z + i / r.side}, (*columns)[std::size_t(i)]);
    }
    EXPECT_EQ(sum, kSampleHash);
}

TEST(CudaTerrain, BatchesOverlapAndRefuse) {
    const auto generator = base_generator(7);
    auto gpu = open_cuda_batches(generator, {.batches = 2, .columns_most = 64, .pack_threads = 2});
    if (!gpu) GTEST_SKIP() << gpu.error().message;
    const TerrainPalette palette = plain_palette(*generator);
    EXPECT_FALSE((*gpu)->submit({{0, 0}, 9, 8}));
    EXPECT_FALSE((*gpu)->submit({{0, 0}, 0, 8}));
    EXPECT_FALSE((*gpu)->collect(77, palette));
    const auto a = (*gpu)->submit({{0, 0}, 8, 8}), b = (*gpu)->submit({{8, 0}, 8, 8});
    ASSERT_TRUE(a && b);
    EXPECT_FALSE((*gpu)->submit({{16, 0}, 8, 8})); // all under way
    const auto second = (*gpu)->collect(*b, palette), first = (*gpu)->collect(*a, palette);
    ASSERT_TRUE(first && second);
    EXPECT_EQ(column_hash((*first)[9]), column_hash(generator->generate({1, 1}, palette)));
    EXPECT_EQ(column_hash((*second)[9]), column_hash(generator->generate({9, 1}, palette)));
    EXPECT_FALSE((*gpu)->collect(*a, palette)); // once
}

} // namespace
} // namespace vitrail
