// Terrain as content: the functions' errors, what a second content folder may change, and that the base game holds
// every row of its reference tables.
#include "script/content_loader.h"
#include "terrain/compile/compile.h"
#include "terrain/compile/shape_info.h"
#include "world/block_state.h"

#include <algorithm>
#include <filesystem>
#include <fmt/format.h>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <iterator>
#include <map>
#include <unistd.h>

namespace vitrail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A small world that is complete.
constexpr const char* kSmall = R"lua(
    define_block("stone", {}) define_block("dirt", {}) define_block("grass_block", { properties = { snowy = { false, true } } })
    define_terrain { warp = { "20 F3(.015)",
                     0
}
, fields = {{name = "sea", noise = "F(.001)"}}, attributes = {{name = "ocean", field = "sea", low = .01, high = -.02}},
  cave_attributes = {{name = "deep", by_depth = true, offset = "5 F3(.01)", low = 20, high = 30}},
  materials = {dirt = .5}
}
    define_terrain_layer("stone", { block = "stone", thickness = 10, amplitude = 5, frequency = .01, remainder = true })
    define_terrain_layer("dirt", { block = "dirt", loose = true, thickness = 4, repose = 40, steepest = 1.2 })
    define_terrain_biome("test:sea", { wants = "+", height = "100 + 8 F(.01)", materials = { dirt = 0 } })
    define_terrain_biome("test:land", { wants = "-", height = 140, rules = { { from = "dirt", depth = 1, to = "grass_block[snowy=true]" } } })
    define_cave_biome("test:none", { wants = "-" })
    define_cave_biome("test:deep", { wants = "+", rules = { { place = "floor", from = "rock", to = "dirt", depth = 2, chance = .5 } } })
    define_terrain_feature("test:bush", { shape = "shrub", biome = "test:land", cell = 9, padding = 2, chance = .5, layers = "dirt",
        least_thickness = .5, lowest_y = 120, highest_y = 200, numbers = { radius_most = 2 }, blocks = { trunk = "stone", leaves = "dirt" } })
    define_decorator { biome = "test:land", block = "grass_block", upper = "dirt", chance = .25, on = { "grass_block", "loose" } }
)lua";

Result<Content> load(const std::string& text) {
    const ContentFile files[] = {{"small.lua", kSmall}, {"test.lua", text}};
    return load_content_texts(files);
}

std::string error_of(const std::string& text) {
    const auto loaded = load(text);
    return loaded ? "no error" : loaded.error().message;
}

TEST(TerrainContent, NothingSaidIsNoTerrain) {
    const ContentFile file{"a.lua", "define_block('x', {})"};
    const auto content = load_content_texts({&file, 1});
    ASSERT_TRUE(content);
    EXPECT_EQ(content->terrain, nullptr);
    EXPECT_NE(content->registry, nullptr);
}

// Lua writes small numbers with an exponent, which expressions do not know.
TEST(TerrainContent, PlainNumbersBecomeExpressions) {
    for (const auto& [lua, text] : {std::pair{"1e-5", "0.00001"}, {"-12.5", "-12.5"}, {"1000000", "1000000"}}) {
        const auto content =
            load(fmt::format("define_terrain_biome('test:land', {{ wants = '-', height = {} }})", lua));
        ASSERT_TRUE(content) << content.error().message;
        EXPECT_EQ(content->terrain->biomes.back().height, text);
        EXPECT_TRUE(compile_terrain(*content->terrain, 1));
    }
    EXPECT_THAT(error_of("define_terrain_biome('test:land', { wants = '-', height = 1e300 })"),
                HasSubstr("height: expected an expression"));
}

