// No stripes, periods or mirror images in what stands in the real world: correlations of features and decorators less
// what is expected of them.
#include "tests/terrain/rates.h"

#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace vitrail {
namespace {

// What stands in each block column less what was expected there, and that number's variance: biomes, soils and slopes
// are gone from it, only chance is left.
struct Residue {
    i32 side = 0; // blocks
    std::vector<float> rest, variance;
    i64 cell = 1, first_x = 0, first_z = 0; // pairs in one cell are left out: a cell holds one place at most

    explicit Residue(const Area& area)
        : side(area.side * 16)
        , rest(size_t(area.blocks()))
        , variance(rest.size())
        , first_x(area.block_x(0))
        , first_z(area.block_z(0)) {}
    size_t index(i64 x, i64 z) const { return size_t((z - first_z) * side + x - first_x); }

    // Of pairs a lag apart; 0 where too few are expected to say anything.
    double sigmas(i32 lag_x, i32 lag_z) const {
        const auto cells = [&](i64 first, std::vector<i64>& of) {
            for (i32 i = 0; i < side; ++i) {
                const i64 v = first + i;
                of.push_back(v >= 0 ? v / cell : -((cell - 1 - v) / cell));
            }
        };
        std::vector<i64> cell_x, cell_z;
        cells(first_x, cell_x);
        cells(first_z, cell_z);
        double both = 0, expected = 0;
        for (i32 z = 0; z + lag_z < side; ++z) {
            const bool same_z = cell_z[size_t(z)] == cell_z[size_t(z + lag_z)];
            for (i32 x = std::max(0, -lag_x); x + std::max(lag_x, 0) < side; ++x) {
                const size_t a = size_t(z * side + x), b = size_t((z + lag_z) * side + x + lag_x);
                if (variance[a] * variance[b] == 0) continue;
                if (same_z && cell > 1 && cell_x[size_t(x)] == cell_x[size_t(x + lag_x)]) continue;
                both += double(rest[a] * rest[b]);
                expected += double(variance[a] * variance[b]);
            }
        }
        return expected > 20 ? both / std::sqrt(expected) : 0;
    }
};

Residue feature_residue(const Area& area, u32 row) {
    const FeatureOdds odds = feature_odds(area, base_terrain().features[row], row);
    Residue r(area);
    r.cell = odds.cell;
    for (i32 i = 0; i < area.blocks(); ++i) {
        const size_t at = r.index(area.block_x(i), area.block_z(i));
        const double p = odds.one[size_t(i)];
        r.rest[at] = float(-p);
        r.variance[at] = float(p * (1 - p) + (odds.second.empty() ? 0 : odds.second[size_t(i)]));
    }
    for (const Placement& p : area.placements)
        if (p.feature == row) r.rest[r.index(p.x, p.z)] += 1;
    return r;
}

// The same by cells of the feature's grid.
Residue cell_residue(const Area& area, u32 row) {
    const FeatureOdds odds = feature_odds(area, base_terrain().features[row], row);
    const CellsOf cells(area, odds.cell);
    Residue r(area);
    r.side = i32(cells.wide);
    r.first_x = r.first_z = 0;
    r.rest.assign(cells.count(), 0);
    std::vector<float> second(cells.count());
    for (i32 i = 0; i < area.blocks(); ++i) {
        const size_t c = cells.of(area.block_x(i), area.block_z(i));
        r.rest[c] -= float(odds.one[size_t(i)]);
        if (!odds.second.empty()) second[c] += float(odds.second[size_t(i)]);
    }
    r.variance.resize(cells.count());
    for (size_t c = 0; c < cells.count(); ++c)
        r.variance[c] = -r.rest[c] * (1 + r.rest[c]) + second[c];
    for (const Placement& p : area.placements)
        if (p.feature == row) r.rest[cells.of(p.x, p.z)] += 1;
    return r;
}

Residue decorator_residue(const Area& area, bool below_ground) {
    Residue r(area);
    DecoratedColumn blocks;
    for (i32 column = 0; column < area.side * area.side; ++column) {
        blocks.make(area, column);
        std::array<double, kColumnCells> chance{};
        decorator_places(area, column, blocks, [&](u32 row, i32 index, bool there) {
            const DecoratorPlace place = area.world.tables().decorator[row].place;
            const bool cave = place == DecoratorPlace::cave_floor || place == DecoratorPlace::cave_ceiling;
            if (cave != below_ground) return;
            const i32 i = column << 8 | index;
            const double p = double(base_terrain().decorators[row].chance);
            r.rest[r.index(area.block_x(i), area.block_z(i))] += float(double(there) - p);
            chance[size_t(index)] += p;
        });
        for (i32 index = 0; index < kColumnCells; ++index) {
            const i32 i = column << 8 | index;
            const double p = chance[size_t(index)]; // of one draw; floors above each other each have their own
            r.variance[r.index(area.block_x(i), area.block_z(i))] = float(below_ground ? p : p * (1 - p));
        }
    }
    return r;
}

constexpr i32 kLags = 64, kNearLags = 6;

struct Worst {
    double sigmas = 0, numbers = 0;
    std::string what;
    void look(const Residue& r, const std::string& name, i32 lag_x, i32 lag_z) {
        take(std::abs(r.sigmas(lag_x, lag_z)), fmt::format("{} at lag {},{}", name, lag_x, lag_z));
    }
    void take(double value, const std::string& name) {
        numbers += value > 0;
        if (value <= sigmas) return;
        sigmas = value;
        what = name;
    }
    // Along the axes and diagonals far, and in every direction nearby.
    void look(const Residue& r, const std::string& name) {
        for (i32 lag = 1; lag <= kLags; ++lag)
            for (const auto& [x, z] : {std::pair{1, 0}, {0, 1}, {1, 1}, {-1, 1}})
                look(r, name, lag * x, lag * z);
        for (i32 z = 1; z <= kNearLags; ++z)
            for (i32 x = -kNearLags; x <= kNearLags; ++x)
                if (x != 0 && std::abs(x) != z) look(r, name, x, z);
    }
    // Products of rare events have longer tails than normal numbers, hence the 1.2.
    double bound() const { return 1.2 * bound_of(numbers); }
};

u32 biome_row(const std::string& name) {
    const auto& list = base_terrain().biomes;
    return u32(std::find_if(list.begin(), list.end(), [&](const auto& b) { return b.name == name; }) - list.begin());
}

// Features of small cells and all decorators of a biome in its best square of a region.
void look_at(const SampledWorld& world, const Region& region, const std::string& biome, i32 side, Worst& worst) {
    const auto sites = biome_sites(world, region, side, 1);
    if (sites[biome_row(biome)].empty()) return;
    const Area area(world, sites[biome_row(biome)][0], side);
    for (u32 f = 0; f < base_terrain().features.size(); ++f) {
        const auto& feature = base_terrain().features[f];
        if (feature.cell > 10 || (feature.biome != biome && feature.place != "cave_floor")) continue;
        worst.look(feature_residue(area, f), feature.name + " in " + region.name);
        worst.look(cell_residue(area, f), "cells of " + feature.name + " in " + region.name);
    }
    worst.look(decorator_residue(area, false), "decorators of " + biome + " in " + region.name);
    worst.look(decorator_residue(area, true), "decorators below " + biome + " in " + region.name);
}

// Coordinates that lose their signs make quadrants that mirror each other: pairs of blocks that would are as unlike as
// any. Mirrors lie at 0 or between blocks.
void quadrants_are_unlike(u64 seeds, i32 side, Worst& worst) {
    constexpr int ways = 3;
    struct Pair {
        double both = 0, expected = 0;
    };
    std::map<std::array<int, 4>, Pair> pairs; // two quadrants, images of x and of z
    const auto image = [](int way, i64 v) { return way == 0 ? v : way == 1 ? -v : -1 - v; };
    for (u64 s = 0; s < seeds; ++s) {
        const SampledWorld world(statistics_seed(s));
        std::vector<Residue> outside, below;
        for (const Region& region : quadrants(side)) {
            const Area area(world, region.corner, side);
            outside.push_back(decorator_residue(area, false));
            below.push_back(decorator_residue(area, true));
        }
        const i64 size = outside[0].side;
        for (int q = 0; q < 6 * ways * ways; ++q) {
            constexpr int of[6][2] = {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}};
            const std::array<int, 4> key{of[q % 6][0], of[q % 6][1], q / 6 % ways, q / 6 / ways};
            for (const auto* all : {&outside, &below}) {
                const Residue &one = (*all)[size_t(key[0])], &other = (*all)[size_t(key[1])];
                for (i64 z = one.first_z; z < one.first_z + size; ++z) {
                    const i64 v = image(key[3], z) - other.first_z;
                    if (v < 0 || v >= size) continue;
                    for (i64 x = one.first_x; x < one.first_x + size; ++x) {
                        const i64 u = image(key[2], x) - other.first_x;
                        if (u < 0 || u >= size) continue;
                        const size_t i = one.index(x, z), j = size_t(v * size + u);
                        pairs[key].both += double(one.rest[i] * other.rest[j]);
                        pairs[key].expected += double(one.variance[i] * other.variance[j]);
                    }
                }
            }
        }
    }
    for (const auto& [key, pair] : pairs)
        if (pair.expected > 20)
            worst.take(std::abs(pair.both) / std::sqrt(pair.expected),
                       fmt::format("quadrants {} and {}, images {} and {}", key[0], key[1], key[2], key[3]));
}

