// A small world for the tests of fill and decorate: four biomes, every kind of layer, rule and decorator; grounds and
// caves drawn at random, rougher than any land, so that nothing is right by being flat.
#pragma once

#include "terrain/compile/compile.h"
#include "terrain/cpu/stages.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace vitrail::testing {

inline TerrainDescription fill_description() {
    TerrainDescription d;
    d.fields = {{"a", "F(.01)"}, {"b", "F(.02)"}};
    d.attributes = {{"wet", "a", -.1f, .1f}, {"hot", "b", -.1f, .1f}};
    const auto stratum = [&](const char* name, float thickness, float amplitude, float frequency) -> auto& {
        d.layers.push_back({name, std::string("minecraft:") + name, thickness});
        d.layers.back().amplitude = amplitude;
        d.layers.back().frequency = frequency;
        return d.layers.back();
    };
    stratum("blackstone", 20, 18, .01f);
    stratum("deepslate", 40, 20, .02f);
    stratum("tuff", 6, 24, .0162f);
    stratum("stone", 10, 30, .015f);
    stratum("andesite", 24, 48, .013f).remainder = true;
    stratum("red_sandstone", 3, 2, .035f).hung = true;
    stratum("sandstone", 3.5f, 1.5f, .025f).hung = true;
    for (const char* name : {"gravel", "dirt", "sand"}) {
        d.layers.push_back({name, std::string("minecraft:") + name, 4, true});
        d.layers.back().steepest = 1.5f;
    }
    d.materials = {{"sandstone", 0.f}, {"red_sandstone", .5f}};
    d.biomes.resize(4);
    const char* names[] = {"t:meadow", "t:mesa", "t:ice", "t:odd"};
    const char* wants[] = {"++", "+-", "-+", "--"};
    for (std::size_t i = 0; i < 4; ++i) {
        d.biomes[i].name = names[i];
        d.biomes[i].wants = wants[i];
        d.biomes[i].height = "130";
    }
    d.biomes[1].materials = {{"stone", 2.f}, {"tuff", 0.f}, {"sandstone", 1.f}};
    d.biomes[2].materials = {{"deepslate", .3f}};
    using Rule = TerrainDescription::SurfaceRule;
    d.biomes[0].rules = {Rule{{"minecraft:dirt", "minecraft:sand"}, "", "", 1, 1, "minecraft:grass_block", {}},
                         Rule{{"ground"}, "", "125+6F(.05)", 3, .4f, "minecraft:mud", {}}};
    d.biomes[1].rules = {
        Rule{{"rock"}, "100+12F(.05)", "", 0, 1, "", {"t:b0", "t:b0", "t:b1", "t:b2", "t:b2", "t:b2", "t:b3"}},
        Rule{{"loose"}, "", "140", 2, .1f, "minecraft:moss_block", {}}};
    d.biomes[2].rules = {Rule{{"water"}, "", "", 2, 1, "minecraft:packed_ice", {}},
                         Rule{{"ground"}, "height-4", "", 0, .7f, "minecraft:snow_block", {}},
                         Rule{{"minecraft:snow_block"}, "120", "height-1", 0, .5f, "minecraft:powder_snow", {}}};
    d.biomes[3].rules = {Rule{{"ground"}, "60", "50", 0, 1, "t:never", {}},
                         Rule{{"ground", "water"}, "126", "", 0, .5f, "t:both", {}}};
    d.cave_attributes = {
        {"shallow", "9F(.02)", true, 10, 20}, {"deep", "9F(.02)", true, 60, 74}, {"odd", "F(.02)", false, -.1f, .1f}};
    using CaveRule = TerrainDescription::CaveRule;
    d.cave_biomes = {{"t:none", "-..", {}},
                     {"t:crystal",
                      "+-+",
                      {CaveRule{"rock", {"rock"}, "t:quartz", 1, 1, "F3(.05)", .1f},
                       CaveRule{"rock", {"minecraft:stone", "minecraft:deepslate"}, "t:cobbled", 1, .5f, "", 0}}},
                     {"t:lush",
                      "+--",
                      {CaveRule{"floor", {"rock"}, "minecraft:clay", 3, 1, "F2(.09)", .2f},
                       CaveRule{"floor", {"rock"}, "minecraft:moss_block", 2, .8f, "", 0},
                       CaveRule{"ceiling", {"rock", "loose"}, "minecraft:moss_block", 9, 1, "", 0}}},
                     {"t:forest", "++.", {CaveRule{"floor", {"ground"}, "t:warped", 1, 1, "", 0}}}};
    return d;
}

