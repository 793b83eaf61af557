// The terrain stages one by one, on the base content, with the widest vectors of this CPU. Places lie far apart, so
// that a figure is the mean of many kinds of land.
#include "bench/harness.h"
#include "tests/terrain/base_terrain.h"

#include "terrain/compile/compile.h"
#include "terrain/cpu/stages.h"
#include "terrain/generator.h"

#include <memory>
#include <vector>

namespace vitrail {

static const TerrainTables& base_tables() {
    static const std::unique_ptr<const TerrainTables> tables = [] {
        auto compiled = compile_terrain(base_terrain(), 1);
        if (!compiled) throw std::runtime_error(compiled.error().message);
        return std::move(compiled->tables);
    }();
    return *tables;
}

static void bench_land(bench::Context& c) {
    const TerrainTables& t = base_tables();
    auto tile = std::make_unique<LandTile>();
    constexpr i32 kColumns = 400;
    c.measure(kColumns, [&] {
        for (i32 i = 0; i < kColumns; ++i) {
            terrain_stages(best_isa()).land(t, {i % 20 * 61 - 600, i / 20 * 53 - 500}, *tile);
            bench::keep(*tile);
        }
    });
}

// A zone at a time, as the generator runs it; land is there already.
static void bench_ground(bench::Context& c) {
    const TerrainTables& t = base_tables();
    constexpr i32 kZones = 6, kWide = kZoneColumns + 2 * kGroundReach, kOwn = kZoneColumns * kZoneColumns;
    std::vector<LandTile> land(std::size_t(kZones * kWide * kWide));
    std::vector<const LandTile*> tiles;
    for (i32 i = 0; i < i32(land.size()); ++i) {
        const i32 zone = i / (kWide * kWide), x = i % kWide, z = i / kWide % kWide;
        terrain_stages(best_isa()).land(t, {zone * 500 - 1500 + x, zone * 300 - 900 + z}, land[std::size_t(i)]);
        tiles.push_back(&land[std::size_t(i)]);
    }
    std::vector<GroundTile> out(kOwn);
    c.measure(kZones * kOwn, [&] {
        for (i32 zone = 0; zone < kZones; ++zone) {
            terrain_stages(best_isa())
                .ground(t, {zone * 500 - 1500, zone * 300 - 900}, kZoneColumns, kZoneColumns,
                        &tiles[std::size_t(zone * kWide * kWide)], out.data());
            bench::keep(out[0]);
        }
    });
}

static void bench_lattice(bench::Context& c) {
    const TerrainTables& t = base_tables();
    auto tile = std::make_unique<LatticeTile>();
    constexpr i32 kColumns = 400;
    c.measure(kColumns, [&] {
        for (i32 i = 0; i < kColumns; ++i) {
            terrain_stages(best_isa()).lattice(t, {i % 20 * 61 - 600, i / 20 * 53 - 500}, *tile);
            bench::keep(*tile);
        }
    });
}

// Squares of columns here and there, lattices and ground there already; the ground is land without loose layers.
static void bench_caves(bench::Context& c) {
    const TerrainTables& t = base_tables();
    constexpr i32 kSquares = 12, kSide = 4, kPoints = (kSide + 1) * (kSide + 1), kColumns = kSquares * kSide * kSide;
    std::vector<LatticeTile> lattices(std::size_t(kSquares * kPoints));
    std::vector<GroundTile> ground(std::size_t{kColumns});
    auto land = std::make_unique<LandTile>();
    const auto corner = [](i32 square) { return ColumnPos{square * 511 - 3000, square * 307 - 2000}; };
    for (i32 i = 0; i < kSquares * kPoints; ++i) {
        const ColumnPos at = corner(i / kPoints);
        terrain_stages(best_isa())
            .lattice(t, {at.x + i % kPoints % (kSide + 1), at.z + i % kPoints / (kSide + 1)}, lattices[std::size_t(i)]);
    }
    const auto place = [&](i32 i) {
        const ColumnPos at = corner(i / (kSide * kSide));
        return ColumnPos{at.x + i % kSide, at.z + i / kSide % kSide};
    };
    for (i32 i = 0; i < kColumns; ++i) {
        GroundTile& g = ground[std::size_t(i)];
        terrain_stages(best_isa()).land(t, place(i), *land);
        for (i32 k = 0; k < kColumnCells; ++k) {
            for (u32 a = 0; a < t.attributes; ++a)
                g.attribute[a][k] = land->attribute[a][k];
            g.land[k] = g.top[k] = land->height[k];
        }
    }
    auto tile = std::make_unique<CaveTile>();
    c.measure(kColumns, [&] {
        for (i32 i = 0; i < kColumns; ++i) {
            const LatticeTile* own =
                &lattices[std::size_t(i / (kSide * kSide) * kPoints + i / kSide % kSide * (kSide + 1) + i % kSide)];
            const LatticeTile* const around[4] = {own, own + 1, own + kSide + 1, own + kSide + 2};
            terrain_stages(best_isa()).caves(t, place(i), ground[std::size_t(i)], around, *tile);
            bench::keep(*tile);
        }
    });
}

// Squares of columns with all that the stage reads: `side` columns a side and the ring of features around them.
namespace {
struct FeatureSquares {
    static constexpr i32 kSquares = 24, kSide = 4, kWide = kSide + 2 * kFeatureReach;
    std::shared_ptr<TerrainGenerator> generator;
    std::vector<std::shared_ptr<const GroundTile>> ground;
    std::vector<std::shared_ptr<const CaveTile>> caves;
    std::vector<FeatureTile> features;

