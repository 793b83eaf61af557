// The base game's world as a whole, over fixed seeds: every biome within 16 km, layers as thick as they are described,
// cave biomes at their depths.
#include "tests/terrain/rates.h"

#include "terrain/cpu/noise_rows.h"
#include "terrain/kernel/cave_biome_kernel.h"

#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vitrail {
namespace {

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

} // namespace
} // namespace vitrail
