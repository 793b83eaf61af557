// Rules change blocks of the ground after the layers lie (kernel/fill_kernel.h), in the order of their rows.
//
// Surface rules work in block columns whose drawn biome is the rule's. Depth counts from the top of the ground, for
// rules that change water from the sea's surface. A rule for the topmost block alone is the land's skin - grass and the
// like - and stops where water stands over it; rules for more blocks do not.
//
// Cave rules work in blocks whose drawn cave biome is the rule's. Floors and ceilings are those of the block column
// itself: the `depth` blocks under (over) an open one. Rules for rock reach all rock of the biome, not only what caves
// show, because players dig.
#pragma once

#include "terrain/kernel/biome_kernel.h"
#include "terrain/kernel/cave_biome_kernel.h"
#include "terrain/kernel/cave_layers.h"
#include "terrain/kernel/program_kernel.h"
#include "terrain/kernel/strata_kernel.h"

namespace vitrail {

inline constexpr i32 kCaveRuleDepthMost = 24; // deeper floors and ceilings are as deep as this

// Across the lanes.
template <class L>
VX_HD i32 lanes_least(typename L::I v) {
    if constexpr (L::kWidth == 1) {
        return v;
    } else {
        i32 w[L::kWidth];
        L::store(w, v);
        for (i32 half = L::kWidth / 2; half > 0; half /= 2)
            for (i32 l = 0; l < half; ++l)
                w[l] = w[l] < w[l + half] ? w[l] : w[l + half];
        return w[0];
    }
}
template <class L>
VX_HD i32 lanes_most(typename L::I v) {
    return -lanes_least<L>(-v);
}
template <class L>
VX_HD u32 lanes_or(typename L::U v) {
    if constexpr (L::kWidth == 1) {
        return v;
    } else {
        u64 w[8];
        __builtin_memcpy(w, &v, sizeof w);
        const u64 all = ((w[0] | w[1]) | (w[2] | w[3])) | ((w[4] | w[5]) | (w[6] | w[7]));
        return u32(all) | u32(all >> 32);
    }
}

namespace rule_detail {

template <class L>
VX_HD typename L::U get(const BlockTile& tile, i32 index, i32 y) {
    return L::load_bytes(tile.block + (y << 8) + index);
}

template <class L>
VX_HD auto in_set(const BlockSet& set, typename L::U block) {
    typename L::U found = L::u(0);
    for (u32 w = 0; w < kBlocksMost / 32; ++w)
        if (set.words[w] != 0)
            found = found | select((block >> 5) == L::u(w), L::u(set.words[w]) >> (block & 31u), L::u(0));
    return (found & 1u) != L::u(0);
}

// Blocks whose random number is below the chance; bits: random_bits of the block column.
template <class L>
VX_HD auto drawn(typename L::U bits, i32 y, float chance) {
    return unit_of(mix_bits(bits + u32(y) * 0xc2b2ae3du)) < L::f(chance);
}

VX_HD bool has_water(const BlockSet& set) {
    return set.has(kWater);
}

} // namespace rule_detail

// top: where the ground ends, y. inputs: as programs read them.
template <class L>
VX_HD_FN void surface_rule_row(const TerrainTables& t, const SurfaceRuleRow& rule, const Row<L>& row,
                               typename L::M here, typename L::I top, const typename L::F* inputs, BlockTile& out) {
    using I = typename L::I;
    using U = typename L::U;
    using namespace rule_detail;
    const I sea = L::i(kTerrainSeaLevel);
    const bool water = has_water(rule.from);
    if (!water && rule.depth == 1) {
        const auto dry = top >= sea;
        here = here & dry;
    }
    const I surface = water ? select(top < sea, sea, top) : top;
    const Spot<L> place = row.spot(L::f(0.0f));
    I low = L::i(kTerrainMinY + 1), high = surface, above = L::i(0);
    if (rule.above.count != 0) {
        above = block_above<L>(run_program<L>(t, rule.above, place, inputs));
        low = greatest(low, above);
    }
    if (rule.below.count != 0) high = least(high, block_above<L>(run_program<L>(t, rule.below, place, inputs)));
    if (rule.depth > 0) low = greatest(low, surface - i32(rule.depth));
    // Lanes that are not of the biome have nothing to change.
    high = select(here, high, L::i(kTerrainMinY));
    const i32 end = lanes_most<L>(high), first = lanes_least<L>(select(low < high, low, L::i(kTerrainMaxY)));
    if (first >= end) return;
    const U bits = rule.chance < 1.0f ? random_bits(rule.key, row.block_x(), row.block_z()) : L::u(0);
    U band = L::u(0);
    const u32 bands = rule.bands;
    if (bands != 0) band = as_uint(first - above + kTerrainHeight * i32(bands)) % bands;
    for (i32 y = first; y < end; ++y) {
        const U block = get<L>(out, row.index, y);
        const auto above_low = low <= L::i(y), below_high = high > L::i(y), changes = in_set<L>(rule.from, block);
        auto hit = above_low & below_high & changes;
        if (rule.chance < 1.0f) {
            const auto chosen = drawn<L>(bits, y, rule.chance);
            hit = hit & chosen;
        }
        U to = L::u(rule.to[0]);
        if (bands != 0) {
            if (L::any(hit))
                for (u32 i = 1; i < bands; ++i)
                    to = select(band == L::u(i), L::u(rule.to[i]), to);
            band = select(band + 1u == L::u(bands), L::u(0), band + 1u);
        }
        L::store_bytes(out.block + (y << 8) + row.index, select(hit, to, block));
    }
}

template <class L>
VX_HD_FN void surface_rules_row(const TerrainTables& t, const Row<L>& row, typename L::I top,
                                const typename L::F* inputs, BlockTile& out) {
    if (t.surface_rules == 0) return;
    const typename L::U picked =
        pick_biome<L>(t, inputs, unit_of(random_bits(t.pick_key, row.block_x(), row.block_z())));
    for (u32 r = 0; r < t.surface_rules; ++r) {
        const auto here = picked == L::u(t.surface_rule[r].biome);
        if (L::any(here)) surface_rule_row<L>(t, t.surface_rule[r], row, here, top, inputs, out);
    }
}

inline constexpr i32 kCaveRuleLevels = 8; // worked at once

namespace rule_detail {

// The cave biomes of the levels y to y + 7. Where no attribute changes with depth between them and one biome alone has
// weight, every block draws that one, whatever its random number; true then, and only out[0] is set.
template <class L>
VX_HD_FN bool cave_biomes(const TerrainTables& t, const GroundTile& ground, const CaveTile& caves, const Row<L>& row,
                          i32 y, typename L::U* out) {
    using F = typename L::F;
    const F land = L::load(ground.land + row.index);
    auto vague = L::f(0.0f) > L::f(1.0f);
    for (u32 i = 0; i < t.cave_attributes; ++i) {
        const CaveAttributeRow& a = t.cave_attribute[i];
        if (a.with_depth == 0.0f) continue;
        // As cave_attributes_at and step_between compute it; rounding keeps order, so what is beyond an edge at both
        // ends is so between them.
        const F offset = L::load(caves.offset[i] + row.index);
        const F from = ((land - float(y)) * a.with_depth + offset - a.low) * (1.0f / (a.high - a.low));
        const F to =
            ((land - float(y + kCaveRuleLevels - 1)) * a.with_depth + offset - a.low) * (1.0f / (a.high - a.low));
        const auto begun = greatest(from, to) > L::f(0.0f), undone = least(from, to) < L::f(1.0f);
        vague = vague | (begun & undone);
    }
    if (!L::any(vague)) {
        F attributes[kAttributesMost];
        cave_attributes_at<L>(t, ground, caves, row.index, L::i(y), attributes);
        typename L::U found = L::u(0), biome = L::u(0);
        for (u32 b = 0; b < t.cave_biomes; ++b) {
            const auto some = wants_weight<L>(t.cave_biome[b].wants, t.cave_attributes, attributes) > L::f(0.0f);
            found = found + select(some, L::u(1), L::u(0));
            biome = select(some, L::u(b), biome);
        }
        if (!L::any(found > L::u(1))) {
            out[0] = biome;
            return true;
        }
    }
    for (i32 i = 0; i < kCaveRuleLevels; ++i)
        out[i] = pick_cave_biome<L>(t, ground, caves, row, L::i(y + i));
    return false;
}

// Bit i: whether the level y + i is within `depth` blocks under (floor) or over (ceiling) an open one and not open
// itself.
template <class L>
VX_HD typename L::U near_open(const CaveTile& caves, i32 index, i32 y, i32 depth, bool floor) {
    using U = typename L::U;
    const i32 word = y >> 5, bit = y & 31; // a multiple of 8
    const U own = L::load(caves.open[word] + index);
    U near = L::u(0);
    if (floor) {
        U above = own >> u32(bit);
        if (bit != 0 && word + 1 < kTerrainHeight / 32)
            above = above | L::load(caves.open[word + 1] + index) << u32(32 - bit);
        for (i32 i = 1; i <= depth; ++i)
            near = near | above >> u32(i);
    } else {
        U below = own << u32(24 - bit);
        if (bit != 24 && word > 0) below = below | L::load(caves.open[word - 1] + index) >> u32(8 + bit);
        for (i32 i = 1; i <= depth; ++i)
            near = near | below << u32(i);
        near = near >> 24u;
    }
    return near & ((own >> u32(bit)) ^ 0xffffffffu) & 0xffu;
}

} // namespace rule_detail

template <class L>
VX_HD_FN void cave_rule_levels(const TerrainTables& t, u32 number, const Row<L>& row, const CaveTile& caves, i32 y,
                               const typename L::U* biomes, bool same, CoarseFields* fields, BlockTile& out) {
    using F = typename L::F;
    using U = typename L::U;
    using namespace rule_detail;
    const CaveRuleRow& rule = t.cave_rule[number];
    const U biome = L::u(rule.biome);
    U levels = L::u(0xffu);
    if (rule.place != CavePlace::rock) {
        const i32 depth = rule.depth < kCaveRuleDepthMost ? rule.depth : kCaveRuleDepthMost;
        levels = near_open<L>(caves, row.index, y, depth, rule.place == CavePlace::floor);
    }
    if (same) levels = select(biomes[0] == biome, levels, L::u(0));
    const u32 some = lanes_or<L>(levels);
    if (some == 0) return;
    const U bits = rule.chance < 1.0f ? random_bits(rule.key, row.block_x(), row.block_z()) : L::u(0);
    F vein[3];
    if (rule.veins != 0)
        for (i32 i = 0; i < 3; ++i)
            vein[i] = vein_noise<L>(t, number, y / kCoarseStep + i, row, fields);
    for (i32 i = 0; i < kCaveRuleLevels; ++i) {
        if ((some >> i & 1) == 0 || y + i == kTerrainMinY) continue;
        auto hit = (levels >> u32(i) & 1u) != L::u(0);
        if (!same) {
            const auto here = biomes[i] == biome;
            hit = hit & here;
        }
        if (rule.veins != 0) {
            const F low = vein[i >> 2], high = vein[(i >> 2) + 1];
            const auto in_vein = absolute<L>(low + (high - low) * (float(i & 3) * 0.25f)) < L::f(rule.vein_width);
            hit = hit & in_vein;
        }
        if (!L::any(hit)) continue;
        const U block = get<L>(out, row.index, y + i);
        const auto changes = in_set<L>(rule.from, block);
        hit = hit & changes;
        if (rule.chance < 1.0f) {
            const auto chosen = drawn<L>(bits, y + i, rule.chance);
            hit = hit & chosen;
        }
        L::store_bytes(out.block + ((y + i) << 8) + row.index, select(hit, L::u(rule.to), block));
    }
}

// top: where the ground ends, y.
template <class L>
VX_HD_FN void cave_rules_row(const TerrainTables& t, const Row<L>& row, const GroundTile& ground, const CaveTile& caves,
                             typename L::I top, CoarseFields* fields, BlockTile& out) {
    if (t.cave_rules == 0) return;
    u32 anywhere = 0, near_caves = 0; // biomes with rules for rock, with rules for floors and ceilings
    for (u32 r = 0; r < t.cave_rules; ++r)
        (t.cave_rule[r].place == CavePlace::rock ? anywhere : near_caves) |= 1u << t.cave_rule[r].biome;
    const i32 end = lanes_most<L>(top);
    for (i32 y = kTerrainMinY; y < end; y += kCaveRuleLevels) {
        typename L::U biomes[kCaveRuleLevels];
        const bool same = rule_detail::cave_biomes<L>(t, ground, caves, row, y, biomes);
        u32 present = 0;
        for (i32 i = 0; i < (same ? 1 : kCaveRuleLevels); ++i)
            present |= lanes_or<L>(L::u(1) << biomes[i]);
        if ((present & (anywhere | near_caves)) == 0) continue;
        for (u32 r = 0; r < t.cave_rules; ++r)
            if ((present >> t.cave_rule[r].biome & 1) != 0)
                cave_rule_levels<L>(t, r, row, caves, y, biomes, same, fields, out);
    }
}

} // namespace vitrail
