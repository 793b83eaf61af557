// Worlds made by scripts: every brush against a brute-force picture of it, errors with their line, and limits that
// hold.
#include "script/world_script.h"

#include "script/content_loader.h"

#include <cmath>
#include <filesystem>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace vitrail {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::shared_ptr<const BlockRegistry> registry() {
    static const auto loaded = [] {
        const std::vector<std::filesystem::path> roots{std::filesystem::path(VITRAIL_SOURCE_DIR) / "content/base"};
        return load_content(roots)->registry;
    }();
    return loaded;
}

struct Made {
    BiomeTable biomes;
    Result<ScriptedWorld> world;
    explicit Made(const std::string& text, const WorldScriptLimits& limits = {})
        : world(run_world_script(text, "w.lua", std::make_shared<StateTable>(registry()), biomes, limits)) {}
    std::string at(i32 x, i32 y, i32 z) const {
        return world->dimension.states().info(world->dimension.state_at({x, y, z})).state.to_string();
    }
    bool is(i32 x, i32 y, i32 z, const char* block) const {
        return world->dimension.states().info(world->dimension.state_at({x, y, z})).state.name ==
               std::string("minecraft:") + block;
    }
};

std::string error_of(const std::string& text, const WorldScriptLimits& limits = {}) {
    const Made made(text, limits);
    return made.world ? "no error" : made.world.error().message;
}

// Compares a box of blocks with what a function says.
template <class F>
void expect_stone_where(const Made& made, i32 reach, F is_stone) {
    ASSERT_TRUE(made.world) << made.world.error().message;
    u32 wrong = 0, stone = 0;
    for (i32 y = 64 - reach; y <= 64 + reach; ++y)
        for (i32 z = -reach; z <= reach; ++z)
            for (i32 x = -reach; x <= reach; ++x) {
                wrong += made.is(x, y, z, "stone") != is_stone(x, y, z);
                stone += is_stone(x, y, z);
            }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(stone, 0u);
}

TEST(WorldScript, FillTakesCornersInAnyOrder) {
    expect_stone_where(Made("fill(5, 70, -9, -17, 60, 3, 'stone')"), 20, [](i32 x, i32 y, i32 z) {
        return x >= -17 && x <= 5 && y >= 60 && y <= 70 && z >= -9 && z <= 3;
    });
}

TEST(WorldScript, ShellIsHollow) {
    expect_stone_where(Made("shell(-7, 60, -3, 9, 68, 8, 'stone')"), 12, [](i32 x, i32 y, i32 z) {
        const bool in = x >= -7 && x <= 9 && y >= 60 && y <= 68 && z >= -3 && z <= 8;
        return in && (x == -7 || x == 9 || y == 60 || y == 68 || z == -3 || z == 8);
    });
}

TEST(WorldScript, SpheresAreWhereTheirBlocksMiddlesAre) {
    expect_stone_where(Made("sphere(1.5, 64.25, -2, 6.3, 'stone')"), 12, [](i32 x, i32 y, i32 z) {
        const double dx = x - 1.5, dy = y - 64.25, dz = z + 2;
        return dx * dx + dy * dy + dz * dz <= 6.3 * 6.3;
    });
    expect_stone_where(Made("sphere(0, 64, 0, {9.5, 3.5, 5.5}, 'stone')"), 12, [](i32 x, i32 y, i32 z) {
        const double dx = x / 9.5, dy = (y - 64) / 3.5, dz = z / 5.5;
        return dx * dx + dy * dy + dz * dz <= 1;
    });
    expect_stone_where(Made("sphere(3, 64, 3, 0, 'stone')"), 8,
                       [](i32 x, i32 y, i32 z) { return x == 3 && y == 64 && z == 3; });
}

