// A small world for the tests of land and ground: three attributes, all eight combinations of them as biomes, steep and
// flat ones, every loose layer somewhere. Hand-made, so that these tests do not change with the content.
#pragma once

#include "terrain/compile/expression.h"
#include "terrain/compile/names.h"
#include "terrain/cpu/stages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace vitrail::testing {

inline const float kPi = 3.14159265f;

struct SmallBiome {
    const char* wants;
    const char* height;
    float loose[8]; // gravel, clay, mud, dirt, red sand, sand, smooth sand, snow
};
inline const SmallBiome kSmallBiomes[] = {
    {"+++", "107+16F(.0065)", {0, 0, 0, 0, 0, .7f, .8f, 0}},
    {"++-", "66+18F(.006)", {.5f, 0, 0, 0, 0, 0, 0, 0}},
    {"+-+", "129.5+6F(.0045)", {0, 0, 0, 0, 0, 0, 1, 0}},
    {"+--", "134+8F(.007)", {1, 0, 0, 0, 0, 0, 0, 0}},
    {"-++", "130+12F(.008)", {0, 1.7f, 2.2f, .6f, 0, 0, 0, 0}},
    {"-+-", "n=(abs(F(.0035))+.05)^2+.1(F(.005)-.5); 165+140(n-.15)+20 n F(.035)", {1, 0, 0, 1, 0, 0, 0, 1.1f}},
    {"--+", "137+13F(.0075)", {0, 0, 0, 0, 1, 0, 0, 0}},
    {"---",
     "128+16S(.015)+9F3(.007)+(1.2ss(.45,.35,W(.015))+.6ss(.45,.35,W(.021)))(54+7F3(.02))",
     {0, 0, 0, 1, 0, 1, 0, 0}},
};

inline std::unique_ptr<TerrainTables> small_tables(u64 seed) {
    auto t = std::make_unique<TerrainTables>();
    t->seed = seed;
    TableBuilder builder(*t);
    u32 made = 0;
    const auto program = [&](const std::string& text) {
        auto p = compile_expression(text, "row " + std::to_string(made++), builder);
        EXPECT_TRUE(p) << text;
        return p ? *p : Program{};
    };
    t->warp_x = program("20F3(.015)");
    t->warp_z = program("20F3(.015)");
    t->fields = 3;
    t->field[0] = program("F(.00224)");
    t->field[1] = program("F(.0048)");
    t->field[2] = program("F(.0037)");
    t->attributes = 3;
    t->attribute[0] = {0, .01f, -.02f};
    t->attribute[1] = {1, -.08f, .08f};
    t->attribute[2] = {2, -.06f, .06f};
    t->loose = 8;
    const float layers[8][3] = {{2.5f, 55, 1.8f}, {2.7f, 40, 1.8f}, {2.3f, 45, 1.6f}, {4.2f, 40, 1.2f},
                                {3.5f, 30, 1.5f}, {3.8f, 35, 1.4f}, {4.5f, 65, 4.0f}, {2.5f, 45, 1.5f}};
    for (u32 l = 0; l < 8; ++l)
        t->loose_layer[l] = {Block(10 + l), layers[l][0], std::tan(layers[l][1] * kPi / 180), layers[l][2]};
    t->biomes = 8;
    for (u32 b = 0; b < 8; ++b) {
        const SmallBiome& from = kSmallBiomes[b];
        for (u32 a = 0; a < 3; ++a)
            t->biome[b].wants[a] = i8(from.wants[a] == '+' ? 1 : -1);
        t->biome[b].height = program(from.height);
        for (u32 l = 0; l < 8; ++l)
            t->biome[b].loose[l] = from.loose[l];
    }
    t->pick_key = random_key(seed, purpose_of("pick"));
    return t;
}

// Land of a rectangle of columns, with the reach of ground around it.
class Lands {
public:
    Lands(ColumnPos first, i32 columns_x, i32 columns_z)
        : first_(first)
        , wide_(columns_x + 2 * kGroundReach)
        , tiles_(std::size_t(wide_ * (columns_z + 2 * kGroundReach))) {}
    Lands(const TerrainTables& t, ColumnPos first, i32 columns_x, i32 columns_z, Isa isa = best_isa())
        : Lands(first, columns_x, columns_z) {
        for (std::size_t i = 0; i < tiles_.size(); ++i)
            terrain_stages(isa).land(t, at(i), tiles_[i]);
    }

    ColumnPos at(std::size_t i) const {
        const i32 x = i32(i) % wide_ - kGroundReach, z = i32(i) / wide_ - kGroundReach;
        return {i32(u32(first_.x) + u32(x)), i32(u32(first_.z) + u32(z))};
    }
    std::size_t size() const { return tiles_.size(); }
    LandTile& tile(std::size_t i) { return tiles_[i]; }
    const LandTile& tile(std::size_t i) const { return tiles_[i]; }
    i32 wide() const { return wide_; }
    // Blocks from the least corner of all of it.
    const LandTile& tile_at(i32 x, i32 z) const { return tiles_[std::size_t((z >> 4) * wide_ + (x >> 4))]; }
    float height(i32 x, i32 z) const { return tile_at(x, z).height[(x & 15) | (z & 15) << 4]; }

    // Pointers to the tiles that columns first + (x, z) .. of a part of it need.
    std::vector<const LandTile*> part(i32 x, i32 z, i32 columns_x, i32 columns_z) const {
        std::vector<const LandTile*> out;
        for (i32 row = z; row < z + columns_z + 2 * kGroundReach; ++row)
            for (i32 column = x; column < x + columns_x + 2 * kGroundReach; ++column)
                out.push_back(&tiles_[std::size_t(row * wide_ + column)]);
        return out;
    }
    std::vector<GroundTile> ground(const TerrainTables& t, i32 x, i32 z, i32 columns_x, i32 columns_z,
                                   Isa isa = best_isa()) const {
        std::vector<GroundTile> out(std::size_t(columns_x * columns_z));
        terrain_stages(isa).ground(t, {first_.x + x, first_.z + z}, columns_x, columns_z,
                                   part(x, z, columns_x, columns_z).data(), out.data());
        return out;
    }

private:
    ColumnPos first_;
    i32 wide_;
    std::vector<LandTile> tiles_;
};

} // namespace vitrail::testing
