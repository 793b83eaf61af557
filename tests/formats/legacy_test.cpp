// Old numbers and what their neighbors add.
#include "formats/anvil.h"
#include "formats/legacy_connect.h"

#include <functional>
#include <gtest/gtest.h>
#include <map>

namespace vitrail {
namespace {

std::string state(u32 id, u32 meta, LegacyBits bits = 0) {
    return legacy_state(LegacyCode(id << 4 | meta), bits).to_string();
}

TEST(LegacyIds, EveryNumberOf1_12HasAName) {
    for (u32 id = 0; id < 256; ++id)
        for (u32 meta = 0; meta < 16; ++meta) {
            const BlockState s = legacy_state(LegacyCode(id << 4 | meta));
            const bool known = s.name.starts_with("minecraft:");
            EXPECT_EQ(known, id != 253 && id != 254) << id;
            const auto parsed = parse_block_state(s.to_string());
            ASSERT_TRUE(parsed) << s.to_string();
            EXPECT_EQ(*parsed, s);
        }
    EXPECT_EQ(state(254, 3), "legacy:254[meta=3]");
    EXPECT_EQ(legacy_state(0xffff).to_string(), "legacy:4095[meta=15]");
    EXPECT_EQ(legacy_count_name(0xffff), "id:4095:15");
    for (u32 bits = 0; bits < 65536; bits += 7)
        for (u32 id = 0; id < 256; id += 1)
            (void)legacy_state(LegacyCode(id << 4 | bits % 16), LegacyBits(bits));
}

TEST(LegacyIds, NamesAreThoseOfTheFlattening) {
    EXPECT_EQ(state(0, 0), "minecraft:air");
    EXPECT_EQ(state(1, 5), "minecraft:andesite");
    EXPECT_EQ(state(2, 0), "minecraft:grass_block[snowy=false]");
    EXPECT_EQ(state(9, 3), "minecraft:water[level=3]");
    EXPECT_EQ(state(17, 5), "minecraft:spruce_log[axis=x]");
    EXPECT_EQ(state(17, 14), "minecraft:birch_wood[axis=y]");
    EXPECT_EQ(state(162, 9), "minecraft:dark_oak_log[axis=z]");
    EXPECT_EQ(state(31, 1), "minecraft:short_grass");
    EXPECT_EQ(state(35, 14), "minecraft:red_wool");
    EXPECT_EQ(state(43, 0), "minecraft:smooth_stone_slab[type=double]");
    EXPECT_EQ(state(43, 8), "minecraft:smooth_stone");
    EXPECT_EQ(state(44, 11), "minecraft:cobblestone_slab[type=top]");
    EXPECT_EQ(state(50, 1), "minecraft:wall_torch[facing=east]");
    EXPECT_EQ(state(50, 5), "minecraft:torch");
    EXPECT_EQ(state(53, 6), "minecraft:oak_stairs[facing=south,half=top,shape=straight]");
    EXPECT_EQ(state(54, 5), "minecraft:chest[facing=east,type=single]");
    EXPECT_EQ(state(66, 9), "minecraft:rail[shape=north_east]");
    EXPECT_EQ(state(69, 13), "minecraft:lever[face=floor,facing=north,powered=true]");
    EXPECT_EQ(state(78, 7), "minecraft:snow[layers=8]");
    EXPECT_EQ(state(97, 2), "minecraft:infested_stone_bricks");
    EXPECT_EQ(state(99, 14),
              "minecraft:brown_mushroom_block[down=true,east=true,north=true,south=true,up=true,west=true]");
    EXPECT_EQ(state(118, 2), "minecraft:water_cauldron[level=2]");
    EXPECT_EQ(state(126, 10), "minecraft:birch_slab[type=top]");
    EXPECT_EQ(state(140, 9), "minecraft:potted_cactus");
    EXPECT_EQ(state(155, 3), "minecraft:quartz_pillar[axis=x]");
    EXPECT_EQ(state(159, 8), "minecraft:light_gray_terracotta");
    EXPECT_EQ(state(179, 2), "minecraft:cut_red_sandstone");
    EXPECT_EQ(state(208, 0), "minecraft:dirt_path");
    EXPECT_EQ(state(227, 1), "minecraft:light_gray_shulker_box[facing=up]");
    EXPECT_EQ(state(250, 2), "minecraft:black_glazed_terracotta[facing=north]");
    EXPECT_EQ(state(252, 0), "minecraft:white_concrete_powder");
}

TEST(LegacyIds, BlockEntitiesTellTheRest) {
    auto bits = [](const std::function<void(nbt::Writer&)>& fill) {
        nbt::Writer w;
        w.begin_compound();
        fill(w);
        w.end_compound();
        const Bytes bytes = w.take();
        nbt::Document doc;
        EXPECT_TRUE(doc.parse(bytes));
        return legacy_bits_of_block_entity(doc.root());
    };
    EXPECT_EQ(state(26, 8, bits([](auto& w) { w.put_string("id", "minecraft:bed").put_int("color", 11); })),
              "minecraft:blue_bed[facing=south,occupied=false,part=head]");
    EXPECT_EQ(state(26, 0), "minecraft:red_bed[facing=south,occupied=false,part=foot]");
    EXPECT_EQ(state(176, 4, bits([](auto& w) { w.put_string("id", "Banner").put_int("Base", 15); })),
              "minecraft:white_banner[rotation=4]");
    EXPECT_EQ(
        state(144, 1, bits([](auto& w) { w.put_string("id", "Skull").put_byte("SkullType", 4).put_byte("Rot", 9); })),
        "minecraft:creeper_head[rotation=9]");
    EXPECT_EQ(state(144, 3, bits([](auto& w) { w.put_string("id", "Skull").put_byte("SkullType", 1); })),
              "minecraft:wither_skeleton_wall_skull[facing=south]");
    EXPECT_EQ(state(140, 0, bits([](auto& w) {
                        w.put_string("id", "FlowerPot").put_string("Item", "minecraft:red_flower").put_int("Data", 8);
                    })),
              "minecraft:potted_oxeye_daisy");
    EXPECT_EQ(
        state(140, 0, bits([](auto& w) { w.put_string("id", "FlowerPot").put_int("Item", 6).put_int("Data", 2); })),
        "minecraft:potted_birch_sapling");
    EXPECT_EQ(state(25, 0, bits([](auto& w) { w.put_string("id", "Music").put_byte("note", 24); })),
              "minecraft:note_block[instrument=harp,note=24,powered=false]");
}

TEST(LegacyIds, BiomesHaveTheirNewestNames) {
    EXPECT_EQ(legacy_biome_name(1), "minecraft:plains");
    EXPECT_EQ(legacy_biome_name(3), "minecraft:windswept_hills");
    EXPECT_EQ(legacy_biome_name(18), "minecraft:forest");
    EXPECT_EQ(legacy_biome_name(50), "minecraft:deep_frozen_ocean");
    EXPECT_EQ(legacy_biome_name(165), "minecraft:eroded_badlands");
    EXPECT_EQ(legacy_biome_name(200), "legacy:biome_200");
}

// A small world around the origin of a middle column.
class Connect : public ::testing::Test {
protected:
    void put(i32 x, i32 y, i32 z, u32 id, u32 meta = 0) { blocks_[{x, y, z}] = LegacyCode(id << 4 | meta); }
    // The state at a place of the middle column after connecting.
    std::string at(i32 x, i32 y, i32 z) {
        DecodeContext context;
        std::array<RawColumn, 9> columns;
        std::array<const RawColumn*, 9> around{};
        for (i32 i = 0; i < 9; ++i) {
            std::vector<LegacyCode> codes(4096);
            for (const auto& [p, code] : blocks_)
                if (p[0] >> 4 == i % 3 - 1 && p[2] >> 4 == i / 3 - 1 && p[1] < 16)
                    codes[LocalPos(p[0] & 15, p[1], p[2] & 15).index] = code;
            RawSection& section = columns[std::size_t(i)].add_section();
            section.y = 0;
            set_legacy_blocks(codes.data(), context, section);
            around[std::size_t(i)] = &columns[std::size_t(i)];
        }
        std::vector<LegacyKey> palette;
        std::vector<u16> indices;
        connect_legacy(LegacyView(around), columns[4].sections[0], palette, indices);
        return legacy_state_of(palette[indices[LocalPos(x, y, z).index]]).to_string();
    }
    std::map<std::array<i32, 3>, LegacyCode> blocks_;
};

TEST_F(Connect, FencesReachOverTheBorderOfColumns) {
    put(0, 4, 8, 85), put(-1, 4, 8, 85), put(1, 4, 8, 1), put(0, 4, 7, 86), put(0, 4, 9, 113);
    EXPECT_EQ(at(0, 4, 8), "minecraft:oak_fence[east=true,north=false,south=false,west=true]");
}

TEST_F(Connect, PanesJoinGlassAndWallsStandUp) {
    put(4, 4, 4, 102), put(5, 4, 4, 95, 3), put(4, 4, 5, 101);
    EXPECT_EQ(at(4, 4, 4), "minecraft:glass_pane[east=true,north=false,south=true,west=false]");
    put(8, 4, 8, 139), put(8, 4, 7, 139), put(8, 4, 9, 139);
    EXPECT_EQ(at(8, 4, 8), "minecraft:cobblestone_wall[east=none,north=low,south=low,up=false,west=none]");
    put(8, 5, 8, 50, 5);
    EXPECT_EQ(at(8, 4, 8), "minecraft:cobblestone_wall[east=none,north=low,south=low,up=true,west=none]");
}

TEST_F(Connect, StairsTurnCorners) {
    put(4, 4, 4, 53, 0), put(5, 4, 4, 53, 3); // faces east; in front one that faces north
    EXPECT_EQ(at(4, 4, 4), "minecraft:oak_stairs[facing=east,half=bottom,shape=outer_left]");
    put(5, 4, 4, 53, 2); // south
    EXPECT_EQ(at(4, 4, 4), "minecraft:oak_stairs[facing=east,half=bottom,shape=outer_right]");
    put(5, 4, 4, 0), put(3, 4, 4, 67, 3);
    EXPECT_EQ(at(4, 4, 4), "minecraft:oak_stairs[facing=east,half=bottom,shape=inner_left]");
    put(3, 4, 4, 67, 7); // upside down: no corner
    EXPECT_EQ(at(4, 4, 4), "minecraft:oak_stairs[facing=east,half=bottom,shape=straight]");
}

TEST_F(Connect, HalvesTellEachOther) {
    put(3, 4, 3, 64, 4 | 2), put(3, 5, 3, 64, 8 | 1);
    EXPECT_EQ(at(3, 4, 3), "minecraft:oak_door[facing=west,half=lower,hinge=right,open=true,powered=false]");
    EXPECT_EQ(at(3, 5, 3), "minecraft:oak_door[facing=west,half=upper,hinge=right,open=true,powered=false]");
    put(6, 4, 6, 175, 4), put(6, 5, 6, 175, 8);
    EXPECT_EQ(at(6, 5, 6), "minecraft:rose_bush[half=upper]");
}

TEST_F(Connect, SnowWiresChests) {
    put(1, 4, 1, 2), put(1, 5, 1, 78);
    EXPECT_EQ(at(1, 4, 1), "minecraft:grass_block[snowy=true]");
    put(8, 4, 8, 55, 7), put(9, 4, 8, 1), put(9, 5, 8, 55), put(8, 4, 7, 55);
    EXPECT_EQ(at(8, 4, 8), "minecraft:redstone_wire[east=up,north=side,power=7,south=none,west=none]");
    put(12, 4, 12, 54, 2), put(13, 4, 12, 54, 2); // both look north; east is clockwise of north
    EXPECT_EQ(at(12, 4, 12), "minecraft:chest[facing=north,type=left]");
    EXPECT_EQ(at(13, 4, 12), "minecraft:chest[facing=north,type=right]");
    put(2, 4, 12, 54), put(2, 4, 13, 54); // Beta: no facing stored
    EXPECT_EQ(at(2, 4, 12), "minecraft:chest[facing=east,type=left]");
}

} // namespace
} // namespace vitrail