TEST(WorldScript, CylindersAndCones) {
    expect_stone_where(Made("cylinder(.5, 60, .5, 4.6, 7, 'stone')"), 12, [](i32 x, i32 y, i32 z) {
        return y >= 60 && y < 67 && (x - .5) * (x - .5) + (z - .5) * (z - .5) <= 4.6 * 4.6;
    });
    expect_stone_where(Made("cone(0, 60, 0, {8.5, 5.5}, 9, 'stone')"), 12, [](i32 x, i32 y, i32 z) {
        const double size = 1 - (y - 60) / 9.0;
        return y >= 60 && y < 69 && x * x / (8.5 * 8.5) + z * z / (5.5 * 5.5) <= size * size;
    });
}

TEST(WorldScript, LinesHaveNoGaps) {
    const Made made("line(-8, 60, 3, 9, 66, -4, 'stone')");
    ASSERT_TRUE(made.world);
    for (i32 x = -8; x <= 9; ++x) {
        const double t = (x + 8) / 17.0;
        EXPECT_TRUE(made.is(x, i32(std::floor(60 + 6 * t + .5)), i32(std::floor(3 - 7 * t + .5)), "stone")) << x;
    }
}

TEST(WorldScript, OverReplacesOnlyWhatItNames) {
    const Made made(
        "fill(0, 60, 0, 40, 60, 0, 'oak_log[axis=x]') fill(0, 60, 0, 4, 60, 0, 'oak_log[axis=z]')\n"
        "fill(8, 60, 0, 9, 60, 0, 'dirt')\n"
        "fill(0, 60, 0, 40, 60, 0, 'glass', 'oak_log[axis=x]') fill(-3, 60, 0, 40, 60, 0, 'sand', 'oak_log')\n"
        "fill(0, 60, 0, 40, 61, 0, 'stone', 'air')");
    ASSERT_TRUE(made.world) << made.world.error().message;
    EXPECT_TRUE(made.is(4, 60, 0, "sand"));
    EXPECT_TRUE(made.is(5, 60, 0, "glass"));
    EXPECT_TRUE(made.is(8, 60, 0, "dirt"));
    EXPECT_TRUE(made.is(40, 61, 0, "stone"));
    EXPECT_TRUE(made.is(-3, 60, 0, "air"));
}

TEST(WorldScript, StairsClimbAndShapesJoin) {
    const Made made("stairs(0, 60, 0, 'east', 2, 3, 'stone_brick_stairs', 'stone_bricks')\n"
                    "fill(0, 60, 10, 2, 60, 10, 'oak_fence') set(1, 60, 11, 'oak_fence') fill(20, 60, 0, 22, 60, 0, "
                    "'grass_block')\n"
                    "set(21, 61, 0, 'snow[layers=3]') set(22, 61, 0, 'poppy')");
    ASSERT_TRUE(made.world) << made.world.error().message;
    EXPECT_THAT(made.at(2, 62, 0), HasSubstr("facing=east"));
    EXPECT_TRUE(made.is(2, 62, 1, "stone_brick_stairs")); // clockwise of east is south
    EXPECT_TRUE(made.is(2, 61, 0, "stone_bricks"));
    EXPECT_TRUE(made.is(3, 62, 0, "air"));
    EXPECT_THAT(made.at(1, 60, 10), testing::AllOf(HasSubstr("west=true"), HasSubstr("east=true"),
                                                   HasSubstr("south=true"), HasSubstr("north=false")));
    EXPECT_THAT(made.at(21, 60, 0), HasSubstr("snowy=true"));
    EXPECT_THAT(made.at(22, 60, 0), HasSubstr("snowy=false"));
}

