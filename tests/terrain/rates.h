// What the tables lead one to expect in an area - placements, decorators - evaluated plainly and without any random
// number, and how unlikely what is there would be.
#pragma once

#include "tests/terrain/world_area.h"

#include <cmath>

namespace vitrail {

// Whether tests print what they measured.
inline bool printing() {
    return long_statistics() || std::getenv("VITRAIL_PRINT") != nullptr;
}

// Within how many standard deviations all of so many normal numbers lie, but for one time in a thousand.
inline double bound_of(double numbers) {
    double low = 1, high = 12;
    for (int i = 0; i < 60; ++i) {
        const double mid = (low + high) / 2;
        (std::erfc(mid / std::sqrt(2.0)) * numbers > 1e-3 ? low : high) = mid;
    }
    return high;
}

// Observed and expected numbers of independent things.
struct Tally {
    double seen = 0, mean = 0, variance = 0;
    Tally& operator+=(const Tally& o) {
        seen += o.seen;
        mean += o.mean;
        variance += o.variance;
        return *this;
    }
    double sigmas() const { return variance > 0 ? (seen - mean) / std::sqrt(variance) : seen > 0 ? 99 : 0; }
    // Probability of being as far off or farther, two-sided: the larger of a normal and a Poisson tail, as sums of
    // unequal chances have lighter tails than the latter and clusters heavier ones than it, but not than the former.
    double chance() const {
        if (variance <= 0) return seen > 0 ? 0 : 1;
        const double normal = std::erfc(std::abs(seen - mean) / std::sqrt(2 * variance));
        if (mean > 60) return normal;
        double below = 0, term = std::exp(-mean); // below: P(n < seen)
        for (double n = 0; n < seen; ++n, term *= mean / n)
            below += term;
        return std::max(normal, std::min(1.0, 2 * std::min(below + term, 1 - below)));
    }
};

// The places of one feature: the chance that it stands in each block column of an area; caves may give it several
// floors, so `second` holds the expectation of n (n - 1).
struct FeatureOdds {
    std::vector<double> one, second; // Area's block columns
    i64 cell = 1;
};

inline FeatureOdds feature_odds(const Area& area, const TerrainDescription::Feature& feature, u32 row) {
    const TerrainTables& t = area.world.tables();
    const u32 biome = t.feature[row].biome; // its name is looked up by the compiler; all else is read as described
    FeatureOdds odds;
    odds.cell = feature.cell;
    const i64 inner = feature.cell - 2 * feature.padding;
    const double at_block = 1.0 / double(inner * inner);
    const bool in_caves = feature.place == "cave_floor" || feature.place == "cave_ceiling";
    u32 soils = 0;
    for (const std::string& layer : feature.layers) {
        u32 loose = 0;
        for (const auto& l : base_terrain().layers) {
            if (l.loose && l.name == layer) soils |= 1u << loose;
            loose += l.loose;
        }
    }
    odds.one.resize(size_t(area.blocks()));
    if (in_caves) odds.second.resize(size_t(area.blocks()));
    const auto rest = [&](i64 v) { return ((v % feature.cell) + feature.cell) % feature.cell; };
    const auto in_cell = [&](i64 v) { return rest(v) >= feature.padding && rest(v) < feature.cell - feature.padding; };
    for (i32 i = 0; i < area.blocks(); ++i) {
        if (!in_caves && area.share_of(biome, i) <= 0) continue;
        if (!in_cell(area.block_x(i)) || !in_cell(area.block_z(i))) continue;
        const GroundTile& ground = area.ground[size_t(i >> 8)];
        const CaveTile& caves = area.caves[size_t(i >> 8)];
        const i32 index = i & 255;
        const auto open = [&](i32 y) {
            return y >= 0 && y < kTerrainHeight && (caves.open[y / 32][index] >> (y % 32) & 1) != 0;
        };
        const double top = double(ground.top[index]);
        if (in_caves) {
            double sum = 0, squares = 0, shares[kCaveBiomesMost];
            u32 any = 0;
            for (const auto& word : caves.open)
                any |= word[index];
            for (i32 y = 9; any != 0 && y < 200; ++y) {
                if (!open(y) || open(y - 1)) continue;
                i32 end = y;
                while (open(end + 1))
                    ++end;
                if (end - y + 1 < feature.least_height) continue;
                if (feature.shape == "crystal_pillar" && end - y + 1 > 84) continue; // no crystal grows so long
                if (feature.place == "cave_ceiling" && end + 1 >= top) continue;
                const i32 stands = feature.place == "cave_ceiling" ? end : y;
                if (stands < feature.lowest_y || stands > feature.highest_y) continue;
                cave_shares(t, ground, caves, index, stands, shares);
                const double p = double(feature.chance) * shares[biome];
                sum += p;
                squares += p * p;
            }
            odds.one[size_t(i)] = sum * at_block;
            odds.second[size_t(i)] = (sum * sum - squares) * at_block;
            continue;
        }
        const i32 above = i32(std::ceil(top));
        if (feature.place == "surface") {
            if (above < kTerrainSeaLevel) continue;
        } else if (kTerrainSeaLevel - above < std::max(feature.water_depth, 1)) {
            continue;
        }
        const i32 stands = feature.place == "sea_surface" ? kTerrainSeaLevel : above;
        if (stands < feature.lowest_y || stands > feature.highest_y) continue;
        if (open(above - 1)) continue;
        if (soils != 0) {
            i32 l = i32(t.loose) - 1;
            while (l >= 0 && double(ground.loose[l][index]) <= .05)
                --l;
            if (l < 0 || (soils >> l & 1) == 0 || ground.loose[l][index] < feature.least_thickness) continue;
        }
        odds.one[size_t(i)] = double(feature.chance) * double(area.share_of(biome, i)) * at_block;
    }
    return odds;
}

// Which cell of the grid a block lies in, counted from the area's first.
struct CellsOf {
    i64 first_x, first_z, wide;
    i64 cell;
    CellsOf(const Area& area, i64 cell_size)
        : cell(cell_size) {
        first_x = down(area.block_x(0));
        first_z = down(area.block_z(0));
        wide = i64(area.side) * 16 / cell + 2;
    }
    i64 down(i64 v) const { return v >= 0 ? v / cell : -((cell - 1 - v) / cell); }
    size_t of(i64 x, i64 z) const { return size_t((down(z) - first_z) * wide + down(x) - first_x); }
    size_t count() const { return size_t(wide * wide); }
};

inline Tally feature_tally(const Area& area, const FeatureOdds& odds, u32 row) {
    const CellsOf cells(area, odds.cell);
    std::vector<double> one(cells.count()), second(cells.count());
    for (i32 i = 0; i < area.blocks(); ++i) {
        if (odds.one[size_t(i)] == 0) continue;
        const size_t c = cells.of(area.block_x(i), area.block_z(i));
        one[c] += odds.one[size_t(i)];
        if (!odds.second.empty()) second[c] += odds.second[size_t(i)];
    }
    Tally tally;
    for (size_t c = 0; c < one.size(); ++c) {
        tally.mean += one[c];
        tally.variance += one[c] + second[c] - one[c] * one[c];
    }
    for (const Placement& p : area.placements)
        tally.seen += p.feature == row;
    return tally;
}

// One column filled and decorated, without features; `before` is what decorators find.
struct DecoratedColumn {
    std::unique_ptr<BlockTile> before = std::make_unique<BlockTile>(), after = std::make_unique<BlockTile>();
    void make(const Area& area, i32 column) {
        const SampledWorld& w = area.world;
        w.stages.fill(w.tables(), area.column(column), area.ground[size_t(column)], area.caves[size_t(column)],
                      *before);
        *after = *before;
        w.stages.decorate(w.tables(), area.column(column), area.ground[size_t(column)], area.caves[size_t(column)],
                          *after);
    }
};

// Places count only where one biome has all the weight, so that nothing is left to chance but the decorator's own.
inline constexpr double kAllWeight = .9999;

// Adds what one column holds. Calls place(row, block column, whether it stands there) for each place where the row
// could stand.
template <class Place>
void decorator_places(const Area& area, i32 column, const DecoratedColumn& blocks, Place&& place) {
    const TerrainTables& t = area.world.tables();
    const auto& described = base_terrain().decorators;
    const GroundTile& ground = area.ground[size_t(column)];
    const CaveTile& caves = area.caves[size_t(column)];
    const auto try_rows = [&](i32 index, i32 y, i32 step, DecoratorPlace where, u32 biome) {
        const auto before = [&](i32 at) { return blocks.before->block[at << 8 | index]; };
        const Block free = where == DecoratorPlace::sea_floor ? kWater : kAir;
        if (before(y) != free || before(y - step) == kLava || y - step < 1) return;
        for (u32 r = 0; r < t.decorators; ++r) {
            const DecoratorRow& row = t.decorator[r];
            if (row.place != where || row.biome != biome || !row.on.has(before(y - step))) continue;
            if (!described[r].upper.empty() && before(y + step) != free) continue;
            place(r, index, blocks.after->block[y << 8 | index] == row.block);
        }
    };
    double shares[kBiomesMost];
    for (i32 index = 0; index < kColumnCells; ++index) {
        const i32 y = i32(std::ceil(double(ground.top[index])));
        for (u32 b = 0; b < t.biomes; ++b)
            if (double(area.share_of(b, column << 8 | index)) > kAllWeight)
                try_rows(index, y, 1, y < kTerrainSeaLevel ? DecoratorPlace::sea_floor : DecoratorPlace::surface, b);
        const auto open = [&](i32 v) { return (caves.open[v / 32][index] >> (v % 32) & 1) != 0; };
        u32 any = 0;
        for (const auto& word : caves.open)
            any |= word[index];
        for (i32 v = 2; any != 0 && v < 200; ++v) {
            if (!open(v)) continue;
            for (const i32 step : {1, -1}) {
                if (open(v - step)) continue;
                // A floor's plants, two blocks high at most, take the room of what would hang above them.
                if (step < 0 && (!open(v - 1) || !open(v - 2))) continue;
                double outside[kCaveBiomesMost];
                cave_shares(t, ground, caves, index, v, shares);
                cave_shares(t, ground, caves, index, v - step, outside);
                for (u32 b = 0; b < t.cave_biomes; ++b)
                    if (shares[b] > kAllWeight && outside[b] > kAllWeight)
                        try_rows(index, v, step, step > 0 ? DecoratorPlace::cave_floor : DecoratorPlace::cave_ceiling,
                                 b);
            }
        }
    }
}

// rows: one a decorator.
inline void add_decorators(const Area& area, std::vector<Tally>& rows) {
    DecoratedColumn blocks;
    for (i32 column = 0; column < area.side * area.side; ++column) {
        blocks.make(area, column);
        decorator_places(area, column, blocks, [&](u32 r, i32, bool there) {
            const double p = double(base_terrain().decorators[r].chance);
            rows[r] += {double(there), p, p * (1 - p)};
        });
    }
}

// Loose layers, sums of blocks: as the formula lays them, and what erosion left of that; the same where the land is
// gentle around, so that nothing slides.
struct LooseTally {
    double laid = 0, left = 0, gentle_laid = 0, gentle_left = 0;
};
inline double material_weight(const std::string& layer, const double* shares) {
    const TerrainDescription& d = base_terrain();
    double weight = 0;
    for (size_t b = 0; b < d.biomes.size(); ++b) {
        const auto own = d.biomes[b].materials.find(layer), usual = d.materials.find(layer);
        weight += shares[b] * (own != d.biomes[b].materials.end() ? double(own->second)
                               : usual != d.materials.end()       ? double(usual->second)
                                                                  : 1.0);
    }
    return weight;
}
// Steepest way to any of the 8 neighbors, blocks a block; (x, z) in blocks of the area, not at its rim.
inline double slope_in(const Area& area, i32 x, i32 z) {
    const auto land = [&](i32 u, i32 v) {
        return double(area.ground[size_t((v >> 4) * area.side + (u >> 4))].land[(u & 15) | (v & 15) << 4]);
    };
    double slope = 0;
    for (i32 dz = -1; dz <= 1; ++dz)
        for (i32 dx = -1; dx <= 1; ++dx)
            if (dx != 0 || dz != 0)
                slope =
                    std::max(slope, std::abs(land(x + dx, z + dz) - land(x, z)) / std::sqrt(double(dx * dx + dz * dz)));
    return slope;
}
// rows: one a loose layer. Every third block column is looked at.
inline void add_loose(const Area& area, std::vector<LooseTally>& rows) {
    const i32 wide = area.side * 16;
    double shares[kBiomesMost];
    for (i32 z = 4; z + 4 < wide; z += 3)
        for (i32 x = 4; x + 4 < wide; x += 3) {
            const GroundTile& ground = area.ground[size_t((z >> 4) * area.side + (x >> 4))];
            const i32 index = (x & 15) | (z & 15) << 4;
            surface_shares(area.world.tables(), ground, index, shares);
            const double slope = slope_in(area, x, z);
            bool gentle = slope < .25;
            for (const i32 d : {-3, 3})
                gentle = gentle && slope_in(area, x + d, z) < .25 && slope_in(area, x, z + d) < .25;
            u32 l = 0;
            for (const auto& layer : base_terrain().layers) {
                if (!layer.loose) continue;
                const double laid = double(layer.thickness) * std::max(0.0, 1 - slope / double(layer.steepest)) *
                                    material_weight(layer.name, shares);
                const double left = double(ground.loose[l++][index]);
                LooseTally& row = rows[l - 1];
                row.laid += laid;
                row.left += left;
                if (!gentle) continue;
                row.gentle_laid += laid;
                row.gentle_left += left;
            }
        }
}

} // namespace vitrail
