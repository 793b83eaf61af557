// Cave fields and open blocks: the same bits for every lane type, the same as a plain evaluation of the formulas,
// without seams, away from water, and as much of them as the design says.
#include "tests/terrain/base_terrain.h"

#include "terrain/compile/compile.h"
#include "terrain/cpu/stages.h"
#include "terrain/kernel/cave_biome_kernel.h"
#include "terrain/kernel/cave_kernel.h"
#include "terrain/kernel/cave_layers.h"

#include "base/rng.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>
#include <vector>

namespace vitrail {
namespace {

const TerrainTables& tables(u64 seed = 11) {
    static std::map<u64, CompiledTerrain> made;
    auto& one = made[seed];
    if (!one.tables) {
        auto compiled = compile_terrain(base_terrain(), seed);
        if (!compiled) throw std::runtime_error(compiled.error().message);
        one = std::move(*compiled);
    }
    return *one.tables;
}

// Both sides of every axis and all edges of the world.
const ColumnPos kPlaces[] = {
    {0, 0}, {-1, -1}, {1000, -70000}, {134217694, 134217694}, {-134217696, 134217690}, {-134217696, -134217696}};

// A column's lattices and caves over flat or given ground.
struct Column {
    ColumnPos at;
    std::unique_ptr<LatticeTile[]> lattice = std::make_unique<LatticeTile[]>(4);
    const LatticeTile* lattices[4] = {&lattice[0], &lattice[1], &lattice[2], &lattice[3]};
    std::unique_ptr<GroundTile> ground = std::make_unique<GroundTile>();
    std::unique_ptr<CaveTile> caves = std::make_unique<CaveTile>();

