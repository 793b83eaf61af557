// Rules change blocks of the ground after the layers lie (kernel/fill_kernel.h), in the order of their rows.
//
// Surface rules work in block columns whose drawn biome is the rule's. Depth counts from the top of the ground, for
// rules that change water from the sea's surface. A rule for the topmost block alone is the land's skin - grass and the
// like - and stops where water stands over it; rules for more blocks do not.
#pragma once

#include "terrain/kernel/biome_kernel.h"
#include "terrain/kernel/cave_layers.h"
#include "terrain/kernel/program_kernel.h"
#include "terrain/kernel/strata_kernel.h"

namespace vitrail {

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

// A set as lanes ask it: only words that hold anything.
template <class L>
struct SetProbe {
    u32 count = 0;
    u32 number[kBlocksMost / 32], word[kBlocksMost / 32];
    VX_HD explicit SetProbe(const BlockSet& set) {
        for (u32 w = 0; w < kBlocksMost / 32; ++w)
            if (set.words[w] != 0) {
                number[count] = w;
                word[count++] = set.words[w];
            }
    }
    VX_HD typename L::M has(typename L::U block) const {
        typename L::U found = L::u(0);
        for (u32 i = 0; i < count; ++i)
            found = found | select((block >> 5) == L::u(number[i]), L::u(word[i]) >> (block & 31u), L::u(0));
        return (found & 1u) != L::u(0);
    }
};

// Blocks whose random number is below the chance; bits: random_bits of the block column.
template <class L>
VX_HD auto drawn(typename L::U bits, i32 y, float chance) {
    return unit_of(random_at(bits, u32(y))) < L::f(chance);
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
    const SetProbe<L> from(rule.from);
    for (i32 y = first; y < end; ++y) {
        const U block = get<L>(out, row.index, y);
        const auto above_low = low <= L::i(y), below_high = high > L::i(y), changes = from.has(block);
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
    const typename L::U picked = pick_biome<L>(t, inputs, biome_draw<L>(t, row));
    for (u32 r = 0; r < t.surface_rules; ++r) {
        const auto here = picked == L::u(t.surface_rule[r].biome);
        if (L::any(here)) surface_rule_row<L>(t, t.surface_rule[r], row, here, top, inputs, out);
    }
}

} // namespace vitrail
