// Weights of biomes: they sum to 1, draws follow them, and lanes agree with threads.
#include "base_terrain.h"
#include "ground_tables.h"

#include "terrain/compile/compile.h"
#include "terrain/kernel/biome_kernel.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <random>

namespace vitrail {
namespace {

using testing::small_tables;
using Wide = WideLanes<-1>;

// Attributes as the world has them: mostly settled at 0 or 1, sometimes in between.
struct RandomAttributes {
    std::mt19937 random{7};
    void next(float* attribute, u32 count) {
        std::uniform_real_distribution<float> unit(0, 1);
        for (u32 i = 0; i < count; ++i) {
            const float kind = unit(random);
            attribute[i] = kind < .3f ? 0.0f : kind < .6f ? 1.0f : unit(random);
        }
    }
};

TEST(BiomeWeight, SumToOneWhereRowsTellEachOtherApart) {
    const auto t = small_tables(1);
    RandomAttributes attributes;
    for (int i = 0; i < 10000; ++i) {
        float a[kAttributesMost];
        attributes.next(a, t->attributes);
        double sum = 0;
        for (u32 b = 0; b < t->biomes; ++b) {
            const float w = surface_weight<ScalarLanes>(*t, b, a);
            ASSERT_GE(w, 0.0f);
            ASSERT_LE(w, 1.0f);
            double expected = 1;
            for (u32 k = 0; k < t->attributes; ++k)
                expected *= t->biome[b].wants[k] > 0 ? a[k] : 1.0 - a[k];
            ASSERT_NEAR(w, expected, 1e-6);
            sum += w;
        }
        ASSERT_NEAR(sum, 1.0, 1e-6);
        ASSERT_NEAR(surface_weight_sum<ScalarLanes>(*t, a), 1.0f, 1e-6f);
    }
}

TEST(BiomeWeight, SumToOneInTheBaseContent) {
    const auto compiled = compile_terrain(base_terrain(), 1);
    ASSERT_TRUE(compiled) << compiled.error().message;
    const TerrainTables& t = *compiled->tables;
    RandomAttributes attributes;
    for (int i = 0; i < 100000; ++i) {
        float a[kAttributesMost];
        attributes.next(a, kAttributesMost);
        ASSERT_NEAR(surface_weight_sum<ScalarLanes>(t, a), 1.0f, 1e-6f);
        ASSERT_NEAR(cave_weight_sum<ScalarLanes>(t, a), 1.0f, 1e-6f);
    }
}

// Skipping must leave out exactly those of weight 0, whatever the wants and attributes.
TEST(BiomeWeight, WeightlessMeansAFactorOfZero) {
    std::mt19937 random(3);
    RandomAttributes attributes;
    int some = 0, none = 0;
    for (int i = 0; i < 100000; ++i) {
        i8 wants[kAttributesMost];
        for (i8& w : wants)
            w = i8(int(random() % 3) - 1);
        float a[kAttributesMost];
        attributes.next(a, kAttributesMost);
        const u32 count = 1 + random() % kAttributesMost;
        for (u32 k = count; k < kAttributesMost; ++k)
            wants[k] = 0;
        const bool skipped = weightless(wants, settled_attributes<ScalarLanes>(count, a));
        ASSERT_EQ(skipped, wants_weight<ScalarLanes>(wants, count, a) == 0.0f);
        ++(skipped ? none : some);
    }
    EXPECT_GT(some, 1000);
    EXPECT_GT(none, 1000);
    // All lanes must agree: 15 zeros and a half are not settled.
    FloatLanes lanes = {};
    EXPECT_EQ(settled_attributes<Wide>(1, &lanes).none, 1u);
    lanes[11] = .5f;
    EXPECT_EQ(settled_attributes<Wide>(1, &lanes).none, 0u);
    lanes = Wide::f(1.0f);
    EXPECT_EQ(settled_attributes<Wide>(1, &lanes).full, 0x80u);
    lanes[15] = .5f;
    EXPECT_EQ(settled_attributes<Wide>(1, &lanes).full, 0u);
}

TEST(BiomeWeight, AnyIsNoFactor) {
    const i8 wants[kAttributesMost] = {1, 0, -1, 0, 0, 0, 0, 0};
    const float a[3] = {.25f, .9f, .5f};
    EXPECT_EQ(wants_weight<ScalarLanes>(wants, 3, a), .125f);
    EXPECT_EQ(wants_weight<ScalarLanes>(wants, 1, a), .25f);
    EXPECT_EQ(wants_weight<ScalarLanes>(wants, 0, a), 1.0f);
}

// A modder's row that overlaps the others takes its share of the sum, nobody's weight is lost.
TEST(BiomeWeight, DrawsFollowTheSharesEvenWhereRowsOverlap) {
    auto t = small_tables(1);
    for (i8& w : t->biome[t->biomes].wants)
        w = 0;
    t->biome[t->biomes].wants[0] = 1;
    ++t->biomes;
    const float a[3] = {.7f, .4f, .1f};
    const float sum = surface_weight_sum<ScalarLanes>(*t, a);
    EXPECT_NEAR(sum, 1.7f, 1e-5f);
    constexpr int kDraws = 1 << 18;
    std::vector<int> counts(t->biomes);
    for (int i = 0; i < kDraws; ++i)
        ++counts[pick_biome<ScalarLanes>(*t, a, (float(i) + .5f) / kDraws)];
    // Evenly spaced numbers: each biome's count is its share to within one draw and rounding.
    for (u32 b = 0; b < t->biomes; ++b)
        EXPECT_NEAR(counts[b], surface_weight<ScalarLanes>(*t, b, a) / sum * kDraws, 3) << b;
}

TEST(BiomeWeight, NothingWithoutWeightIsEverDrawn) {
    const auto t = small_tables(1);
    RandomAttributes attributes;
    std::uniform_real_distribution<float> unit(0, 1);
    for (int i = 0; i < 100000; ++i) {
        float a[kAttributesMost];
        attributes.next(a, t->attributes);
        const float edges[] = {0.0f, unit(attributes.random) * .99999f, 16777215.0f / 16777216.0f};
        for (const float u : edges) {
            const u32 b = pick_biome<ScalarLanes>(*t, a, u);
            ASSERT_LT(b, t->biomes);
            ASSERT_GT(surface_weight<ScalarLanes>(*t, b, a), 0.0f);
        }
        const u32 best = strongest_biome<ScalarLanes>(*t, a);
        for (u32 b = 0; b < t->biomes; ++b)
            ASSERT_LE(surface_weight<ScalarLanes>(*t, b, a), surface_weight<ScalarLanes>(*t, best, a));
    }
}

TEST(BiomeWeight, NaNAndNoWeightsAreHarmless) {
    const auto t = small_tables(1);
    const float bad = std::numeric_limits<float>::quiet_NaN();
    const float a[3] = {bad, bad, bad};
    EXPECT_EQ(pick_biome<ScalarLanes>(*t, a, .5f), 0u);
    EXPECT_EQ(strongest_biome<ScalarLanes>(*t, a), 0u);
    auto empty = small_tables(1);
    empty->biomes = 0;
    const float ok[3] = {1, 1, 1};
    EXPECT_EQ(pick_biome<ScalarLanes>(*empty, ok, .5f), 0u);
    EXPECT_EQ(surface_weight_sum<ScalarLanes>(*empty, ok), 0.0f);
}

TEST(BiomeWeight, CaveBiomesLikewise) {
    auto t = small_tables(1);
    t->cave_attributes = 2;
    t->cave_biomes = 3;
    const i8 wants[3][2] = {{-1, 0}, {1, 1}, {1, -1}};
    for (int b = 0; b < 3; ++b)
        std::memcpy(t->cave_biome[b].wants, wants[b], 2);
    const float a[2] = {.75f, .25f};
    EXPECT_EQ(cave_weight<ScalarLanes>(*t, 0, a), .25f);
    EXPECT_EQ(cave_weight<ScalarLanes>(*t, 1, a), .1875f);
    EXPECT_EQ(cave_weight<ScalarLanes>(*t, 2, a), .5625f);
    EXPECT_EQ(cave_weight_sum<ScalarLanes>(*t, a), 1.0f);
    EXPECT_EQ(pick_cave_biome<ScalarLanes>(*t, a, .24f), 0u);
    EXPECT_EQ(pick_cave_biome<ScalarLanes>(*t, a, .26f), 1u);
    EXPECT_EQ(pick_cave_biome<ScalarLanes>(*t, a, .99f), 2u);
    EXPECT_EQ(strongest_cave_biome<ScalarLanes>(*t, a), 2u);
}

TEST(BiomeWeight, LanesDrawWhatThreadsDraw) {
    const auto t = small_tables(3);
    RandomAttributes attributes;
    auto tile = std::make_unique<GroundTile>();
    for (const ColumnPos at : {ColumnPos{0, 0}, ColumnPos{-5, 17}, ColumnPos{134217694, -134217696}}) {
        for (int i = 0; i < kColumnCells; ++i) {
            float a[kAttributesMost];
            attributes.next(a, t->attributes);
            for (u32 k = 0; k < t->attributes; ++k)
                tile->attribute[k][i] = a[k];
        }
        u32 wide[kColumnCells];
        for (i32 row = 0; row < 16; ++row)
            Wide::store(wide + row * 16, surface_biome_row<Wide>(*t, *tile, wide_row<Wide>(at, row)));
        for (i32 i = 0; i < kColumnCells; ++i)
            ASSERT_EQ(wide[i], surface_biome_row<ScalarLanes>(*t, *tile, thread_row(at, i)));
    }
}

} // namespace
} // namespace vitrail
