// The base game's world as a whole, over fixed seeds: every biome within 16 km, layers as thick as they are described,
// cave biomes at their depths, and no stripes or periods in what stands on the ground.
#include "tests/terrain/rates.h"

#include "terrain/cpu/noise_rows.h"
#include "terrain/kernel/cave_biome_kernel.h"

#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>

namespace vitrail {
namespace {

bool printing() {
    return long_statistics() || std::getenv("VITRAIL_PRINT") != nullptr;
}

// Within how many standard deviations all of so many normal numbers lie, but for one time in a thousand.
double bound_of(double numbers) {
    double low = 1, high = 12;
    for (int i = 0; i < 60; ++i) {
        const double mid = (low + high) / 2;
        (std::erfc(mid / std::sqrt(2.0)) * numbers > 1e-3 ? low : high) = mid;
    }
    return high;
}

// Mean and its standard deviation from equal, independent samples.
struct Samples {
    double count = 0, sum = 0, squares = 0;
    void add(double v) {
        ++count;
        sum += v;
        squares += v * v;
    }
    double mean() const { return sum / count; }
    double deviation() const { return std::sqrt(std::max(0.0, squares / count - mean() * mean())); }
    double error() const { return deviation() / std::sqrt(count - 1); }
};

// Shares of 16 km around the origin (8 km each way): seeds * quadrants * biomes, by which biome is strongest.
void biomes_occur(u64 seeds, i32 spacing) {
    const i32 side = 512; // columns a quadrant
    const auto regions = quadrants(side);
    const u32 biomes = u32(base_terrain().biomes.size());
    std::vector<Samples> total(biomes);
    std::vector<std::array<Samples, 4>> by_quadrant(biomes);
    std::vector<double> least(biomes, 1);
    for (u64 s = 0; s < seeds; ++s) {
        const SampledWorld world(statistics_seed(s));
        std::vector<std::array<double, 4>> share(biomes);
        for (size_t q = 0; q < 4; ++q) {
            double samples = 0, shares[kBiomesMost];
            std::vector<double> found(biomes);
            for (i32 z = spacing / 2; z < side; z += spacing)
                for (i32 x = spacing / 2; x < side; x += spacing) {
                    const LandTile tile = world.land({regions[q].corner.x + x, regions[q].corner.z + z});
                    for (const i32 index : {0, 15, 240, 255}) {
                        surface_shares(world.tables(), tile, index, shares);
                        ++found[size_t(std::max_element(shares, shares + biomes) - shares)];
                        ++samples;
                    }
                }
            for (u32 b = 0; b < biomes; ++b)
                share[b][q] = found[b] / samples;
        }
        for (u32 b = 0; b < biomes; ++b) {
            const double all = (share[b][0] + share[b][1] + share[b][2] + share[b][3]) / 4;
            EXPECT_GT(all, 0) << world.compiled.biome_names[b] << " occurs nowhere within 8 km of the origin, seed "
                              << statistics_seed(s);
            total[b].add(all);
            least[b] = std::min(least[b], all);
            for (size_t q = 0; q < 4; ++q)
                by_quadrant[b][q].add(share[b][q] - all);
        }
    }
    if (printing()) fmt::print("biome: mean share of 16 km x 16 km over {} seeds, least of a seed\n", seeds);
    for (u32 b = 0; b < biomes; ++b) {
        const std::string& name = base_terrain().biomes[b].name;
        if (printing()) fmt::print("  {:32} {:.4f} {:.4f}\n", name, total[b].mean(), least[b]);
        EXPECT_GT(total[b].mean(), .003) << name; // the rarest
        EXPECT_LT(total[b].mean(), .20) << name;  // the most common
        if (seeds >= 10) {
            for (size_t q = 0; q < 4; ++q) // Student's t of 19 degrees: 96 numbers beyond 6 once in a thousand times
                EXPECT_LT(std::abs(by_quadrant[b][q].mean()), 6 * by_quadrant[b][q].error())
                    << name << " in " << regions[q].name;
        }
    }
}

TEST(TerrainStatistics, EveryBiomeWithin16Km) {
    biomes_occur(kSanitized ? 1 : 3, kSanitized ? 16 : 12);
}
TEST(TerrainStatistics, EveryBiomeWithin16KmOf20SeedsLong) {
    if (!long_statistics()) GTEST_SKIP() << "VITRAIL_LONG is not set";
    biomes_occur(kStatisticsSeeds, 8);
}

// Scattered columns of the quadrants, 1 km apart, so that each is a sample of its own: bare rock without rules, to
// measure strata; and what the caves' biomes follow from.
struct Scattered {
    SampledWorld world;
    std::unique_ptr<TerrainTables> bare;
    std::unique_ptr<GroundTile> ground = std::make_unique<GroundTile>();
    std::unique_ptr<CaveTile> none = std::make_unique<CaveTile>(), caves = std::make_unique<CaveTile>();
    std::unique_ptr<BlockTile> blocks = std::make_unique<BlockTile>();