TEST(TerrainContent, ReadsEveryKey) {
    const auto content = load("");
    ASSERT_TRUE(content) << content.error().message;
    const TerrainDescription& d = *content->terrain;
    EXPECT_EQ(d.warp_x, "20 F3(.015)");
    EXPECT_EQ(d.warp_z, "0");
    ASSERT_EQ(d.attributes.size(), 1u);
    EXPECT_FLOAT_EQ(d.attributes[0].high, -.02f);
    ASSERT_EQ(d.layers.size(), 2u);
    EXPECT_TRUE(d.layers[0].remainder);
    EXPECT_EQ(d.layers[0].block, "minecraft:stone");
    EXPECT_FLOAT_EQ(d.layers[1].repose_degrees, 40);
    EXPECT_FLOAT_EQ(d.materials.at("dirt"), .5f);
    ASSERT_EQ(d.biomes.size(), 2u);
    EXPECT_EQ(d.biomes[1].height, "140");
    ASSERT_EQ(d.biomes[1].rules.size(), 1u);
    EXPECT_EQ(d.biomes[1].rules[0].to, "minecraft:grass_block[snowy=true]");
    EXPECT_EQ(d.biomes[1].rules[0].depth, 1);
    EXPECT_THAT(d.biomes[1].rules[0].from, ElementsAre("minecraft:dirt"));
    ASSERT_EQ(d.cave_biomes.size(), 2u);
    EXPECT_THAT(d.cave_biomes[1].rules[0].from, ElementsAre("rock"));
    ASSERT_EQ(d.features.size(), 1u);
    const auto& f = d.features[0];
    EXPECT_EQ(f.shape, "shrub");
    EXPECT_EQ(f.place, "surface");
    EXPECT_EQ(f.cell, 9);
    EXPECT_EQ(f.padding, 2);
    EXPECT_THAT(f.layers, ElementsAre("dirt"));
    EXPECT_EQ(f.lowest_y, 120);
    EXPECT_EQ(f.highest_y, 200);
    EXPECT_FLOAT_EQ(f.numbers.at("radius_most"), 2);
    EXPECT_EQ(f.blocks.at("leaves"), "minecraft:dirt");
    ASSERT_EQ(d.decorators.size(), 1u);
    EXPECT_EQ(d.decorators[0].upper, "minecraft:dirt");
    EXPECT_THAT(d.decorators[0].on, ElementsAre("minecraft:grass_block", "loose"));
    const auto compiled = compile_terrain(d, 1);
    EXPECT_TRUE(compiled) << compiled.error().message;
}

TEST(TerrainContent, ErrorsNameFileRowKeyAndWhatWasExpected) {
    const auto starts = [](const char* script, const char* message) {
        EXPECT_THAT(error_of(script), HasSubstr(message)) << script;
    };
    starts("define_terrain(5)", "test.lua:1: terrain: expected a table, got 5");
    starts("define_terrain { fields = 5 }", "terrain: fields: expected a list, got 5");
    starts("define_terrain { fields = { { name = 'x' } } }", "terrain: fields: [1]: there is no noise");
    starts("define_terrain { fields = { { name = 'A b', noise = 'F(.1)' } } }", "fields: [1]: name: expected a word");
    starts("define_terrain { warp = { 'F(.1)' } }", "terrain: warp: expected two expressions");
    starts("define_terrain { attributes = { { name = 'x', field = 'sea', low = 0/0, high = 1 } } }",
           "low: expected a number from");
    starts("define_terrain { mountains = 1 }", "unknown key mountains; there are warp fields");
    starts("define_terrain { materials = { dirt = -1 } }", "terrain: materials: dirt: expected a number from 0 to 100");
    starts("local f = {} for i = 1, 9 do f[i] = { name = 'f' .. i, noise = 1 } end define_terrain { fields = f }",
           "fields: 9 entries, at most 8");
    starts("define_terrain_layer('x y', {})", "terrain layer: expected a word");
    starts("define_terrain_layer('x', { thickness = 1 })", "terrain layer x: there is no block");
    starts("define_terrain_layer('x', { block = 'stone', thickness = 1/0 })",
           "terrain layer x: thickness: expected a number from 0 to 384");
    starts("define_terrain_layer('x', { block = 'Stone!' })", "terrain layer x: block: ");
    starts("define_terrain_layer('x', { block = 'stone', loose = 1 })", "loose: expected true or false");
    starts("define_terrain_layer('x', { block = 'stone', loose = true, hung = true })",
           "terrain layer x: what is loose neither hangs");
    starts("define_terrain_layer('x', { block = 'stone', over = 'none' })",
           "terrain layer x: over: there is no layer none");
    starts("for i = 1, 99 do define_terrain_layer('x' .. i, { block = 'stone' }) end", "more than 24 layers");
    starts("define_terrain_biome('test:b', { height = 1 })", "terrain biome test:b: there is no wants");
    starts("define_terrain_biome('test:b', { wants = '+x', height = 1 })",
           "test:b: wants: expected a sign an attribute");
    starts("define_terrain_biome('test:b', { wants = '+', height = {} })", "test:b: height: expected an expression");
    starts("define_terrain_biome('test:b', { wants = '+', height = 1/0 })", "test:b: height: expected an expression");
    starts("define_terrain_biome('test:b', { wants = '+', height = string.rep('1+', 1500) .. 1 })",
           "more than 2000 bytes");
    starts("define_terrain_biome('test:b', { wants = '+', height = 1, rules = { { from = 'dirt' } } })",
           "rules: [1]: expected either to or bands");
    starts("define_terrain_biome('test:b', { wants = '+', height = 1, rules = { { from = {}, to = 'dirt' } } })",
           "rules: [1]: from: expected");
    starts("define_terrain_biome('test:b', { wants = '+', height = 1, rules = { { from = 'rock', bands = { 'dirt' "
           "} } } })",
           "bands are counted from above");
    starts("for i = 1, 99 do define_terrain_biome('test:b' .. i, { wants = '+', height = 1 }) end",
           "more than 48 biomes");
    starts("define_cave_biome('test:b', { wants = '+', rules = { { place = 'wall', from = 'rock', to = 'dirt' } } })",
           "place: expected one of floor ceiling rock");
    starts("define_terrain_feature('test:f', { shape = 'shrub', biome = 'test:land', cell = 4, padding = 2 })",
           "test:f: padding: nothing is left");
    starts("define_terrain_feature('test:f', { shape = 'shrub', biome = 'test:land', cell = 4.5 })",
           "test:f: cell: expected a whole number");
    starts("define_terrain_feature('test:f', { shape = 'shrub', biome = 'test:land', cell = 4, chance = 1.5 })",
           "test:f: chance: expected a number from 0 to 1");
    starts("define_terrain_feature('test:f', { shape = 'shrub', biome = 'test:land', cell = 4, place = 'sky' })",
           "test:f: place: expected one of surface");
    starts("for i = 1, 999 do define_terrain_feature('test:f' .. i, { shape = 'shrub', biome = 'test:land', cell = "
           "4 }) end",
           "more than 96 features");
    starts("define_decorator { biome = 'test:land', block = 'dirt' }", "decorator: there is no chance");
    starts("for i = 1, 999 do define_decorator { biome = 'test:b' .. i, block = 'dirt', chance = 0 } end",
           "more than 192 decorators");
}

