#include "formats/builders.h"
#include "formats/region.h"

#include "base/rng.h"

#include <gtest/gtest.h>

namespace vitrail {
namespace {

using test::RegionBuilder;

Bytes chunk_nbt(i32 value, std::size_t filler = 10) {
    nbt::Writer w;
    Bytes noise(filler);
    Rng rng{u64(value) + 1};
    for (u8& b : noise)
        b = u8(rng.next());
    w.begin_compound().put_int("value", value).put_bytes("noise", noise).put_int("end", value).end_compound();
    return w.take();
}

RegionFile open(const RegionBuilder& builder) {
    auto region = RegionFile::from_bytes(builder.bytes(), {2, -1});
    EXPECT_TRUE(region);
    return std::move(*region);
}

TEST(Region, ReadsEveryCompression) {
    RegionBuilder builder;
    u32 slot = 0;
    for (const Compression method : {Compression::gzip, Compression::zlib, Compression::none, Compression::lz4})
        ++slot, builder.add(slot - 1, chunk_nbt(i32(slot), 300000), method);
    const RegionFile region = open(builder);
    EXPECT_EQ(region.chunk_count(), 4u);
    EXPECT_EQ(region.column_of_slot(33), (ColumnPos{65, -31}));
    ChunkReader reader;
    for (u32 s = 0; s < 4; ++s) {
        const auto read = reader.read(region, s);
        ASSERT_TRUE(read.usable) << s;
        EXPECT_FALSE(read.error || read.stream_broken || read.flaws) << s;
        EXPECT_EQ(reader.document.root()["end"].integer(), i32(s) + 1);
    }
    EXPECT_FALSE(reader.read(region, 5).usable);
}

TEST(Region, ReadsChunksInFilesOfTheirOwn) {
    test::TempFolder folder;
    RegionBuilder builder;
    const u32 slot = 3 | 4 << 5;
    builder.add(slot, chunk_nbt(77, 2000000), Compression::zlib, true).add(0, chunk_nbt(1), Compression::zlib, true);
    test::write_file(folder.path() / "r.-1.2.mca", builder.bytes());
    test::write_file(folder.path() / "c.-29.68.mcc", builder.external_file(slot));
    const auto region = RegionFile::open(folder.path() / "r.-1.2.mca");
    ASSERT_TRUE(region);
    ChunkReader reader;
    ASSERT_TRUE(reader.read(*region, slot).usable);
    EXPECT_EQ(reader.document.root()["end"].integer(), 77);
    const auto absent = reader.read(*region, 0);
    EXPECT_FALSE(absent.usable);
    EXPECT_TRUE(absent.error);
}

TEST(Region, SavesWhatItCanOfDamagedChunks) {
    const Bytes nbt = chunk_nbt(5, 20000), zlib = test::packed(nbt, Compression::zlib);
    RegionBuilder builder;
    builder.add_raw(0, ByteView(zlib).first(zlib.size() - 4), 2, u32(zlib.size() - 3));     // lacks only its checksum
    builder.add_raw(1, ByteView(zlib).first(zlib.size() / 2), 2, u32(zlib.size() / 2 + 1)); // half
    builder.add_raw(2, zlib, 1, u32(zlib.size() + 1));                                      // says gzip
    builder.add_raw(3, zlib, 2, 0);                                                         // no length
    builder.add_raw(4, zlib, 2, 0x7fffffff);                                                // too long
    builder.add_raw(5, zlib, 9, u32(zlib.size() + 1)); // unknown number, zlib inside
    Bytes broken = zlib;
    for (std::size_t i = 0; i < 8; ++i)
        broken[broken.size() / 2 + i] ^= 0x55;
    builder.add_raw(6, broken, 2, u32(broken.size() + 1));
    builder.set_location(7, 1u << 8 | 1).set_location(8, 0xffffffu << 8 | 1).set_location(9, 2u << 8 | 200);
    const RegionFile region = open(builder);
    ChunkReader reader;
    const auto value = [&] { return reader.document.root()["end"].integer(-1); };
    auto read = reader.read(region, 0);
    EXPECT_TRUE(read.usable && read.stream_broken && !read.error);
    EXPECT_EQ(value(), 5);
    read = reader.read(region, 1);
    EXPECT_TRUE(read.usable && read.stream_broken && read.error);
    EXPECT_EQ(reader.document.root()["value"].integer(), 5);
    EXPECT_EQ(value(), -1);
    read = reader.read(region, 2);
    EXPECT_TRUE(read.usable && read.flaws & kSlotWrongMethod);
    EXPECT_EQ(value(), 5);
    EXPECT_FALSE(reader.read(region, 3).usable);
    read = reader.read(region, 4);
    EXPECT_TRUE(read.usable && read.flaws & kSlotWrongLength);
    EXPECT_EQ(value(), 5);
    EXPECT_TRUE(reader.read(region, 5).usable);
    read = reader.read(region, 6);
    EXPECT_TRUE(read.stream_broken);
    EXPECT_FALSE(reader.read(region, 7).usable);
    EXPECT_FALSE(reader.read(region, 8).usable);
    read = reader.read(region, 9); // the sectors of slot 0, and all others
    EXPECT_TRUE(read.flaws & kSlotOverlaps);
    EXPECT_TRUE(read.flaws & kSlotBeyondFile);
    EXPECT_TRUE(reader.read(region, 1).flaws & kSlotOverlaps);
}

TEST(Region, BoundsWhatUnpacks) {
    const Bytes zeros(std::size_t(80) << 20);
    Inflater inflater;
    for (const Compression method : {Compression::zlib, Compression::gzip, Compression::lz4}) {
        const Inflated out = inflater.unpack(method, test::packed(zeros, method));
        ASSERT_TRUE(out.error);
        EXPECT_EQ(out.error->code, ErrorCode::limit);
        EXPECT_LE(out.bytes.size(), kMaxInflatedBytes);
    }
}

TEST(Region, RefusesFilesThatAreNone) {
    EXPECT_TRUE(RegionFile::from_bytes({}));
    EXPECT_FALSE(RegionFile::from_bytes(Bytes(100)));
    EXPECT_TRUE(RegionFile::from_bytes(Bytes(5000)));
    EXPECT_FALSE(RegionFile::open("/nonexistent/r.0.0.mca"));
    EXPECT_FALSE(RegionFile::open("/"));
    EXPECT_TRUE(region_pos_of("r.-12.3.mca"));
    for (const char* name : {"r.1.mca", "r.a.b.mca", "r.1.2.mcx", "r.1.2.mca.bak", "x.1.2.mca", "r.99999999999.0.mca",
                             "r.9999999.0.mca", ""})
        EXPECT_FALSE(region_pos_of(name)) << name;
}

TEST(Region, SurvivesRandomDamage) {
    RegionBuilder builder;
    for (u32 slot = 0; slot < 8; ++slot)
        builder.add(slot, chunk_nbt(i32(slot), 200), Compression(1 + slot % 4));
    Rng rng(3);
    for (int run = 0; run < 1500; ++run) {
        Bytes bytes = builder.bytes();
        for (u32 n = 1 + rng.below(20); n > 0; --n) {
            const u32 at = rng.below(2) ? rng.below(40) : 8192 + rng.below(u32(bytes.size()) - 8192);
            bytes[at] = u8(rng.next());
        }
        if (rng.below(4) == 0) bytes.resize(rng.below(u32(bytes.size())));
        const auto region = RegionFile::from_bytes(bytes);
        ChunkReader reader;
        if (region)
            for (u32 slot = 0; slot < 8; ++slot)
                (void)reader.read(*region, slot);
    }
}

} // namespace
} // namespace vitrail