inline CompiledTerrain compiled(const TerrainDescription& d, u64 seed) {
    auto terrain = compile_terrain(d, seed);
    EXPECT_TRUE(terrain) << terrain.error().message;
    return std::move(*terrain);
}

inline Block block_of(const CompiledTerrain& terrain, const std::string& name) {
    const auto at = std::find(terrain.block_names.begin(), terrain.block_names.end(), name);
    EXPECT_NE(at, terrain.block_names.end()) << name;
    return Block(at - terrain.block_names.begin());
}

using Random = std::mt19937_64;
inline float uniform(Random& random, float low, float high) {
    return low + (high - low) * float(random() >> 40) / float(1 << 24);
}

// Attributes are mostly 0 or 1, as in most of the world, and in a third of the tiles between.
inline std::unique_ptr<GroundTile> random_ground(const TerrainTables& t, Random& random) {
    auto g = std::make_unique<GroundTile>();
    const float level = uniform(random, 90, 170), rough = uniform(random, 0, 1) < .2f ? 40.0f : 3.0f;
    for (u32 a = 0; a < kAttributesMost; ++a) {
        const bool mixed = random() % 3 == 0;
        const float whole = float(random() & 1);
        for (float& v : g->attribute[a])
            v = a < t.attributes ? (mixed ? uniform(random, -.3f, 1.3f) : whole) : 0;
        for (float& v : g->attribute[a])
            v = std::clamp(v, 0.0f, 1.0f);
    }
    for (i32 i = 0; i < kColumnCells; ++i) {
        g->land[i] = level + uniform(random, -rough, rough);
        float sum = 0;
        for (u32 l = 0; l < kLooseMost; ++l) {
            g->loose[l][i] = l < t.loose && random() % 2 == 0 ? uniform(random, 0, 4) : 0;
            sum += g->loose[l][i];
        }
        g->rock[i] = std::max(g->land[i] - sum, 1.0f);
        g->top[i] = g->rock[i] + sum;
    }
    // Corners of what can be
    if (random() % 8 == 0) {
        g->rock[3] = 1;
        for (u32 l = 0; l < kLooseMost; ++l)
            g->loose[l][3] = 0;
        g->top[3] = 1;
        g->land[3] = 1;
        g->top[200] = g->rock[200] = g->land[200] = 380;
        for (u32 l = 0; l < kLooseMost; ++l)
            g->loose[l][200] = 0;
    }
    return g;
}

// Runs of open blocks below the ground, a quarter of the block columns open to the sky.
inline std::unique_ptr<CaveTile> random_caves(const TerrainTables& t, const GroundTile& ground, Random& random) {
    auto c = std::make_unique<CaveTile>();
    std::fill_n(&c->open[0][0], sizeof c->open / 4, 0u);
    std::fill_n(&c->offset[0][0], sizeof c->offset / 4, 0.0f);
    for (u32 a = 0; a < t.cave_attributes; ++a) {
        const float whole = t.cave_attribute[a].with_depth != 0 ? uniform(random, -9, 9) : uniform(random, -.6f, .6f);
        for (float& v : c->offset[a])
            v = whole + uniform(random, -.5f, .5f);
    }
    const bool any = random() % 4 != 0;
    for (i32 i = 0; any && i < kColumnCells; ++i) {
        const i32 end = i32(std::ceil(ground.top[i])) - (random() % 4 == 0 ? 0 : 3);
        for (i32 y = i32(random() % 30); y < end; y += 2 + i32(random() % 60))
            for (i32 n = 1 + i32(random() % 20); n > 0 && y < end; --n, ++y)
                c->open[y >> 5][i] |= 1u << (y & 31);
    }
    return c;
}

inline bool is_open(const CaveTile& c, i32 i, i32 y) {
    return y >= 0 && y < kTerrainHeight && (c.open[y >> 5][i] >> (y & 31) & 1) != 0;
}

// Columns in all quadrants, near and at the far edge.
inline std::vector<ColumnPos> fill_places() {
    return {{0, 0},           {-1, -1},           {5, -9},         {-77, 31},           {1200, 4500},
            {-98765, -43210}, {1874999, 1874999}, {-1875000, 777}, {1874999, -1875000}, {-134217728, 134217727}};
}

inline std::vector<Isa> isas() {
    std::vector<Isa> out;
    for (const Isa isa : {Isa::portable, Isa::avx2, Isa::avx512})
        if (isa <= best_isa()) out.push_back(isa);
    return out;
}

} // namespace vitrail::testing