TEST(TerrainContent, ReferencesAreChecked) {
    EXPECT_THAT(error_of("define_terrain_layer('x', { block = 'nothing' })"),
                HasSubstr("terrain layer x: there is no block minecraft:nothing"));
    EXPECT_THAT(error_of("define_terrain_layer('x', { block = 'stone[a=b]' })"),
                HasSubstr("terrain layer x: block minecraft:stone has no a=b"));
    EXPECT_THAT(error_of("define_terrain_layer('x', { block = 'grass_block[snowy=7]' })"), HasSubstr("has no snowy=7"));
    EXPECT_THAT(error_of("define_terrain { attributes = { { name = 'a', field = 'b', low = 0, high = 1 } } }"),
                HasSubstr("terrain attribute a: there is no field b"));
    EXPECT_THAT(error_of("define_terrain_biome('test:b', { wants = '++', height = 1 })"),
                HasSubstr("terrain biome test:b: wants: 2 signs for 1 attributes"));
    EXPECT_THAT(error_of("define_terrain_biome('test:b', { wants = '+', height = 1, materials = { mud = 1 } })"),
                HasSubstr("test:b: materials: there is no layer mud"));
    EXPECT_THAT(error_of("define_terrain_biome('test:b', { wants = '+', height = 1, rules = { { from = 'mud', to = "
                         "'dirt' } } })"),
                HasSubstr("terrain biome test:b: rules: [1]: there is no block minecraft:mud"));
    EXPECT_THAT(error_of("define_terrain_feature('test:f', { shape = 'shrub', biome = 'test:moon', cell = 4 })"),
                HasSubstr("test:f: there is no terrain biome test:moon"));
    EXPECT_THAT(error_of("define_terrain_feature('test:f', { shape = 'shrub', biome = 'test:land', place = "
                         "'cave_floor', cell = 4 })"),
                HasSubstr("test:f: there is no cave biome test:land"));
    EXPECT_THAT(
        error_of(
            "define_terrain_feature('test:f', { shape = 'shrub', biome = 'test:land', cell = 4, layers = 'mud' })"),
        HasSubstr("there is no layer mud"));
    EXPECT_THAT(error_of("define_decorator { biome = 'test:moon', block = 'dirt', chance = 0 }"),
                HasSubstr("decorator minecraft:dirt of test:moon: there is no terrain biome"));
}

TEST(TerrainContent, LaterRowsTakeTheirNamesPlace) {
    const auto content = load(R"lua(
        define_terrain { fields = { { name = "heat", noise = "S(.01)"
    }
    }
    , attributes = {{name = "warm", field = "heat", low = 0, high = .1}}
    }
        define_terrain_layer("clay", { block = "dirt", loose = true, thickness = 1, over = "stone" })
        define_terrain_biome("test:sea", { wants = "+-", height = 50 })
        define_terrain_biome("test:lagoon", { wants = "++", height = "120 + 4 ss(0, 1, warm) F2(.02)" })
        define_terrain_feature("test:bush", { shape = "shrub", biome = "test:lagoon", cell = 5, blocks = { trunk = "stone", leaves = "dirt" } })
        define_decorator { biome = "test:land", block = "grass_block", chance = .5 })lua");
    ASSERT_TRUE(content) << content.error().message;
    const TerrainDescription& d = *content->terrain;
    ASSERT_EQ(d.layers.size(), 3u);
    EXPECT_EQ(d.layers[1].name, "clay");
    ASSERT_EQ(d.biomes.size(), 3u);
    EXPECT_EQ(d.biomes[0].name, "test:sea");
    EXPECT_EQ(d.biomes[0].height, "50");
    EXPECT_EQ(d.biomes[1].wants, "-.") << "an attribute that a biome does not know does not matter to it";
    EXPECT_EQ(d.attributes.size(), 2u);
    ASSERT_EQ(d.features.size(), 1u);
    EXPECT_EQ(d.features[0].biome, "test:lagoon");
    ASSERT_EQ(d.decorators.size(), 1u);
    EXPECT_FLOAT_EQ(d.decorators[0].chance, .5f);
    const auto compiled = compile_terrain(d, 1);
    ASSERT_TRUE(compiled) << compiled.error().message;
    EXPECT_THAT(compiled->biome_names, ElementsAre("test:sea", "test:land", "test:lagoon", "test:none", "test:deep"));
}

