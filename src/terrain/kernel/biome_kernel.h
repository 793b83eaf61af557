// Weights of biomes. Each attribute that a biome wants is a factor v, or 1 - v where it wants the opposite; rows that
// tell each other apart by every attribute sum to 1 by themselves, and where a modder's row overlaps them all are
// shares of the sum.
#pragma once

#include "terrain/kernel/random_kernel.h"
#include "terrain/tiles.h"

namespace vitrail {

// 0..1. attribute: `attributes` values in 0..1.
template <class L>
VX_HD typename L::F wants_weight(const i8* wants, u32 attributes, const typename L::F* attribute) {
    typename L::F weight = L::f(1.0f);
    for (u32 i = 0; i < attributes; ++i) {
        if (wants[i] > 0) weight = weight * attribute[i];
        if (wants[i] < 0) weight = weight * (1.0f - attribute[i]);
    }
    return weight;
}

// Attributes that are 0 or 1 in every lane: most are, as thresholds are narrow, and most biomes then have no weight at
// all. Skipping those is exact: a weight of 0 changes no sum, no draw and no maximum.
struct SettledAttributes {
    u64 none = 0; // 0x01 in byte i: attribute i is 0
    u64 full = 0; // 0x80 in byte i: attribute i is 1
};
template <class L>
VX_HD SettledAttributes settled_attributes(u32 attributes, const typename L::F* attribute) {
    SettledAttributes settled;
    for (u32 i = 0; i < attributes; ++i) {
        if (!L::any(attribute[i] != L::f(0.0f))) settled.none |= u64(0x01) << 8 * i;
        if (!L::any(attribute[i] != L::f(1.0f))) settled.full |= u64(0x80) << 8 * i;
    }
    return settled;
}
// Whether a factor of the weight is 0 in every lane; all eight wants at once, byte by byte: 1, 0 or -1.
VX_HD bool weightless(const i8* wants, SettledAttributes settled) {
    static_assert(kAttributesMost == 8, "a row's wants fill a u64");
    u64 bytes;
    __builtin_memcpy(&bytes, wants, sizeof bytes);
    const u64 against = bytes & 0x8080808080808080u, for_it = bytes & 0x0101010101010101u & ~(against >> 7);
    return ((for_it & settled.none) | (against & settled.full)) != 0;
}

namespace biome_detail {

template <class L, class BiomeRow>
VX_HD_FN typename L::F weight_sum(const BiomeRow* rows, u32 count, u32 attributes, const typename L::F* attribute) {
    const SettledAttributes settled = settled_attributes<L>(attributes, attribute);
    typename L::F sum = L::f(0.0f);
    for (u32 b = 0; b < count; ++b)
        if (!weightless(rows[b].wants, settled)) sum = sum + wants_weight<L>(rows[b].wants, attributes, attribute);
    return sum;
}

// The last row with any weight that begins at or before unit * sum: its weight holds that place.
template <class L, class BiomeRow>
VX_HD_FN typename L::U pick(const BiomeRow* rows, u32 count, u32 attributes, const typename L::F* attribute,
                            typename L::F unit) {
    using F = typename L::F;
    const SettledAttributes settled = settled_attributes<L>(attributes, attribute);
    const F place = unit * weight_sum<L>(rows, count, attributes, attribute);
    typename L::U picked = L::u(0);
    F begin = L::f(0.0f);
    for (u32 b = 0; b < count; ++b) {
        if (weightless(rows[b].wants, settled)) continue;
        const F weight = wants_weight<L>(rows[b].wants, attributes, attribute);
        picked = select((weight > L::f(0.0f)) & (begin <= place), L::u(b), picked);
        begin = begin + weight;
    }
    return picked;
}

// The first of the rows with the largest weight.
template <class L, class BiomeRow>
VX_HD_FN typename L::U strongest(const BiomeRow* rows, u32 count, u32 attributes, const typename L::F* attribute) {
    using F = typename L::F;
    const SettledAttributes settled = settled_attributes<L>(attributes, attribute);
    typename L::U found = L::u(0);
    F most = L::f(0.0f);
    for (u32 b = 0; b < count; ++b) {
        if (weightless(rows[b].wants, settled)) continue;
        const F weight = wants_weight<L>(rows[b].wants, attributes, attribute);
        found = select(weight > most, L::u(b), found);
        most = greatest(weight, most);
    }
    return found;
}

} // namespace biome_detail

// Surface biomes, by the surface attributes (LandTile, GroundTile).
template <class L>
VX_HD typename L::F surface_weight(const TerrainTables& t, u32 biome, const typename L::F* attribute) {
    return wants_weight<L>(t.biome[biome].wants, t.attributes, attribute);
}
template <class L>
VX_HD typename L::F surface_weight_sum(const TerrainTables& t, const typename L::F* attribute) {
    return biome_detail::weight_sum<L>(t.biome, t.biomes, t.attributes, attribute);
}
// Drawn by the weights; unit: random in [0, 1). A biome of weight 0 is never drawn while any other has some.
template <class L>
VX_HD typename L::U pick_biome(const TerrainTables& t, const typename L::F* attribute, typename L::F unit) {
    return biome_detail::pick<L>(t.biome, t.biomes, t.attributes, attribute, unit);
}
template <class L>
VX_HD typename L::U strongest_biome(const TerrainTables& t, const typename L::F* attribute) {
    return biome_detail::strongest<L>(t.biome, t.biomes, t.attributes, attribute);
}

// Cave biomes, by the values of the cave attributes at a block.
template <class L>
VX_HD typename L::F cave_weight(const TerrainTables& t, u32 biome, const typename L::F* attribute) {
    return wants_weight<L>(t.cave_biome[biome].wants, t.cave_attributes, attribute);
}
template <class L>
VX_HD typename L::F cave_weight_sum(const TerrainTables& t, const typename L::F* attribute) {
    return biome_detail::weight_sum<L>(t.cave_biome, t.cave_biomes, t.cave_attributes, attribute);
}
template <class L>
VX_HD typename L::U pick_cave_biome(const TerrainTables& t, const typename L::F* attribute, typename L::F unit) {
    return biome_detail::pick<L>(t.cave_biome, t.cave_biomes, t.cave_attributes, attribute, unit);
}
template <class L>
VX_HD typename L::U strongest_cave_biome(const TerrainTables& t, const typename L::F* attribute) {
    return biome_detail::strongest<L>(t.cave_biome, t.cave_biomes, t.cave_attributes, attribute);
}

// Attributes of one row of a tile, LandTile or GroundTile; `attribute` holds kAttributesMost values.
template <class L, class Tile>
VX_HD void load_attributes(const TerrainTables& t, const Tile& tile, i32 index, typename L::F* attribute) {
    for (u32 i = 0; i < t.attributes; ++i)
        attribute[i] = L::load(tile.attribute[i] + index);
}

// The number in [0, 1) that a block column's biome is drawn with.
template <class L>
VX_HD typename L::F biome_draw(const TerrainTables& t, const Row<L>& row) {
    return unit_of(random_next(clump_bits(t.pick_key, row.block_x(), row.block_z()), 1));
}
// Which surface biome the materials, rules and decorators of each block column come from: one draw for all of them, so
// that blocks mix at borders and still belong together.
template <class L, class Tile>
VX_HD_FN typename L::U surface_biome_row(const TerrainTables& t, const Tile& tile, const Row<L>& row) {
    typename L::F attribute[kAttributesMost];
    load_attributes<L>(t, tile, row.index, attribute);
    return pick_biome<L>(t, attribute, biome_draw<L>(t, row));
}

} // namespace vitrail