TEST(WorldScript, LandFollowsItsHeightsAndCovers) {
    const Made made(
        "local h = {} for z = 0, 4 do for x = 0, 4 do h[#h + 1] = 60 + 8 * x end end\n"
        "land { x = -16, z = -16, step = 8, width = 5, heights = h, bottom = 40, water = 70,\n"
        "  cover = { { top = 'sand', below = 70, depth = 2 }, { top = 'grass_block', under = 'dirt', depth = 4 } } }");
    ASSERT_TRUE(made.world) << made.world.error().message;
    for (i32 x = -8; x < 8; ++x) { // a plane of slope 1 between the outermost cells
        const i32 top = 59 + (x + 16);
        EXPECT_TRUE(made.is(x, top, 3, top < 70 ? "sand" : "grass_block")) << x;
        EXPECT_TRUE(made.is(x, top - 1, 3, top < 70 ? "sand" : "dirt")) << x;
        EXPECT_TRUE(made.is(x, top - 4, 3, "stone")) << x;
        EXPECT_TRUE(made.is(x, top + 1, 3, top + 1 <= 70 ? "water" : "air")) << x;
    }
    EXPECT_TRUE(made.is(0, 40, 0, "stone"));
    EXPECT_TRUE(made.is(0, 39, 0, "air"));
    EXPECT_TRUE(made.is(16, 60, 0, "air"));
    EXPECT_TRUE(made.is(-17, 41, 0, "air"));
}

TEST(WorldScript, AsksWhatIsThere) {
    const Made made(
        "assert(top(3, 3) == -64) fill(0, 10, 0, 9, 30, 9, 'oak_log[axis=z]') assert(top(3, 3) == 31)\n"
        "assert(get(3, 30, 3) == 'minecraft:oak_log[axis=z]', get(3, 30, 3)) assert(get(3, 31, 3) == 'minecraft:air')\n"
        "local least, most, last = 0, 0, noise(0, 0, 20, 5, 3)\n"
        "for x = 1, 4000 do local n = noise(x, 7.5, 20, 5, 3) least, most = math.min(least, n), math.max(most, n) end\n"
        "assert(least < -.3 and least > -1.3 and most > .3 and most < 1.3, least .. ' ' .. most)\n"
        "assert(math.abs(noise(10, 7.5, 20) - noise(10.01, 7.5, 20)) < .01) print(noise(3.5, 4.5, 9) ~= noise(3.5, "
        "4.5, 9, 1))");
    ASSERT_TRUE(made.world) << made.world.error().message;
    EXPECT_EQ(made.world->output, "true\n");
}

TEST(WorldScript, BiomesByArea) {
    const Made made(
        "biome('plains') biome('minecraft:cherry_grove', 0, 0, 15, 15) fill(-16, 60, 0, 31, 60, 0, 'stone')");
    ASSERT_TRUE(made.world) << made.world.error().message;
    const auto biome_at = [&](i32 x) {
        return made.biomes.name(made.world->dimension.find({x >> 4, 3, 0})->biomes.at(LocalPos(x & 15, 12, 0)));
    };
    EXPECT_EQ(biome_at(-1), "minecraft:plains");
    EXPECT_EQ(biome_at(0), "minecraft:cherry_grove");
    EXPECT_EQ(biome_at(15), "minecraft:cherry_grove");
    EXPECT_EQ(biome_at(16), "minecraft:plains");
}

TEST(WorldScript, StationsAndTheWorldItself) {
    const Made made("world { name = 'Garden', spawn = {3, 70, -4.5}, yaw = 90, time = 6000 }\n"
                    "station { name = 'pond', effect = 'water', at = {1.5, 70, 2}, look = {-45, 10}, fov = 60, time = "
                    "7000, text = 'Waves.',\n"
                    "  without = 'water.waves=false' }\n"
                    "station { name = 'hall', effect = 'reflections', at = {0, 0, 0}, look = {0, 0}, without = { "
                    "'ssr.enabled=false', 'a.b=0.5' } }");
    ASSERT_TRUE(made.world) << made.world.error().message;
    EXPECT_EQ(made.world->name, "Garden");
    EXPECT_EQ(made.world->spawn, (BlockPos{3, 70, -5}));
    ASSERT_EQ(made.world->stations.size(), 2u);
    const Station& pond = made.world->stations[0];
    EXPECT_EQ(pond.at[0], 1.5);
    EXPECT_EQ(pond.yaw, -45);
    EXPECT_EQ(pond.fov, 60);
    EXPECT_EQ(pond.time, 7000);
    EXPECT_THAT(pond.without, testing::ElementsAre("water.waves=false"));
    EXPECT_THAT(made.world->stations[1].without, testing::ElementsAre("ssr.enabled=false", "a.b=0.5"));
}