    static ColumnPos place(i32 i) {
        const i32 square = i / (kWide * kWide);
        return {square * 511 - 6000 + i % kWide, square * 307 - 4000 + i / kWide % kWide};
    }
    FeatureSquares()
        : generator(TerrainGenerator::create(base_terrain(), 1).value())
        , features(std::size_t(kSquares * kWide * kWide)) {
        for (i32 i = 0; i < i32(features.size()); ++i) {
            ground.push_back(generator->ground(place(i)));
            caves.push_back(generator->caves(place(i)));
            make(i);
        }
    }
    void make(i32 i) {
        const std::size_t k = std::size_t(i);
        terrain_stages(best_isa()).features(generator->tables(), place(i), *ground[k], *caves[k], features[k]);
    }
};
} // namespace

static void bench_features(bench::Context& c) {
    FeatureSquares squares;
    c.measure(double(squares.features.size()), [&] {
        for (i32 i = 0; i < i32(squares.features.size()); ++i)
            squares.make(i);
        bench::keep(squares.features[0]);
    });
}

static void bench_draw(bench::Context& c) {
    using S = FeatureSquares;
    S squares;
    constexpr i32 kColumns = S::kSquares * S::kSide * S::kSide;
    std::vector<BlockTile> filled(std::size_t{kColumns}), drawn;
    const auto own = [](i32 i) { // where column i of a square stands among all tiles
        return i / (S::kSide * S::kSide) * S::kWide * S::kWide + (i / S::kSide % S::kSide + kFeatureReach) * S::kWide +
               i % S::kSide + kFeatureReach;
    };
    for (i32 i = 0; i < kColumns; ++i)
        terrain_stages(best_isa())
            .fill(squares.generator->tables(), S::place(own(i)), *squares.ground[std::size_t(own(i))],
                  *squares.caves[std::size_t(own(i))], filled[std::size_t(i)]);
    c.measure(
        kColumns, [&] { drawn = filled; },
        [&] {
            for (i32 i = 0; i < kColumns; ++i) {
                const FeatureTile* around[49];
                for (i32 k = 0; k < 49; ++k)
                    around[k] = &squares.features[std::size_t(own(i) + (k / 7 - kFeatureReach) * S::kWide + k % 7 -
                                                              kFeatureReach)];
                terrain_stages(best_isa())
                    .draw(squares.generator->tables(), S::place(own(i)), around, drawn[std::size_t(i)]);
            }
            bench::keep(drawn[0]);
        });
}

// Columns here and there, ground and caves there already.
namespace {
struct FillPlaces {
    static constexpr i32 kColumns = 24 * 4;
    std::shared_ptr<TerrainGenerator> generator = TerrainGenerator::create(base_terrain(), 1).value();
    std::vector<std::shared_ptr<const GroundTile>> ground;
    std::vector<std::shared_ptr<const CaveTile>> caves;

    static ColumnPos place(i32 i) { return {i / 4 * 511 - 6000 + i % 2, i / 4 * 307 - 4000 + i / 2 % 2}; }
    FillPlaces() {
        for (i32 i = 0; i < kColumns; ++i) {
            ground.push_back(generator->ground(place(i)));
            caves.push_back(generator->caves(place(i)));
        }
    }
    void fill(i32 i, BlockTile& out) const {
        const std::size_t k = std::size_t(i);
        terrain_stages(best_isa()).fill(generator->tables(), place(i), *ground[k], *caves[k], out);
    }
};
} // namespace

static void bench_fill(bench::Context& c) {
    const FillPlaces places;
    auto tile = std::make_unique<BlockTile>();
    c.measure(FillPlaces::kColumns, [&] {
        for (i32 i = 0; i < FillPlaces::kColumns; ++i) {
            places.fill(i, *tile);
            bench::keep(*tile);
        }
    });
}

// Fresh tiles for each run: what is decorated already costs less.
static void bench_decorate(bench::Context& c) {
    const FillPlaces places;
    std::vector<BlockTile> tiles(std::size_t{FillPlaces::kColumns});
    for (i32 i = 0; i < FillPlaces::kColumns; ++i)
        places.fill(i, tiles[std::size_t(i)]);
    const std::vector<BlockTile> filled = tiles;
    c.measure(
        FillPlaces::kColumns, [&] { tiles = filled; },
        [&] {
            for (i32 i = 0; i < FillPlaces::kColumns; ++i) {
                const std::size_t k = std::size_t(i);
                terrain_stages(best_isa())
                    .decorate(places.generator->tables(), FillPlaces::place(i), *places.ground[k], *places.caves[k],
                              tiles[k]);
            }
            bench::keep(tiles[0]);
        });
}

void register_stage_benches(bench::Suite& suite);
void register_stage_benches(bench::Suite& suite) {
    suite.add("terrain.land", "/s", "columns, one core", bench_land);
    suite.add("terrain.ground", "/s", "columns of whole zones, one core", bench_ground);
    suite.add("terrain.lattice", "/s", "columns, one core", bench_lattice);
    suite.add("terrain.caves", "/s", "columns, one core", bench_caves);
    suite.add("terrain.features", "/s", "columns, one core", bench_features);
    suite.add("terrain.draw", "/s", "columns, one core", bench_draw);
    suite.add("terrain.fill", "/s", "columns, one core", bench_fill);
    suite.add("terrain.decorate", "/s", "columns, one core", bench_decorate);
}

} // namespace vitrail