TEST(TerrainStatistics, QuadrantsAreUnlike) {
    Worst worst;
    quadrants_are_unlike(kSanitized ? 1 : 3, kSanitized ? 8 : 16, worst);
    if (printing())
        fmt::print("{:.2f} sigmas ({}) of {} numbers, bound {:.2f}\n", worst.sigmas, worst.what, worst.numbers,
                   worst.bound());
    EXPECT_LT(worst.sigmas, worst.bound()) << worst.what;
    EXPECT_GE(worst.numbers, kSanitized ? 0 : 12);
}

TEST(TerrainStatistics, NothingStandsInStripesOrPeriods) {
    const SampledWorld world(statistics_seed(0));
    const auto regions = quadrants(120);
    Worst worst;
    const std::string biomes[] = {"vitrail:coral_reef", "vitrail:jungle", "vitrail:lush_birch_forest",
                                  "vitrail:tianzi_mountains"};
    for (size_t i = 0; i < (kSanitized ? 1 : 4); ++i)
        look_at(world, regions[(i + 2) % 4], biomes[i], kSanitized ? 8 : 16, worst);
    if (printing())
        fmt::print("{:.2f} sigmas ({}) of {} numbers, bound {:.2f}\n", worst.sigmas, worst.what, worst.numbers,
                   worst.bound());
    EXPECT_LT(worst.sigmas, worst.bound()) << worst.what;
    EXPECT_GE(worst.numbers, kSanitized ? 300 : 2000);
}
TEST(TerrainStatistics, NothingStandsInStripesOrPeriodsInAnyQuadrantLong) {
    if (!long_statistics()) GTEST_SKIP() << "VITRAIL_LONG is not set";
    Worst worst;
    for (u64 s = 0; s < 3; ++s) {
        const SampledWorld world(statistics_seed(s));
        auto regions = quadrants(480);
        const auto far = far_edges(480);
        regions.insert(regions.end(), far.begin(), far.end());
        for (const Region& region : regions)
            for (const std::string biome : {"vitrail:coral_reef", "vitrail:jungle", "vitrail:lush_birch_forest",
                                            "vitrail:tianzi_mountains", "vitrail:plains"})
                look_at(world, region, biome, 24, worst);
    }
    fmt::print("{:.2f} sigmas ({}) of {} numbers, bound {:.2f}\n", worst.sigmas, worst.what, worst.numbers,
               worst.bound());
    EXPECT_LT(worst.sigmas, worst.bound()) << worst.what;
}

} // namespace
} // namespace vitrail