    explicit Scattered(u64 seed)
        : world(seed)
        , bare(std::make_unique<TerrainTables>(world.tables())) {
        bare->surface_rules = bare->cave_rules = 0;
    }
    void make(ColumnPos at, bool with_caves) {
        const LandTile land = world.land(at);
        *ground = GroundTile{};
        std::copy_n(&land.attribute[0][0], kAttributesMost * kColumnCells, &ground->attribute[0][0]);
        for (float* plane : {ground->land, ground->rock, ground->top})
            std::copy_n(land.height, kColumnCells, plane);
        if (!with_caves) {
            world.stages.fill(*bare, at, *ground, *none, *blocks);
            return;
        }
        LatticeTile lattice[4];
        for (i32 i = 0; i < 4; ++i)
            world.stages.lattice(*bare, {at.x + (i & 1), at.z + (i >> 1)}, lattice[i]);
        const LatticeTile* lattices[4] = {&lattice[0], &lattice[1], &lattice[2], &lattice[3]};
        world.stages.caves(*bare, at, *ground, lattices, *caves);
    }
};

void strata_are_as_thick_as_described(u64 seeds, i32 a_side) {
    const auto regions = quadrants(512);
    std::vector<const TerrainDescription::Layer*> strata;
    for (const auto& layer : base_terrain().layers)
        if (!layer.loose) strata.push_back(&layer);
    const size_t count = strata.size();
    struct Stratum {
        double seen = 0, mean = 0, weight = 0;
        Samples noise, full; // at the columns; full: thickness at weight 1
    };
    std::vector<std::vector<Stratum>> rows(regions.size(), std::vector<Stratum>(count));
    double blocks = 0;
    std::vector<std::array<float, kColumnCells>> noise(count);
    for (u64 s = 0; s < seeds; ++s) {
        Scattered scattered(statistics_seed(s));
        const TerrainTables& t = scattered.world.tables();
        ASSERT_EQ(t.strata, count);
        for (size_t q = 0; q < regions.size(); ++q)
            for (i32 i = 0; i < a_side * a_side; ++i) {
                const i32 step = regions[q].side / a_side;
                const ColumnPos at{regions[q].corner.x + i % a_side * step + step / 2,
                                   regions[q].corner.z + i / a_side * step + step / 2};
                scattered.make(at, false);
                for (size_t l = 0; l < count; ++l) {
                    const Noise n = t.noise[t.stratum[l].noise];
                    noise_rows(best_isa()).fractal2(t.octave + n.first, n.octaves, at, noise[l].data());
                    rows[q][l].noise.add(double(noise[l][0]));
                    rows[q][l].full.add(std::max(0.0, double(strata[l]->thickness) +
                                                          double(strata[l]->amplitude) * double(noise[l][0])));
                }
                double shares[kBiomesMost];
                for (i32 index = 0; index < kColumnCells; ++index) {
                    surface_shares(t, *scattered.ground, index, shares);
                    std::vector<double> thick(count), weight(count);
                    double hung = 0, stacked = 0;
                    for (size_t l = 0; l < count; ++l) {
                        weight[l] = material_weight(strata[l]->name, shares);
                        if (strata[l]->remainder) continue;
                        thick[l] = weight[l] *
                                   std::max(0.0, double(strata[l]->thickness) +
                                                     double(strata[l]->amplitude) * double(noise[l][size_t(index)]));
                        (strata[l]->hung ? hung : stacked) += thick[l];
                    }
                    // Bottom up; what finds no room is cut.
                    const double top = double(scattered.ground->top[index]), room = std::max(0.0, top - hung);
                    double at_y = 0;
                    for (size_t l = 0; l < count; ++l) {
                        double here = strata[l]->remainder ? std::max(0.0, room - stacked) : thick[l];
                        if (!strata[l]->hung) {
                            here = std::min(here, room - at_y);
                            at_y += here;
                        }
                        rows[q][l].mean += here;
                        rows[q][l].weight += weight[l];
                        for (i32 y = 0; y < i32(std::ceil(top)); ++y) {
                            const Block b = scattered.blocks->block[y << 8 | index];
                            rows[q][l].seen += b == t.stratum[l].block || (y == 0 && l == 0);
                        }
                    }
                    if (q == 0) ++blocks;
                }
            }
    }
    if (printing())
        fmt::print("stratum: stated thickness, mean where its weight is 1, blocks seen / expected a block column; "
                   "noise, sigmas\n");
    for (size_t l = 0; l < count; ++l) {
        for (size_t q = 0; q < regions.size(); ++q) {
            const Stratum& r = rows[q][l];
            const std::string where = strata[l]->name + " in " + regions[q].name;
            // Noise is read every fourth block and layers begin at whole blocks, upwards: only the first, which begins
            // at 0 anyway, gains half a block by it.
            EXPECT_NEAR(r.seen / blocks, (r.mean / blocks) + (l == 0 ? .5 : 0), .03 + .002 * r.mean / blocks) << where;
            if (seeds >= 10) {
                EXPECT_GT(r.seen / blocks, .005) << where; // the uppermost lie in high mountains only
            }
            EXPECT_LT(std::abs(r.noise.mean()), bound_of(4 * double(count)) * r.noise.error()) << where;
        }
        if (printing())
            fmt::print(
                "  {:14} {:5.1f} {:6.2f}  {:.3f}/{:.3f} {:.3f}/{:.3f} {:.3f}/{:.3f} {:.3f}/{:.3f}  {:+.1f} {:+.1f} "
                "{:+.1f} {:+.1f}\n",
                strata[l]->name, strata[l]->thickness, rows[0][l].full.mean(), rows[0][l].seen / blocks,
                rows[0][l].mean / blocks, rows[1][l].seen / blocks, rows[1][l].mean / blocks, rows[2][l].seen / blocks,
                rows[2][l].mean / blocks, rows[3][l].seen / blocks, rows[3][l].mean / blocks,
                rows[0][l].noise.mean() / rows[0][l].noise.error(), rows[1][l].noise.mean() / rows[1][l].noise.error(),
                rows[2][l].noise.mean() / rows[2][l].noise.error(), rows[3][l].noise.mean() / rows[3][l].noise.error());
    }
}

TEST(TerrainStatistics, StrataAreAsThickAsDescribed) {
    strata_are_as_thick_as_described(1, 8);
}
TEST(TerrainStatistics, StrataAreAsThickAsDescribedOver20SeedsLong) {
    if (!long_statistics()) GTEST_SKIP() << "VITRAIL_LONG is not set";
    strata_are_as_thick_as_described(kStatisticsSeeds, 8);
}

// Cave biomes: drawn as often as their weights say, and the attributes behind the weights lie where they are described:
// shallow begins 19 blocks below the land, deep 72, half of the deep is warped.
void cave_biomes_occur(u64 seeds, i32 a_side) {
    const auto regions = quadrants(512);
    const size_t biomes = base_terrain().cave_biomes.size();
    std::vector<std::vector<Tally>> drawn(regions.size(), std::vector<Tally>(biomes));
    std::vector<std::vector<Samples>> middle(regions.size(),
                                             std::vector<Samples>(base_terrain().cave_attributes.size()));
    std::vector<Samples> warped(regions.size());
    for (u64 s = 0; s < seeds; ++s) {
        Scattered scattered(statistics_seed(s));
        const TerrainTables& t = scattered.world.tables();
        for (size_t q = 0; q < regions.size(); ++q)
            for (i32 i = 0; i < a_side * a_side; ++i) {
                const i32 step = regions[q].side / a_side;
                const ColumnPos at{regions[q].corner.x + i % a_side * step + step / 2,
                                   regions[q].corner.z + i / a_side * step + step / 2};
                scattered.make(at, true);
                for (u32 a = 0; a < t.cave_attributes; ++a)
                    middle[q][a].add((double(t.cave_attribute[a].low) + double(t.cave_attribute[a].high)) / 2 -
                                     double(scattered.caves->offset[a][0]));
                warped[q].add(scattered.caves->offset[3][0] > 0);
                double shares[kBiomesMost];
                for (i32 index = 0; index < kColumnCells; index += 3)
                    for (i32 y = 4; y < std::min(i32(scattered.ground->top[index]), 180); y += 5) {
                        cave_shares(t, *scattered.ground, *scattered.caves, index, y, shares);
                        const u32 pick = cave_biome_at<>(t, *scattered.ground, *scattered.caves, at, index, y);
                        for (u32 b = 0; b < biomes; ++b)
                            drawn[q][b] += {double(pick == b), shares[b], shares[b] * (1 - shares[b])};
                    }
            }
    }
    const double bound = bound_of(double(4 * biomes));
    for (size_t b = 0; b < biomes; ++b)
        for (size_t q = 0; q < regions.size(); ++q) {
            const Tally& d = drawn[q][b];
            double all = 0;
            for (const Tally& other : drawn[q])
                all += other.seen;
            if (printing())
                fmt::print("  {:24} {}: {:.4f} of the rock, {:+.2f} sigmas\n", base_terrain().cave_biomes[b].name,
                           regions[q].name, d.seen / all, d.sigmas());
            EXPECT_LT(std::abs(d.sigmas()), bound) << base_terrain().cave_biomes[b].name << " in " << regions[q].name;
            EXPECT_GT(d.seen / all, .03) << base_terrain().cave_biomes[b].name << " in " << regions[q].name;
        }
    for (size_t q = 0; q < regions.size(); ++q) {
        ASSERT_EQ(base_terrain().cave_attributes[0].name, "shallow");
        ASSERT_EQ(base_terrain().cave_attributes[1].name, "deep");
        ASSERT_EQ(base_terrain().cave_attributes[3].name, "warped");
        if (printing())
            fmt::print("  {}: shallow from {:.2f} +- {:.2f}, deep from {:.2f} +- {:.2f}, warped {:.3f} +- {:.3f}\n",
                       regions[q].name, middle[q][0].mean(), middle[q][0].error(), middle[q][1].mean(),
                       middle[q][1].error(), warped[q].mean(), warped[q].error());
        EXPECT_NEAR(middle[q][0].mean(), 19, bound * middle[q][0].error()) << regions[q].name;
        EXPECT_NEAR(middle[q][1].mean(), 72, bound * middle[q][1].error()) << regions[q].name;
        EXPECT_NEAR(warped[q].mean(), .5, bound * warped[q].error()) << regions[q].name;
    }
}

TEST(TerrainStatistics, CaveBiomesOccurAtTheirDepths) {
    cave_biomes_occur(1, 6);
}
TEST(TerrainStatistics, CaveBiomesOccurAtTheirDepthsOver20SeedsLong) {
    if (!long_statistics()) GTEST_SKIP() << "VITRAIL_LONG is not set";
    cave_biomes_occur(kStatisticsSeeds, 8);
}

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
