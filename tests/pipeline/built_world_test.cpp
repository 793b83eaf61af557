#include "pipeline/built_world.h"

#include "base_land.h"
#include "store/save_queue.h"

#include <filesystem>
#include <gtest/gtest.h>
#include <unistd.h>

using namespace vitrail;
namespace fs = std::filesystem;

namespace {

struct BuiltWorldTest : testing::Test {
    fs::path folder = fs::temp_directory_path() / ("vitrail-built-" + std::to_string(getpid()));
    std::shared_ptr<StateTable> states = std::make_shared<StateTable>(base_content().registry);
    BiomeTable biomes;
    void SetUp() override { fs::remove_all(folder); }
    void TearDown() override { fs::remove_all(folder); }

    StateId state(const char* text) { return *states->intern_with_defaults(*parse_block_state(text)); }
    Dimension build() {
        Dimension out(DimensionInfo{}, states);
        (void)state("minecraft:dirt"); // numbered, never used
        auto mixed = std::make_shared<Chunk>();
        mixed->blocks.set({3, 4, 5}, state("minecraft:glowstone"));
        mixed->blocks.set({3, 5, 5}, state("minecraft:oak_log[axis=z]"));
        mixed->biomes.cells.fill(*biomes.intern("minecraft:plains"));
        out.put({-1, 4, 2}, mixed);
        auto plain = std::make_shared<Chunk>();
        plain->blocks = BlockStorage(state("minecraft:stone"));
        out.put({-1, 3, 2}, plain);
        out.put({-1, 9, 2}, std::make_shared<Chunk>()); // air
        return out;
    }
};

} // namespace

TEST_F(BuiltWorldTest, ComesBackBlockForBlock) {
    const Dimension built = build();
    LevelRecord level;
    level.name = "Garden";
    level.spawn.at = {1, 70, 2};
    level.generator = "endless"; // a built world has none
    const auto kept = keep_built_world(folder.string(), built, biomes, level);
    ASSERT_TRUE(kept) << kept.error().message;
    EXPECT_EQ(kept->columns, 1u);
    EXPECT_EQ(kept->chunks, 2u);

    auto records = WorldRecords::open(folder.string(), base_content().registry, {.read_only = true});
    ASSERT_TRUE(records);
    const auto read = (*records)->load_level();
    ASSERT_TRUE(read && *read);
    EXPECT_EQ((*read)->name, "Garden");
    EXPECT_EQ((*read)->generator, "");
    EXPECT_FALSE((*read)->unfinished);
    EXPECT_EQ((*read)->spawn.at, (BlockPos{1, 70, 2}));
    const auto column = (*records)->load_column(DimensionId::overworld, {-1, 2});
    ASSERT_TRUE(column && *column);
    EXPECT_TRUE((*column)->generated);
    EXPECT_EQ((*column)->heights.above[3 | 5 << 4], 4 * 16 + 6);
    EXPECT_EQ((*column)->heights.above[0], 64);
    const auto chunks = (*records)->load_column_chunks(DimensionId::overworld, {-1, 2});
    ASSERT_TRUE(chunks);
    ASSERT_EQ(chunks->size(), 2u);
    for (const auto& [at, chunk] : *chunks)
        for (u32 i = 0; i < kChunkVolume; ++i)
            ASSERT_EQ((*records)->states().info(chunk->blocks.get(LocalPos(i))).state,
                      states->info(built.find(at)->blocks.get(LocalPos(i))).state);
    EXPECT_EQ((*records)->biomes().name((*chunks)[1].chunk->biomes.cells[7]), "minecraft:plains");
    EXPECT_FALSE((*records)->states().find("minecraft:dirt")); // only what is there is numbered
}

TEST_F(BuiltWorldTest, AWorldThatIsThereStaysAsItIs) {
    ASSERT_TRUE(keep_built_world(folder.string(), build(), biomes, {.name = "first"}));
    const auto again = keep_built_world(folder.string(), build(), biomes, {.name = "second"});
    ASSERT_FALSE(again);
    EXPECT_EQ(again.error().code, ErrorCode::denied);
    auto records = WorldRecords::open(folder.string(), base_content().registry, {.read_only = true});
    ASSERT_TRUE(records);
    EXPECT_EQ((*(*records)->load_level())->name, "first");
}
