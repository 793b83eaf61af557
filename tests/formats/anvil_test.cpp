#include "formats/anvil.h"
#include "formats/builders.h"
#include "formats/count.h"

#include "base/rng.h"

#include <bit>
#include <gtest/gtest.h>

namespace vitrail {
namespace {

RawColumn decode(const Bytes& nbt, ColumnPos at = {}) {
    static DecodeContext context;
    nbt::Document doc;
    EXPECT_TRUE(doc.parse(nbt));
    RawColumn out;
    const auto ok = decode_chunk(doc.root(), at, context, out);
    EXPECT_TRUE(ok);
    return out;
}

Bytes big_endian(const std::vector<u64>& words) {
    Bytes out;
    for (const u64 w : words)
        for (int i = 7; i >= 0; --i)
            out.push_back(u8(w >> 8 * i));
    return out;
}

// Both packings of every width against a bit-by-bit packer.
TEST(Anvil, UnpacksEveryWidthOfBothPackings) {
    Rng rng(11);
    for (unsigned bits = 1; bits <= 12; ++bits) {
        const std::size_t entries = bits == 1 ? 2 : (std::size_t(1) << (bits - 1)) + 1;
        std::vector<u16> want(4096);
        for (u16& v : want)
            v = u16(rng.below(u32(entries)));
        std::vector<u64> straddling(std::size_t(bits) * 64), padded((4096 + 64 / bits - 1) / (64 / bits));
        for (u32 i = 0; i < 4096; ++i)
            for (unsigned b = 0; b < bits; ++b) {
                const u64 bit = want[i] >> b & 1;
                const u32 at = i * bits + b;
                straddling[at / 64] |= bit << at % 64;
                padded[i / (64 / bits)] |= bit << (i % (64 / bits) * bits + b);
            }
        std::vector<u16> got;
        u32 bad = 0;
        for (const i32 version : {0, 2230, 2566}) {
            ASSERT_TRUE(unpack_indices(big_endian(straddling), entries, version, got, bad)) << bits;
            if (64 % bits != 0 || version < kPaddedIndicesVersion) {
                EXPECT_EQ(got, want) << bits;
            }
            ASSERT_TRUE(unpack_indices(big_endian(padded), entries, version, got, bad)) << bits;
            EXPECT_EQ(got, want) << bits;
        }
        EXPECT_EQ(bad, 0u);
    }
    std::vector<u16> got;
    u32 bad = 0;
    EXPECT_FALSE(unpack_indices(Bytes(8 * 100), 5, 3000, got, bad));
    EXPECT_FALSE(unpack_indices({}, 5, 3000, got, bad));
    // Indices beyond the palette become its first entry.
    EXPECT_TRUE(unpack_indices(Bytes(8 * 256, 0x77), 5, 3000, got, bad));
    EXPECT_EQ(bad, 4096u);
}

TEST(Anvil, ReadsNumericSectionsWithAndWithoutHighIds) {
    std::vector<u16> codes(4096, 1 << 4);
    codes[0] = 35 << 4 | 14;
    codes[4095] = 4095u << 4 | 15;
    const RawColumn column =
        decode(test::numeric_chunk(-3, 7, {{0, std::vector<u16>(4096, 7 << 4)}, {15, codes}}), {-3, 7});
    ASSERT_EQ(column.sections.size(), 2u);
    EXPECT_FALSE(column.position_disagrees);
    EXPECT_EQ(column.data_version, 0);
    EXPECT_TRUE(column.sections[0].indices.empty());
    EXPECT_EQ(column.sections[0].entry_at(5), 7u << 4);
    for (u32 i = 0; i < 4096; ++i)
        ASSERT_EQ(column.section_at(15)->entry_at(i), codes[i]);
    EXPECT_TRUE(decode(test::numeric_chunk(1, 1, {}), {0, 0}).position_disagrees);
}

TEST(Anvil, ReadsTheNewestChunks) {
    DecodeContext context;
    nbt::Document doc;
    RawColumn column;
    const Bytes nbt = test::modern_chunk(0, 0, -4, "minecraft:air", "minecraft:stone", "minecraft:meadow");
    ASSERT_TRUE(doc.parse(nbt));
    ASSERT_TRUE(decode_chunk(doc.root(), {0, 0}, context, column));
    ASSERT_EQ(column.sections.size(), 1u);
    EXPECT_EQ(column.sections[0].y, -4);
    EXPECT_EQ(column.status, "full");
    EXPECT_EQ(context.names.text(column.sections[0].entry_at(255)), "minecraft:stone");
    EXPECT_EQ(context.names.text(column.sections[0].entry_at(256)), "minecraft:air");
    std::array<u32, 64> biomes;
    ASSERT_TRUE(column.biomes_of(-4, biomes));
    EXPECT_EQ(context.names.text(biomes[63]), "minecraft:meadow");
}

TEST(Anvil, SortsProperties) {
    nbt::Writer w;
    w.begin_compound().put_string("Name", "minecraft:oak_stairs").begin_compound("Properties");
    w.put_string("shape", "straight")
        .put_string("facing", "east")
        .put_string("half", "top")
        .end_compound()
        .end_compound();
    const Bytes bytes = w.take();
    nbt::Document doc;
    ASSERT_TRUE(doc.parse(bytes));
    std::string text;
    block_state_text(doc.root(), text);
    EXPECT_EQ(text, "minecraft:oak_stairs[facing=east,half=top,shape=straight]");
}

TEST(Anvil, ReadsOldBiomesEntitiesAndTicks) {
    const Bytes nbt = test::numeric_chunk(0, 0, {{0, std::vector<u16>(4096, 1 << 4)}}, 1343, [](nbt::Writer& w) {
        Bytes biomes(256, 1);
        biomes[2 * 16 + 2] = 21; // speaks for the first cell
        w.put_bytes("Biomes", biomes);
        w.begin_list("TileEntities", nbt::Type::compound, 2);
        w.begin_compound()
            .put_string("id", "minecraft:chest")
            .put_int("x", 3)
            .put_int("y", 4)
            .put_int("z", 5)
            .end_compound();
        w.begin_compound()
            .put_string("id", "minecraft:sign")
            .put_int("x", 19)
            .put_int("y", 4)
            .put_int("z", 5)
            .end_compound();
        w.end_list().begin_list("Entities", nbt::Type::compound, 1).begin_compound().put_string("id", "minecraft:pig");
        w.begin_list("Pos", nbt::Type::float64, 3).put_double("", 1).put_double("", 70.5).put_double("", 2).end_list();
        w.end_compound().end_list().begin_list("TileTicks", nbt::Type::compound, 1).begin_compound();
        w.put_int("x", 1).put_int("y", 2).put_int("z", 3).put_int("t", 20).put_int("p", -1).end_compound().end_list();
    });
    const RawColumn column = decode(nbt);
    ASSERT_EQ(column.level_biomes.size(), 16u);
    EXPECT_NE(column.level_biomes[0], column.level_biomes[1]);
    ASSERT_EQ(column.block_entities.size(), 2u);
    EXPECT_EQ(column.block_entities[0].at, (BlockPos{3, 4, 5}));
    EXPECT_EQ(column.block_entities[1].at, (BlockPos{3, 4, 5})); // brought into its own chunk, and said
    EXPECT_EQ(column.problems.size(), 1u);
    ASSERT_EQ(column.entities.size(), 1u);
    EXPECT_EQ(column.entities[0].y, 70);
    nbt::Document blob;
    ASSERT_TRUE(blob.parse(column.entities[0].nbt));
    EXPECT_EQ(blob.root()["id"].text(), "minecraft:pig");
    ASSERT_EQ(column.ticks.size(), 1u);
    EXPECT_EQ(column.ticks[0].delay, 20);
}

TEST(Anvil, SkipsWrongSectionsAndSaysSo) {
    nbt::Writer w;
    w.begin_compound().begin_compound("Level").begin_list("Sections", nbt::Type::compound, 5);
    w.begin_compound().put_byte("Y", 0).put_bytes("Blocks", Bytes(4095)).end_compound();
    w.begin_compound().put_byte("Y", 1).put_bytes("Blocks", Bytes(4096)).put_bytes("Data", Bytes(2048)).end_compound();
    w.begin_compound().put_byte("Y", 1).put_bytes("Blocks", Bytes(4096)).put_bytes("Data", Bytes(2048)).end_compound();
    w.begin_compound().put_byte("Y", 2).begin_list("Palette", nbt::Type::compound, 0).end_list().end_compound();
    w.begin_compound().put_byte("Y", 3).put_bytes("SkyLight", Bytes(2048)).end_compound(); // light only: nothing wrong
    w.end_list().end_compound().end_compound();
    const RawColumn column = decode(w.take());
    EXPECT_EQ(column.sections.size(), 1u);
    EXPECT_EQ(column.sections_skipped, 3u);
    EXPECT_EQ(column.problems.size(), 3u);
    DecodeContext context;
    RawColumn none;
    nbt::Document doc;
    nbt::Writer player;
    player.begin_compound().put_int("Health", 20).end_compound();
    const Bytes bytes = player.take();
    ASSERT_TRUE(doc.parse(bytes));
    EXPECT_FALSE(decode_chunk(doc.root(), {}, context, none));
}

// McRegion lies x, z, y; every cell must come out where it was.
TEST(McRegion, TurnsTheOrderOfBlocks) {
    Bytes blocks(32768), data(16384);
    auto id = [](u32 x, u32 y, u32 z) { return u8((x * 7 + y * 3 + z * 5) % 96); };
    for (u32 x = 0; x < 16; ++x)
        for (u32 z = 0; z < 16; ++z)
            for (u32 y = 0; y < 128; ++y) {
                const u32 i = (x * 16 + z) * 128 + y;
                blocks[i] = id(x, y, z);
                data[i / 2] |= u8(((x + y) & 15) << (i & 1) * 4);
            }
    nbt::Writer w;
    w.begin_compound().begin_compound("Level").put_int("xPos", 0).put_int("zPos", 0);
    w.put_bytes("Blocks", blocks).put_bytes("Data", data).end_compound().end_compound();
    const RawColumn column = decode(w.take());
    ASSERT_EQ(column.sections.size(), 8u);
    for (u32 y = 0; y < 128; ++y)
        for (u32 cell = 0; cell < 256; ++cell) {
            const u32 x = cell & 15, z = cell >> 4;
            ASSERT_EQ(column.section_at(i32(y >> 4))->entry_at((y & 15) << 8 | cell),
                      u32(id(x, y, z) << 4 | ((x + y) & 15)));
        }
}

} // namespace
} // namespace vitrail
