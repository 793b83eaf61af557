// Worlds of every layout, made by hand on disk.
#include "formats/builders.h"
#include "formats/count.h"

#include <gtest/gtest.h>

namespace vitrail {
namespace {

namespace fs = std::filesystem;

Bytes level_dat(const std::function<void(nbt::Writer&)>& fill) {
    nbt::Writer w;
    w.begin_compound().begin_compound("Data").put_string("LevelName", "Hand made");
    fill(w);
    w.end_compound().end_compound();
    const Bytes plain = w.take();
    return test::packed(plain, Compression::gzip);
}

Bytes region_of(const Bytes& chunk, Compression method = Compression::zlib) {
    return test::RegionBuilder().add(0, chunk, method).bytes();
}

CountReport count(const fs::path& source) {
    ThreadPool pool(0);
    const auto world = open_world_source(source);
    EXPECT_TRUE(world) << world.error().message;
    return world ? count_world(*world, pool) : CountReport{};
}

TEST(WorldSource, ReadsAWorldOf1_2) {
    test::TempFolder folder;
    std::vector<u16> codes(4096);
    std::fill_n(codes.begin(), 256, u16(98 << 4 | 3));
    test::write_file(folder.path() / "level.dat", level_dat([](nbt::Writer& w) {
                         w.put_int("SpawnX", 10)
                             .put_int("SpawnY", 64)
                             .put_int("SpawnZ", -20)
                             .put_long("RandomSeed", -77)
                             .put_long("Time", 30000);
                     }));
    test::write_file(folder.path() / "region" / "r.0.0.mca", region_of(test::numeric_chunk(0, 0, {{0, codes}})));
    test::write_file(folder.path() / "region" / "r.0.0.mcr", Bytes(100)); // left over from the upgrade
    test::write_file(folder.path() / "DIM-1" / "region" / "r.0.0.mca",
                     region_of(test::numeric_chunk(0, 0, {{0, std::vector<u16>(4096, 87 << 4)}})));
    const auto world = open_world_source(folder.path());
    ASSERT_TRUE(world);
    EXPECT_TRUE(world->problems.empty());
    EXPECT_EQ(world->level.name, "Hand made");
    EXPECT_EQ(world->level.spawn, (BlockPos{10, 64, -20}));
    EXPECT_EQ(world->level.seed, -77);
    EXPECT_EQ(world->level.day_time, 6000u);
    ASSERT_EQ(world->dimensions.size(), 2u);
    EXPECT_EQ(world->dimensions[0].name, "minecraft:overworld");
    EXPECT_EQ(world->dimensions[0].regions[0].file.extension(), ".mca");
    EXPECT_EQ(world->dimensions[1].name, "minecraft:the_nether");
    const auto counts = count(folder.path()).counts;
    EXPECT_EQ(counts, (std::map<std::string, u64>{{"id:0:0", 3840}, {"id:87:0", 4096}, {"id:98:3", 256}}));
    EXPECT_EQ(count(folder.path() / "level.dat").counts, counts);
    EXPECT_EQ(count(folder.path() / "region" / "r.0.0.mca").counts.size(), 2u);
}

TEST(WorldSource, ReadsTheNewestLayout) {
    test::TempFolder folder;
    test::write_file(
        folder.path() / "level.dat", level_dat([](nbt::Writer& w) {
            const i32 pos[] = {1, -60, 3};
            w.put_int("DataVersion", 4700).begin_compound("spawn").put_ints("pos", pos);
            w.put_string("dimension", "minecraft:the_nether").put_float("yaw", 90).end_compound().put_long("Time", 5);
        }));
    nbt::Writer settings;
    settings.begin_compound().begin_compound("data").put_long("seed", 123456789012345).end_compound().end_compound();
    test::write_file(folder.path() / "data" / "minecraft" / "world_gen_settings.dat",
                     test::packed(settings.take(), Compression::gzip));
    const fs::path d = folder.path() / "dimensions";
    test::write_file(
        d / "minecraft" / "overworld" / "region" / "r.0.0.mca",
        region_of(test::modern_chunk(0, 0, -4, "minecraft:air", "minecraft:resin_block"), Compression::lz4));
    test::write_file(d / "minecraft" / "overworld" / "entities" / "r.0.0.mca", Bytes());
    test::write_file(d / "minecraft" / "the_nether" / "region" / "r.-1.0.mca",
                     region_of(test::modern_chunk(-32, 0, 0, "minecraft:air", "minecraft:netherrack")));
    test::write_file(d / "mod" / "deep" / "caves" / "region" / "r.0.0.mca",
                     region_of(test::modern_chunk(0, 0, 0, "mod:rock", "mod:ore")));
    const auto world = open_world_source(folder.path());
    ASSERT_TRUE(world);
    EXPECT_EQ(world->level.spawn, (BlockPos{1, -60, 3}));
    EXPECT_EQ(world->level.spawn_dimension, "minecraft:the_nether");
    EXPECT_EQ(world->level.seed, 123456789012345);
    ASSERT_EQ(world->dimensions.size(), 3u);
    EXPECT_EQ(world->dimensions[0].name, "minecraft:overworld");
    EXPECT_FALSE(world->dimensions[0].regions[0].entities.empty());
    EXPECT_EQ(world->dimensions[1].name, "minecraft:the_nether");
    EXPECT_EQ(world->dimensions[2].name, "mod:deep/caves");
    const CountReport report = count(folder.path());
    EXPECT_TRUE(report.read.clean());
    EXPECT_EQ(report.counts, (std::map<std::string, u64>{{"minecraft:air", 7680},
                                                         {"minecraft:netherrack", 256},
                                                         {"minecraft:resin_block", 256},
                                                         {"mod:ore", 256},
                                                         {"mod:rock", 3840}}));
}

TEST(WorldSource, WorksWithoutOrWithADamagedLevel) {
    test::TempFolder folder;
    const Bytes region = region_of(test::numeric_chunk(0, 0, {{0, std::vector<u16>(4096, 16)}}));
    test::write_file(folder.path() / "region" / "r.0.0.mca", region);
    EXPECT_EQ(count(folder.path()).voxels, 4096u);
    test::write_file(folder.path() / "level.dat", Bytes(50, 0x5a));
    auto world = open_world_source(folder.path());
    ASSERT_TRUE(world);
    EXPECT_FALSE(world->level.found);
    EXPECT_FALSE(world->problems.empty());
    // The older copy steps in.
    test::write_file(folder.path() / "level.dat_old", level_dat([](nbt::Writer&) {}));
    world = open_world_source(folder.path());
    EXPECT_EQ(world->level.name, "Hand made");
    // A folder of bare files, and one that holds none.
    test::TempFolder bare;
    test::write_file(bare.path() / "r.5.-5.mca", region);
    EXPECT_EQ(count(bare.path()).voxels, 4096u);
    EXPECT_FALSE(open_world_source(bare.path() / "nothing"));
    test::TempFolder empty;
    EXPECT_FALSE(open_world_source(empty.path()));
}

} // namespace
} // namespace vitrail