    Column(const TerrainTables& t, ColumnPos where, Isa isa = best_isa())
        : at(where) {
        for (i32 i = 0; i < 4; ++i)
            terrain_stages(isa).lattice(t, {at.x + (i & 1), at.z + (i >> 1)}, lattice[i]);
        flat(141.5f);
    }
    void flat(float top) {
        for (i32 i = 0; i < kColumnCells; ++i)
            ground->top[i] = ground->land[i] = top;
    }
    // Slopes and steps at heights from 90 to 230, some below the sea, the ocean from 0 to 1.
    void rough(const TerrainTables& t, u64 seed) {
        Rng rng(seed);
        const float base = 95 + rng.unit() * 80, slope = rng.unit() * 3 - 1.5f, across = rng.unit() * 3 - 1.5f;
        const float cliff = rng.below(2) ? 40.0f : 0.0f;
        const i32 edge = i32(rng.below(16));
        for (i32 i = 0; i < kColumnCells; ++i) {
            const i32 x = i & 15, z = i >> 4;
            ground->top[i] =
                base + slope * float(x) + across * float(z) + (x + z / 2 > edge ? cliff : 0.0f) + rng.unit() * 3;
            ground->land[i] = ground->top[i] + rng.unit() * 4;
            for (u32 a = 0; a < t.attributes; ++a)
                ground->attribute[a][i] = rng.below(3) == 0 ? rng.unit() : 0.0f;
        }
    }
    // As the caves see it: the least of the block column and those beside it, the slope going on beyond the tile.
    double lowest(i32 x, i32 z) const {
        const auto top = [&](i32 u, i32 v) { return double(ground->top[u | v << 4]); };
        double least = top(x, z);
        for (i32 d = -1; d <= 1; d += 2) {
            least = std::min(least, x + d < 0 || x + d > 15 ? 2 * top(x, z) - top(x - d, z) : top(x + d, z));
            least = std::min(least, z + d < 0 || z + d > 15 ? 2 * top(x, z) - top(x, z - d) : top(x, z + d));
        }
        return least;
    }
    void carve(const TerrainTables& t, Isa isa = best_isa()) {
        terrain_stages(isa).caves(t, at, *ground, lattices, *caves);
    }
    bool open(i32 x, i32 y, i32 z) const { return cave_open(*caves, x | z << 4, y); }
};

TEST(Caves, SameBitsForEveryLaneType) {
    const TerrainTables& t = tables();
    for (const ColumnPos place : kPlaces) {
        Column c(t, place);
        auto one = std::make_unique<LatticeTile>();
        for (i32 level = 0; level < kLatticeLevels; ++level)
            for (i32 point = 0; point < 16; ++point)
                lattice_level<ScalarLanes>(t, thread_point(place, point), level, *one);
        c.rough(t, u64(place.x));
        auto carved = std::make_unique<CaveTile>();
        std::memset(carved.get(), 0, sizeof *carved);
        for (i32 i = 0; i < kColumnCells; ++i) // every level is looked at, unlike the stage's
            cave_row<ScalarLanes>(t, *c.ground, c.lattices, thread_row(place, i), ~u64(0), *carved);
        for (int isa = 0; isa <= int(best_isa()); ++isa) {
            auto other = std::make_unique<LatticeTile>();
            terrain_stages(Isa(isa)).lattice(t, place, *other);
            EXPECT_EQ(std::memcmp(other.get(), one.get(), sizeof *one), 0) << isa;
            std::memset(c.caves.get(), 0, sizeof *c.caves);
            c.carve(t, Isa(isa));
            EXPECT_EQ(std::memcmp(c.caves.get(), carved.get(), sizeof *carved), 0) << isa;
        }
    }
}

double step(double a, double b, double v) {
    const double s = std::min(1.0, std::max(0.0, (v - a) / (b - a)));
    return s * s * (3 - 2 * s);
}

// Straight from the formulas, in double, at every block and without anything skipped.
TEST(Caves, AgainstAPlainEvaluation) {
    const TerrainTables& t = tables();
    const auto at = [](const LatticeTile* const l[4], bool width, i32 level, i32 px, i32 pz) {
        const LatticeTile& tile = *l[(px == 4) + 2 * (pz == 4)];
        return double((width ? tile.width : tile.closeness)[level][(px & 3) | (pz & 3) << 2]);
    };
    u64 open = 0, wrong = 0, checked = 0;
    for (i32 k = 0; k < 24; ++k) {
        Column c(t, {k * 911 - 9000, 500 - k * 77});
        c.rough(t, u64(k));
        c.carve(t);
        for (i32 i = 0; i < kColumnCells; ++i) {
            const i32 x = i & 15, z = i >> 4;
            const double top = c.ground->top[i], ocean = c.ground->attribute[t.ocean][i];
            const double low = c.lowest(x, z);
            const bool dry = low >= 132;
            const Row<ScalarLanes> row = thread_row(c.at, i);
            const auto ravine = ravine_span<ScalarLanes>(t, row, dry ? float(ocean) : 1.0f, float(top));
            const Noise n = t.ravine_depth;
            const double mouth = 44 * step(.25, .5, fractal2<ScalarLanes>(t.octave + n.first, n.octaves, row.spot(0)));
            for (i32 y = 0; y < kTerrainHeight; ++y) {
                bool want = false, close = false;
                if (y < 144) {
                    double f[2];
                    for (i32 w = 0; w < 2; ++w) {
                        double sum = 0;
                        for (i32 corner = 0; corner < 8; ++corner) {
                            const i32 cx = corner & 1, cy = corner >> 1 & 1, cz = corner >> 2;
                            const double fx = (x & 3) * .25, fy = (y & 3) * .25, fz = (z & 3) * .25;
                            const double part = (cx ? fx : 1 - fx) * (cy ? fy : 1 - fy) * (cz ? fz : 1 - fz);
                            sum += part * at(c.lattices, w != 0, y / 4 + cy, x / 4 + cx, z / 4 + cz);
                        }
                        f[w] = sum;
                    }
                    const double theta = f[1] * step(142, 95, y + 50 * ocean - mouth) * (.3 + .7 * step(5, 20, y));
                    want = theta > .07 && f[0] < theta;
                    close = std::fabs(theta - .07) < 1e-4 || std::fabs(f[0] - theta) < 1e-4;
                }
                want = want || (y >= std::floor(ravine.low) && y < std::floor(ravine.high));
                want = want && y >= 1 && (dry ? y < top : y < low - 8);
                const bool got = c.open(x, y, z);
                open += got;
                ++checked;
                if (!close) wrong += got != want;
            }
        }
    }
    EXPECT_EQ(wrong, 0u);
    EXPECT_GT(open, checked / 200);
}

// Fields anchored at two columns describe one space, and interpolation stays near what it stands for.
TEST(Caves, FieldsAreContinuousAndInterpolatedWell) {
    const TerrainTables& t = tables();
    Rng rng(3);
    double sum = 0, most = 0, seam = 0;
    i32 differ = 0, count = 0;
    for (i32 k = 0; k < 60; ++k) {
        const ColumnPos at{i32(rng.below(1u << 20)) - (1 << 19), i32(rng.below(1u << 20)) - (1 << 19)};
        Column c(t, at);
        const float z = float(rng.below(16)), y = float(rng.below(144));
        float c0, w0, c1, w1;
        cave_fields<ScalarLanes>(t, {at.x * 16, at.z * 16, 16, y, z}, c0, w0);
        cave_fields<ScalarLanes>(t, {at.x * 16 + 16, at.z * 16, 0, y, z}, c1, w1);
        if (c0 < 1) seam = std::max(seam, double(std::fabs(c0 - c1)));
        seam = std::max(seam, double(std::fabs(w0 - w1)));
        for (i32 i = 0; i < 100; ++i) {
            const Row<ScalarLanes> row = thread_row(at, i32(rng.below(256)));
            const i32 by = i32(rng.below(144));
            float near_c, near_w, far_c, far_w, exact_c, exact_w;
            cave_fields_row<ScalarLanes>(c.lattices, row, by / 4, near_c, near_w);
            cave_fields_row<ScalarLanes>(c.lattices, row, by / 4 + 1, far_c, far_w);
            const float f = float(by % 4) * .25f, got_c = near_c + (far_c - near_c) * f,
                        got_w = near_w + (far_w - near_w) * f;
            cave_fields<ScalarLanes>(t, row.spot(float(by)), exact_c, exact_w);
            differ += (got_c < got_w) != (exact_c < exact_w);
            const double error = std::fabs(std::min(got_c, 1.0f) - std::min(exact_c, 1.0f));
            sum += error;
            most = std::max(most, error);
            EXPECT_NEAR(got_w, exact_w, 0.06f);
            ++count;
        }
    }
    RecordProperty("mean_error", std::to_string(sum / count));
    RecordProperty("largest_error", std::to_string(most));
    RecordProperty("blocks_that_differ_percent", std::to_string(100.0 * differ / count));
    EXPECT_LT(seam, 2e-3);
    EXPECT_LT(sum / count, 0.03);
    EXPECT_LT(double(differ) / count, 0.03); // of blocks: their state is another than without interpolation
}

// Open next to closed as often across borders of columns as within them, along both axes.
TEST(Caves, NoWallsAtBorders) {
    const TerrainTables& t = tables();
    const i32 n = 14;
    std::vector<Column> columns;
    for (i32 i = 0; i < n * n; ++i) {
        columns.emplace_back(t, ColumnPos{i % n * 1 - 7, i / n + 3000});
        columns.back().carve(t);
    }
    const auto open = [&](i32 x, i32 y, i32 z) {
        return columns[size_t((z >> 4) * n + (x >> 4))].open(x & 15, y, z & 15);
    };
    double changes[2][16] = {}; // axis, place in the column
    for (i32 y = 5; y < 140; ++y)
        for (i32 v = 0; v < n * 16; ++v)
            for (i32 u = 1; u < n * 16; ++u) {
                changes[0][u & 15] += open(u, y, v) != open(u - 1, y, v);
                changes[1][u & 15] += open(v, y, u) != open(v, y, u - 1);
            }
    for (auto& axis : changes) {
        double mean = 0;
        for (i32 i = 1; i < 16; ++i)
            mean += axis[i] / n / 15;
        const double border = axis[0] / (n - 1);
        EXPECT_NEAR(border / mean, 1.0, 0.15);
        EXPECT_GT(mean, 100.0);
    }
}

TEST(Caves, KeepARoofUnderWaterAndBedrockBelow) {
    const TerrainTables& t = tables();
    u64 open = 0, breached = 0;
    for (i32 k = 0; k < 40; ++k) {
        Column c(t, {k * 37, -k * 91});
        c.rough(t, u64(k) + 100);
        c.carve(t);
        for (i32 i = 0; i < kColumnCells; ++i) {
            const i32 x = i & 15, z = i >> 4;
            const float top = c.ground->top[i];
            EXPECT_FALSE(c.open(x, 0, z));
            for (i32 y = 1; y < kTerrainHeight; ++y) {
                if (!c.open(x, y, z)) continue;
                ++open;
                ASSERT_LT(float(y), top);
                if (top >= float(kTerrainSeaLevel) + 4 && float(y + 1) >= top) ++breached;
                for (const i32 side : {0, -1, 1, -2, 2}) { // itself and the four beside it
                    const i32 u = x + side % 2, v = z + side / 2;
                    if (u < 0 || v < 0 || u > 15 || v > 15) continue;
                    const float beside = c.ground->top[u | v << 4];
                    if (beside < float(kTerrainSeaLevel) + 4) {
                        ASSERT_LT(float(y), beside - 8) << "beside or under water";
                    }
                }
            }
        }
    }
    EXPECT_GT(open, 1000u);
    EXPECT_GT(breached, 0u); // but dry land opens here and there
}

struct Shares {
    double by_depth[10] = {}, surface = 0;
};
Shares shares(const TerrainTables& t, i32 columns, u64 seed, i32 far) {
    Shares out;
    Rng rng(seed);
    for (i32 k = 0; k < columns; ++k) {
        const auto place = [&] { return far ? far - i32(rng.below(30000)) : i32(rng.below(1u << 17)) - (1 << 16); };
        Column c(t, {place(), place()});
        c.carve(t);
        for (i32 i = 0; i < kColumnCells; ++i) {
            for (i32 y = 0; y < 160; ++y)
                out.by_depth[y / 16] += double(c.open(i & 15, y, i >> 4)) / (columns * 256.0 * 16);
            out.surface += double(c.open(i & 15, 141, i >> 4)) / (columns * 256.0);
        }
    }
    return out;
}

// About a tenth of the rock from y 16 to 112 is open, less above and below; land at 141 is open in one place of a
// hundred.
TEST(Caves, ShareOfOpenBlocksByDepth) {
    for (const i32 far : {0, 134217690}) {
        const Shares s = shares(tables(), 500, 17, far);
        for (i32 i = 1; i < 7; ++i) {
            EXPECT_GT(s.by_depth[i], 0.03) << "y " << i * 16 << " far " << far;
            EXPECT_LT(s.by_depth[i], 0.14) << "y " << i * 16 << " far " << far;
        }
        EXPECT_LT(s.by_depth[0], 0.06);
        EXPECT_LT(s.by_depth[8], 0.06);
        EXPECT_EQ(s.by_depth[9], 0.0);
        EXPECT_GT(s.surface, 0.003);
        EXPECT_LT(s.surface, 0.05);
    }
}

// Depth of the ravine at a block column, blocks.
float ravine_depth(const TerrainTables& t, ColumnPos at, i32 x, i32 z) {
    const auto r = ravine_span<ScalarLanes>(t, thread_row(at, x | z << 4), 0.0f, 400.0f);
    return std::max(0.0f, r.high - r.low);
}

// Ravines take a few places of a hundred near the origin and at the world's edge, and their walls do not step at
// borders more than within columns: what wraps or is anchored by column does not show.
TEST(Caves, RavinesGoOnOverBorders) {
    const TerrainTables& t = tables();
    for (const i32 far : {0, 134217600, -134217600}) {
        Rng rng(9);
        double steps[2] = {}, depth = 0;
        i32 counts[2] = {}, deep = 0, count = 0;
        for (i32 k = 0; k < 1500; ++k) {
            const ColumnPos at{far + i32(rng.below(4000)) - 2000 * (far == 0), far / 2 + i32(rng.below(4000))};
            if (ravine_depth(t, at, 8, 8) == 0 && ravine_depth(t, at, 15, 15) == 0 && rng.below(8) != 0) continue;
            for (i32 z = 0; z < 16; ++z)
                for (i32 x = 0; x < 16; ++x) {
                    const float own = ravine_depth(t, at, x, z);
                    const ColumnPos east{at.x + (x == 15), at.z}, south{at.x, at.z + (z == 15)};
                    steps[x == 15] += std::fabs(double(own - ravine_depth(t, east, (x + 1) & 15, z)));
                    ++counts[x == 15];
                    steps[z == 15] += std::fabs(double(own - ravine_depth(t, south, x, (z + 1) & 15)));
                    ++counts[z == 15];
                    depth = std::max(depth, double(own));
                }
        }
        for (i32 k = 0; k < 20000; ++k) {
            deep += ravine_depth(t, {far + i32(rng.below(9000)), i32(rng.below(9000))}, i32(rng.below(16)),
                                 i32(rng.below(16))) > 8;
            ++count;
        }
        EXPECT_NEAR((steps[1] / counts[1]) / (steps[0] / counts[0]), 1.0, 0.2) << far;
        EXPECT_GT(depth, 50) << far;
        EXPECT_LT(depth, 90) << far;
        EXPECT_GT(double(deep) / count, 0.004) << far;
        EXPECT_LT(double(deep) / count, 0.03) << far;
    }
}

TEST(Caves, EveryCaveBiomeOccurs) {
    const TerrainTables& t = tables();
    std::vector<u64> floors(t.cave_biomes), ceilings(t.cave_biomes);
    auto lands = std::make_unique<LandTile[]>(169);
    const LandTile* land[169];
    Rng rng(23);
    for (i32 k = 0; k < 60; ++k) {
        Column c(t, {i32(rng.below(2000)) - 1000, i32(rng.below(2000)) - 1000});
        terrain_stages(best_isa())
            .land(t, c.at, lands[0]); // the same land all around: what erodes does not matter here
        for (auto& l : land)
            l = &lands[0];
        terrain_stages(best_isa()).ground(t, c.at, 1, 1, land, c.ground.get());
        c.carve(t);
        for (i32 i = 0; i < kColumnCells; ++i) {
            CaveLayer layer;
            for (i32 y = 0; next_cave_layer(*c.caves, i, y, layer); y = layer.end + 2) {
                ++floors[cave_biome_at(t, *c.ground, *c.caves, c.at, i, layer.start)];
                if (layer.has_ceiling(c.ground->top[i]))
                    ++ceilings[cave_biome_at(t, *c.ground, *c.caves, c.at, i, layer.end)];
            }
        }
    }
    for (u32 b = 0; b < t.cave_biomes; ++b) {
        EXPECT_GT(floors[b], 100u) << b;
        EXPECT_GT(ceilings[b], 100u) << b;
    }
}

} // namespace
} // namespace vitrail