TEST(TerrainContent, BadExpressionsAreErrorsOfTheCompiler) {
    const auto content = load("define_terrain_biome('test:land', { wants = '-', height = '1 + ' })");
    ASSERT_TRUE(content) << content.error().message;
    const auto compiled = compile_terrain(*content->terrain, 1);
    ASSERT_FALSE(compiled);
    EXPECT_THAT(compiled.error().message, HasSubstr("test:land"));
}

// The base game.
class BaseTerrain : public testing::Test {
protected:
    static const Content& content() {
        static const Content content = [] {
            const std::filesystem::path roots[] = {std::filesystem::path(VITRAIL_SOURCE_DIR) / "content" / "base"};
            auto loaded = load_content(roots);
            EXPECT_TRUE(loaded) << (loaded ? "" : loaded.error().message);
            return loaded ? *loaded : Content{};
        }();
        return content;
    }
    const TerrainDescription& d() { return *content().terrain; }
    void SetUp() override { ASSERT_NE(content().terrain, nullptr); }
};

TEST_F(BaseTerrain, CompilesForAnySeed) {
    for (const u64 seed : {0ull, 1ull, ~0ull}) {
        const auto compiled = compile_terrain(d(), seed);
        ASSERT_TRUE(compiled) << compiled.error().message;
        EXPECT_EQ(compiled->tables->biomes, 24u);
        EXPECT_EQ(compiled->tables->cave_biomes, 5u);
        EXPECT_EQ(compiled->tables->strata, 12u);
        EXPECT_EQ(compiled->tables->loose, 8u);
        for (const std::string& block : compiled->block_names) {
            const auto state = parse_block_state(block);
            ASSERT_TRUE(state) << block;
            EXPECT_NE(content().registry->find_block(state->name), BlockId::unknown) << block;
        }
        for (const std::string& biome : compiled->biome_names)
            EXPECT_EQ(content().registry->biome_named(biome).name, biome) << "has no colors";
    }
}

// Every combination of attributes belongs to exactly one biome.
template <class T>
void expect_partition(const std::vector<T>& biomes, std::size_t attributes) {
    for (u32 mask = 0; mask < 1u << attributes; ++mask) {
        int owners = 0;
        for (const T& biome : biomes) {
            ASSERT_EQ(biome.wants.size(), attributes) << biome.name;
            bool fits = true;
            for (std::size_t i = 0; i < attributes; ++i)
                if (biome.wants[i] != '.' && (biome.wants[i] == '+') != ((mask >> i & 1) != 0)) fits = false;
            owners += fits;
        }
        EXPECT_EQ(owners, 1) << mask;
    }
}

TEST_F(BaseTerrain, WantsAreAPartition) {
    expect_partition(d().biomes, 6);
    expect_partition(d().cave_biomes, 4);
}

