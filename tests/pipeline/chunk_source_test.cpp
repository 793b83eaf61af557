#include "pipeline/chunk_source.h"

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

    explicit Source(const std::string& generator) {
        static int count = 0;
        folder = std::filesystem::temp_directory_path() /
                 ("vitrail-source-" + std::to_string(::getpid()) + "-" + std::to_string(count++));
        std::filesystem::remove_all(folder);
        OpenOptions open;
        open.create = true;
        records = std::move(*WorldRecords::open(folder.string(), std::make_shared<BlockRegistry>(), open));
        saves = std::make_unique<SaveQueue>(*records);
        source = std::move(*ChunkSource::create(*records, *saves, {7, generator, DimensionId::overworld}));
    }
    ~Source() {
        saves.reset();
        records.reset();
        std::filesystem::remove_all(folder);
    }
};

TEST(ChunkSource, GeneratesWhatIsNotStoredWithTheHeightsAWorldWouldFind) {
    Source s("hills");
    for (i32 x = -2; x < 2; ++x) {
        auto column = s.source->load(DimensionInfo{}, {x, 5});
        ASSERT_TRUE(column) << column.error().message;
        EXPECT_TRUE(column->made);
        EXPECT_FALSE(column->stored);
        Dimension dimension(DimensionInfo{}, s.records->states_ptr());
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
    Source s("hills");
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
        auto column = s.source->load(DimensionInfo{}, {9, 9});
        ASSERT_TRUE(column);
        EXPECT_TRUE(column->made);
        EXPECT_TRUE(column->stored);
        ASSERT_EQ(column->chunks.size(), 1u);
        EXPECT_EQ(column->chunks[0].chunk->blocks.get(LocalPos(3, 4, 5)), gold);
        EXPECT_EQ(column->heights.above[3 | 5 << 4], 3 * 16 + 5);
        EXPECT_EQ(column->heights.above[0], DimensionInfo{}.min_y);
        ASSERT_TRUE(s.saves->flush());
    }
    EXPECT_FALSE(ChunkSource::create(*s.records, *s.saves, {7, "no such generator", DimensionId::overworld}));
}

TEST(ChunkSource, WithoutAGeneratorThereIsOpenAirThatTheStoreDoesNotKnow) {
    Source s("");
    auto column = s.source->load(DimensionInfo{}, {0, 0});
    ASSERT_TRUE(column);
    EXPECT_TRUE(column->made);
    EXPECT_FALSE(column->stored);
    EXPECT_TRUE(column->chunks.empty());
}

} // namespace
} // namespace vitrail
