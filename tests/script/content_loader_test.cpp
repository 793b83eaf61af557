#include "script/content_loader.h"

#include "world/state_table.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <set>

namespace vitrail {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Result<std::shared_ptr<BlockRegistry>> load(const std::string& text) {
    const ContentFile file{"test.lua", text};
    VX_TRY_ASSIGN(Content content, load_content_texts({&file, 1}));
    return content.registry;
}

std::string error_of(const std::string& text) {
    const auto loaded = load(text);
    return loaded ? "no error" : loaded.error().message;
}

const BlockDef& block_in(const std::shared_ptr<BlockRegistry>& registry, const char* name) {
    const BlockId id = registry->find_block(name);
    EXPECT_NE(id, BlockId::unknown) << name;
    return registry->blocks()[std::size_t(id)];
}

// The look the table picks for a state.
BlockLook look_of(const std::shared_ptr<BlockRegistry>& registry, const char* state) {
    StateTable table(registry);
    return *table.info(*table.intern_with_defaults(*parse_block_state(state))).look;
}

TEST(Content, ReadsEveryKey) {
    const auto registry = load(R"(
        define_block("lamp", { properties = { lit = { true, false }, power = { 0, 1, 2 } }, default = { lit = false, power = 2 },
            texture = { "lamp_side", "lamp_top" }, shape = "slab", layer = "cutout_mipped", transparency = 0.25, opacity = 3, light = { 1, 2, 3 },
            hardness = -1, viscosity = 0.5, collision = false, tint = { 10, 20, 30 }, tint_faces = "top", material = "metal", replaceable = true,
            climbable = true, sway = true, optics = "dielectric", ior = 1.31, absorption = { 0.5, 0.25, 0 }, hidden_from_hotbar = true, boxes = { { 0, 0, 0, 16, 0.25, 16, "wire" } } })
        define_block("vitrail:plain", { texture = "plain", light = 7, tint = "grass" })
        define_texture("fire", { frame_time = 2 })
        define_biome("plains", { temperature = 0.5, downfall = 0.25, grass = { 1, 2, 3 }, water = { 4, 5, 6 } })
        define_hotbar { "vitrail:plain", "lamp" })");
    ASSERT_TRUE(registry) << registry.error().message;
    const BlockDef& lamp = block_in(*registry, "minecraft:lamp");
    ASSERT_EQ(lamp.properties.size(), 2u);
    EXPECT_EQ(lamp.properties[0].name, "lit");
    EXPECT_THAT(lamp.properties[0].values, ElementsAre("true", "false"));
    EXPECT_EQ(lamp.properties[0].default_value, "false");
    EXPECT_THAT(lamp.properties[1].values, ElementsAre("0", "1", "2"));
    EXPECT_EQ(lamp.properties[1].default_value, "2");
    const BlockLook& look = lamp.look;
    EXPECT_THAT(look.textures, ElementsAre("lamp_side", "lamp_top"));
    EXPECT_EQ(look.shape, ShapeKind::slab);
    EXPECT_EQ(look.layer, RenderLayer::cutout_mipped);
    EXPECT_EQ(look.transparency, 0.25f);
    EXPECT_EQ(look.opacity, 3);
    EXPECT_THAT(look.light, ElementsAre(1, 2, 3));
    EXPECT_EQ(look.hardness, -1);
    EXPECT_EQ(look.viscosity, 0.5f);
    EXPECT_FALSE(look.collision);
    EXPECT_EQ(look.tint, TintKind::fixed);
    EXPECT_THAT(look.tint_color, ElementsAre(10, 20, 30));
    EXPECT_EQ(look.tint_faces, TintFaces::top);
    EXPECT_EQ(look.material, "metal");
    EXPECT_TRUE(look.replaceable && look.climbable && look.sway);
    EXPECT_EQ(look.optics, OpticsKind::dielectric);
    EXPECT_EQ(look.ior, 1.31f);
    EXPECT_THAT(look.absorption, ElementsAre(0.5f, 0.25f, 0.0f));
    EXPECT_FALSE(lamp.in_hotbar_list);
    ASSERT_EQ(look.boxes.size(), 1u);
    EXPECT_EQ(look.boxes[0].y1, 0.25f);
    EXPECT_EQ(look.boxes[0].texture, "wire");
    const BlockDef& plain = block_in(*registry, "vitrail:plain");
    EXPECT_THAT(plain.look.light, ElementsAre(7, 7, 7));
    EXPECT_EQ(plain.look.opacity, 15);
    EXPECT_EQ(plain.look.tint, TintKind::grass);
    EXPECT_TRUE((*registry)->find_texture("wire"));
    EXPECT_EQ((*registry)->textures()[std::size_t(*(*registry)->find_texture("fire"))].frame_time, 2u);
    EXPECT_EQ((*registry)->biome_named("minecraft:plains").temperature, 0.5f);
    EXPECT_THAT((*registry)->biome_named("minecraft:plains").water, ElementsAre(4, 5, 6));
    EXPECT_THAT((*registry)->hotbar, ElementsAre("vitrail:plain", "minecraft:lamp"));
}

TEST(Content, OpacityFollowsFromShapeAndLayer) {
    const auto registry = load(R"(
        define_block("a", {}) define_block("b", { layer = "cutout" }) define_block("c", { shape = "slab" })
        define_block("d", { shape = "pillar" }) define_block("e", { shape = "cross", opacity = 4 })
        define_block("f", { properties = { type = { "bottom", "double" } }, shape = "slab", variants = { ["type=double"] = { shape = "cube" } } }))");
    ASSERT_TRUE(registry);
    EXPECT_EQ(block_in(*registry, "minecraft:a").look.opacity, 15);
    EXPECT_EQ(block_in(*registry, "minecraft:b").look.opacity, 0);
    EXPECT_EQ(block_in(*registry, "minecraft:c").look.opacity, 0);
    EXPECT_EQ(block_in(*registry, "minecraft:d").look.opacity, 15);
    EXPECT_EQ(block_in(*registry, "minecraft:e").look.opacity, 4);
    EXPECT_EQ(look_of(*registry, "f[type=double]").opacity, 15);
    EXPECT_EQ(look_of(*registry, "f[type=bottom]").opacity, 0);
}

TEST(Content, AllMatchingVariantsApplyFewestConditionsFirst) {
    const auto registry = load(R"(
        define_block("b", { properties = { a = { 1, 2 }, b = { 1, 2 }, c = { 1, 2 } }, texture = "base", hardness = 1, variants = {
            ["a=2"] = { texture = "a", hardness = 2 }, ["b=2"] = { light = 5 }, ["a=2,b=2"] = { texture = "ab" }, ["c=2"] = { opacity = 3 } } }))");
    ASSERT_TRUE(registry);
    for (const char a : {'1', '2'})
        for (const char b : {'1', '2'})
            for (const char c : {'1', '2'}) {
                const std::string state = std::string("b[a=") + a + ",b=" + b + ",c=" + c + "]";
                const BlockLook look = look_of(*registry, state.c_str());
                EXPECT_EQ(look.textures.at(0), a == '1' ? "base" : b == '2' ? "ab" : "a") << state;
                EXPECT_EQ(look.hardness, a == '2' ? 2 : 1) << state;
                EXPECT_EQ(look.light[0], b == '2' ? 5 : 0) << state;
                EXPECT_EQ(look.opacity, c == '2' ? 3 : 15) << state;
            }
}

// Random variants, resolved by the loader, against laying them over one by one.
TEST(Content, VariantsAgainstBruteForce) {
    std::srand(5);
    for (int round = 0; round < 60; ++round) {
        struct Written {
            std::vector<std::pair<std::string, std::string>> when;
            int field, value;
        };
        std::vector<Written> written;
        std::set<std::string> keys;
        std::string lua;
        for (int v = std::rand() % 9; v > 0; --v) {
            Written w;
            std::string key;
            for (const char* property : {"p", "q", "r"})
                if (std::rand() % 2) {
                    const std::string value = std::to_string(std::rand() % 3);
                    w.when.emplace_back(property, value);
                    key += (key.empty() ? "" : ",") + std::string(property) + "=" + value;
                }
            if (key.empty() || !keys.insert(key).second) continue;
            w.field = std::rand() % 3;
            w.value = std::rand() % 16;
            lua += "[\"" + key + "\"] = { " +
                   (w.field == 0   ? "opacity"
                    : w.field == 1 ? "light"
                                   : "hardness") +
                   " = " + std::to_string(w.value) + " }, ";
            written.push_back(w);
        }
        std::sort(written.begin(), written.end(), [](const Written& a, const Written& b) {
            return std::pair(a.when.size(), a.when) < std::pair(b.when.size(), b.when);
        });
        const auto registry =
            load("define_block('b', { properties = { p = {0, 1, 2}, q = {0, 1, 2}, r = {0, 1, 2} }, variants = { " +
                 lua + "} })");
        ASSERT_TRUE(registry) << registry.error().message;
        StateTable table(*registry);
        for (int i = 0; i < 27; ++i) {
            BlockState state{"minecraft:b", {}};
            state.set("p", std::to_string(i % 3));
            state.set("q", std::to_string(i / 3 % 3));
            state.set("r", std::to_string(i / 9));
            int want[3] = {15, 0, 1};
            for (const Written& w : written)
                if (std::all_of(w.when.begin(), w.when.end(),
                                [&](const auto& c) { return state.get(c.first) == c.second; }))
                    want[w.field] = w.value;
            const BlockLook& look = *table.info(*table.intern(state)).look;
            EXPECT_EQ(look.opacity, want[0]) << lua << state.to_string();
            EXPECT_EQ(look.light[1], want[1]) << lua << state.to_string();
            EXPECT_EQ(look.hardness, float(want[2])) << lua << state.to_string();
        }
    }
}

TEST(Content, ErrorsNameFileBlockAndWhatWasExpected) {
    EXPECT_EQ(error_of("\ndefine_block('stone', { colour = 1 })"), "test.lua:2: minecraft:stone: unknown key colour");
    EXPECT_EQ(error_of("define_block('stone', { light = 16 })"),
              "test.lua:1: minecraft:stone: light: expected a whole number from 0 to 15, got 16");
    EXPECT_THAT(error_of("define_block('stone', { light = 'x' })"),
                HasSubstr("light: expected a number or {red, green, blue} of 0 to 15, got \"x\""));
    EXPECT_THAT(error_of("define_block('stone', { optics = 'foggy' })"), HasSubstr("optics: expected one of automatic"));
    EXPECT_THAT(error_of("define_block('stone', { ior = 0.5 })"), HasSubstr("ior: expected a number from 1 to 4"));
    EXPECT_THAT(error_of("define_block('stone', { absorption = { 1, 2 } })"), HasSubstr("absorption: expected {red"));
    EXPECT_THAT(error_of("define_block('stone', { shape = 'ball' })"),
                HasSubstr("shape: expected one of none, cube, pillar"));
    EXPECT_THAT(error_of("define_block('stone', { texture = {} })"),
                HasSubstr("texture: expected a texture's name or a list of 1 to 6"));
    EXPECT_THAT(error_of("define_block('stone', { texture = '../../etc/passwd' })"),
                HasSubstr("expected a texture's name"));
    EXPECT_THAT(error_of("define_block('stone', { texture = '/etc/passwd' })"), HasSubstr("expected a texture's name"));
    EXPECT_THAT(error_of("define_block('Stone!', {})"), HasSubstr("expected a block's name such as"));
    EXPECT_THAT(error_of("define_block(nil, {})"), HasSubstr("got nothing"));
    EXPECT_THAT(error_of("define_block('stone')"), HasSubstr("minecraft:stone: expected a table, got nothing"));
    EXPECT_THAT(error_of("define_block('stone', { boxes = { { 1, 2, 3 } } })"),
                HasSubstr("expected a box {x0, y0, z0, x1, y1, z1[, texture]}"));
    EXPECT_THAT(error_of("define_block('stone', { boxes = { { 9, 0, 0, 1, 1, 1 } } })"),
                HasSubstr("box 1: its first corner"));
    EXPECT_THAT(error_of("define_block('stone', { hardness = 0/0 })"), HasSubstr("hardness: expected a number"));
    EXPECT_THAT(error_of("define_block('stone', { collision = 1 })"),
                HasSubstr("collision: expected true or false, got 1"));
    EXPECT_THAT(error_of("define_block('stone', { properties = { a = {} } })"),
                HasSubstr("a: expected a list of 1 to 64 values"));
    EXPECT_THAT(error_of("define_block('stone', { properties = { a = {'x', 'x'} } })"),
                HasSubstr("the value x is there twice"));
    EXPECT_THAT(error_of("define_block('stone', { properties = { a = {'x'} }, default = { a = 'y' } })"),
                HasSubstr("default: expected one of x for a"));
    EXPECT_THAT(error_of("define_block('stone', { default = { a = 'y' } })"),
                HasSubstr("default: there is no property a"));
    EXPECT_THAT(error_of("define_block('stone', { properties = { a = {1, 2} }, variants = { ['a=3'] = {} } })"),
                HasSubstr("variant \"a=3\": a is one of 1, 2, not \"3\""));
    EXPECT_THAT(error_of("define_block('stone', { properties = { a = {1, 2} }, variants = { ['b=3'] = {} } })"),
                HasSubstr("there is no property b"));
    EXPECT_THAT(error_of("define_block('stone', { properties = { a = {1, 2} }, variants = { ['a'] = {} } })"),
                HasSubstr("expected property=value"));
    EXPECT_THAT(error_of("define_block('stone', { properties = { a = {1, 2} }, variants = { ['a=1,a=2'] = {} } })"),
                HasSubstr("there twice"));
    EXPECT_THAT(
        error_of("define_block('stone', { properties = { a = {1, 2} }, variants = { ['a=1'] = { glow = 1 } } })"),
        HasSubstr("variants: \"a=1\": unknown key glow"));
    EXPECT_THAT(error_of("define_block('s', { properties = (function() local p, v = {}, {} for i = 1, 20 do v[i] = i "
                         "end for i = 1, 3 do p['a' .. i] = v "
                         "end return p end)() })"),
                HasSubstr("more than 4096 states"));
    EXPECT_THAT(error_of("define_texture('x', { speed = 1 })"), HasSubstr("texture x: unknown key speed"));
    EXPECT_THAT(error_of("define_biome('x', { grass = 'green' })"),
                HasSubstr("biome minecraft:x: grass: expected {red, green, blue} of 0 to 255"));
    EXPECT_THAT(error_of("define_hotbar { 'nothing' }"), HasSubstr("hotbar: there is no block minecraft:nothing"));
    EXPECT_THAT(error_of("local function helper() define_block('x', { a = 1 }) end\n\nhelper()"),
                HasSubstr("(from test.lua:3)"));
    EXPECT_THAT(error_of("while true do end"), HasSubstr("test.lua: the instruction limit of scripts is passed"));
    EXPECT_THAT(error_of("for i = 1, 1e9 do define_block('b' .. i, {}) end"), HasSubstr("more than 32768 blocks"));
    EXPECT_THAT(error_of("for i = 1, 1e9 do define_block('b', { texture = 't' .. i }) end"),
                HasSubstr("more than 16384 textures"));
}

TEST(Content, LaterDefinitionsWinAndTheHashFollowsTheText) {
    const ContentFile files[] = {{"a.lua", "define_block('x', { hardness = 1 }) shared = 5"},
                                 {"b.lua", "define_block('x', { hardness = shared })"}};
    const auto both = load_content_texts(files), first = load_content_texts({files, 1});
    ASSERT_TRUE(both && first);
    EXPECT_EQ(block_in(both->registry, "minecraft:x").look.hardness, 5);
    EXPECT_NE(both->registry->content_hash, first->registry->content_hash);
    EXPECT_EQ(both->registry->content_hash, load_content_texts(files)->registry->content_hash);
}

TEST(Content, OlderMaterialForm) {
    const auto registry = load("define_material(7, { name = 'Red Clay', texture = 'clay', hardness = 2, light = 3 })");
    ASSERT_TRUE(registry) << registry.error().message;
    EXPECT_EQ(block_in(*registry, "vitrail:red_clay").look.hardness, 2);
    EXPECT_THAT(error_of("define_material('x', {})"), HasSubstr("expected define_material"));
}

TEST(Content, FoldersAreReadInOrder) {
    const auto root = std::filesystem::temp_directory_path() / ("vitrail_content_" + std::to_string(getpid()));
    std::filesystem::create_directories(root / "one");
    std::filesystem::create_directories(root / "two");
    std::ofstream(root / "one" / "b.lua") << "define_block('x', { hardness = n })";
    std::ofstream(root / "one" / "a.lua") << "n = 2";
    std::ofstream(root / "one" / "notes.txt") << "not Lua";
    std::ofstream(root / "two" / "c.lua") << "define_block('y', { texture = 5 })";
    const std::filesystem::path roots[] = {root / "one", root / "two"};
    const auto one = load_content({roots, 1});
    ASSERT_TRUE(one) << one.error().message;
    EXPECT_EQ(block_in(one->registry, "minecraft:x").look.hardness, 2);
    EXPECT_THAT(one->registry->content_roots, ElementsAre((root / "one").string()));
    const auto two = load_content(roots);
    ASSERT_FALSE(two);
    EXPECT_THAT(two.error().message, testing::StartsWith("two/c.lua:1: minecraft:y: texture: expected"));
    const std::filesystem::path missing[] = {root / "none"};
    EXPECT_EQ(load_content(missing).error().code, ErrorCode::not_found);
    std::filesystem::remove_all(root);
}

// The base game: it loads, its pictures are there, and every state of every block has a proper shape.
class BaseContent : public testing::Test {
protected:
    void SetUp() override {
        if (!std::filesystem::exists(folder_ / "00_families.lua")) GTEST_SKIP() << "no base content";
        const std::filesystem::path roots[] = {folder_};
        auto loaded = load_content(roots);
        ASSERT_TRUE(loaded) << loaded.error().message;
        registry_ = loaded->registry;
    }
    std::filesystem::path folder_ = std::filesystem::path(VITRAIL_SOURCE_DIR) / "content" / "base";
    std::shared_ptr<BlockRegistry> registry_;
};

TEST_F(BaseContent, EveryStateHasAShape) {
    EXPECT_GT(registry_->blocks().size(), 500u);
    StateTable table(registry_);
    std::size_t states = 0;
    for (const BlockDef& def : registry_->blocks()) {
        std::vector<std::size_t> place(def.properties.size(), 0);
        for (bool more = true; more;) {
            BlockState state{def.name, {}};
            for (std::size_t p = 0; p < place.size(); ++p)
                state.set(def.properties[p].name, def.properties[p].values[place[p]]);
            const auto id = table.intern(state);
            ASSERT_TRUE(id) << id.error().message;
            const StateInfo& info = table.info(*id);
            ASSERT_NE(info.look, nullptr);
            EXPECT_EQ(info.look->textures.empty(), def.name == "vitrail:unknown") << state.to_string();
            for (const auto* boxes : {&info.shape.collision, &info.shape.pick})
                for (const ShapeBox& b : *boxes)
                    for (int a = 0; a < 3; ++a)
                        ASSERT_LT(b.min[a], b.max[a]) << state.to_string();
            // What is drawn can be picked, or it could never be taken away.
            if (info.look->shape != ShapeKind::none && info.look->shape != ShapeKind::liquid) {
                EXPECT_FALSE(info.shape.pick.empty()) << state.to_string();
            }
            ++states;
            std::size_t p = 0;
            while (p < place.size() && ++place[p] == def.properties[p].values.size())
                place[p++] = 0;
            more = p < place.size();
        }
    }
    RecordProperty("states", std::to_string(states));
}

TEST_F(BaseContent, TexturesAreThere) {
    if (!std::filesystem::exists(folder_ / "textures" / "stone.png")) GTEST_SKIP() << "no textures yet";
    std::string missing;
    int count = 0;
    for (const TextureDef& texture : registry_->textures())
        if (texture.name != "unknown" && !std::filesystem::exists(folder_ / "textures" / (texture.name + ".png")) &&
            ++count <= 50)
            missing += " " + texture.name;
    EXPECT_EQ(count, 0) << "missing:" << missing;
}

} // namespace
} // namespace vitrail
