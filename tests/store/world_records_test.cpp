#include "store/world_records.h"

#include "store/keys.h"
#include "store/record.h"
#include "tests/store/temp_folder.h"
#include "tests/store/world_fixture.h"

#include <gtest/gtest.h>

namespace vitrail {

using namespace vitrail::testing;

TEST(WorldRecords, KeepsEverythingOverAReopening) {
    TempFolder folder;
    LevelRecord level;
    level.name = "Höhle";
    level.seed = 0xfedcba9876543210;
    level.spawn = {DimensionId(1), {-5, 70, 2147483000}};
    level.time_ticks = 123456789;
    level.day_minutes = 45;
    level.generator = "hills";
    level.generator_version = 3;
    level.content_hash = 77;
    PlayerRecord player;
    player.name = "Ada";
    player.at = {DimensionId(1), {-kFixedOne * 3 + 5, kFixedOne * 64, 17}};
    player.yaw = 12.5f;
    player.pitch = -3;
    player.hotbar = {"minecraft:stone", "", "minecraft:oak_log[axis=y]"};
    player.hotbar_slot = 2;
    player.flying = true;
    ColumnRecord column;
    for (std::size_t i = 0; i < 256; ++i)
        column.heights.above[i] = i32(i * i) - 2000000000;
    column.generated = true;
    column.stage = 9;
    auto chunk = std::make_shared<Chunk>(*random_chunk(5));
    {
        auto world = open_world(folder.path());
        const StateId log = state_named(world->states(), "minecraft:oak_log[axis=y]");
        chunk->blocks.set(LocalPos(3, 4, 5), log);
        chunk->biomes.cells[7] = *world->biomes().intern("minecraft:plains");
        chunk->ticks = {{LocalPos(1, 2, 3), 1ull << 40, -7, log}};
        chunk->entities = {{1, 2, 3}, {}};
        SaveBatch batch;
        batch.level = level;
        batch.dimensions = {{DimensionId(0), "minecraft:overworld", -64, 320, true},
                            {DimensionId(1), "minecraft:the_nether", 0, 128, false}};
        batch.chunks.push_back({DimensionId(1), {-1, -4, 100}, chunk});
        batch.columns.push_back({DimensionId(1), {-1, 100}, column});
        batch.players = {player};
        batch.entities.push_back({99, Bytes{4, 5}});
        batch.scripts.push_back({"counter", Bytes{1}});
        const auto saved = world->save(batch);
        ASSERT_TRUE(saved) << saved.error().message;
    }
    auto world = open_world(folder.path(), {});
    EXPECT_EQ(world->states().size(), 3u);
    EXPECT_EQ(world->states().info(StateId(2)).state.to_string(), "minecraft:oak_log[axis=y]");
    EXPECT_EQ(world->biomes().name(BiomeId(1)), "minecraft:plains");
    const auto l = **world->load_level();
    EXPECT_EQ(l.name, level.name);
    EXPECT_EQ(l.seed, level.seed);
    EXPECT_EQ(l.spawn, level.spawn);
    EXPECT_EQ(l.time_ticks, level.time_ticks);
    EXPECT_EQ(l.day_minutes, 45u);
    EXPECT_EQ(l.generator_version, 3u);
    const auto dimensions = *world->load_dimensions();
    ASSERT_EQ(dimensions.size(), 2u);
    EXPECT_EQ(dimensions[0].min_y, -64);
    EXPECT_EQ(dimensions[1].name, "minecraft:the_nether");
    EXPECT_FALSE(dimensions[1].has_sky);
    const auto c = *world->load_chunk(DimensionId(1), {-1, -4, 100});
    ASSERT_TRUE(c);
    EXPECT_TRUE(same_chunk(*c, *chunk));
    EXPECT_FALSE(*world->load_chunk(DimensionId(0), {-1, -4, 100}));
    const auto col = **world->load_column(DimensionId(1), {-1, 100});
    EXPECT_EQ(col.heights.above, column.heights.above);
    EXPECT_TRUE(col.generated);
    EXPECT_FALSE(col.lit);
    EXPECT_EQ(col.stage, 9u);
    const auto p = **world->load_player("Ada");
    EXPECT_EQ(p.at, player.at);
    EXPECT_EQ(p.hotbar, player.hotbar);
    EXPECT_TRUE(p.flying);
    EXPECT_FALSE(*world->load_player("Bob"));
    EXPECT_EQ(**world->load_entity(99), (Bytes{4, 5}));
    EXPECT_EQ(world->load_scripts()->at("counter"), Bytes{1});
    EXPECT_TRUE(world->damage().empty());
}

TEST(WorldRecords, ColumnIsOneRangeAndListsAreComplete) {
    TempFolder folder;
    auto world = open_world(folder.path());
    SaveBatch batch;
    for (i32 y : {-3, 5, 0, -1, 2000})
        for (i32 x : {-1, 0, 1})
            batch.chunks.push_back({DimensionId(0), {x, y, -7}, random_chunk(u64(y + x))});
    batch.chunks.push_back({DimensionId(1), {0, 0, -7}, random_chunk(1)});
    batch.columns.push_back({DimensionId(0), {40, 2}, {}});
    ASSERT_TRUE(world->save(batch));
    const auto chunks = *world->load_column_chunks(DimensionId(0), {0, -7});
    ASSERT_EQ(chunks.size(), 5u);
    const i32 expected[] = {-3, -1, 0, 5, 2000};
    for (std::size_t i = 0; i < 5; ++i)
        EXPECT_EQ(chunks[i].at, (ChunkPos{0, expected[i], -7}));
    EXPECT_EQ(*world->list_columns(DimensionId(0)), (std::vector<ColumnPos>{{-1, -7}, {0, -7}, {1, -7}, {40, 2}}));
    EXPECT_EQ(world->list_columns(DimensionId(1))->size(), 1u);
    EXPECT_EQ(world->list_columns(DimensionId(2))->size(), 0u);
}

TEST(WorldRecords, DamagedRecordIsSetAsideAndTheRestLives) {
    TempFolder folder;
    auto world = open_world(folder.path());
    SaveBatch batch;
    for (i32 y = 0; y < 4; ++y)
        batch.chunks.push_back({DimensionId(0), {0, y, 0}, random_chunk(u64(y))});
    ASSERT_TRUE(world->save(batch));
    const Bytes key = keys::chunk(DimensionId(0), {0, 2, 0});
    Bytes record = **world->store().get(Table::chunk, key);
    record.back() ^= 1;
    WriteBatch spoil;
    spoil.put(Table::chunk, key, record);
    ASSERT_TRUE(world->store().commit(spoil));

    EXPECT_EQ(world->load_column_chunks(DimensionId(0), {0, 0})->size(), 3u);
    ASSERT_EQ(world->damage().size(), 1u);
    EXPECT_EQ(world->damage()[0].key, key);
    EXPECT_EQ(world->damage()[0].reason, "checksum is wrong");
    EXPECT_FALSE(*world->load_chunk(DimensionId(0), {0, 2, 0}));
    EXPECT_EQ(world->damage().size(), 1u) << "set aside once";
    u32 quarantined = 0;
    ASSERT_TRUE(world->store().scan(Table::quarantine, {}, {}, [&](ByteView k, ByteView) {
        EXPECT_EQ(k[0], u8(Table::chunk));
        return ++quarantined, true;
    }));
    EXPECT_EQ(quarantined, 1u);
    // The place can be used again.
    SaveBatch again;
    again.chunks.push_back({DimensionId(0), {0, 2, 0}, random_chunk(9)});
    ASSERT_TRUE(world->save(again));
    EXPECT_TRUE(*world->load_chunk(DimensionId(0), {0, 2, 0}));
}

TEST(WorldRecords, RecordUnderAnotherKeyIsDamage) {
    TempFolder folder;
    auto world = open_world(folder.path());
    SaveBatch batch;
    batch.chunks.push_back({DimensionId(0), {0, 0, 0}, random_chunk(1)});
    ASSERT_TRUE(world->save(batch));
    const Bytes record = **world->store().get(Table::chunk, keys::chunk(DimensionId(0), {0, 0, 0}));
    WriteBatch moved;
    moved.put(Table::chunk, keys::chunk(DimensionId(0), {0, 1, 0}), record);
    ASSERT_TRUE(world->store().commit(moved));
    EXPECT_FALSE(*world->load_chunk(DimensionId(0), {0, 1, 0}));
    EXPECT_EQ(world->damage().size(), 1u);
}

TEST(WorldRecords, LostStateNameKeepsTheOtherNumbers) {
    TempFolder folder;
    {
        auto world = open_world(folder.path());
        for (const char* name : {"a:one", "a:two", "a:three"})
            state_named(world->states(), name);
        SaveBatch batch;
        batch.level = LevelRecord{};
        ASSERT_TRUE(world->save(batch));
        WriteBatch spoil;
        spoil.put(Table::state, keys::number(3), Bytes{1, 2, 3});
        spoil.erase(Table::state, keys::number(4));
        ASSERT_TRUE(world->store().commit(spoil));
    }
    auto world = open_world(folder.path());
    ASSERT_EQ(world->states().size(), 5u);
    EXPECT_EQ(world->states().info(StateId(2)).state.name, "a:one");
    EXPECT_EQ(world->states().info(StateId(3)).state.name, "vitrail:lost_3");
    EXPECT_EQ(world->states().info(StateId(4)).state.name, "vitrail:lost_4");
    EXPECT_EQ(u32(state_named(world->states(), "a:two")), 5u) << "an old number never gets a new meaning";
}

TEST(Record, RefusesWhatIsNotItsOwn) {
    const Bytes key{1, 2}, payload{3, 4, 5};
    const Bytes good = seal_record(Table::player, key, 1, payload);
    ASSERT_TRUE(open_record(Table::player, key, 1, good));
    EXPECT_EQ(open_record(Table::chunk, key, 1, good).error().code, ErrorCode::damaged);
    EXPECT_EQ(open_record(Table::player, Bytes{1, 3}, 1, good).error().code, ErrorCode::damaged);
    EXPECT_EQ(open_record(Table::player, key, 0, good).error().code, ErrorCode::unsupported);
    for (std::size_t i = 0; i < good.size(); ++i)
        for (int bit = 0; bit < 8; ++bit) {
            Bytes bad = good;
            bad[i] ^= u8(1 << bit);
            EXPECT_FALSE(open_record(Table::player, key, 255, bad)) << i << " " << bit;
        }
    for (std::size_t size = 0; size < good.size(); ++size)
        EXPECT_FALSE(open_record(Table::player, key, 1, ByteView(good).first(size)));
}

TEST(Keys, ByteOrderIsNumberOrder) {
    Rng rng(3);
    for (int i = 0; i < 2000; ++i) {
        auto number = [&] { return i32(rng.next() >> (32 + rng.below(31))) * (rng.below(2) ? 1 : -1); };
        const ChunkPos a{number(), number(), number()}, b{rng.below(2) ? a.x : number(), number(), a.z};
        const bool less = std::tuple(a.x, a.z, a.y) < std::tuple(b.x, b.z, b.y);
        EXPECT_EQ(keys::chunk(DimensionId(0), a) < keys::chunk(DimensionId(0), b), less);
        EXPECT_EQ(keys::read_chunk(keys::chunk(DimensionId(7), a)), (Located<ChunkPos>{DimensionId(7), a}));
        const Bytes column = keys::column(DimensionId(7), column_of(a));
        EXPECT_LE(column, keys::chunk(DimensionId(7), a));
        EXPECT_GT(keys::after(column), keys::chunk(DimensionId(7), a));
    }
    EXPECT_TRUE(keys::after(Bytes{0xff, 0xff}).empty());
    EXPECT_EQ(keys::after(Bytes{1, 0xff}), Bytes{2});
}

} // namespace vitrail
