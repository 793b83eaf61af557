// Layers of open blocks against brute force, and the draw of cave biomes.
#include "terrain/cpu/stages.h"
#include "terrain/kernel/cave_biome_kernel.h"
#include "terrain/kernel/cave_layers.h"

#include "base/rng.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

namespace vitrail {
namespace {

std::vector<CaveLayer> layers_by_hand(const CaveTile& caves, i32 index, i32 from) {
    std::vector<CaveLayer> out;
    bool inside = false;
    for (i32 y = from; y < kTerrainHeight; ++y) {
        const bool open = (caves.open[y / 32][index] >> (y % 32) & 1) != 0;
        EXPECT_EQ(open, cave_open(caves, index, y));
        if (open && !inside) out.push_back({y, y});
        if (open) out.back().end = y;
        inside = open;
    }
    return out;
}

void expect_layers(const CaveTile& caves, i32 index, i32 from) {
    const std::vector<CaveLayer> want = layers_by_hand(caves, index, from);
    std::vector<CaveLayer> got;
    CaveLayer layer;
    for (i32 y = from; next_cave_layer(caves, index, y, layer); y = layer.end + 2) {
        got.push_back(layer);
        ASSERT_LE(got.size(), 200u);
    }
    ASSERT_EQ(got.size(), want.size());
    for (size_t i = 0; i < got.size(); ++i) {
        EXPECT_EQ(got[i].start, want[i].start);
        EXPECT_EQ(got[i].end, want[i].end);
        EXPECT_EQ(got[i].height(), want[i].end - want[i].start + 1);
    }
}

TEST(CaveLayers, AgainstBruteForce) {
    Rng rng(5);
    auto caves = std::make_unique<CaveTile>();
    for (int round = 0; round < 60; ++round) {
        const u32 stay = 1 + rng.below(40); // runs of about so many blocks
        for (i32 i = 0; i < kColumnCells; ++i) {
            u32 open = rng.below(2);
            for (auto& word : caves->open) {
                word[i] = 0;
                for (u32 b = 0; b < 32; ++b) {
                    if (rng.below(stay) == 0) open ^= 1;
                    word[i] |= open << b;
                }
            }
        }
        for (i32 i = 0; i < kColumnCells; i += 7)
            expect_layers(*caves, i, i32(rng.below(round % 3 == 0 ? 1 : kTerrainHeight + 1)));
    }
}

TEST(CaveLayers, EmptyFullAndAtTheEnds) {
    auto caves = std::make_unique<CaveTile>();
    CaveLayer layer;
    EXPECT_FALSE(next_cave_layer(*caves, 0, 0, layer));
    for (auto& word : caves->open)
        word[3] = ~0u;
    ASSERT_TRUE(next_cave_layer(*caves, 3, 0, layer));
    EXPECT_EQ(layer.start, 0);
    EXPECT_EQ(layer.end, kTerrainHeight - 1);
    EXPECT_FALSE(next_cave_layer(*caves, 3, layer.end + 2, layer));
    caves->open[11][9] = 1u << 31;
    caves->open[1][9] = 1u << 31;
    caves->open[2][9] = 1;
    ASSERT_TRUE(next_cave_layer(*caves, 9, 0, layer));
    EXPECT_EQ(layer.start, 63);
    EXPECT_EQ(layer.end, 64);
    ASSERT_TRUE(next_cave_layer(*caves, 9, 66, layer));
    EXPECT_EQ(layer.start, 383);
    EXPECT_EQ(layer.end, 383);
    EXPECT_FALSE(next_cave_layer(*caves, 9, kTerrainHeight, layer));
}

TEST(CaveLayers, OpenToTheSkyHasNoCeiling) {
    const CaveLayer layer{120, 139};
    EXPECT_FALSE(layer.has_ceiling(139.5f)); // 139 is the highest block of the ground
    EXPECT_FALSE(layer.has_ceiling(140.0f));
    EXPECT_TRUE(layer.has_ceiling(140.25f)); // the block at 140 is ground
}

// Attributes: shallow and deep by depth, rocky and warped by noise alone (here: by hand).
std::unique_ptr<TerrainTables> biome_tables() {
    auto t = std::make_unique<TerrainTables>();
    t->cave_pick_key = random_key(3, 4);
    t->cave_attributes = 4;
    t->cave_attribute[0] = {{}, 1, 15, 23};
    t->cave_attribute[1] = {{}, 1, 66, 78};
    t->cave_attribute[2] = {{}, 0, 0, 1};
    t->cave_attribute[3] = {{}, 0, 1, 0}; // descending
    t->cave_biomes = 5;
    const i8 wants[5][4] = {{-1, -1, 0, 0}, {1, -1, 1, 0}, {1, -1, -1, 0}, {0, 1, 0, 1}, {0, 1, 0, -1}};
    for (u32 b = 0; b < 5; ++b)
        for (u32 a = 0; a < 4; ++a)
            t->cave_biome[b].wants[a] = wants[b][a];
    return t;
}

struct Place {
    std::unique_ptr<GroundTile> ground = std::make_unique<GroundTile>();
    std::unique_ptr<CaveTile> caves = std::make_unique<CaveTile>();
    explicit Place(u64 seed) {
        Rng rng(seed);
        for (i32 i = 0; i < kColumnCells; ++i) {
            ground->land[i] = 120 + float(rng.below(600)) * 0.1f;
            for (u32 a = 0; a < 4; ++a)
                caves->offset[a][i] = float(rng.below(1200)) * 0.001f - 0.1f;
        }
    }
};

template <int I>
void expect_picks(const TerrainTables& t, const Place& p, ColumnPos at) {
    using L = WideLanes<I>;
    for (i32 row = 0; row < 16; ++row)
        for (i32 y = -3; y < 200; ++y) {
            const auto picked = pick_cave_biome<L>(t, *p.ground, *p.caves, wide_row<L>(at, row), L::i(y));
            for (i32 l = 0; l < 16; ++l)
                ASSERT_EQ(picked[l], cave_biome_at(t, *p.ground, *p.caves, at, row * 16 + l, y))
                    << row << " " << l << " " << y;
        }
}

TEST(CaveBiomes, LanesAndSingleBlocksDrawTheSame) {
    const auto t = biome_tables();
    expect_picks<0>(*t, Place(1), {0, 0});
    expect_picks<0>(*t, Place(2), {-134217696, 134217695});
}

TEST(CaveBiomes, WeightsSumToOne) {
    const auto t = biome_tables();
    const Place p(9);
    for (i32 i = 0; i < kColumnCells; ++i)
        for (i32 y = 0; y < 160; ++y) {
            float attributes[kAttributesMost], weights[kCaveBiomesMost], sum = 0;
            cave_attributes_at<ScalarLanes>(*t, *p.ground, *p.caves, i, y, attributes);
            cave_biome_weights<ScalarLanes>(*t, attributes, weights);
            for (u32 b = 0; b < t->cave_biomes; ++b) {
                ASSERT_GE(weights[b], 0.0f);
                sum += weights[b];
            }
            ASSERT_NEAR(sum, 1.0f, 1e-5f);
        }
}

TEST(CaveBiomes, RowsThatOverlapOrLeaveGapsStillSumToOne) {
    auto t = biome_tables();
    t->cave_biome[1].wants[2] = 0; // overlaps the lush caves now
    float attributes[kAttributesMost] = {1, 0, .25f, .5f}, weights[kCaveBiomesMost];
    cave_biome_weights<ScalarLanes>(*t, attributes, weights);
    EXPECT_NEAR(weights[1], 1 / 1.75f, 1e-6f);
    EXPECT_NEAR(weights[2], .75f / 1.75f, 1e-6f);
    t->cave_biomes = 2; // nobody wants the depths: the first has them
    attributes[1] = 1;
    cave_biome_weights<ScalarLanes>(*t, attributes, weights);
    EXPECT_EQ(weights[0], 1.0f);
    EXPECT_EQ(weights[1], 0.0f);
    const Place p(4);
    EXPECT_EQ(cave_biome_at(*t, *p.ground, *p.caves, {0, 0}, 0, -100), 0u);
}

// Each biome is drawn as often as its weight says, and one of weight 0 never.
TEST(CaveBiomes, DrawnByWeight) {
    const auto t = biome_tables();
    Place p(1);
    for (i32 i = 0; i < kColumnCells; ++i) {
        p.ground->land[i] = 140;
        for (auto& offset : p.caves->offset)
            offset[i] = 0;
        p.caves->offset[2][i] = 0.4f;
        p.caves->offset[3][i] = 0.7f;
    }
    for (const i32 y : {139, 121, 120, 100, 69, 67, 30}) {
        float attributes[kAttributesMost], weights[kCaveBiomesMost];
        cave_attributes_at<ScalarLanes>(*t, *p.ground, *p.caves, 0, y, attributes);
        cave_biome_weights<ScalarLanes>(*t, attributes, weights);
        double drawn[kCaveBiomesMost] = {};
        const i32 columns = 100;
        for (i32 c = 0; c < columns; ++c)
            for (i32 i = 0; i < kColumnCells; ++i)
                drawn[cave_biome_at(*t, *p.ground, *p.caves, {c - 50, 7 - c}, i, y)] += 1.0 / (columns * kColumnCells);
        for (u32 b = 0; b < t->cave_biomes; ++b) {
            EXPECT_NEAR(drawn[b], weights[b], 0.015) << "biome " << b << " at " << y; // 4.7 deviations
            if (weights[b] == 0) {
                EXPECT_EQ(drawn[b], 0.0);
            }
        }
    }
}

// A tall cave whose floor is deep and whose ceiling is shallow: each end has the biome of its own depth.
TEST(CaveBiomes, CeilingsDoNotTakeTheFloorsBiome) {
    const auto t = biome_tables();
    Place p(1);
    for (i32 i = 0; i < kColumnCells; ++i) {
        p.ground->land[i] = 140;
        for (auto& offset : p.caves->offset)
            offset[i] = 0;
        p.caves->open[1][i] = ~0u << 8; // 40 ..
        p.caves->open[2][i] = ~0u;
        p.caves->open[3][i] = (1u << (101 - 96)) - 1; // .. 100
        CaveLayer layer;
        ASSERT_TRUE(next_cave_layer(*p.caves, i, 0, layer));
        EXPECT_EQ(cave_biome_at(*t, *p.ground, *p.caves, {2, 3}, i, layer.start), 3u);
        EXPECT_EQ(cave_biome_at(*t, *p.ground, *p.caves, {2, 3}, i, layer.end), 2u);
    }
}

} // namespace
} // namespace vitrail