TEST_F(BaseTerrain, AttributesAndBiomesAreThoseOfTheTable) {
    const struct {
        const char *name, *noise;
        float low, high;
    } attributes[] = {{"ocean", "F(.000224)", .01f, -.02f},       {"beach", "F(.000224)", -.15f, -.05f},
                      {"rocky", "F(.00048)", -.08f, .08f},        {"magic", "F(.00096)", -.07f, .07f},
                      {"temperature", "F(.000384)", -.06f, .06f}, {"moisture", "F(.0016)", -.12f, .12f}};
    ASSERT_EQ(d().attributes.size(), std::size(attributes));
    for (std::size_t i = 0; i < std::size(attributes); ++i) {
        const auto& a = d().attributes[i];
        EXPECT_EQ(a.name, attributes[i].name);
        EXPECT_FLOAT_EQ(a.low, attributes[i].low) << a.name;
        EXPECT_FLOAT_EQ(a.high, attributes[i].high) << a.name;
        const auto field =
            std::find_if(d().fields.begin(), d().fields.end(), [&](const auto& f) { return f.name == a.field; });
        ASSERT_NE(field, d().fields.end());
        EXPECT_EQ(field->noise, attributes[i].noise) << a.name;
    }
    EXPECT_EQ(d().attributes[0].field, d().attributes[1].field) << "the beach is the rim of the sea";
    const std::pair<const char*, const char*> biomes[] = {{"coral_reef", "+-++.."},
                                                          {"archipelago", "+-+-.."},
                                                          {"warm_ocean", "+--.+."},
                                                          {"icebergs", "+--+-."},
                                                          {"cool_ocean", "+----."},
                                                          {"rocky_beach", "+++..."},
                                                          {"tropical_beach", "++-.+."},
                                                          {"beach", "++-.-."},
                                                          {"savanna", "-.++++"},
                                                          {"mesa", "-.+++-"},
                                                          {"frozen_wasteland", "-.++-+"},
                                                          {"redwood_forest", "-.++--"},
                                                          {"swamp", "-.+-++"},
                                                          {"sparse_desert", "-.+-+-"},
                                                          {"lush_birch_forest", "-.+--+"},
                                                          {"tianzi_mountains", "-.+---"},
                                                          {"jungle", "-.-+++"},
                                                          {"red_desert", "-.-++-"},
                                                          {"purple_mushrooms", "-.-+-+"},
                                                          {"crystals", "-.-+--"},
                                                          {"oasis", "-.--++"},
                                                          {"desert", "-.--+-"},
                                                          {"plains", "-.---+"},
                                                          {"mountains", "-.----"}};
    ASSERT_EQ(d().biomes.size(), std::size(biomes));
    for (std::size_t i = 0; i < std::size(biomes); ++i) {
        EXPECT_EQ(d().biomes[i].name, std::string("vitrail:") + biomes[i].first);
        EXPECT_EQ(d().biomes[i].wants, biomes[i].second) << biomes[i].first;
    }
    std::vector<std::string> caves;
    for (const auto& biome : d().cave_biomes)
        caves.push_back(biome.name);
    EXPECT_THAT(caves, testing::UnorderedElementsAre("vitrail:none", "vitrail:crystal_caves", "vitrail:lush_caves",
                                                     "vitrail:warped_forest", "vitrail:amber_forest"));
    const auto& mesa = d().biomes[9];
    ASSERT_EQ(mesa.rules.size(), 2u); // bands, and turf on what dirt comes over the border
    EXPECT_EQ(mesa.rules[0].bands.size(), 32u);
}

TEST_F(BaseTerrain, LayersAreThoseOfTheTable) {
    const struct {
        const char* name;
        bool loose, hung;
        float a, b, c; // thickness, amplitude, frequency; loose: thickness, repose, steepest
    } rows[] = {{"blackstone", false, false, 32, 32, .003f},  {"deepslate", false, false, 66, 20, .0045f},
                {"slate", false, false, 6, 24, .0062f},       {"stone", false, false, 40, 30, .005f},
                {"tuff", false, false, 24, 42, .006f},        {"calcite", false, false, 20, 30, .004f},
                {"granite", false, false, 18, 36, .0034f},    {"terracotta", false, false, 32, 16, .002f},
                {"marble", false, false, 28, 56, .005f},      {"andesite", false, false, 24, 48, .003f},
                {"red_sandstone", false, true, 3, 2, .0035f}, {"sandstone", false, true, 3.5f, 1.5f, .0025f},
                {"gravel", true, false, 2.5f, 55, 1.8f},      {"clay", true, false, 2.7f, 40, 1.8f},
                {"mud", true, false, 2.3f, 45, 1.6f},         {"dirt", true, false, 4.2f, 40, 1.2f},
                {"red_sand", true, false, 3.5f, 30, 1.5f},    {"sand", true, false, 3.8f, 35, 1.4f},
                {"smooth_sand", true, false, 4.5f, 65, 4},    {"snow", true, false, 2.5f, 45, 1.5f}};
    ASSERT_EQ(d().layers.size(), std::size(rows));
    for (std::size_t i = 0; i < std::size(rows); ++i) {
        const auto& layer = d().layers[i];
        EXPECT_EQ(layer.name, rows[i].name);
        EXPECT_EQ(layer.loose, rows[i].loose) << layer.name;
        EXPECT_EQ(layer.hung, rows[i].hung) << layer.name;
        EXPECT_EQ(layer.remainder, layer.name == "andesite") << layer.name;
        EXPECT_FLOAT_EQ(layer.thickness, rows[i].a) << layer.name;
        EXPECT_FLOAT_EQ(layer.loose ? layer.repose_degrees : layer.amplitude, rows[i].b) << layer.name;
        EXPECT_FLOAT_EQ(layer.loose ? layer.steepest : layer.frequency, rows[i].c) << layer.name;
    }
}

