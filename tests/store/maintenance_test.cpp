#include "store/maintenance.h"

#include "store/keys.h"
#include "store/save_queue.h"
#include "tests/store/temp_folder.h"
#include "tests/store/world_fixture.h"

#include <gtest/gtest.h>
#include <thread>

namespace vitrail {

using namespace vitrail::testing;

TEST(Maintenance, InspectCountsWhatIsThere) {
    TempFolder folder;
    auto world = open_world(folder.path());
    const StateId stone = state_named(world->states(), "minecraft:stone");
    auto chunk = std::make_shared<Chunk>();
    for (u32 i = 0; i < 100; ++i)
        chunk->blocks.set(LocalPos(i), stone);
    for (u32 i = 100; i < 107; ++i)
        chunk->blocks.set(LocalPos(i), StateId::hidden);
    chunk->entities = {{1}};
    SaveBatch batch;
    batch.level = LevelRecord{.name = "Test", .seed = 5};
    batch.dimensions.push_back({DimensionId(0), "minecraft:overworld", -64, 320, true});
    for (i32 y : {0, 1})
        batch.chunks.push_back({DimensionId(0), {3, y, 4}, chunk});
    batch.chunks.push_back({DimensionId(0), {4, 0, 4}, std::make_shared<Chunk>()});
    batch.players.push_back({.name = "Ada"});
    ASSERT_TRUE(world->save(batch));
    const auto report = inspect_world(folder.path()); // while it is open
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_EQ(report->level.name, "Test");
    EXPECT_EQ(report->blocks,
              (std::map<std::string, u64>{{"minecraft:air", 2 * (4096 - 107) + 4096}, {"minecraft:stone", 200}}));
    ASSERT_EQ(report->dimensions.size(), 1u);
    EXPECT_EQ(report->dimensions[0].name, "minecraft:overworld");
    EXPECT_EQ(report->dimensions[0].chunks, 3u);
    EXPECT_EQ(report->dimensions[0].columns, 2u);
    EXPECT_EQ(report->entities, 2u);
    EXPECT_EQ(report->players, 1u);
    EXPECT_GT(report->size_bytes, 0u);
    EXPECT_EQ(report->damaged, 0u);
}

TEST(Maintenance, VerifyFindsEveryKindOfDamage) {
    TempFolder folder;
    auto world = open_world(folder.path());
    SaveBatch batch;
    for (i32 x = 0; x < 10; ++x)
        batch.chunks.push_back({DimensionId(0), {x, 0, 0}, random_chunk(u64(x))});
    auto odd = std::make_shared<Chunk>();
    odd->blocks = BlockStorage(StateId(77)); // a state the world does not know
    batch.chunks.push_back({DimensionId(0), {10, 0, 0}, odd});
    batch.columns.push_back({DimensionId(0), {0, 0}, {}});
    ASSERT_TRUE(world->save(batch));
    EXPECT_EQ(verify_world(folder.path())->damaged, 1u);
    auto spoil = [&](Table table, const Bytes& key) {
        Bytes record = **world->store().get(table, key);
        record[record.size() / 2] ^= 0x10;
        WriteBatch write;
        write.put(table, key, record);
        ASSERT_TRUE(world->store().commit(write));
    };
    spoil(Table::chunk, keys::chunk(DimensionId(0), {3, 0, 0}));
    spoil(Table::column, keys::column(DimensionId(0), {0, 0}));
    const auto report = verify_world(folder.path());
    ASSERT_TRUE(report);
    EXPECT_FALSE(report->sound());
    EXPECT_EQ(report->damaged, 3u);
    EXPECT_EQ(report->chunks, 11u);
    ASSERT_EQ(report->findings.size(), 3u);
    EXPECT_EQ(report->findings[0], "chunk 3 0 0 in dimension 0: checksum is wrong");
    // Loading sets them aside; then the world is sound, and what was set aside is counted.
    for (i32 x = 0; x < 11; ++x)
        ASSERT_TRUE(world->load_chunk(DimensionId(0), {x, 0, 0}));
    ASSERT_TRUE(world->load_column(DimensionId(0), {0, 0}));
    const auto after = verify_world(folder.path());
    EXPECT_TRUE(after->sound()) << after->findings[0];
    EXPECT_EQ(after->quarantined, 3u);
}

TEST(Maintenance, BackupIsOneMomentOfALivingWorld) {
    TempFolder folder, target;
    auto world = open_world(folder.path());
    SaveBatch first;
    for (i32 x = 0; x < 200; ++x)
        first.chunks.push_back({DimensionId(0), {x, 0, 0}, random_chunk(1)});
    ASSERT_TRUE(world->save(first));
    std::atomic<bool> stop{false};
    std::thread player([&] {
        for (u64 n = 2; !stop; ++n) {
            SaveBatch batch;
            for (i32 x : {0, 100, 199}) {
                auto chunk = std::make_shared<Chunk>(*random_chunk(n));
                chunk->revision = n;
                batch.chunks.push_back({DimensionId(0), {x, 0, 0}, chunk});
            }
            ASSERT_TRUE(world->save(batch));
        }
    });
    for (int i = 0; i < 5; ++i) {
        const std::string copy = target / std::to_string(i);
        const auto done = backup_world(folder.path(), copy);
        ASSERT_TRUE(done) << done.error().message;
        EXPECT_TRUE(verify_world(copy)->sound());
        auto other = open_world(copy, {});
        const u64 revision = (*other->load_chunk(DimensionId(0), {0, 0, 0}))->revision;
        EXPECT_EQ((*other->load_chunk(DimensionId(0), {100, 0, 0}))->revision, revision);
        EXPECT_EQ((*other->load_chunk(DimensionId(0), {199, 0, 0}))->revision, revision);
        EXPECT_EQ(other->list_columns(DimensionId(0))->size(), 200u);
    }
    stop = true;
    player.join();
    EXPECT_EQ(backup_world(folder.path(), target / "0").error().code, ErrorCode::invalid_argument);
    EXPECT_EQ(backup_world(folder / "none", target / "9").error().code, ErrorCode::not_found);
    EXPECT_FALSE(std::filesystem::exists(target / "9"));
}

TEST(SaveQueue, KeepsInOrderAndTellsWhenDurable) {
    TempFolder folder;
    auto world = open_world(folder.path());
    std::vector<int> kept;
    {
        SaveQueue queue(*world, {.group_ms = 10});
        for (int n = 0; n < 50; ++n) {
            auto chunk = std::make_shared<Chunk>();
            chunk->revision = u64(n);
            SaveBatch batch;
            batch.chunks.push_back({DimensionId(0), {n % 5, n % 3, 0}, chunk});
            batch.scripts.push_back({"n", Bytes{u8(n)}});
            queue.submit(std::move(batch), [&kept, n] { kept.push_back(n); });
            EXPECT_EQ((*queue.load_chunk(DimensionId(0), {n % 5, n % 3, 0}))->revision, u64(n));
        }
        EXPECT_EQ(queue.load_column_chunks(DimensionId(0), {1, 0})->size(), 3u);
        ASSERT_TRUE(queue.flush());
        EXPECT_EQ(kept.size(), 50u);
        EXPECT_EQ(queue.pending_bytes(), 0u);
        EXPECT_EQ((*world->load_script("n"))->at(0), 49);
        SaveBatch gone;
        gone.chunks.push_back({DimensionId(0), {1, 1, 0}, nullptr});
        queue.submit(std::move(gone));
        EXPECT_FALSE(*queue.load_chunk(DimensionId(0), {1, 1, 0}));
        EXPECT_EQ(queue.load_column_chunks(DimensionId(0), {1, 0})->size(), 2u);
    } // the destructor keeps the rest
    for (int n = 0; n < 50; ++n)
        EXPECT_EQ(kept[std::size_t(n)], n);
    EXPECT_FALSE(*world->load_chunk(DimensionId(0), {1, 1, 0}));
}

TEST(SaveQueue, FastProducerWaitsInsteadOfFillingMemory) {
    TempFolder folder;
    auto world = open_world(folder.path());
    SaveQueue queue(*world, {.group_ms = 1, .pending_bytes_most = 100000});
    u64 most = 0;
    for (i32 n = 0; n < 200; ++n) {
        SaveBatch batch;
        for (i32 y = 0; y < 4; ++y)
            batch.chunks.push_back({DimensionId(0), {n, y, 0}, random_chunk(u64(n), 300)});
        queue.submit(std::move(batch));
        most = std::max(most, queue.pending_bytes());
    }
    EXPECT_LE(most, 100000u);
    ASSERT_TRUE(queue.flush());
    EXPECT_EQ(world->list_columns(DimensionId(0))->size(), 200u);
}

} // namespace vitrail