TEST(WorldScript, ErrorsNameTheLineAndWhatWasExpected) {
    EXPECT_EQ(error_of("\n\nset(1, 2, 3, 'no_such_block')"), "w.lua:3: there is no block minecraft:no_such_block");
    EXPECT_EQ(error_of("set(1, 2, 3, 'oak_log[axis=q]')"), "w.lua:1: minecraft:oak_log: axis is one of x y z, not q");
    EXPECT_EQ(error_of("set(1, 2, 3, 'oak_log[color=red]')"), "w.lua:1: minecraft:oak_log has no property color");
    EXPECT_EQ(error_of("fill(1, 2, 3, 4, 5, 'stone')"),
              "w.lua:1: z is a string: expected fill(x0, y0, z0, x1, y1, z1, block [, over])");
    EXPECT_EQ(error_of("set(1, 320, 3, 'stone')"), "w.lua:1: y is from -64 to 319, not 320");
    EXPECT_EQ(error_of("set(4096, 0, 3, 'stone')"), "w.lua:1: x and z are from -4096 to 4095, not 4096");
    EXPECT_EQ(error_of("set(0/0, 0, 3, 'stone')"), "w.lua:1: x is out of range: expected set(x, y, z, block [, over])");
    EXPECT_THAT(error_of("set(1, 2, 3, 'stone', nil, 7)"), HasSubstr("too much"));
    EXPECT_THAT(error_of("sphere(0, 64, 0, -1, 'stone')"), HasSubstr("radius"));
    EXPECT_THAT(error_of("stairs(0, 64, 0, 'up', 1, 1, 'oak_stairs')"), HasSubstr("facing"));
    EXPECT_THAT(error_of("stairs(0, 64, 0, 'east', 1, 1, 'stone')"), HasSubstr("no property facing"));
    EXPECT_THAT(error_of("land { x = 0, z = 0, width = 3, heights = { 1, 2, 3, 4 } }"), HasSubstr("rows of 3"));
    EXPECT_THAT(error_of("land { x = 0, z = 0, width = 2, heights = { 1, 2, 3, 'x' } }"),
                HasSubstr("land: heights: [4]:"));
    EXPECT_THAT(error_of("land { x = 0, z = 0, width = 2, heights = { 1, 2, 3, 4 }, cover = { { depth = 2 } } }"),
                HasSubstr("there is no top"));
    EXPECT_THAT(error_of("biome('nowhere')"), HasSubstr("there is no biome minecraft:nowhere"));
    EXPECT_THAT(error_of("station { name = 'a', effect = 'b', at = {1, 2}, look = {0, 0} }"),
                HasSubstr("at: expected {x, y, z}"));
    EXPECT_THAT(error_of("station { name = 'a', effect = 'b', at = {1, 2, 3}, look = {0, 91} }"), HasSubstr("pitch"));
    EXPECT_THAT(error_of("for i = 1, 2 do station { name = 'a', effect = 'b', at = {1, 2, 3}, look = {0, 0} } end"),
                HasSubstr("two named a"));
    EXPECT_THAT(error_of("station { name = 'a', effect = 'b', at = {1, 2, 3}, look = {0, 0}, without = 'shadows' }"),
                HasSubstr("without: expected a setting"));
    EXPECT_THAT(error_of("station { name = 'A B', effect = 'b', at = {1, 2, 3}, look = {0, 0} }"),
                HasSubstr("name: expected a word"));
    EXPECT_THAT(error_of("world { title = 'x' }"), HasSubstr("unknown key title"));
    EXPECT_THAT(error_of("define_block('a:b', {})"), HasSubstr("w.lua:1:")); // content is not defined here
    EXPECT_THAT(error_of("local function hut(x)\n set(x, 0, 0, 'bogus')\nend\nhut(3)"), HasSubstr("(from w.lua:4)"));
}