TEST_F(BaseTerrain, FeaturesAreThoseOfTheTable) {
    const struct {
        const char *name, *shape, *biome;
        int cell, padding;
        float chance;
        std::vector<std::string> layers;
        float thickness;
        int least_height = 0;
    } rows[] = {
        {"coral", "coral", "coral_reef", 5, 0, .65f, {"sand", "smooth_sand"}, .3f},
        {"kelp_cool_ocean", "kelp", "cool_ocean", 5, 0, .5f, {}, 0},
        {"kelp_warm_ocean", "kelp", "warm_ocean", 5, 0, .5f, {}, 0},
        {"iceberg", "iceberg", "icebergs", 112, 6, .7f, {}, 0},
        {"acacia", "acacia", "savanna", 36, 4, .3f, {"dirt"}, .5f},
        {"redwood", "redwood", "redwood_forest", 16, 2, .7f, {"dirt"}, .5f},
        {"cypress", "cypress", "swamp", 18, 3, .6f, {"dirt", "mud"}, .5f},
        {"birch_lush_birch_forest", "birch", "lush_birch_forest", 9, 2, .7f, {"dirt"}, .5f},
        {"birch_swamp", "birch", "swamp", 16, 2, .15f, {"dirt", "mud"}, .5f},
        {"pine", "pine", "tianzi_mountains", 7, 1, .8f, {}, 0},
        {"shrub", "shrub", "tianzi_mountains", 6, 1, .8f, {}, 0},
        {"rafflesia", "rafflesia", "jungle", 54, 6, .5f, {"dirt"}, .5f},
        {"jungle_tree_large", "jungle_tree", "jungle", 28, 3, .7f, {"dirt"}, .5f},
        {"jungle_tree_small", "small_jungle_tree", "jungle", 10, 2, .82f, {"dirt"}, .5f},
        {"jungle_tree_tiny", "small_jungle_tree", "jungle", 6, 1, .28f, {"dirt"}, .3f},
        {"purple_mushroom_medium", "medium_mushroom", "purple_mushrooms", 10, 2, .5f, {"dirt"}, .3f},
        {"purple_mushroom_large", "mushroom", "purple_mushrooms", 18, 3, .45f, {"dirt"}, .5f},
        {"crystal_medium", "crystal", "crystals", 28, 6, .9f, {}, 0},
        {"crystal_large", "crystal", "crystals", 52, 10, .8f, {}, 0},
        {"palm_tropical_beach", "palm", "tropical_beach", 48, 3, .35f, {"smooth_sand"}, .3f},
        {"palm_red_desert", "palm", "red_desert", 40, 3, .2f, {"red_sand"}, .3f},
        {"palm_oasis", "palm", "oasis", 24, 3, .35f, {"dirt", "sand"}, .3f},
        {"palm_desert", "palm", "desert", 64, 3, .3f, {"sand"}, .3f},
        {"cactus_sparse_desert", "cactus", "sparse_desert", 16, 2, .2f, {"smooth_sand"}, .3f},
        {"cactus_mesa", "cactus", "mesa", 16, 2, .3f, {}, 0},
        {"cactus_desert", "cactus", "desert", 16, 2, .5f, {"sand"}, .3f},
        {"cactus_red_desert", "cactus", "red_desert", 16, 2, .7f, {"red_sand"}, .3f},
        {"stormlight", "stormlight", "crystal_caves", 32, 4, .8f, {}, 0, 4},
        {"stormlight_hanging", "stormlight", "crystal_caves", 32, 4, .8f, {}, 0, 4},
        {"crystal_pillar", "crystal_pillar", "crystal_caves", 28, 5, .6f, {}, 0, 10},
        {"glowstone_cluster_crystal_caves", "glowstone_cluster", "crystal_caves", 24, 3, .6f, {}, 0, 16},
        {"glowstone_cluster_lush_caves", "glowstone_cluster", "lush_caves", 24, 3, .6f, {}, 0, 16},
        {"glowstone_cluster_warped_forest", "glowstone_cluster", "warped_forest", 16, 3, .8f, {}, 0, 16},
        {"glowstone_cluster_amber_forest", "glowstone_cluster", "amber_forest", 18, 3, .75f, {}, 0, 16},
        {"cave_vine", "cave_vine", "lush_caves", 4, 0, .4f, {}, 0, 4},
        {"warped_fungus", "fungus", "warped_forest", 7, 1, .75f, {}, 0, 6},
        {"amber_fungus", "fungus", "amber_forest", 5, 1, .6f, {}, 0, 9},
    };
    for (const auto& row : rows) {
        const std::string name = std::string("vitrail:") + row.name;
        const auto f =
            std::find_if(d().features.begin(), d().features.end(), [&](const auto& x) { return x.name == name; });
        ASSERT_NE(f, d().features.end()) << name;
        EXPECT_EQ(f->shape, row.shape) << name;
        EXPECT_EQ(f->biome, std::string("vitrail:") + row.biome) << name;
        EXPECT_EQ(f->cell, row.cell) << name;
        EXPECT_EQ(f->padding, row.padding) << name;
        EXPECT_FLOAT_EQ(f->chance, row.chance) << name;
        EXPECT_EQ(f->layers, row.layers) << name;
        EXPECT_FLOAT_EQ(f->least_thickness, row.thickness) << name;
        EXPECT_EQ(f->least_height, row.least_height) << name;
    }
    const auto feature = [&](const char* name) -> const TerrainDescription::Feature& {
        return *std::find_if(d().features.begin(), d().features.end(), [&](const auto& f) { return f.name == name; });
    };
    EXPECT_EQ(feature("vitrail:coral").highest_y, 121);
    EXPECT_EQ(feature("vitrail:crystal_large").highest_y, 179);
    EXPECT_EQ(feature("vitrail:crystal_medium").highest_y, 179);
    EXPECT_FLOAT_EQ(feature("vitrail:iceberg").numbers.at("radius_least"), 20);
    EXPECT_FLOAT_EQ(feature("vitrail:iceberg").numbers.at("radius_most"), 32);
    EXPECT_FLOAT_EQ(feature("vitrail:redwood").numbers.at("height_least"), 27);
    EXPECT_FLOAT_EQ(feature("vitrail:redwood").numbers.at("height_most"), 40);
    EXPECT_FLOAT_EQ(feature("vitrail:purple_mushroom_large").numbers.at("cap_radius_most"), 19);
    EXPECT_FLOAT_EQ(feature("vitrail:cave_vine").numbers.at("glowing_share"), .2f);
}

