// The world is the same at its far edges as at the origin: which biomes, how rough, how hollow, how overgrown; and no
// detail is lost there.
#include "tests/terrain/rates.h"

#include <array>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <map>
#include <set>

namespace vitrail {
namespace {

// Numbers of one region and seed, by name; each is a mean over scattered columns.
using Figures = std::map<std::string, double>;

double mean_of(const std::vector<double>& v) {
    double sum = 0;
    for (const double a : v)
        sum += a;
    return sum / double(v.size());
}

// a_side^2 places of 3 columns each.
Figures figures_of(const SampledWorld& world, const Region& region, i32 a_side) {
    const TerrainTables& t = world.tables();
    const i32 step = region.side / a_side;
    std::map<std::string, std::vector<double>> found;
    double shares[kBiomesMost];
    std::set<float> distinct;
    u64 differences = 0, level = 0;
    CaveTile caves;
    GroundTile ground{};
    for (i32 i = 0; i < a_side * a_side; ++i) {
        const ColumnPos at{region.corner.x + i % a_side * step + step / 3,
                           region.corner.z + i / a_side * step + step / 3};
        const LandTile here = world.land(at), next = world.land({at.x + 1, at.z}), far = world.land({at.x + 4, at.z});
        std::vector<double> one, four, sixteen, sixty_four;
        for (i32 index = 0; index < kColumnCells; ++index) {
            const double h = double(here.height[index]);
            if ((index & 15) < 15) {
                const float d = here.height[index + 1] - here.height[index];
                one.push_back(double(d) * double(d));
                distinct.insert(d);
                ++differences;
                level += d == 0;
            }
            if ((index & 15) < 12) four.push_back(std::pow(double(here.height[index + 4]) - h, 2));
            sixteen.push_back(std::pow(double(next.height[index]) - h, 2));
            sixty_four.push_back(std::pow(double(far.height[index]) - h, 2));
        }
        // Land is smooth in most places and a cliff in few: logarithms keep the few from deciding all.
        const auto rough = [&](const char* name, const std::vector<double>& v) {
            found[name].push_back(std::log(1e-5 + mean_of(v)));
        };
        rough("log roughness, lag 1", one);
        rough("log roughness, lag 4", four);
        rough("log roughness, lag 16", sixteen);
        rough("log roughness, lag 64", sixty_four);
        found["height"].push_back(double(here.height[0]));
        surface_shares(t, here, 0, shares);
        for (u32 b = 0; b < t.biomes; ++b)
            found["share of " + world.compiled.biome_names[b]].push_back(shares[b]);

        std::copy_n(&here.attribute[0][0], kAttributesMost * kColumnCells, &ground.attribute[0][0]);
        for (float* plane : {ground.land, ground.rock, ground.top})
            std::copy_n(here.height, kColumnCells, plane);
        LatticeTile lattice[4];
        for (i32 k = 0; k < 4; ++k)
            world.stages.lattice(t, {at.x + (k & 1), at.z + (k >> 1)}, lattice[k]);
        const LatticeTile* lattices[4] = {&lattice[0], &lattice[1], &lattice[2], &lattice[3]};
        world.stages.caves(t, at, ground, lattices, caves);
        for (i32 w = 0; w < 4; ++w) {
            double open = 0;
            for (const u32 bits : caves.open[w])
                open += __builtin_popcount(bits);
            found[fmt::format("open share, y {} to {}", w * 32, w * 32 + 31)].push_back(open / 8192);
        }
        for (u32 a = 0; a < t.cave_attributes; ++a)
            found["offset of cave attribute " + base_terrain().cave_attributes[a].name].push_back(
                double(caves.offset[a][0]));
    }
    Figures figures;
    for (const auto& [name, values] : found)
        figures[name] = mean_of(values);
    // Floats near 130 are 2^-16 apart: some differences are equal, but not many.
    figures["distinct differences"] = double(distinct.size()) / double(differences);
    figures["level steps"] = double(level) / double(differences);
    return figures;
}

// Differences between the regions' means, seed by seed, must look like chance. Student's t; bound: his 1 - 10^-5.
void expect_same(u64 seeds, i32 a_side, double bound) {
    const auto near = quadrants(512), far = far_edges(512);
    std::map<std::string, std::array<std::vector<double>, 2>> all;
    for (u64 s = 0; s < seeds; ++s) {
        const SampledWorld world(statistics_seed(s));
        for (size_t i = 0; i < near.size(); ++i) {
            for (const auto& [name, v] : figures_of(world, near[i], a_side))
                all[name][0].push_back(v);
            for (const auto& [name, v] : figures_of(world, far[i], a_side))
                all[name][1].push_back(v);
        }
    }
    for (const auto& [name, v] : all) {
        double variance = 0;
        const double mean[2] = {mean_of(v[0]), mean_of(v[1])};
        for (int k = 0; k < 2; ++k)
            for (const double a : v[size_t(k)])
                variance += (a - mean[k]) * (a - mean[k]);
        const double n = double(v[0].size()), error = std::sqrt(variance / (2 * n - 2) * 2 / n);
        const double t = error > 0 ? (mean[1] - mean[0]) / error : 0;
        if (printing()) fmt::print("  {:40} {:10.5f} {:10.5f} t {:+.2f}\n", name, mean[0], mean[1], t);
        EXPECT_LT(std::abs(t), bound) << name << ": " << mean[0] << " near the origin, " << mean[1] << " at the edge";
        EXPECT_TRUE(std::isfinite(mean[1])) << name;
    }
    for (const double v : all["distinct differences"][1])
        EXPECT_GT(v, .5);
    for (const double v : all["level steps"][1])
        EXPECT_LT(v, .02);
}

TEST(TerrainFarEdge, TheLandIsTheSame) {
    expect_same(kSanitized ? 2 : 4, kSanitized ? 6 : 12, 6.5);
}
TEST(TerrainFarEdge, TheLandIsTheSameOver20SeedsLong) {
    if (!long_statistics()) GTEST_SKIP() << "VITRAIL_LONG is not set";
    expect_same(kStatisticsSeeds, 24, 4.8);
}

} // namespace
} // namespace vitrail