// Whatever a script asks for: one line, soon, and no more memory than the limits say.
TEST(WorldScript, HostileScriptsEndWithOneLine) {
    WorldScriptLimits limits;
    limits.instructions_most = 3'000'000;
    limits.memory_bytes_most = 8 << 20;
    limits.canvas.chunks_most = 2000;
    limits.canvas.mixed_chunks_most = 200;
    limits.canvas.cells_most = 20'000'000;
    for (const char* text : {
             "while true do set(0, 0, 0, 'stone') end",
             "while true do pcall(fill, -4096, -64, -4096, 4095, 319, 4095, 'stone') end",
             "fill(-4096, -64, -4096, 4095, 319, 4095, 'stone')",
             "for i = -4096, 4080, 16 do for k = -4096, 4080, 16 do pcall(set, i, 0, k, 'stone') end end",
             "for i = 0, 4000 do pcall(set, i * 2, i % 300, 0, i % 2 == 0 and 'stone' or 'dirt') end",
             "while true do pcall(sphere, 0, 64, 0, 200, 'stone') end",
             "while true do pcall(land, { x = -4000, z = -4000, step = 64, width = 100, heights = (function() local h "
             "= {} for i = 1, 1000 do h[i] = 80 end return h end)() }) end",
             "local h = {} for i = 1, 200000 do h[i] = 319 end land { x = -4096, z = -4096, step = 16, width = 400, "
             "heights = h }",
             "local c = {} for i = 1, 32 do c[i] = { top = 'stone', above = 300, wander = 64 } end\n"
             "land { x = -4096, z = -4096, step = 64, width = 129, heights = (function() local h = {} for i = 1, 129 * "
             "129 do h[i] = 64 end return h end)(), cover = c }",
             "for i = 1, 1000 do station { name = 's' .. i, effect = 'x', at = {0, 0, 0}, look = {0, 0} } end",
             "for i = 1, 1000 do biome('plains', i, i, i, i) end",
             "while true do pcall(line, -4096, 0, 0, 4095, 300, 4095, 'stone') end",
             "while true do noise(1e6, 1e6, .001, 1, 8) end",
             "while true do top(0, 0) end",
             "local s = 'x' while true do s = s .. s end",
             "set(0, 0, 0, ('x'):rep(100000))",
             "sphere(1e6, 64, 1e6, 1e6, 'stone')",
             "cylinder(0, 0, 0, 1e300, 1e300, 'stone')",
             "line(-1e6, 0, 0, 1e6, 0, 0, 'stone')",
         }) {
        const std::string message = error_of(text, limits);
        EXPECT_THAT(message, StartsWith("w.lua:")) << text;
        EXPECT_LT(message.size(), 400u) << text;
        EXPECT_EQ(message.find('\n'), std::string::npos) << text;
    }
}

TEST(WorldScript, ALimitThatWasPassedIsAnErrorEvenIfTheScriptWentOn) {
    WorldScriptLimits limits;
    limits.canvas.cells_most = 1000;
    EXPECT_EQ(error_of("pcall(fill, 0, 0, 0, 99, 99, 99, 'stone')", limits),
              "w.lua: more than 1000 blocks are drawn in all");
}

TEST(WorldScript, TheSameScriptMakesTheSameWorld) {
    const char* text =
        "math.random() for i = 1, 300 do set(math.random(0, 31), math.random(60, 80), math.random(0, 31), 'stone') end";
    const Made one(text), other(text);
    ASSERT_TRUE(one.world && other.world);
    for (const auto& [at, chunk] : one.world->dimension.chunks()) {
        const ChunkPtr same = other.world->dimension.find(at);
        ASSERT_TRUE(same);
        EXPECT_EQ(chunk->blocks, same->blocks);
    }
}

} // namespace
} // namespace vitrail
