#include "pipeline/chunk_source.h"

#include "base_land.h"
#include "pipeline/new_world.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

namespace vitrail {
namespace {

struct Source {
    std::filesystem::path folder;
    std::unique_ptr<WorldRecords> records;
    std::unique_ptr<SaveQueue> saves;
    std::unique_ptr<ChunkSource> source;

    explicit Source(bool generated) {
        static int count = 0;
        folder = std::filesystem::temp_directory_path() /
                 ("vitrail-source-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
        std::filesystem::remove_all(folder);
        OpenOptions open;
        open.create = true;
        records = std::move(*WorldRecords::open(folder.string(), base_content().registry, open));
        saves = std::make_unique<SaveQueue>(*records);
        source = std::move(
            *ChunkSource::create(*records, *saves, {generated ? base_generator(7) : nullptr, DimensionId::overworld}));
    }
    ~Source() {
        saves.reset();
        records.reset();
        std::filesystem::remove_all(folder);
    }
};

TEST(ChunkSource, GeneratesWhatIsNotStoredWithTheHeightsAWorldWouldFind) {
    Source s(true);
    for (i32 x = -2; x < 2; ++x) {
        auto column = s.source->load(new_overworld(true), {x, 5});
        ASSERT_TRUE(column) << column.error().message;
        EXPECT_TRUE(column->made);
        EXPECT_FALSE(column->stored);
        Dimension dimension(new_overworld(true), s.records->states_ptr());
        for (auto& c : column->chunks) {
            EXPECT_EQ(c.chunk->light, nullptr);
            dimension.put(c.at, c.chunk);
        }
        EXPECT_EQ(compute_heights(dimension, {x, 5}).above, column->heights.above);
    }
    // Another dimension has no generator.
    DimensionInfo nether;
    nether.id = DimensionId(1);
    auto column = s.source->load(nether, {0, 0});
    ASSERT_TRUE(column);
    EXPECT_TRUE(column->chunks.empty());
}

TEST(ChunkSource, StoredColumnsWinOverTheGenerator) {
    Source s(true);
    const StateId gold = *s.records->states().intern(*parse_block_state("minecraft:gold_block"));
    auto chunk = std::make_shared<Chunk>();
    chunk->blocks.set(LocalPos(3, 4, 5), gold);
    SaveBatch batch;
    batch.chunks.push_back({DimensionId::overworld, {9, 3, 9}, chunk});
    ColumnRecord record;
    record.generated = true;
    batch.columns.push_back({DimensionId::overworld, {9, 9}, record});
    s.saves->submit(std::move(batch)); // pending or kept: the same answer
    for (int round = 0; round < 2; ++round) {
        auto column = s.source->load(new_overworld(true), {9, 9});
        ASSERT_TRUE(column);
        EXPECT_TRUE(column->made);
        EXPECT_TRUE(column->stored);
        ASSERT_EQ(column->chunks.size(), 1u);
        EXPECT_EQ(column->chunks[0].chunk->blocks.get(LocalPos(3, 4, 5)), gold);
        EXPECT_EQ(column->heights.above[3 | 5 << 4], 3 * 16 + 5);
        EXPECT_EQ(column->heights.above[0], kTerrainMinY);
        ASSERT_TRUE(s.saves->flush());
    }
}

TEST(ChunkSource, AColumnReadAndFinishedApartIsTheColumnLoaded) {
    Source s(true);
    const DimensionInfo info = new_overworld(true);
    auto stored = s.source->read(info, {4, -7});
    ASSERT_TRUE(stored);
    EXPECT_FALSE(stored->whole);
    const ColumnData apart = s.source->finish(info, {4, -7}, std::move(*stored));
    const auto whole = s.source->load(info, {4, -7});
    ASSERT_TRUE(whole);
    EXPECT_EQ(apart.heights.above, whole->heights.above);
    ASSERT_EQ(apart.chunks.size(), whole->chunks.size());
    EXPECT_EQ(apart.chunks.size(), std::size_t(kTerrainSections));
    for (std::size_t i = 0; i < apart.chunks.size(); ++i)
        for (u32 c = 0; c < u32(kChunkVolume); ++c)
            ASSERT_EQ(apart.chunks[i].chunk->blocks.get(LocalPos(c)), whole->chunks[i].chunk->blocks.get(LocalPos(c)));
}

// Worlds of another height than the generator's: the heights are of what the world holds.
TEST(ChunkSource, ADimensionOfAnotherHeightTakesWhatFits) {
    Source s(true);
    for (const auto& [low, high] : {std::pair{-64, 400}, {0, 384}, {-64, 320}, {32, 128}}) {
        DimensionInfo info;
        info.min_y = low, info.max_y = high;
        const auto column = s.source->load(info, {1, 2});
        ASSERT_TRUE(column);
        Dimension dimension(info, s.records->states_ptr());
        for (auto& c : column->chunks) {
            EXPECT_TRUE(dimension.contains(origin_of(c.at)));
            dimension.put(c.at, c.chunk);
        }
        EXPECT_EQ(compute_heights(dimension, {1, 2}).above, column->heights.above);
    }
}

TEST(ChunkSource, AnUnknownGeneratorIsNamedAndNothingIsMade) {
    const auto* terrain = base_content().terrain.get();
    const auto unknown = open_generator("hills", 1, terrain, 7);
    ASSERT_FALSE(unknown);
    EXPECT_EQ(unknown.error().code, ErrorCode::unsupported);
    EXPECT_NE(unknown.error().message.find("hills"), std::string::npos);
    EXPECT_EQ(open_generator(kGeneratorName, kGeneratorVersion + 1, terrain, 7).error().code, ErrorCode::unsupported);
    EXPECT_EQ(open_generator(kGeneratorName, kGeneratorVersion, nullptr, 7).error().code, ErrorCode::not_found);
    EXPECT_EQ(open_generator("", 0, nullptr, 7)->get(), nullptr);
}

TEST(ChunkSource, ABlockThatTheContentDoesNotKnowIsNamed) {
    StateTable states(std::make_shared<BlockRegistry>());
    BiomeTable biomes;
    const auto palette = make_terrain_palette(states, biomes, *base_generator(7));
    ASSERT_FALSE(palette);
    EXPECT_EQ(palette.error().code, ErrorCode::invalid_argument);
}

TEST(ChunkSource, WithoutAGeneratorThereIsOpenAirThatTheStoreDoesNotKnow) {
    Source s(false);
    auto column = s.source->load(DimensionInfo{}, {0, 0});
    ASSERT_TRUE(column);
    EXPECT_TRUE(column->made);
    EXPECT_FALSE(column->stored);
    EXPECT_TRUE(column->chunks.empty());
}

} // namespace
} // namespace vitrail
