// Placement of features: rates, chance without rows or stripes, padding, conditions, caps.
#include "terrain/cpu/features_stage.h"
#include "terrain/kernel/cave_layers.h"
#include "terrain/kernel/random_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <random>
#include <vector>

namespace vitrail {
namespace {

constexpr i32 kEdgeColumn = kWorldEdge / 16;

// One biome everywhere, flat land at y = 140 with dirt on it, no caves.
struct Flat {
    std::unique_ptr<TerrainTables> t = std::make_unique<TerrainTables>();
    std::unique_ptr<GroundTile> ground = std::make_unique<GroundTile>();
    std::unique_ptr<CaveTile> caves = std::make_unique<CaveTile>();
    std::unique_ptr<FeatureTile> out = std::make_unique<FeatureTile>();

    Flat() {
        t->biomes = 1;
        t->cave_biomes = 1;
        t->loose = 3;
        t->loose_layer[0].block = 10;
        t->loose_layer[1].block = 11;
        t->loose_layer[2].block = 12;
        level(140.0f);
    }
    void level(float top) {
        for (i32 i = 0; i < kColumnCells; ++i) {
            ground->land[i] = ground->top[i] = top;
            ground->rock[i] = top - 4;
            ground->loose[1][i] = 4;
        }
    }
    void open(i32 index, i32 from, i32 to) {
        for (i32 y = from; y <= to; ++y)
            caves->open[y >> 5][index] |= 1u << (y & 31);
    }
    // A cactus without arms: one solid.
    FeatureRow& row(u32 salt, u16 cell, u16 padding, float chance) {
        FeatureRow& r = t->feature[t->features++];
        r.shape = Shape::cactus;
        r.place = FeaturePlace::surface;
        r.cell = cell;
        r.padding = padding;
        r.chance = chance;
        r.bound_low = -4;
        r.bound_high = 20;
        r.reach = 8;
        r.key = random_key(99, salt);
        r.numbers[0] = r.numbers[1] = 5;
        r.blocks[0] = 20;
        return r;
    }
    const FeatureTile& at(ColumnPos c) {
        features_stage(*t, c, *ground, *caves, *out);
        return *out;
    }
};

// Bounds 4.5 standard deviations wide over some 100 numbers: a right build fails once in a thousand seeds, and seeds
// are fixed.
constexpr double kSigmas = 4.5;

TEST(Placement, RatesEqualTheChanceInEveryQuadrantAndAtTheEdge) {
    const struct {
        u16 cell, padding;
        float chance;
    } kinds[] = {{5, 0, .65f}, {7, 1, .8f}, {9, 2, .15f}, {16, 2, .7f}, {28, 5, .6f}, {36, 4, .3f}};
    Flat w;
    u32 salt = 1;
    for (const auto& k : kinds)
        w.row(salt++, k.cell, k.padding, k.chance);
    constexpr i32 side = 48;
    const ColumnPos corners[] = {{100, 100},
                                 {-200, 100},
                                 {-200, -200},
                                 {100, -200},
                                 {kEdgeColumn - side, kEdgeColumn - side},
                                 {-kEdgeColumn, 5},
                                 {-kEdgeColumn, kEdgeColumn - side}};
    for (const ColumnPos corner : corners) {
        std::vector<double> count(std::size(kinds));
        for (i32 z = 0; z < side; ++z)
            for (i32 x = 0; x < side; ++x) {
                const FeatureTile& tile = w.at({corner.x + x, corner.z + z});
                for (u32 i = 0; i < tile.placements; ++i)
                    ++count[tile.placement[i].feature];
            }
        for (size_t i = 0; i < std::size(kinds); ++i) {
            const double cells = std::pow(side * 16.0 / kinds[i].cell, 2), p = kinds[i].chance;
            // Cells at the rim count in part: their share of the perimeter widens the bound.
            const double sigma = std::sqrt(cells * p * (1 - p) + 4 * std::sqrt(cells) * p * 0.25);
            EXPECT_NEAR(count[i], cells * p, kSigmas * sigma)
                << "cell " << kinds[i].cell << " at " << corner.x << "," << corner.z;
        }
    }
}

double correlation(const std::vector<double>& v, i32 side, i32 lag_x, i32 lag_z) {
    double mean = 0, square = 0, both = 0;
    for (const double a : v)
        mean += a;
    mean /= double(v.size());
    u64 pairs = 0;
    for (i32 z = 0; z < side; ++z)
        for (i32 x = 0; x < side; ++x) {
            const double a = v[size_t(z * side + x)] - mean;
            square += a * a;
            if (x + lag_x < side && z + lag_z < side) {
                both += a * (v[size_t((z + lag_z) * side + x + lag_x)] - mean);
                ++pairs;
            }
        }
    return both / double(pairs) / (square / double(v.size()));
}

void expect_no_period(const std::vector<double>& field, i32 side, const char* what) {
    const double bound = kSigmas / std::sqrt(double(side) * (side - 64));
    for (i32 lag = 1; lag <= 64; ++lag) {
        EXPECT_LT(std::abs(correlation(field, side, lag, 0)), bound) << what << " lag x " << lag;
        EXPECT_LT(std::abs(correlation(field, side, 0, lag)), bound) << what << " lag z " << lag;
        EXPECT_LT(std::abs(correlation(field, side, lag, lag)), bound) << what << " lag xz " << lag;
    }
}

TEST(Placement, CountsPerColumnHaveNoPeriod) {
    constexpr i32 side = 192;
    Flat w;
    w.row(1, 16, 2, .5f);
    w.row(2, 8, 1, .4f); // cells that end where columns end: counts of columns are independent
    for (const ColumnPos corner :
         {ColumnPos{0, 0}, ColumnPos{-side - 7, -side / 2}, ColumnPos{kEdgeColumn - side, -kEdgeColumn}}) {
        std::vector<double> one(side * side), two(side * side);
        for (i32 i = 0; i < side * side; ++i) {
            const FeatureTile& tile = w.at({corner.x + i % side, corner.z + i / side});
            for (u32 p = 0; p < tile.placements; ++p)
                ++(tile.placement[p].feature == 0 ? one : two)[size_t(i)];
        }
        expect_no_period(one, side, "cell 16");
        expect_no_period(two, side, "cell 8");
    }
}

TEST(Placement, CellsOfAnySizeAreIndependent) {
    // Cells that do not divide columns: which are taken, and where in its cell a feature stands.
    for (const u16 cell : {u16(7), u16(9), u16(13)}) {
        Flat w;
        w.row(cell, cell, 1, .5f);
        constexpr i32 side = 150;
        const i32 columns = side * cell / 16 + 1;
        std::vector<double> taken(side * side), east(side * side, (cell - 1) * .5), south = east;
        for (i32 cz = 0; cz < columns; ++cz)
            for (i32 cx = 0; cx < columns; ++cx) {
                const FeatureTile& tile = w.at({cx, cz});
                for (u32 p = 0; p < tile.placements; ++p) {
                    const i32 x = tile.placement[p].x / cell, z = tile.placement[p].z / cell;
                    if (x >= side || z >= side) continue;
                    const size_t i = size_t(z * side + x);
                    ASSERT_EQ(taken[i], 0) << "two in one cell";
                    taken[i] = 1;
                    east[i] = tile.placement[p].x % cell;
                    south[i] = tile.placement[p].z % cell;
                }
            }
        expect_no_period(taken, side, "taken");
        expect_no_period(east, side, "x in the cell");
        expect_no_period(south, side, "z in the cell");
    }
}

TEST(Placement, KeepsItsPaddingEverywhere) {
    for (const ColumnPos corner :
         {ColumnPos{-12, -12}, ColumnPos{kEdgeColumn - 24, -kEdgeColumn}, ColumnPos{-kEdgeColumn, -12}}) {
        Flat w;
        w.row(3, 11, 3, 1.0f);
        std::vector<std::pair<i64, i64>> places;
        for (i32 i = 0; i < 24 * 24; ++i) {
            const ColumnPos c{corner.x + i % 24, corner.z + i / 24};
            const FeatureTile& tile = w.at(c);
            for (u32 p = 0; p < tile.placements; ++p) {
                EXPECT_EQ(tile.placement[p].x >> 4, c.x);
                EXPECT_EQ(tile.placement[p].z >> 4, c.z);
                places.emplace_back(tile.placement[p].x, tile.placement[p].z);
            }
        }
        ASSERT_GT(places.size(), 900u);
        i64 nearest = 1000;
        for (size_t a = 0; a < places.size(); ++a)
            for (size_t b = 0; b < a; ++b)
                nearest = std::min(nearest, std::max(std::abs(places[a].first - places[b].first),
                                                     std::abs(places[a].second - places[b].second)));
        EXPECT_GE(nearest, 6);
    }
}

TEST(Placement, AnyCellSizeAndPaddingIsSafe) {
    Flat w;
    w.row(1, 0, 0, 1);     // no cell at all counts as 1
    w.row(2, 3, 60000, 1); // more padding than cell
    w.row(3, 65535, 0, 1);
    for (const ColumnPos c :
         {ColumnPos{0, 0}, ColumnPos{-kEdgeColumn, kEdgeColumn - 1}, ColumnPos{134217727, -134217728}})
        EXPECT_LE(w.at(c).placements, kPlacementsMost);
}

TEST(Placement, DoesNotDependOnTheOrderOfAsking) {
    Flat w;
    w.row(1, 9, 1, .7f);
    w.row(2, 23, 2, .9f).shape = Shape::iceberg;
    std::vector<ColumnPos> order;
    for (i32 i = 0; i < 100; ++i)
        order.push_back({i % 10 - 5, i / 10 - 5});
    std::vector<FeatureTile> first(100), second(100);
    for (size_t i = 0; i < 100; ++i)
        features_stage(*w.t, order[i], *w.ground, *w.caves, first[i]);
    std::vector<size_t> shuffled(100);
    for (size_t i = 0; i < 100; ++i)
        shuffled[i] = i;
    std::shuffle(shuffled.begin(), shuffled.end(), std::mt19937(5));
    for (const size_t i : shuffled) {
        std::memset(static_cast<void*>(&second[i]), 0xee, sizeof second[i]); // what was there before does not show
        features_stage(*w.t, order[i], *w.ground, *w.caves, second[i]);
        ASSERT_EQ(first[i].placements, second[i].placements);
        ASSERT_EQ(first[i].primitives, second[i].primitives);
        for (u32 p = 0; p < first[i].placements; ++p) {
            const Placement &a = first[i].placement[p], &b = second[i].placement[p];
            EXPECT_TRUE(a.x == b.x && a.y == b.y && a.z == b.z && a.bits == b.bits && a.first == b.first &&
                        a.count == b.count);
        }
        for (u32 p = 0; p < first[i].primitives; ++p) {
            const Primitive &a = first[i].primitive[p], &b = second[i].primitive[p];
            EXPECT_TRUE(a.a == b.a && a.b == b.b && a.ra == b.ra && a.rb == b.rb &&
                        std::equal(a.low, a.low + 3, b.low));
        }
    }
}

// How many of 400 cells of a row with chance 1 are taken.
u32 taken(Flat& w) {
    u32 n = 0;
    for (i32 i = 0; i < 400; ++i)
        n += w.at({i % 20 - 10, i / 20 - 10}).placements;
    return n;
}

TEST(Placement, StandsOnTheGroundItWants) {
    Flat w;
    FeatureRow& r = w.row(1, 16, 0, 1);
    EXPECT_EQ(taken(w), 400u);
    EXPECT_EQ(w.at({0, 0}).placement[0].y, 140);
    w.level(139.2f);
    EXPECT_EQ(w.at({0, 0}).placement[0].y, 140); // the block at 139 is ground
    r.layers = 1 << 1;
    r.least_thickness = 3.5f;
    EXPECT_EQ(taken(w), 400u);
    r.least_thickness = 4.5f;
    EXPECT_EQ(taken(w), 0u) << "too thin";
    r.least_thickness = 0.5f;
    for (float& v : w.ground->loose[2])
        v = 0.3f;
    EXPECT_EQ(taken(w), 0u) << "another layer lies on top";
    for (float& v : w.ground->loose[2])
        v = 0.01f;
    EXPECT_EQ(taken(w), 400u) << "a trace does not count";
    r.layers = 1 << 0;
    EXPECT_EQ(taken(w), 0u);
    r.layers = 0;
    r.highest_y = 139;
    EXPECT_EQ(taken(w), 0u);
    r.highest_y = 300;
    r.lowest_y = 141;
    EXPECT_EQ(taken(w), 0u);
    r.lowest_y = 0;
    for (i32 i = 0; i < kColumnCells; ++i)
        w.open(i, 130, 139);
    EXPECT_EQ(taken(w), 0u) << "over a ravine";
}

TEST(Placement, SeaAndLandAreTold) {
    Flat w;
    FeatureRow& r = w.row(1, 16, 0, 1);
    w.level(128.0f); // the lowest dry land
    EXPECT_EQ(taken(w), 400u);
    r.place = FeaturePlace::sea_floor;
    EXPECT_EQ(taken(w), 0u);
    w.level(100.0f);
    EXPECT_EQ(taken(w), 400u);
    EXPECT_EQ(w.at({3, 3}).placement[0].y, 100);
    EXPECT_EQ(w.at({3, 3}).placement[0].room, 28);
    r.water_depth = 29;
    EXPECT_EQ(taken(w), 0u);
    r.water_depth = 28;
    r.place = FeaturePlace::sea_surface;
    EXPECT_EQ(taken(w), 400u);
    EXPECT_EQ(w.at({3, 3}).placement[0].y, 128);
    r.place = FeaturePlace::surface;
    EXPECT_EQ(taken(w), 0u);
}

TEST(Placement, CaveLayersDecideEachByThemselves) {
    Flat w;
    FeatureRow& r = w.row(1, 16, 0, 1);
    r.place = FeaturePlace::cave_floor;
    EXPECT_EQ(taken(w), 0u);
    for (i32 i = 0; i < kColumnCells; ++i) {
        w.open(i, 5, 20);    // its floor is lava
        w.open(i, 40, 49);   // 10 high
        w.open(i, 60, 64);   // 5 high
        w.open(i, 120, 139); // open to the sky
    }
    EXPECT_EQ(taken(w), 1200u);
    const FeatureTile& tile = w.at({0, 0});
    ASSERT_EQ(tile.placements, 3u);
    EXPECT_EQ(tile.placement[0].y, 40);
    EXPECT_EQ(tile.placement[0].room, 10);
    EXPECT_EQ(tile.placement[1].y, 60);
    EXPECT_NE(tile.placement[0].bits, tile.placement[1].bits);
    r.least_height = 6;
    EXPECT_EQ(taken(w), 800u);
    r.place = FeaturePlace::cave_ceiling;
    EXPECT_EQ(taken(w), 400u) << "a ceiling needs rock above";
    EXPECT_EQ(w.at({0, 0}).placement[0].y, 49);
    r.chance = .3f;
    EXPECT_NEAR(taken(w), 120, kSigmas * std::sqrt(400 * .3 * .7));
}

TEST(Placement, FollowsTheShareOfItsBiome) {
    Flat w;
    w.t->attributes = 1;
    w.t->biomes = 3;
    w.t->biome[0].wants[0] = 1;
    w.t->biome[1].wants[0] = -1;
    w.t->biome[2].wants[0] = -1; // overlaps the second: each has half of its weight
    w.row(1, 16, 0, .8f);
    w.row(2, 16, 0, .8f).biome = 1;
    for (const float v : {0.0f, 0.25f, 1.0f}) {
        std::fill_n(w.ground->attribute[0], kColumnCells, v);
        double count[2] = {};
        for (i32 i = 0; i < 10000; ++i) {
            const FeatureTile& tile = w.at({i % 100 - 50, i / 100 - 50});
            for (u32 p = 0; p < tile.placements; ++p)
                ++count[tile.placement[p].feature];
        }
        const double share[2] = {v / (v + 2 * (1 - v)), (1 - v) / (v + 2 * (1 - v))};
        for (i32 k = 0; k < 2; ++k) {
            const double p = .8 * share[k];
            EXPECT_NEAR(count[k], 10000 * p, kSigmas * std::sqrt(10000 * p * (1 - p)) + 1e-9) << v;
        }
    }
}

TEST(Placement, CaveBiomeOfTheFloorDecidesAtTheFloor) {
    Flat w;
    w.t->cave_attributes = 1;
    w.t->cave_attribute[0] = {Program{}, 1.0f, 40.0f, 60.0f}; // by depth: below 60 all of it
    w.t->cave_biomes = 2;
    w.t->cave_biome[0].wants[0] = -1;
    w.t->cave_biome[1].wants[0] = 1;
    FeatureRow& r = w.row(1, 16, 0, 1);
    r.biome = 1;
    r.place = FeaturePlace::cave_floor;
    for (i32 i = 0; i < kColumnCells; ++i)
        w.open(i, 60, 110); // floor 80 deep, ceiling 30
    EXPECT_EQ(taken(w), 400u);
    r.place = FeaturePlace::cave_ceiling;
    EXPECT_EQ(taken(w), 0u);
    r.biome = 0;
    EXPECT_EQ(taken(w), 400u);
}

TEST(Placement, CapsLeaveWholeFeaturesOnly) {
    Flat w;
    w.row(1, 1, 0, 1);
    {
        const FeatureTile& tile = w.at({-3, 4});
        ASSERT_EQ(tile.placements, kPlacementsMost);
        for (u32 p = 0; p < tile.placements; ++p) { // the first ones in order, z before x
            EXPECT_EQ(tile.placement[p].x, -48 + i32(p % 16));
            EXPECT_EQ(tile.placement[p].z, 64 + i32(p / 16));
        }
    }
    w.t->features = 0;
    FeatureRow& many = w.row(2, 3, 0, 1); // more solids than there is room for
    many.shape = Shape::redwood;
    many.numbers[0] = many.numbers[1] = 30;
    many.bound_high = 75;
    many.reach = 14;
    const FeatureTile& tile = w.at({0, 0});
    EXPECT_LE(tile.primitives, kPrimitivesMost);
    u32 next = 0;
    for (u32 p = 0; p < tile.placements; ++p) {
        EXPECT_EQ(tile.placement[p].first, next);
        EXPECT_GT(tile.placement[p].count, 2u);
        next += tile.placement[p].count;
    }
    EXPECT_EQ(next, tile.primitives);
}

} // namespace
} // namespace vitrail
