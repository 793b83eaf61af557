// From a description to tables: what lands where, keys that do not depend on neighbors, and errors that name their row.
#include "terrain/compile/compile.h"

#include "terrain/compile/names.h"
#include "terrain/compile/shape_info.h"
#include "terrain/tiles.h"
#include "tests/terrain/base_terrain.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <gtest/gtest.h>

using namespace vitrail;

namespace {

// One row of everything.
TerrainDescription small() {
    TerrainDescription d;
    d.warp_x = "20F3(.015)";
    d.warp_z = "20F3(.015)";
    d.fields = {{"sea", "F(.0007)"}, {"heat", "F(.0012)"}};
    d.attributes = {{"heat", "heat", -.06f, .06f}, {"ocean", "sea", .01f, -.02f}};
    auto layer = [](const char* name, float thickness) {
        TerrainDescription::Layer l;
        l.name = name;
        l.block = std::string("minecraft:") + name;
        l.thickness = thickness;
        return l;
    };
    auto dirt = layer("dirt", 4.2f), sandstone = layer("sandstone", 3.5f), stone = layer("stone", 40),
         andesite = layer("andesite", 24), sand = layer("sand", 3.8f);
    dirt.loose = sand.loose = true;
    dirt.repose_degrees = 45;
    sand.repose_degrees = 35;
    sand.steepest = 1.4f;
    sandstone.hung = true;
    stone.amplitude = 30;
    stone.frequency = .005f;
    andesite.remainder = true;
    d.layers = {dirt, sandstone, stone, andesite, sand};
    d.materials = {{"sand", 0.0f}};
    TerrainDescription::Biome plains;
    plains.name = "vitrail:plains";
    plains.wants = ".-";
    plains.height = "144 + 8F(.008)";
    plains.rules = {{.from = {"dirt"},
                     .above = "",
                     .below = "",
                     .depth = 1,
                     .chance = 1,
                     .to = "minecraft:grass_block",
                     .bands = {}}};
    plains.rules[0].from = {"loose"};
    TerrainDescription::Biome sea;
    sea.name = "vitrail:sea";
    sea.wants = "-+";
    sea.height = "93 + 18F(.0055) ocean";
    sea.materials = {{"sand", .7f}, {"dirt", 0.0f}};
    d.biomes = {plains, sea};
    d.cave_attributes = {{"deep", "23F3(.01)", true, 19, 21}};
    TerrainDescription::CaveBiome none, crystal;
    none.name = "vitrail:none";
    none.wants = "-";
    crystal.name = "vitrail:crystal";
    crystal.wants = "+";
    TerrainDescription::CaveRule vein;
    vein.place = "rock";
    vein.from = {"rock"};
    vein.to = "minecraft:quartz_block";
    vein.vein = "F3(.05)";
    vein.vein_width = .04f;
    crystal.rules = {vein};
    d.cave_biomes = {none, crystal};
    TerrainDescription::Decorator grass;
    grass.biome = "vitrail:plains";
    grass.block = "minecraft:short_grass";
    grass.chance = .2f;
    d.decorators = {grass};
    TerrainDescription::Feature feature;
    const ShapeInfo& info = shape_infos()[0];
    feature.name = "first";
    feature.shape = info.name;
    feature.biome = "vitrail:plains";
    feature.cell = 12;
    feature.padding = 2;
    feature.chance = .5f;
    feature.layers = {"sand"};
    for (const char* name : info.blocks)
        if (name) feature.blocks[name] = "minecraft:stone";
    d.features = {feature};
    return d;
}

CompiledTerrain compiled(const TerrainDescription& d, u64 seed = 1) {
    auto out = compile_terrain(d, seed);
    if (!out) throw std::runtime_error(out.error().message);
    return std::move(*out);
}
bool same_bytes(const TerrainTables& a, const TerrainTables& b) {
    return std::memcmp(&a, &b, sizeof a) == 0;
}
bool same_key(RandomKey a, RandomKey b) {
    return a.a == b.a && a.b == b.b;
}

} // namespace

