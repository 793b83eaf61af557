#include "pipeline/column_keeper.h"

#include "pipeline/new_world.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace vitrail;
namespace fs = std::filesystem;

namespace {

struct KeeperTest : testing::Test {
    fs::path folder = fs::temp_directory_path() / ("vitrail-keeper-" + std::to_string(getpid()));
    std::shared_ptr<BlockRegistry> registry = std::make_shared<BlockRegistry>();
    void SetUp() override { fs::remove_all(folder); }
    void TearDown() override { fs::remove_all(folder); }
    // As `vitrail generate --world` does with one column.
    void generate(ColumnPos at) {
        auto keeper = ColumnKeeper::open(folder.string(), 7, registry);
        ASSERT_TRUE(keeper) << keeper.error().message;
        const auto palette = make_terrain_palette((*keeper)->records().states(), (*keeper)->records().biomes());
        ASSERT_TRUE(palette);
        GeneratedColumn column = generate_column(7, at, *palette);
        ASSERT_TRUE((*keeper)->keep(at, column));
        ASSERT_TRUE((*keeper)->flush());
    }
};

} // namespace

TEST_F(KeeperTest, GeneratingAgainLeavesWhatSomebodyBuilt) {
    ASSERT_NO_FATAL_FAILURE(generate({2, 3}));
    const ChunkPos where{2, 5, 3};
    StateId gold{};
    {
        auto records = WorldRecords::open(folder.string(), registry);
        ASSERT_TRUE(records);
        gold = *(*records)->states().intern(*parse_block_state("minecraft:gold_block"));
        const auto old = (*records)->load_chunk(DimensionId::overworld, where);
        ASSERT_TRUE(old && *old);
        auto edited = std::make_shared<Chunk>(**old);
        edited->blocks.set({1, 2, 3}, gold);
        SaveBatch batch;
        batch.chunks.push_back({DimensionId::overworld, where, edited});
        ASSERT_TRUE((*records)->save(batch));
    }
    ASSERT_NO_FATAL_FAILURE(generate({2, 3}));
    ASSERT_NO_FATAL_FAILURE(generate({2, 4})); // others still come
    auto records = WorldRecords::open(folder.string(), registry);
    ASSERT_TRUE(records);
    const auto now = (*records)->load_chunk(DimensionId::overworld, where);
    ASSERT_TRUE(now && *now);
    EXPECT_EQ((*now)->blocks.get({1, 2, 3}), gold);
    EXPECT_EQ((*records)->list_columns(DimensionId::overworld)->size(), 2u);
}

TEST_F(KeeperTest, AnotherSeedIsRefused) {
    ASSERT_NO_FATAL_FAILURE(generate({0, 0}));
    EXPECT_FALSE(ColumnKeeper::open(folder.string(), 8, registry));
}
