#include "pipeline/column_keeper.h"

#include "base_land.h"
#include "pipeline/new_world.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace vitrail;
namespace fs = std::filesystem;

namespace {

struct KeeperTest : testing::Test {
    fs::path folder = fs::temp_directory_path() / ("vitrail-keeper-" + std::to_string(getpid()));
    std::shared_ptr<const BlockRegistry> registry = base_content().registry;
    std::shared_ptr<const TerrainGenerator> generator = base_generator(7);
    void SetUp() override { fs::remove_all(folder); }
    void TearDown() override { fs::remove_all(folder); }
    // As `vitrail generate --world` does with one column.
    void generate(ColumnPos at) {
        auto keeper = ColumnKeeper::open(folder.string(), *generator, registry);
        ASSERT_TRUE(keeper) << keeper.error().message;
        const auto palette =
            make_terrain_palette((*keeper)->records().states(), (*keeper)->records().biomes(), *generator);
        ASSERT_TRUE(palette);
        GeneratedColumn column = generator->generate(at, *palette);
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
    EXPECT_FALSE(ColumnKeeper::open(folder.string(), *base_generator(8), registry));
}

TEST_F(KeeperTest, AWorldOfAnotherGeneratorIsRefusedAndLeftAsItIs) {
    {
        auto records = WorldRecords::open(folder.string(), registry, {.create = true});
        ASSERT_TRUE(records);
        auto level = make_new_level(**records, "Old", 7, nullptr, 0);
        ASSERT_TRUE(level);
        level->generator = "hills", level->generator_version = 1;
        SaveBatch batch;
        batch.level = *level;
        ASSERT_TRUE((*records)->save(batch));
    }
    const auto refused = ColumnKeeper::open(folder.string(), *generator, registry);
    ASSERT_FALSE(refused);
    EXPECT_NE(refused.error().message.find("hills"), std::string::npos);
    auto records = WorldRecords::open(folder.string(), registry);
    ASSERT_TRUE(records);
    EXPECT_EQ((*(*records)->load_level())->generator, "hills");
    EXPECT_TRUE((*records)->list_columns(DimensionId::overworld)->empty());
}

TEST_F(KeeperTest, ANewWorldIsAsHighAsItsLandAndItsSpawnIsDryGround) {
    ASSERT_NO_FATAL_FAILURE(generate({0, 0}));
    auto records = WorldRecords::open(folder.string(), registry);
    ASSERT_TRUE(records);
    const auto infos = (*records)->load_dimensions();
    ASSERT_TRUE(infos && infos->size() == 1);
    EXPECT_EQ((*infos)[0].min_y, kTerrainMinY);
    EXPECT_EQ((*infos)[0].max_y, kTerrainMaxY);
    const BlockPos spawn = (*(*records)->load_level())->spawn.at;
    EXPECT_GE(spawn.y, kTerrainSeaLevel);
    const auto tile = generator->blocks(column_of(chunk_of(spawn)));
    const auto at = [&](i32 y) { return tile->block[u32(spawn.x & 15) | u32(spawn.z & 15) << 4 | u32(y) << 8]; };
    EXPECT_NE(at(spawn.y - 1), kAir);
    EXPECT_NE(at(spawn.y - 1), kWater);
    EXPECT_NE(at(spawn.y), kWater);
}