TEST(CompileTerrain, EveryRowLandsInItsTable) {
    const CompiledTerrain c = compiled(small());
    const TerrainTables& t = *c.tables;
    EXPECT_EQ(c.block_names[kAir], "minecraft:air");
    EXPECT_EQ(c.block_names[kBedrock], "minecraft:bedrock");
    EXPECT_EQ(c.block_names[kWater], "minecraft:water");
    EXPECT_EQ(c.block_names[kLava], "minecraft:lava");
    EXPECT_EQ(t.blocks, c.block_names.size());
    EXPECT_EQ(t.ocean, 1);
    EXPECT_EQ(t.attribute[0].field, 1);
    EXPECT_EQ(t.attribute[1].field, 0);
    // Strata bottom up, the hung ones after them, then what is loose.
    EXPECT_EQ(c.layer_names, (std::vector<std::string>{"stone", "andesite", "sandstone", "dirt", "sand"}));
    EXPECT_EQ(t.strata, 3u);
    EXPECT_EQ(t.loose, 2u);
    EXPECT_EQ(t.stratum[2].hung, 1);
    EXPECT_EQ(c.block_names[t.remainder], "minecraft:andesite");
    EXPECT_EQ(c.block_names[t.deepest_stone], "minecraft:stone");
    EXPECT_NEAR(t.loose_layer[0].repose, 1, 1e-6);
    EXPECT_NEAR(t.loose_layer[1].repose, std::tan(35 * 3.14159265358979 / 180), 1e-6);
    EXPECT_LE(t.erosion_passes * t.loose + 1, u32(kGroundReach) * 16);
    EXPECT_GT((t.erosion_passes + 1) * t.loose + 1, u32(kGroundReach) * 16);
    EXPECT_EQ(t.biome[0].wants[0], 0);
    EXPECT_EQ(t.biome[0].wants[1], -1);
    EXPECT_EQ(t.biome[1].wants[1], 1);
    EXPECT_EQ(t.biome[0].loose[0], 1.0f); // named nowhere
    EXPECT_EQ(t.biome[0].loose[1], 0.0f); // by default
    EXPECT_EQ(t.biome[1].loose[1], 0.7f); // the biome's own
    EXPECT_EQ(t.surface_rules, 1u);
    EXPECT_TRUE(t.surface_rule[0].from.has(t.loose_layer[0].block));
    EXPECT_FALSE(t.surface_rule[0].from.has(t.stratum[0].block));
    EXPECT_EQ(t.cave_biomes, 2u);
    EXPECT_EQ(t.cave_attribute[0].with_depth, 1.0f);
    EXPECT_EQ(t.cave_rules, 1u);
    EXPECT_EQ(t.cave_rule[0].biome, 1);
    EXPECT_EQ(t.noise[t.cave_rule[0].vein].octaves, 3);
    EXPECT_TRUE(t.cave_rule[0].from.has(t.stratum[1].block));
    EXPECT_FALSE(t.cave_rule[0].from.has(t.loose_layer[1].block));
    EXPECT_EQ(c.biome_names,
              (std::vector<std::string>{"vitrail:plains", "vitrail:sea", "vitrail:none", "vitrail:crystal"}));
    EXPECT_EQ(t.feature[0].layers, 2u);
    EXPECT_EQ(t.feature[0].cell, 12);
    // Plants may stand on what rules made of the ground, and may be replaced themselves.
    const DecoratorRow& grass = t.decorator[0];
    EXPECT_TRUE(grass.on.has(t.surface_rule[0].to[0]));
    EXPECT_EQ(t.traits[grass.block], trait_open);
    EXPECT_EQ(t.traits[t.surface_rule[0].to[0]], trait_ground);
    EXPECT_EQ(t.traits[kWater], trait_liquid);
    EXPECT_EQ(t.traits[kAir], trait_open);
    EXPECT_EQ(t.cave_warp_x.octaves, 5);
    EXPECT_EQ(t.cave_gate.octaves, 4);
    EXPECT_EQ(t.noise[t.shape_noise[1]].octaves, 3);
}

TEST(CompileTerrain, TheSameInputGivesTheSameTables) {
    EXPECT_TRUE(same_bytes(*compiled(small()).tables, *compiled(small()).tables));
    EXPECT_FALSE(same_bytes(*compiled(small(), 1).tables, *compiled(small(), 2).tables));
    EXPECT_TRUE(same_bytes(*compiled(base_terrain(), 7).tables, *compiled(base_terrain(), 7).tables));
}

