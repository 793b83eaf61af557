// Pieces of the real world for statistics: squares of columns with all that stages make of them, found where a biome
// has weight.
#pragma once

#include "terrain/compile/compile.h"
#include "terrain/cpu/stages.h"
#include "tests/terrain/base_terrain.h"

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace vitrail {

inline constexpr i32 kEdgeColumns = kWorldEdge / 16; // columns lie at -kEdgeColumns <= x, z < kEdgeColumns

inline bool long_statistics() {
    return std::getenv("VITRAIL_LONG") != nullptr;
}
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define VITRAIL_SANITIZED 1
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define VITRAIL_SANITIZED 1
#endif
#ifdef VITRAIL_SANITIZED
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif

inline constexpr u64 kStatisticsSeeds = 20;
inline u64 statistics_seed(u64 i) {
    return 1000003 * (i + 1);
}

// A square of columns.
struct Region {
    std::string name;
    ColumnPos corner;
    i32 side = 0;
};
inline std::vector<Region> quadrants(i32 side) {
    return {{"+x +z", {0, 0}, side},
            {"-x +z", {-side, 0}, side},
            {"-x -z", {-side, -side}, side},
            {"+x -z", {0, -side}, side}};
}
inline std::vector<Region> far_edges(i32 side) {
    const i32 e = kEdgeColumns;
    return {{"far +x +z", {e - side, e - side}, side},
            {"far -x", {-e, -side / 2}, side},
            {"far -x -z", {-e, -e}, side},
            {"far +x -z", {e - side, -e}, side}};
}

// made_from differs from the base game's land only where a test shows that it would notice.
struct SampledWorld {
    CompiledTerrain compiled;
    const TerrainStages& stages = terrain_stages(best_isa());

    explicit SampledWorld(u64 seed, const TerrainDescription& made_from = base_terrain()) {
        auto made = compile_terrain(made_from, seed);
        if (!made) throw std::runtime_error(made.error().message);
        compiled = std::move(*made);
    }
    const TerrainTables& tables() const { return *compiled.tables; }
    LandTile land(ColumnPos at) const {
        LandTile tile;
        stages.land(tables(), at, tile);
        return tile;
    }
};

// Plain sums in doubles, apart from the kernels.
inline double smooth(double low, double high, double v) {
    if (low == high) return v < low ? 0 : 1;
    const double s = std::clamp((v - low) / (high - low), 0.0, 1.0);
    return s * s * (3 - 2 * s);
}
// shares: one a row. Rows: SurfaceBiomeRow or CaveBiomeRow.
template <class Biome>
void biome_shares(const Biome* rows, u32 count, u32 attributes, const double* value, double* shares) {
    double sum = 0;
    for (u32 b = 0; b < count; ++b) {
        shares[b] = 1;
        for (u32 a = 0; a < attributes; ++a) {
            if (rows[b].wants[a] > 0) shares[b] *= value[a];
            if (rows[b].wants[a] < 0) shares[b] *= 1 - value[a];
        }
        sum += shares[b];
    }
    for (u32 b = 0; b < count; ++b)
        shares[b] /= sum;
}
template <class Tile>
void surface_shares(const TerrainTables& t, const Tile& tile, i32 index, double* shares) {
    double value[kAttributesMost];
    for (u32 a = 0; a < t.attributes; ++a)
        value[a] = double(tile.attribute[a][index]);
    biome_shares(t.biome, t.biomes, t.attributes, value, shares);
}
inline void cave_shares(const TerrainTables& t, const GroundTile& ground, const CaveTile& caves, i32 index, i32 y,
                        double* shares) {
    double value[kAttributesMost];
    for (u32 a = 0; a < t.cave_attributes; ++a) {
        const CaveAttributeRow& row = t.cave_attribute[a];
        value[a] = smooth(double(row.low), double(row.high),
                          (double(ground.land[index]) - y) * double(row.with_depth) + double(caves.offset[a][index]));
    }
    biome_shares(t.cave_biome, t.cave_biomes, t.cave_attributes, value, shares);
}

// A square of columns, made up to the placements. Columns row by row; block columns x | z << 4 in each.
struct Area {
    const SampledWorld& world;
    ColumnPos first;
    i32 side;
    std::vector<GroundTile> ground;
    std::vector<CaveTile> caves;
    std::vector<Placement> placements;
    std::vector<float> share; // of surface biome b at a block column: b * columns * 256 + column * 256 + index

    Area(const SampledWorld& from, ColumnPos at, i32 columns)
        : world(from)
        , first(at)
        , side(columns)
        , ground(size_t(columns * columns))
        , caves(ground.size()) {
        const TerrainTables& t = world.tables();
        const i32 wide = side + 2 * kGroundReach;
        std::vector<LandTile> lands(size_t(wide * wide));
        std::vector<const LandTile*> pointers;
        for (i32 i = 0; i < wide * wide; ++i) {
            world.stages.land(t, {first.x - kGroundReach + i % wide, first.z - kGroundReach + i / wide},
                              lands[size_t(i)]);
            pointers.push_back(&lands[size_t(i)]);
        }
        world.stages.ground(t, first, side, side, pointers.data(), ground.data());
        const i32 points = side + 1;
        std::vector<LatticeTile> lattices(size_t(points * points));
        for (i32 i = 0; i < points * points; ++i)
            world.stages.lattice(t, {first.x + i % points, first.z + i / points}, lattices[size_t(i)]);
        auto features = std::make_unique<FeatureTile>();
        for (i32 i = 0; i < side * side; ++i) {
            const LatticeTile* own = &lattices[size_t(i / side * points + i % side)];
            const LatticeTile* four[4] = {own, own + 1, own + points, own + points + 1};
            world.stages.caves(t, column(i), ground[size_t(i)], four, caves[size_t(i)]);
            world.stages.features(t, column(i), ground[size_t(i)], caves[size_t(i)], *features);
            placements.insert(placements.end(), features->placement, features->placement + features->placements);
        }
        share.resize(size_t(t.biomes) * size_t(blocks()));
        double shares[kBiomesMost];
        for (i32 i = 0; i < blocks(); ++i) {
            surface_shares(t, ground[size_t(i >> 8)], i & 255, shares);
            for (u32 b = 0; b < t.biomes; ++b)
                share[size_t(b) * size_t(blocks()) + size_t(i)] = float(shares[b]);
        }
    }
    i32 blocks() const { return side * side * kColumnCells; } // block columns
    ColumnPos column(i32 i) const { return {first.x + i % side, first.z + i / side}; }
    // Block i of blocks(), absolute.
    i64 block_x(i32 i) const { return i64(first.x + (i >> 8) % side) * 16 + (i & 15); }
    i64 block_z(i32 i) const { return i64(first.z + (i >> 8) / side) * 16 + (i >> 4 & 15); }
    float share_of(u32 biome, i32 i) const { return share[size_t(biome) * size_t(blocks()) + size_t(i)]; }
};

// For each surface biome the places of a region (least columns of squares of `side`) where it has most weight, `wanted`
// of them, best first; fewer where it has none.
inline std::vector<std::vector<ColumnPos>> biome_sites(const SampledWorld& world, const Region& region, i32 side,
                                                       size_t wanted) {
    const TerrainTables& t = world.tables();
    const i32 count = region.side / side;
    std::vector<std::vector<double>> weight(t.biomes, std::vector<double>(size_t(count * count)));
    double shares[kBiomesMost];
    for (i32 i = 0; i < count * count; ++i) {
        const LandTile tile =
            world.land({region.corner.x + i % count * side + side / 2, region.corner.z + i / count * side + side / 2});
        for (const i32 index : {0, 15, 240, 255}) {
            surface_shares(t, tile, index, shares);
            for (u32 b = 0; b < t.biomes; ++b)
                weight[b][size_t(i)] += shares[b] * .25;
        }
    }
    std::vector<std::vector<ColumnPos>> sites(t.biomes);
    for (u32 b = 0; b < t.biomes; ++b) {
        std::vector<std::pair<double, i32>> ranked;
        for (i32 i = 0; i < count * count; ++i) {
            const i32 x = i % count, z = i / count;
            const auto at = [&](i32 u, i32 v) {
                return u < 0 || v < 0 || u >= count || v >= count ? 0.0 : weight[b][size_t(v * count + u)];
            };
            if (at(x, z) > .2)
                ranked.emplace_back(-at(x, z) - .15 * (at(x - 1, z) + at(x + 1, z) + at(x, z - 1) + at(x, z + 1)), i);
        }
        std::sort(ranked.begin(), ranked.end());
        for (size_t k = 0; k < std::min(wanted, ranked.size()); ++k)
            sites[b].push_back(
                {region.corner.x + ranked[k].second % count * side, region.corner.z + ranked[k].second / count * side});
    }
    return sites;
}

} // namespace vitrail