TEST_F(BaseTerrain, DecoratorsAreThoseOfTheTable) {
    // biome, block without namespace minecraft: and properties, chance
    const std::vector<std::tuple<std::string, std::string, float>> rows = {
        {"coral_reef", "seagrass", .2f},
        {"coral_reef", "tall_seagrass", .04f},
        {"coral_reef", "tube_coral", .03f},
        {"coral_reef", "brain_coral", .03f},
        {"coral_reef", "bubble_coral", .03f},
        {"coral_reef", "fire_coral", .03f},
        {"coral_reef", "horn_coral", .03f},
        {"archipelago", "short_grass", .2f},
        {"archipelago", "lily_of_the_valley", .025f},
        {"tropical_beach", "vitrail:jungle_grass", .1f},
        {"savanna", "vitrail:savanna_grass", .1f},
        {"redwood_forest", "short_grass", .2f},
        {"redwood_forest", "tall_grass", .08f},
        {"redwood_forest", "oxeye_daisy", .04f},
        {"redwood_forest", "lily_of_the_valley", .04f},
        {"redwood_forest", "peony", .02f},
        {"swamp", "vitrail:jungle_grass", .3f},
        {"swamp", "fern", .05f},
        {"swamp", "cornflower", .03f},
        {"swamp", "blue_orchid", .03f},
        {"swamp", "allium", .03f},
        {"lush_birch_forest", "short_grass", .3f},
        {"lush_birch_forest", "peony", .02f},
        {"lush_birch_forest", "lilac", .02f},
        {"lush_birch_forest", "dandelion", .04f},
        {"jungle", "vitrail:jungle_grass", .4f},
        {"jungle", "vitrail:tall_jungle_grass", .2f},
        {"jungle", "pitcher_plant", .03f},
        {"jungle", "fern", .12f},
        {"jungle", "blue_orchid", .04f},
        {"sparse_desert", "dead_bush", .02f},
        {"red_desert", "dead_bush", .03f},
        {"desert", "dead_bush", .02f},
        {"purple_mushrooms", "vitrail:purple_mushroom", .1f},
        {"purple_mushrooms", "vitrail:magenta_crystal_shard", .005f},
        {"purple_mushrooms", "vitrail:cyan_crystal_shard", .005f},
        {"purple_mushrooms", "vitrail:green_crystal_shard", .005f},
        {"crystals", "vitrail:blue_mushroom", .02f},
        {"crystals", "vitrail:magenta_crystal_shard", .025f},
        {"crystals", "vitrail:cyan_crystal_shard", .025f},
        {"crystals", "vitrail:green_crystal_shard", .025f},
        {"oasis", "vitrail:jungle_grass", .2f},
        {"oasis", "cornflower", .02f},
        {"plains", "short_grass", .2f},
        {"plains", "red_tulip", .01f},
        {"plains", "orange_tulip", .01f},
        {"plains", "white_tulip", .01f},
        {"plains", "pink_tulip", .01f},
        {"plains", "dandelion", .03f},
        {"plains", "poppy", .03f},
        {"mountains", "short_grass", .05f},
        {"mountains", "lily_of_the_valley", .015f},
        {"crystal_caves", "vitrail:magenta_crystal_shard", .015f},
        {"crystal_caves", "vitrail:cyan_crystal_shard", .015f},
        {"crystal_caves", "vitrail:green_crystal_shard", .015f},
        {"crystal_caves", "vitrail:hanging_magenta_crystal_shard", .015f},
        {"crystal_caves", "vitrail:hanging_cyan_crystal_shard", .015f},
        {"crystal_caves", "vitrail:hanging_green_crystal_shard", .015f},
        {"lush_caves", "short_grass", .1f},
        {"lush_caves", "tall_grass", .03f},
        {"lush_caves", "torchflower", .02f},
        {"warped_forest", "warped_fungus", .02f},
        {"warped_forest", "warped_roots", .06f},
        {"warped_forest", "nether_sprouts", .04f},
        {"amber_forest", "vitrail:amber_fungus", .02f},
        {"amber_forest", "vitrail:amber_roots", .06f}};
    std::map<std::pair<std::string, std::string>, const TerrainDescription::Decorator*> there;
    for (const auto& decorator : d().decorators) {
        std::string block = decorator.block.substr(0, decorator.block.find('['));
        if (block.starts_with("minecraft:")) block = block.substr(10);
        there[{decorator.biome, block}] = &decorator;
        // What is two high has both halves, and only that.
        EXPECT_EQ(decorator.block.find("half=lower") != std::string::npos, !decorator.upper.empty()) << decorator.block;
        if (block.ends_with("_coral")) {
            EXPECT_NE(decorator.block.find("waterlogged=true"), std::string::npos);
        }
    }
    for (const auto& [biome, block, chance] : rows) {
        const auto found = there.find({"vitrail:" + biome, block});
        ASSERT_NE(found, there.end()) << biome << " " << block;
        EXPECT_FLOAT_EQ(found->second->chance, chance) << biome << " " << block;
    }
}

