// Pictures of packs: animations, materials, old names, colors of biomes and blocks.
#include "scene/pack_fixture.h"
#include "scene/pack_names.h"

namespace vitrail::scene {
namespace {

std::array<u8, 4> gray(u8 v) {
    return {v, v, v, 255};
}

TEST(PackArt, AnimationsSayTheirFrames) {
    PackWorld w;
    for (const char* name : {"plain", "listed", "silent", "still"})
        w.block(name, ShapeKind::cube, {name});
    const Bytes strip = test::png_of(test::picture(16, 64, [](u32, u32 y) { return gray(u8(y / 16 * 10)); }));
    for (const char* name : {"plain", "listed", "silent"})
        w.file(std::string("textures/block/") + name + ".png", strip);
    w.file("textures/block/plain.png.mcmeta", R"({"animation": {"frametime": 7}})");
    w.file(
        "textures/block/listed.png.mcmeta",
        R"({"animation": {"frametime": 3, "interpolate": true, "frames": [2, {"index": 0, "time": 9}, 99, {"time": 4}, 1.5, "x"]}})");
    w.file("textures/block/still.png", test::png_of(test::picture(16, 24, [](u32, u32) { return gray(9); })));
    ASSERT_NO_FATAL_FAILURE(w.load());
    const TextureArt& plain = *w.packs->art(w.texture_id("plain"));
    EXPECT_EQ(plain.frames(), 4u);
    ASSERT_EQ(plain.steps.size(), 4u);
    EXPECT_EQ(plain.steps[3].frame, 3);
    EXPECT_EQ(plain.steps[3].ticks, 7);
    EXPECT_FALSE(plain.interpolate);
    const TextureArt& listed = *w.packs->art(w.texture_id("listed"));
    ASSERT_EQ(listed.steps.size(), 3u); // 2, 0, 1: frame 99 is not there, the rest is nonsense
    EXPECT_TRUE(listed.interpolate);
    EXPECT_EQ(listed.steps[0].frame, 2);
    EXPECT_EQ(listed.steps[0].ticks, 3);
    EXPECT_EQ(listed.steps[1].ticks, 9);
    EXPECT_EQ(w.packs->art(w.texture_id("silent"))->steps.size(), 4u);
    const TextureArt& still = *w.packs->art(w.texture_id("still"));
    EXPECT_EQ(still.frames(), 1u); // made square
    EXPECT_EQ(still.side(), 24u);
}

TEST(PackArt, LabPbrAndGlow) {
    PackWorld w;
    for (const char* name : {"shiny", "lamp"})
        w.block(name, ShapeKind::cube, {name});
    w.texture("shiny", {50, 60, 70, 255});
    w.texture("shiny_n", {200, 90, 255, 255});
    // Smoothness 255 in the left half, 0 in the right; emission 254 in the top row, none (255) elsewhere.
    w.file("textures/block/shiny_s.png", test::png_of(test::picture(16, 16, [](u32 x, u32 y) {
               return std::array<u8, 4>{u8(x < 8 ? 255 : 0), 10, 0, u8(y == 0 ? 254 : 255)};
           })));
    w.texture("lamp", {50, 60, 70, 255});
    w.file("textures/block/lamp_glow.png", test::png_of(test::picture(16, 16, [](u32 x, u32) {
               return std::array<u8, 4>{200, 100, 0, u8(x == 0 ? 255 : 0)};
           })));
    w.file("optifine/emissive.properties", "# which\nsuffix.emissive=_glow\r\n");
    ASSERT_NO_FATAL_FAILURE(w.load());
    const TextureArt& shiny = *w.packs->art(w.texture_id("shiny"));
    EXPECT_EQ(shiny.roughness.at(0, 3)[0], 0);
    EXPECT_EQ(shiny.roughness.at(9, 3)[0], 255);
    EXPECT_EQ(shiny.emission.at(4, 0)[0], 255);
    EXPECT_EQ(shiny.emission.at(4, 1)[0], 0);
    EXPECT_EQ(shiny.normal.at(4, 4)[0], 200);
    EXPECT_EQ(shiny.normal.at(4, 4)[1], 90);
    const TextureArt& lamp = *w.packs->art(w.texture_id("lamp"));
    EXPECT_EQ(lamp.albedo.at(0, 5)[0], 200);
    EXPECT_EQ(lamp.albedo.at(1, 5)[0], 50);
    EXPECT_EQ(lamp.emission.at(0, 5)[0], 200);
    EXPECT_EQ(lamp.emission.at(1, 5)[0], 0);
    EXPECT_EQ(lamp.roughness.width, 0u);
}

TEST(PackArt, AlphaDecidesThePass) {
    const auto kind = [](std::array<u8, 2> alphas) {
        return alpha_kind(test::picture(2, 1, [&](u32 x, u32) { return std::array<u8, 4>{1, 2, 3, alphas[x]}; }));
    };
    EXPECT_EQ(kind({255, 255}), AlphaKind::full);
    EXPECT_EQ(kind({255, 0}), AlphaKind::holes);
    EXPECT_EQ(kind({255, 128}), AlphaKind::partial);
}

TEST(PackArt, PacksBeforeTheFlatteningKeepTheirNames) {
    PackWorld w;
    w.mcmeta = R"({"pack":{"pack_format":2,"description":""}})";
    const std::vector<std::pair<const char*, const char*>> names = {
        {"oak_planks", "planks_oak"},
        {"dark_oak_log_top", "log_big_oak_top"},
        {"light_gray_wool", "wool_colored_silver"},
        {"white_tulip", "flower_tulip_white"},
        {"oak_door_top", "door_wood_upper"},
        {"acacia_door_bottom", "door_acacia_lower"},
        {"wheat_stage3", "wheat_stage_3"},
        {"stone", "stone"},
        {"orange_stained_glass_pane_top", "glass_pane_top_orange"},
        {"red_terracotta", "hardened_clay_stained_red"},
        {"iron_door_top", "door_iron_upper"},
        {"lava_still", "lava_still"},
        {"short_grass", "tallgrass"},
        {"birch_leaves", "leaves_birch"}};
    for (const auto& [modern, old] : names) {
        w.block(modern, ShapeKind::cube, {modern});
        w.file(std::string("textures/blocks/") + old + ".png", test::plain_png(16, gray(77)));
    }
    w.block("water", ShapeKind::liquid, {"water_still"}, RenderLayer::translucent).tint = TintKind::water;
    w.file("textures/blocks/water_still.png", test::plain_png(16, {20, 30, 200, 180}));
    w.states_of("stone", R"({"variants": {"normal": {"model": "cube_all"}}})"); // means other blocks: not read
    ASSERT_NO_FATAL_FAILURE(w.load());
    for (const auto& [modern, old] : names)
        EXPECT_TRUE(w.packs->replaces(w.texture_id(modern))) << modern;
    EXPECT_EQ(w.packs->counts().blockstates, 0u);
    // Its water is painted blue.
    EXPECT_EQ(PackWorld::tint_of(w.models->liquid(w.id("water[level=0]"))->still), TintKind::none);
    EXPECT_EQ(w.fixed_tint(w.face(w.id("birch_leaves"), Face::up)), (std::array<u8, 3>{0x80, 0xa7, 0x55}));
}

TEST(PackArt, ColorsOfBiomesComeFromTheMaps) {
    PackWorld w;
    // Red grows as it gets colder, green as it gets drier.
    w.file("textures/colormap/grass.png", test::png_of(test::picture(256, 256, [](u32 x, u32 y) {
               return std::array<u8, 4>{u8(x), u8(y), 7, 255};
           })));
    ASSERT_NO_FATAL_FAILURE(w.load());
    BiomeDef biome;
    biome.name = "minecraft:plains", biome.temperature = 0.8f, biome.downfall = 0.4f;
    EXPECT_EQ(w.packs->grass(biome), (std::array<u8, 3>{50, 173, 7})); // 255 x 0.2 and 255 x (1 - 0.32)
    EXPECT_FALSE(w.packs->foliage(biome));
    biome.temperature = 2, biome.downfall = 0;
    EXPECT_EQ(w.packs->grass(biome), (std::array<u8, 3>{0, 255, 7}));
    biome.temperature = -1, biome.downfall = 1;
    EXPECT_EQ(w.packs->grass(biome), (std::array<u8, 3>{255, 255, 7}));
    biome.name = "minecraft:mangrove_swamp";
    EXPECT_FALSE(w.packs->grass(biome));
}

TEST(PackArt, ColorsOfBlocks) {
    PackWorld w;
    for (const char* name : {"redstone_wire", "melon_stem", "lily_pad", "stone", "grass_block"})
        w.block(name, ShapeKind::cube, {name});
    ASSERT_NO_FATAL_FAILURE(w.load());
    const auto tint = [&](const char* text) { return minecraft_tint(w.states->info(w.id(text))); };
    EXPECT_EQ(tint("redstone_wire[power=0]")->fixed, (std::array<u8, 3>{76, 0, 0}));
    EXPECT_EQ(tint("redstone_wire[power=15]")->fixed, (std::array<u8, 3>{255, 50, 0}));
    EXPECT_EQ(tint("melon_stem[age=7]")->fixed, (std::array<u8, 3>{224, 199, 28}));
    EXPECT_EQ(tint("lily_pad")->fixed, (std::array<u8, 3>{0x20, 0x80, 0x30}));
    EXPECT_EQ(tint("grass_block[snowy=false]")->kind, TintKind::grass);
    EXPECT_EQ(tint("grass_block[snowy=true]")->kind, TintKind::none);
    EXPECT_FALSE(tint("stone"));
}

} // namespace
} // namespace vitrail::scene
