// The land stage: the same bits for every lane type, smooth over column borders, the same kind of land at the edge of
// the world, and held together whatever a program says.
#include "ground_tables.h"

#include "terrain/kernel/land_kernel.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace vitrail {
namespace {

using testing::small_tables;

// Columns on both sides of every axis and at all edges of the world (kWorldEdge is block 2^31 - 512).
const ColumnPos kPlaces[] = {
    {0, 0}, {-1, -1}, {1000, -70000}, {134217695, 134217695}, {-134217696, 134217690}, {-134217696, -134217696}};

void expect_same(const TerrainTables& t, const LandTile& a, const LandTile& b, const char* what) {
    for (u32 k = 0; k < t.attributes; ++k)
        EXPECT_EQ(std::memcmp(a.attribute[k], b.attribute[k], sizeof a.attribute[k]), 0) << what << " attribute " << k;
    EXPECT_EQ(std::memcmp(a.height, b.height, sizeof a.height), 0) << what;
}

TEST(Land, SameBitsForEveryLaneType) {
    const auto t = small_tables(11);
    auto one = std::make_unique<LandTile>(), other = std::make_unique<LandTile>();
    for (const ColumnPos place : kPlaces) {
        for (i32 i = 0; i < kColumnCells; ++i)
            land_row<ScalarLanes>(*t, thread_row(place, i), *one);
        for (int isa = 0; isa <= int(best_isa()); ++isa) {
            terrain_stages(Isa(isa)).land(*t, place, *other);
            expect_same(*t, *one, *other, isa == 0 ? "portable" : isa == 1 ? "AVX2" : "AVX-512");
        }
    }
}

TEST(Land, StaysInItsRange) {
    for (u64 seed = 0; seed < 4; ++seed) {
        const auto t = small_tables(seed);
        auto tile = std::make_unique<LandTile>();
        for (i32 i = 0; i < 200; ++i) {
            terrain_stages(best_isa()).land(*t, {i * 37 - 3000, i * 53 - 2000}, *tile);
            for (i32 k = 0; k < kColumnCells; ++k) {
                ASSERT_GE(tile->height[k], kLandLowest);
                ASSERT_LE(tile->height[k], kLandHighest);
                for (u32 a = 0; a < t->attributes; ++a) {
                    ASSERT_GE(tile->attribute[a][k], 0.0f);
                    ASSERT_LE(tile->attribute[a][k], 1.0f);
                }
            }
        }
    }
}

// The same block seen from the anchors of both columns at a border: what a column computes goes on where the next
// begins.
TEST(Land, ContinuousOverColumnBorders) {
    const auto t = small_tables(5);
    double most = 0, sum = 0;
    int count = 0;
    for (const ColumnPos place : {ColumnPos{0, 0}, ColumnPos{134210000, -134210000}})
        for (i32 i = 0; i < 2000; ++i) {
            const ColumnPos at{place.x - i * 3, place.z + i * 5}, next_x{at.x + 1, at.z}, next_z{at.x, at.z + 1};
            for (i32 k = 0; k < 16; k += 5) {
                Row<ScalarLanes> beyond_x = thread_row(at, k << 4), beyond_z = thread_row(at, k);
                beyond_x.dx = 16;
                beyond_z.dz = 16;
                const auto height = [&](const Row<ScalarLanes>& row) {
                    float attribute[kAttributesMost];
                    surface_attributes<ScalarLanes>(*t, row, attribute);
                    return land_height<ScalarLanes>(*t, row, attribute);
                };
                for (const double d : {std::abs(height(beyond_x) - height(thread_row(next_x, k << 4))),
                                       std::abs(height(beyond_z) - height(thread_row(next_z, k)))}) {
                    most = std::max(most, d);
                    sum += d;
                    ++count;
                }
            }
        }
    EXPECT_LT(sum / count, 1e-4);
    EXPECT_LT(most, .02);
}

// Mean steps between neighbors, and steps of steps, that a loss of detail would show in first.
struct Steps {
    double sum = 0;
    int count = 0;
    void add(float a, float b) {
        sum += std::abs(double(a) - b);
        ++count;
    }
    double mean() const { return sum / count; }
};
struct Roughness {
    Steps first, second;
};
Roughness roughness_at(const TerrainTables& t, ColumnPos middle, i32 tiles) {
    Roughness r;
    auto tile = std::make_unique<LandTile>();
    for (i32 i = 0; i < tiles; ++i) {
        // Far apart, so that a few mountains do not decide it.
        terrain_stages(best_isa()).land(t, {middle.x - i * 41, middle.z - (i * i) % 977}, *tile);
        for (i32 z = 0; z < 16; ++z)
            for (i32 x = 1; x < 15; ++x) {
                const float* h = tile->height + (z << 4 | x);
                r.first.add(h[0], h[1]);
                r.second.add(h[-1] + h[1], 2 * h[0]);
            }
    }
    return r;
}

TEST(Land, AsRoughAtTheEdgeOfTheWorldAsAtTheOrigin) {
    const auto t = small_tables(6);
    const Roughness origin = roughness_at(*t, {0, 0}, 1500);
    for (const ColumnPos place :
         {ColumnPos{134217600, 134217600}, ColumnPos{-134100000, 134217600}, ColumnPos{134217600, -134100000}}) {
        const Roughness far = roughness_at(*t, place, 1500);
        EXPECT_NEAR(far.first.mean() / origin.first.mean(), 1.0, .2);
        EXPECT_NEAR(far.second.mean() / origin.second.mean(), 1.0, .2);
    }
}

TEST(Land, TheClampTakesEverything) {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    EXPECT_EQ(held_between<ScalarLanes>(nan, 4, 380), 4.0f);
    EXPECT_EQ(held_between<ScalarLanes>(-inf, 4, 380), 4.0f);
    EXPECT_EQ(held_between<ScalarLanes>(inf, 4, 380), 380.0f);
    EXPECT_EQ(held_between<ScalarLanes>(5.5f, 4, 380), 5.5f);
}

TEST(Land, NothingThatAProgramSaysEscapesTheRange) {
    const float inf = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    for (const float bad : {nan, inf, -inf, 3e38f}) {
        auto t = small_tables(2);
        // The last instruction slot stands for any program that went wrong.
        t->instruction[kInstructionsMost - 1] = {Op::constant, 0, 0, 0, 0, 0, 0, bad};
        const Program broken{u16(kInstructionsMost - 1), 1};
        for (int which = 0; which < 3; ++which) {
            auto with = std::make_unique<TerrainTables>(*t);
            if (which == 0) with->warp_x = broken;
            if (which == 1) with->field[1] = broken;
            if (which == 2) with->biome[3].height = broken;
            auto wide = std::make_unique<LandTile>(), one = std::make_unique<LandTile>();
            for (const ColumnPos place : kPlaces) {
                terrain_stages(best_isa()).land(*with, place, *wide);
                for (i32 i = 0; i < kColumnCells; ++i)
                    land_row<ScalarLanes>(*with, thread_row(place, i), *one);
                expect_same(*with, *one, *wide, "broken program");
                for (const float h : wide->height)
                    ASSERT_TRUE(h >= kLandLowest && h <= kLandHighest) << h;
            }
        }
    }
}

// A biome that is broken must not show where it has no weight, not even in another lane of the same row.
TEST(Land, ABrokenBiomeStaysAtHome) {
    const auto t = small_tables(2);
    auto with = std::make_unique<TerrainTables>(*t);
    with->instruction[kInstructionsMost - 1] = {
        Op::constant, 0, 0, 0, 0, 0, 0, std::numeric_limits<float>::quiet_NaN()};
    with->biome[7].height = {u16(kInstructionsMost - 1), 1};
    auto good = std::make_unique<LandTile>(), bad = std::make_unique<LandTile>();
    int touched = 0, mixed_rows = 0;
    for (i32 i = 0; i < 2000; ++i) {
        const ColumnPos at{i * 3 - 3000, i};
        terrain_stages(best_isa()).land(*t, at, *good);
        terrain_stages(best_isa()).land(*with, at, *bad);
        for (i32 z = 0; z < 16; ++z) {
            int of_row = 0;
            for (i32 k = z * 16; k < z * 16 + 16; ++k) {
                float a[kAttributesMost];
                load_attributes<ScalarLanes>(*t, *good, k, a);
                if (surface_weight<ScalarLanes>(*t, 7, a) > 0)
                    ++of_row;
                else
                    ASSERT_EQ(good->height[k], bad->height[k]);
            }
            touched += of_row;
            mixed_rows += of_row > 0 && of_row < 16;
        }
    }
    EXPECT_GT(touched, 0);
    EXPECT_GT(mixed_rows, 0);
}

} // namespace
} // namespace vitrail