std::string text_of(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

// The example of docs/terrain.md, as a content folder after the base game's: a field, an attribute, a biome, colors and
// a feature of somebody's own.
TEST_F(BaseTerrain, ASecondFolderAddsABiome) {
    const std::string doc = text_of(std::filesystem::path(VITRAIL_SOURCE_DIR) / "docs" / "terrain.md");
    const std::size_t part = doc.find("## Adding a biome");
    ASSERT_NE(part, std::string::npos);
    const std::size_t first = doc.find("```lua\n", part) + 7, last = doc.find("```", first);
    ASSERT_LT(first, last);
    const auto root = std::filesystem::temp_directory_path() / ("vitrail_terrain_" + std::to_string(getpid()));
    std::filesystem::create_directories(root);
    std::ofstream(root / "lagoon.lua") << doc.substr(first, last - first);
    const std::filesystem::path roots[] = {std::filesystem::path(VITRAIL_SOURCE_DIR) / "content" / "base", root};
    const auto both = load_content(roots);
    std::filesystem::remove_all(root);
    ASSERT_TRUE(both) << both.error().message;
    const TerrainDescription& more = *both->terrain;
    EXPECT_EQ(more.biomes.size(), d().biomes.size() + 1);
    EXPECT_EQ(more.features.size(), d().features.size() + 1);
    EXPECT_EQ(more.biomes.back().name, "my:lagoon");
    EXPECT_EQ(more.biomes[8].wants, "-.++++.") << "the others do not mind the new attribute";
    expect_partition(more.biomes, 7);
    const auto compiled = compile_terrain(more, 1);
    ASSERT_TRUE(compiled) << compiled.error().message;
    EXPECT_EQ(compiled->tables->biomes, 25u);
}

TEST_F(BaseTerrain, EveryShapeIsDescribedAndUsed) {
    const std::string doc = text_of(std::filesystem::path(VITRAIL_SOURCE_DIR) / "docs" / "terrain.md");
    for (const ShapeInfo& shape : shape_infos()) {
        const std::size_t at = doc.find(std::string("\n| `") + shape.name + "` |");
        ASSERT_NE(at, std::string::npos) << shape.name;
        const std::string row = doc.substr(at, doc.find('\n', at + 1) - at);
        for (const ShapeNumber& number : shape.numbers)
            if (number.name) {
                EXPECT_THAT(row, HasSubstr(std::string("`") + number.name + "`")) << shape.name;
            }
        for (const char* block : shape.blocks)
            if (block) {
                EXPECT_THAT(row, HasSubstr(block)) << shape.name;
            }
        EXPECT_TRUE(std::any_of(d().features.begin(), d().features.end(), [&](const auto& f) {
            return f.shape == shape.name;
        })) << shape.name;
    }
}

} // namespace
} // namespace vitrail