TEST(CompileTerrain, AddingRowsChangesNoRandomNumbersOfOthers) {
    const auto before = compiled(small());
    TerrainDescription d = small();
    d.biomes.insert(d.biomes.begin(), d.biomes[1]);
    d.biomes[0].name = "vitrail:new";
    d.biomes[0].rules = {d.biomes[1].rules};
    d.features.insert(d.features.begin(), d.features[0]);
    d.features[0].name = "another";
    d.decorators.insert(d.decorators.begin(), d.decorators[0]);
    d.decorators[0].block = "minecraft:fern";
    d.fields.insert(d.fields.begin(), {"other", "F(.1)"});
    const auto after = compiled(d);
    EXPECT_TRUE(same_key(before.tables->feature[0].key, after.tables->feature[1].key));
    EXPECT_FALSE(same_key(after.tables->feature[0].key, after.tables->feature[1].key));
    EXPECT_TRUE(same_key(before.tables->decorator[0].key, after.tables->decorator[1].key));
    EXPECT_FALSE(same_key(after.tables->decorator[0].key, after.tables->decorator[1].key));
    EXPECT_TRUE(same_key(before.tables->cave_rule[0].key, after.tables->cave_rule[0].key));
    EXPECT_TRUE(same_key(before.tables->pick_key, after.tables->pick_key));
    const auto octave = [](const TerrainTables& t, Program p) {
        for (u32 i = p.first; i < u32(p.first) + p.count; ++i)
            if (t.instruction[i].op == Op::fractal2) return t.octave[t.noise[t.instruction[i].noise].first].key;
        return 0u;
    };
    EXPECT_EQ(octave(*before.tables, before.tables->biome[0].height),
              octave(*after.tables, after.tables->biome[1].height));
    EXPECT_EQ(octave(*before.tables, before.tables->field[0]), octave(*after.tables, after.tables->field[1]));
    EXPECT_EQ(before.tables->octave[before.tables->cave_cells.first].key,
              after.tables->octave[after.tables->cave_cells.first].key);
}

