// Features and decorators of the base game stand as often as its tables say, in every quadrant and at the far edge of
// the world: counted in the real stages' results against what follows from the tables (rates.h), over fixed seeds, at
// places searched for each biome.
#include "tests/terrain/rates.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vitrail {
namespace {

struct Rates {
    std::vector<Region> regions;
    std::vector<std::vector<Tally>> features, decorators; // by region, row
    std::vector<std::vector<LooseTally>> loose;
    u64 areas = 0;

    explicit Rates(std::vector<Region> in)
        : regions(std::move(in))
        , features(regions.size(), std::vector<Tally>(base_terrain().features.size()))
        , decorators(regions.size(), std::vector<Tally>(base_terrain().decorators.size()))
        , loose(regions.size(), std::vector<LooseTally>(kLooseMost)) {}

    void add(const Area& area, size_t region, bool decorate) {
        for (u32 f = 0; f < base_terrain().features.size(); ++f)
            features[region][f] += feature_tally(area, feature_odds(area, base_terrain().features[f], f), f);
        if (decorate) add_decorators(area, decorators[region]);
        if (decorate) add_loose(area, loose[region]);
        ++areas;
    }
    // For every biome its best square; `more` of them where one of its features has wide cells.
    void sample(const SampledWorld& world, size_t region, i32 side, size_t more, u32 biomes_from = 0,
                u32 biomes_step = 1) {
        const auto sites = biome_sites(world, regions[region], side, 1 + more);
        for (u32 b = biomes_from; b < sites.size(); b += biomes_step) {
            const std::string& name = world.compiled.biome_names[b];
            bool wide = false;
            for (const auto& f : base_terrain().features)
                wide |= f.biome == name && f.cell >= 36;
            for (size_t k = 0; k < sites[b].size() && k < (wide ? 1 + more : 1); ++k)
                add(Area(world, sites[b][k], side), region, k == 0);
        }
    }
};

std::vector<Tally> all_regions(const std::vector<std::vector<Tally>>& by_region) {
    std::vector<Tally> sum(by_region[0].size());
    for (const auto& rows : by_region)
        for (size_t r = 0; r < rows.size(); ++r)
            sum[r] += rows[r];
    return sum;
}

std::string feature_name(size_t row) {
    return base_terrain().features[row].name;
}
std::string decorator_name(size_t row) {
    const auto& d = base_terrain().decorators[row];
    return d.block + " of " + d.biome + " at " + d.place;
}

// Rows beyond the bound of a test of so many numbers; family: the chance that a right generator has any.
constexpr double kFamily = 1e-3;
std::vector<std::string> outliers(const std::vector<std::vector<Tally>>& by_region, std::string (*name)(size_t)) {
    std::vector<std::string> found;
    const auto look = [&](const std::vector<Tally>& rows, const std::string& where) {
        for (size_t r = 0; r < rows.size(); ++r)
            if (rows[r].chance() < kFamily / double(rows.size() * (by_region.size() + 1)))
                found.push_back(fmt::format("{} {}: {} seen, {:.1f} expected, {:.1f} sigmas", where, name(r),
                                            rows[r].seen, rows[r].mean, rows[r].sigmas()));
    };
    for (size_t i = 0; i < by_region.size(); ++i)
        look(by_region[i], fmt::format("region {}", i));
    look(all_regions(by_region), "all regions");
    return found;
}

void print(const Rates& rates) {
    const auto table = [&](const char* what, const std::vector<std::vector<Tally>>& by_region,
                           std::string (*name)(size_t)) {
        const auto sum = all_regions(by_region);
        fmt::print("{} in {} areas: seen / expected, sigmas, least expected in a region\n", what, rates.areas);
        for (size_t r = 0; r < sum.size(); ++r) {
            double least = 1e18, worst = 0;
            for (const auto& rows : by_region) {
                least = std::min(least, rows[r].mean);
                worst = std::max(worst, std::abs(rows[r].sigmas()));
            }
            fmt::print("  {:60} {:8.0f} / {:9.1f} = {:.3f}, {:+.2f} (worst {:.2f}), {:.1f}\n", name(r), sum[r].seen,
                       sum[r].mean, sum[r].seen / sum[r].mean, sum[r].sigmas(), worst, least);
        }
    };
    for (u32 l = 0; const auto& layer : base_terrain().layers) {
        if (!layer.loose) continue;
        fmt::print("  {:12} laid a mean {:.1f} blocks, left by erosion of it:", layer.name,
                   rates.loose[0][l].laid / double(rates.areas));
        for (const auto& rows : rates.loose)
            fmt::print(" {:.3f} (gentle {:.4f})", rows[l].left / rows[l].laid,
                       rows[l].gentle_left / rows[l].gentle_laid);
        fmt::print("\n");
        ++l;
    }
    table("features", rates.features, feature_name);
    table("decorators", rates.decorators, decorator_name);
}

u32 loose_layers() {
    u32 count = 0;
    for (const auto& layer : base_terrain().layers)
        count += layer.loose;
    return count;
}

// Erosion takes from every layer, and hardly anything where the land is gentle.
void expect_loose(const Rates& rates) {
    for (size_t region = 0; region < rates.regions.size(); ++region)
        for (u32 l = 0; const auto& layer : base_terrain().layers) {
            if (!layer.loose) continue;
            const LooseTally& row = rates.loose[region][l++];
            if (row.laid < 2000) continue; // blocks: too few to be a rate
            const std::string where = layer.name + " in " + rates.regions[region].name;
            EXPECT_LE(row.left, row.laid * 1.001) << where;
            EXPECT_GE(row.left, row.laid * .6) << where;
            if (row.gentle_laid > 500) {
                EXPECT_NEAR(row.gentle_left / row.gentle_laid, 1, .02) << where;
            }
        }
}

void expect_rates(const Rates& rates) {
    for (const auto& found : {outliers(rates.features, feature_name), outliers(rates.decorators, decorator_name)})
        for (const std::string& text : found)
            ADD_FAILURE() << text;
    expect_loose(rates);
}

// One square a biome, each in another quadrant than the last, and from seed to seed in another one.
Rates quick_sample(const TerrainDescription& made_from) {
    Rates rates(quadrants(kSanitized ? 144 : 288));
    for (u64 s = 0; s < (kSanitized ? 1 : 2); ++s) {
        const SampledWorld world(statistics_seed(s), made_from);
        for (u32 region = 0; region < 4; ++region)
            rates.sample(world, region, 8, 0, (region + u32(s)) % 4, 4);
    }
    return rates;
}

double expected_of(const std::vector<std::vector<Tally>>& by_region) {
    double sum = 0;
    for (const Tally& t : all_regions(by_region))
        sum += t.mean;
    return sum;
}

TEST(TerrainRates, FeaturesAndDecoratorsStandAsOftenAsTheTablesSay) {
    const Rates rates = quick_sample(base_terrain());
    expect_rates(rates);
    EXPECT_GT(expected_of(rates.features), kSanitized ? 2000 : 6000);
    EXPECT_GT(expected_of(rates.decorators), kSanitized ? 20000 : 60000);
    if (printing()) print(rates);
}

// The tests above can fail: a world whose chances are all a fifth lower is not taken for the one described.
TEST(TerrainRates, AFifthFewerWouldBeSeen) {
    TerrainDescription other = base_terrain();
    for (auto& f : other.features)
        f.chance *= .8f;
    for (auto& d : other.decorators)
        d.chance *= .8f;
    const Rates rates = quick_sample(other);
    EXPECT_GE(outliers(rates.features, feature_name).size(), kSanitized ? 2 : 6);
    EXPECT_GE(outliers(rates.decorators, decorator_name).size(), kSanitized ? 15 : 50);
}

TEST(TerrainRates, TheSameAtTheFarEdge) {
    Rates rates(far_edges(kSanitized ? 96 : 144));
    const SampledWorld world(statistics_seed(0));
    for (u32 region = 0; region < 4; ++region)
        rates.sample(world, region, 8, 0, region, kSanitized ? 8 : 4);
    expect_rates(rates);
}

u64 seeds_to_sample() {
    const char* number = std::getenv("VITRAIL_SEEDS");
    return number ? std::strtoull(number, nullptr, 10) : kStatisticsSeeds;
}

Rates long_sample(std::vector<Region> regions, u64 seeds, const TerrainDescription& made_from = base_terrain()) {
    Rates rates(std::move(regions));
    for (u64 s = 0; s < seeds; ++s) {
        const SampledWorld world(statistics_seed(s), made_from);
        for (u32 region = 0; region < 4; ++region)
            rates.sample(world, region, 12, 2);
    }
    return rates;
}

TEST(TerrainRates, EveryRowInEveryQuadrantOver20SeedsLong) {
    if (!long_statistics()) GTEST_SKIP() << "VITRAIL_LONG is not set";
    const Rates rates = long_sample(quadrants(384), seeds_to_sample());
    print(rates);
    expect_rates(rates);
    for (size_t region = 0; region < 4; ++region) {
        for (size_t f = 0; f < rates.features[region].size(); ++f)
            EXPECT_GT(rates.features[region][f].seen, 0) << feature_name(f) << " in " << rates.regions[region].name;
        for (size_t d = 0; d < rates.decorators[region].size(); ++d)
            EXPECT_GT(rates.decorators[region][d].seen, 0) << decorator_name(d) << " in " << rates.regions[region].name;
        for (u32 l = 0; l < loose_layers(); ++l)
            EXPECT_GT(rates.loose[region][l].left, 0) << "loose layer " << l << " in " << rates.regions[region].name;
    }
}

TEST(TerrainRates, EveryRowAtTheFarEdgeLong) {
    if (!long_statistics()) GTEST_SKIP() << "VITRAIL_LONG is not set";
    const Rates rates = long_sample(far_edges(384), (seeds_to_sample() + 2) / 3);
    print(rates);
    expect_rates(rates);
}

} // namespace
} // namespace vitrail
