// Where features stand: one candidate place in each cell of a grid of its own, decided by the column that owns the
// place from what stands in that column alone. One thread a column; the order of candidates (rows, then cells by z,
// then x, then cave layers upwards) is the order in which features take voxels and room in the tile.
#pragma once

#include "terrain/kernel/cave_biome_kernel.h"
#include "terrain/kernel/cave_layers.h"
#include "terrain/kernel/shapes/build_shape.h"

namespace vitrail {

// Thinner loose layers do not count as the topmost one.
inline constexpr float kThinLayer = 0.05f;

// a / b rounded down; b > 0.
VX_HD i64 floor_divide(i64 a, i64 b) {
    const i64 q = a / b;
    return q * b > a ? q - 1 : q;
}

// The first block above the ground: blocks with y < top are ground.
VX_HD i32 first_above(float top) {
    return -floor_int<ScalarLanes>(-top);
}

// The candidate of one cell: its place in blocks and its chance.
struct CellPlace {
    i64 x = 0, z = 0; // may lie beyond the column, another one owns it then
    u32 bits = 0;     // random, further numbers follow from it
    float roll = 0;   // [0, 1)
};
VX_HD CellPlace cell_place(const FeatureRow& row, i64 cell_x, i64 cell_z) {
    const i64 cell = row.cell > 0 ? row.cell : 1;
    const i64 inner = cell > 2 * i64(row.padding) ? cell - 2 * i64(row.padding) : 1;
    CellPlace p;
    p.bits = random_bits(row.key, u32(cell_x), u32(cell_z));
    p.x = cell_x * cell + row.padding + below_of(random_next(p.bits, 0), u32(inner));
    p.z = cell_z * cell + row.padding + below_of(random_next(p.bits, 1), u32(inner));
    p.roll = unit_of(random_next(p.bits, 2));
    return p;
}

namespace placement_detail {

// Least and greatest value of each attribute in a tile: a biome whose product of the best values is 0 occurs nowhere in
// it.
struct AttributeRange {
    float low[kAttributesMost], high[kAttributesMost];
};
template <class L>
VX_HD_FN AttributeRange attribute_range(const TerrainTables& t, const GroundTile& ground) {
    AttributeRange r;
    for (u32 a = 0; a < t.attributes; ++a) {
        float low[16], high[16]; // of every sixteenth block column, so that a compiler can take them at once
        for (i32 l = 0; l < 16; ++l)
            low[l] = high[l] = ground.attribute[a][l];
        for (i32 i = 16; i < kColumnCells; i += 16)
            for (i32 l = 0; l < 16; ++l) {
                const float v = ground.attribute[a][i + l];
                low[l] = v < low[l] ? v : low[l];
                high[l] = v > high[l] ? v : high[l];
            }
        r.low[a] = low[0];
        r.high[a] = high[0];
        for (i32 l = 1; l < 16; ++l) {
            r.low[a] = low[l] < r.low[a] ? low[l] : r.low[a];
            r.high[a] = high[l] > r.high[a] ? high[l] : r.high[a];
        }
    }
    return r;
}
VX_HD bool biome_possible(const TerrainTables& t, u32 biome, const AttributeRange& r) {
    for (u32 a = 0; a < t.attributes; ++a) {
        const i32 wants = t.biome[biome].wants[a];
        if ((wants > 0 && !(r.high[a] > 0.0f)) || (wants < 0 && !(r.low[a] < 1.0f))) return false;
    }
    return true;
}

// Share of one biome among all at a block column, 0..1.
template <class L>
VX_HD_FN float surface_share(const TerrainTables& t, const GroundTile& ground, u32 biome, i32 index) {
    float value[kAttributesMost];
    for (u32 a = 0; a < t.attributes; ++a)
        value[a] = ground.attribute[a][index];
    const float own = surface_weight<L>(t, biome, value);
    if (!(own > 0.0f)) return 0.0f;
    return own / surface_weight_sum<L>(t, value);
}
// The same of a cave biome at a block.
template <class L>
VX_HD_FN float cave_share(const TerrainTables& t, const GroundTile& ground, const CaveTile& caves, u32 biome, i32 index,
                          i32 y) {
    float value[kAttributesMost];
    cave_attributes_at<L>(t, ground, caves, index, y, value);
    const float own = cave_weight<L>(t, biome, value);
    if (!(own > 0.0f)) return 0.0f;
    return own / cave_weight_sum<L>(t, value);
}

// Whether the topmost loose layer is one of the row's and thick enough.
VX_HD bool soil_fits(const TerrainTables& t, const FeatureRow& row, const GroundTile& ground, i32 index) {
    if (row.layers == 0) return true;
    for (i32 i = i32(t.loose) - 1; i >= 0; --i) {
        const float thickness = ground.loose[i][index];
        if (thickness > kThinLayer) return (row.layers >> i & 1) != 0 && thickness >= row.least_thickness;
    }
    return false;
}

// Builds one feature at its place; nothing stays of one that finds no room.
template <class L>
VX_HD_FN void place_one(const TerrainTables& t, u32 feature, i32 x, i32 y, i32 z, i32 room, u32 bits,
                        FeatureTile& out) {
    if (out.placements >= kPlacementsMost) return;
    Placement& p = out.placement[out.placements];
    p = Placement{};
    p.x = x;
    p.y = i16(y);
    p.z = z;
    p.feature = u16(feature);
    p.bits = bits;
    p.first = u16(out.primitives);
    p.room = i16(room);
    ShapeBuilder<L> builder{t, t.feature[feature], p, out};
    build_shape<L>(builder);
    if (builder.fits && p.count > 0)
        ++out.placements;
    else
        out.primitives = p.first;
}

template <class L>
VX_HD_FN void place_outside(const TerrainTables& t, u32 feature, const CellPlace& at, i32 index,
                            const GroundTile& ground, const CaveTile& caves, FeatureTile& out) {
    const FeatureRow& row = t.feature[feature];
    if (at.roll >= row.chance) return;
    const i32 above = first_above(ground.top[index]);
    const i32 depth = kTerrainSeaLevel - above; // of the water
    i32 y = above;
    if (row.place == FeaturePlace::surface) {
        if (depth > 0) return;
    } else {
        if (depth <= 0 || depth < row.water_depth) return;
        if (row.place == FeaturePlace::sea_surface) y = kTerrainSeaLevel;
    }
    if (y < row.lowest_y || y > row.highest_y || y >= kTerrainMaxY) return;
    if (above > kTerrainMinY && cave_open(caves, index, above - 1)) return; // a cave or a ravine took the ground
    if (!soil_fits(t, row, ground, index)) return;
    if (at.roll >= row.chance * surface_share<L>(t, ground, row.biome, index)) return;
    place_one<L>(t, feature, i32(at.x), y, i32(at.z), depth > 0 ? depth : 0, random_next(at.bits, 3), out);
}

template <class L>
VX_HD_FN void place_in_caves(const TerrainTables& t, u32 feature, const CellPlace& at, i32 index,
                             const GroundTile& ground, const CaveTile& caves, FeatureTile& out) {
    const FeatureRow& row = t.feature[feature];
    const bool ceiling = row.place == FeaturePlace::cave_ceiling;
    CaveLayer layer;
    for (i32 from = 0; next_cave_layer(caves, index, from, layer); from = layer.end + 2) {
        if (layer.height() < i32(row.least_height) || layer.start <= kTerrainLavaLevel) continue;
        if (ceiling && !layer.has_ceiling(ground.top[index])) continue;
        const i32 y = ceiling ? layer.end : layer.start;
        if (y < row.lowest_y || y > row.highest_y) continue;
        const u32 bits = random_bits(row.key, u32(at.x), u32(y), u32(at.z));
        const float roll = unit_of(random_next(bits, 2));
        if (roll >= row.chance || roll >= row.chance * cave_share<L>(t, ground, caves, row.biome, index, y)) continue;
        place_one<L>(t, feature, i32(at.x), y, i32(at.z), layer.height(), random_next(bits, 3), out);
    }
}

} // namespace placement_detail

// All features of a column. `out` need not be cleared.
template <class L>
VX_HD_FN void place_features(const TerrainTables& t, ColumnPos at, const GroundTile& ground, const CaveTile& caves,
                             FeatureTile& out) {
    using namespace placement_detail;
    out.placements = 0;
    out.primitives = 0;
    const AttributeRange range = attribute_range<L>(t, ground);
    u32 any_cave = 0;
    for (i32 w = 0; w < kTerrainHeight / 32; ++w)
        for (i32 i = 0; i < kColumnCells; ++i)
            any_cave |= caves.open[w][i];
    const i64 corner_x = i64(at.x) * 16, corner_z = i64(at.z) * 16;
    for (u32 f = 0; f < t.features; ++f) {
        const FeatureRow& row = t.feature[f];
        const bool cave = row.place == FeaturePlace::cave_floor || row.place == FeaturePlace::cave_ceiling;
        if (cave ? any_cave == 0 : !biome_possible(t, row.biome, range)) continue;
        const i64 cell = row.cell > 0 ? row.cell : 1;
        const i64 first_x = floor_divide(corner_x, cell), last_x = floor_divide(corner_x + 15, cell);
        const i64 first_z = floor_divide(corner_z, cell), last_z = floor_divide(corner_z + 15, cell);
        for (i64 cz = first_z; cz <= last_z; ++cz)
            for (i64 cx = first_x; cx <= last_x; ++cx) {
                const CellPlace place = cell_place(row, cx, cz);
                const i64 x = place.x - corner_x, z = place.z - corner_z;
                if (x < 0 || x > 15 || z < 0 || z > 15) continue;
                const i32 index = i32(x) | i32(z) << 4;
                if (cave)
                    place_in_caves<L>(t, f, place, index, ground, caves, out);
                else
                    place_outside<L>(t, f, place, index, ground, caves, out);
            }
    }
}

} // namespace vitrail