TEST(CompileTerrain, ErrorsNameTheRow) {
    using D = TerrainDescription;
    const struct {
        const char* says;
        std::function<void(D&)> spoil;
    } rows[] = {
        {"attribute heat: field 'nothing'; expected one of sea, heat", [](D& d) { d.attributes[0].field = "nothing"; }},
        {"attribute heat: low and high are equal", [](D& d) { d.attributes[0].low = d.attributes[0].high; }},
        {"attribute heat: low is nan", [](D& d) { d.attributes[0].low = std::nanf(""); }},
        {"attribute heat: exists already", [](D& d) { d.attributes[1].name = "heat"; }},
        {"field sea: column 1", [](D& d) { d.fields[0].noise = "nonsense"; }},
        {"field sea: expected noise", [](D& d) { d.fields[0].noise = ""; }},
        {"warp_x: column", [](D& d) { d.warp_x = "1 +"; }},
        {"layer dirt: thickness", [](D& d) { d.layers[0].thickness = -1; }},
        {"layer dirt: repose_degrees", [](D& d) { d.layers[0].repose_degrees = 90; }},
        {"layer dirt: exists already", [](D& d) { d.layers[1].name = "dirt"; }},
        {"layer stone: block ''", [](D& d) { d.layers[2].block = ""; }},
        {"layer stone: frequency", [](D& d) { d.layers[2].frequency = 0; }},
        {"layer stone: only one layer",
         [](D& d) {
             d.layers[2].remainder = d.layers[3].remainder = true;
             std::swap(d.layers[2], d.layers[3]);
         }},
        {"materials: material 'mud'", [](D& d) { d.materials["mud"] = 1; }},
        {"biome vitrail:sea: material 'mud'", [](D& d) { d.biomes[1].materials["mud"] = 1; }},
        {"biome vitrail:plains: wants '.'; expected 2 signs", [](D& d) { d.biomes[0].wants = "."; }},
        {"biome vitrail:plains: wants '.x'", [](D& d) { d.biomes[0].wants = ".x"; }},
        {"biome vitrail:plains: expected a height", [](D& d) { d.biomes[0].height = ""; }},
        {"biome vitrail:plains height: column 3", [](D& d) { d.biomes[0].height = "1 1"; }},
        {"biome vitrail:sea: exists already", [](D& d) { d.biomes[0].name = d.biomes[1].name; }},
        {"biomes: expected at least one", [](D& d) { d.biomes.clear(); }},
        {"rule to minecraft:grass_block: chance", [](D& d) { d.biomes[0].rules[0].chance = 2; }},
        {"rule to minecraft:grass_block: block 'Stone'", [](D& d) { d.biomes[0].rules[0].from = {"Stone"}; }},
        {"rule to minecraft:a: bands want", [](D& d) { d.biomes[0].rules[0].bands = {"minecraft:a"}; }},
        {"cave biome vitrail:crystal rule rock to minecraft:quartz_block vein: column 1",
         [](D& d) { d.cave_biomes[1].rules[0].vein = "x"; }},
        {"cave biome vitrail:crystal rule x to minecraft:quartz_block: place 'x'; expected one of floor, ceiling, rock",
         [](D& d) { d.cave_biomes[1].rules[0].place = "x"; }},
        {"cave biome vitrail:none: wants", [](D& d) { d.cave_biomes[0].wants = ""; }},
        {"feature first: shape 'x'", [](D& d) { d.features[0].shape = "x"; }},
        {"feature first: biome 'x'", [](D& d) { d.features[0].biome = "x"; }},
        {"feature first: place 'x'", [](D& d) { d.features[0].place = "x"; }},
        {"feature first: cave biome 'vitrail:plains'", [](D& d) { d.features[0].place = "cave_floor"; }},
        {"feature first: padding is 6; expected 0 to 5", [](D& d) { d.features[0].padding = 6; }},
        {"feature first: layer 'stone'; expected one of dirt, sand", [](D& d) { d.features[0].layers = {"stone"}; }},
        {"feature first: number 'x'", [](D& d) { d.features[0].numbers["x"] = 1; }},
        {"feature first: block 'x'", [](D& d) { d.features[0].blocks["x"] = "minecraft:stone"; }},
        {"feature first: expected a block", [](D& d) { d.features[0].blocks.clear(); }},
        {"feature first: exists already", [](D& d) { d.features.push_back(d.features[0]); }},
        {"decorator minecraft:short_grass in vitrail:plains: chance", [](D& d) { d.decorators[0].chance = -1; }},
        {"decorator minecraft:short_grass in x: biome 'x'", [](D& d) { d.decorators[0].biome = "x"; }},
        {"decorators", [](D& d) { d.decorators.resize(kDecoratorsMost + 1, d.decorators[0]); }},
        {"surface rules", [](D& d) { d.biomes[0].rules.resize(kRulesMost + 1, d.biomes[0].rules[0]); }},
        {"biomes", [](D& d) { d.biomes.resize(kBiomesMost + 1, d.biomes[0]); }},
        {"blocks",
         [](D& d) {
             for (int i = 0; i < 300; ++i)
                 d.decorators[0].on.push_back("minecraft:b" + std::to_string(i));
         }},
    };
    for (const auto& row : rows) {
        D d = small();
        row.spoil(d);
        const auto out = compile_terrain(d, 1);
        ASSERT_FALSE(out) << row.says;
        EXPECT_NE(out.error().message.find(row.says), std::string::npos)
            << "wanted: " << row.says << "\nsays: " << out.error().message;
    }
}

TEST(CompileTerrain, TheBaseContentHasEveryRowOfTheReference) {
    const CompiledTerrain c = compiled(base_terrain());
    EXPECT_GE(c.tables->biomes, 24u);
    EXPECT_GE(c.tables->cave_biomes, 5u);
    EXPECT_GE(c.layer_names.size(), 20u);
    EXPECT_EQ(c.tables->loose, 8u);
    EXPECT_EQ(c.tables->erosion_passes, 11u);
    EXPECT_GE(c.tables->ocean, 0);
    for (u32 i = 0; i < c.tables->features; ++i) {
        EXPECT_LE(c.tables->feature[i].reach, kFeatureReach * 16 - 1) << c.feature_names[i];
        EXPECT_LE(c.tables->feature[i].bound_low, c.tables->feature[i].bound_high) << c.feature_names[i];
    }
}
