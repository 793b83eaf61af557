// Cave rules change blocks below the ground where the drawn cave biome is the rule's, after the surface rules and in
// the order of their rows. Floors and ceilings are those of the block column itself: the `depth` blocks under (over) an
// open one. Rules for rock reach all rock of the biome, not only what caves show, because players dig; veins there
// follow noise at every fourth block (kernel/coarse_kernel.h). No rule asks another column.
//
// The biomes drawn are those of pick_cave_biome, at a fraction of its work: most levels lie where no attribute changes
// with depth, and biomes are drawn only where a rule has a block to change.
#pragma once

#include "terrain/kernel/cave_biome_kernel.h"
#include "terrain/kernel/rule_kernel.h"

namespace vitrail {

inline constexpr i32 kCaveRuleLevels = 8;     // worked at once

// Draws the cave biomes of one row.
template <class L>
struct CaveDraw {
    using F = typename L::F;
    F land;
    F offset[kAttributesMost];
    F factor[2 * kAttributesMost];             // each attribute, and 1 - the attribute; some change with depth
    u8 uses[kCaveBiomesMost][kAttributesMost]; // the factors of each biome's weight
    u8 used[kCaveBiomesMost];                  // how many they are
    typename L::U bits;                        // random, of the block column
    u32 vague_from[kAttributesMost], vague_to[kAttributesMost]; // levels between which attributes change
    u32 possible = 0; // biomes that may have weight at some level, bits; others are passed over
    // Of one level, or of all up to `steady_to` where nothing changes: sums of the weights, row after row.
    i32 steady_to = -1;
    u32 steady_biomes = 0; // bits: those with weight
    bool alone = false;    // one biome a block column; `biome`
    typename L::U biome;
    F upto[kCaveBiomesMost], sum;
};

namespace cave_rule_detail {

// As wants_weight.
template <class L>
VX_HD typename L::F weight_of(const CaveDraw<L>& d, u32 biome) {
    if (d.used[biome] == 0) return L::f(1.0f);
    typename L::F weight = d.factor[d.uses[biome][0]];
    for (u32 i = 1; i < d.used[biome]; ++i)
        weight = weight * d.factor[d.uses[biome][i]];
    return weight;
}

template <class L>
VX_HD void find_weights(const TerrainTables& t, i32 y, CaveDraw<L>& d) {
    const typename L::F depth = d.land - float(y);
    for (u32 i = 0; i < t.cave_attributes; ++i) {
        const CaveAttributeRow& a = t.cave_attribute[i];
        if (a.with_depth == 0.0f) continue;
        d.factor[2 * i] = step_between<L>(a.low, a.high, depth * a.with_depth + d.offset[i]);
        d.factor[2 * i + 1] = 1.0f - d.factor[2 * i];
    }
    typename L::F sum = L::f(0.0f);
    for (u32 b = 0; b < t.cave_biomes; ++b)
        if ((d.possible >> b & 1) != 0) d.upto[b] = sum = sum + weight_of<L>(d, b);
    d.sum = sum;
}

// As pick_cave_biome: the first whose sum exceeds the drawn share of all.
template <class L>
VX_HD typename L::U draw(const TerrainTables& t, i32 y, const CaveDraw<L>& d) {
    using M = typename L::M;
    const typename L::F drawn = unit_of(random_at(d.bits, u32(y))) * d.sum;
    typename L::U picked = L::u(0);
    M passed = d.sum > L::f(0.0f);
    for (u32 b = 0; b < t.cave_biomes; ++b) {
        if ((d.possible >> b & 1) == 0) continue;
        picked = select(passed, L::u(b), picked);
        const M beyond = d.upto[b] <= drawn;
        passed = passed & beyond;
    }
    return picked;
}

template <class L>
VX_HD_FN void begin(const TerrainTables& t, const GroundTile& ground, const CaveTile& caves, const Row<L>& row,
                    CaveDraw<L>& d) {
    using F = typename L::F;
    d.land = L::load(ground.land + row.index);
    d.bits = random_bits(t.cave_pick_key, row.block_x(), row.block_z());
    F attribute[kAttributesMost];
    cave_attributes_at<L>(t, ground, caves, row.index, L::i(0), attribute);
    for (u32 i = 0; i < t.cave_attributes; ++i) {
        const CaveAttributeRow& a = t.cave_attribute[i];
        d.offset[i] = L::load(caves.offset[i] + row.index);
        d.factor[2 * i] = attribute[i];
        d.factor[2 * i + 1] = 1.0f - attribute[i];
        d.vague_from[i] = 1;
        d.vague_to[i] = 0;
        if (a.with_depth == 0.0f) continue;
        // The step's edges lie at these heights; a level more on both sides for rounding.
        const float scale = 1.0f / a.with_depth;
        const F one = d.land + (d.offset[i] - a.low) * scale, other = d.land + (d.offset[i] - a.high) * scale;
        const F world = L::f(float(kTerrainHeight) + 8.0f), below = L::f(-8.0f);
        const i32 from = lanes_least<L>(to_int(greatest(least(least(one, other), world), below))) - 2;
        const i32 to = lanes_most<L>(to_int(greatest(least(greatest(one, other), world), below))) + 2;
        d.vague_from[i] = u32(from < 0 ? 0 : from);
        d.vague_to[i] = u32(to < 0 ? 0 : to);
    }
    for (u32 b = 0; b < t.cave_biomes; ++b) {
        F weight = L::f(1.0f); // without what changes with depth
        d.used[b] = 0;
        for (u32 i = 0; i < t.cave_attributes; ++i) {
            const i32 wants = t.cave_biome[b].wants[i];
            if (wants == 0) continue;
            const u8 factor = u8(2 * i + (wants < 0 ? 1 : 0));
            d.uses[b][d.used[b]++] = factor;
            if (t.cave_attribute[i].with_depth == 0.0f) weight = weight * d.factor[factor];
        }
        if (L::any(weight > L::f(0.0f))) d.possible |= 1u << b;
    }
}

// Whether attributes change at the level y; if not, the next level where one does, or the world's end.
template <class L>
VX_HD bool is_vague(const TerrainTables& t, const CaveDraw<L>& d, i32 y, i32& next) {
    next = kTerrainMaxY;
    for (u32 i = 0; i < t.cave_attributes; ++i) {
        if (d.vague_from[i] > d.vague_to[i]) continue;
        if (i32(d.vague_from[i]) <= y && y <= i32(d.vague_to[i])) return true;
        if (i32(d.vague_from[i]) > y && i32(d.vague_from[i]) < next) next = i32(d.vague_from[i]);
    }
    return false;
}

// Weights of the levels from y, which is not vague, to `next`.
template <class L>
VX_HD_FN void find_steady(const TerrainTables& t, i32 y, i32 next, CaveDraw<L>& d) {
    using U = typename L::U;
    find_weights<L>(t, y, d);
    d.steady_to = next;
    d.steady_biomes = 0;
    U found = L::u(0);
    d.biome = L::u(0);
    for (u32 b = 0; b < t.cave_biomes; ++b) {
        if ((d.possible >> b & 1) == 0) continue;
        const auto some = weight_of<L>(d, b) > L::f(0.0f);
        if (!L::any(some)) continue;
        d.steady_biomes |= 1u << b;
        found = found + select(some, L::u(1), L::u(0));
        d.biome = select(some, L::u(b), d.biome);
    }
    if (L::any(found == L::u(0))) d.steady_biomes |= 1u;
    d.alone = !L::any(found > L::u(1));
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

} // namespace cave_rule_detail

// top: where the ground ends, y.
template <class L>
VX_HD_FN void cave_rules_row(const TerrainTables& t, const Row<L>& row, const GroundTile& ground, const CaveTile& caves,
                             typename L::I top, CoarseFields* fields, BlockTile& out) {
    using F = typename L::F;
    using U = typename L::U;
    using namespace rule_detail;
    using namespace cave_rule_detail;
    if (t.cave_rules == 0 || t.cave_biomes == 0) return;
    CaveDraw<L> d;
    begin<L>(t, ground, caves, row, d);
    u32 ruled = 0; // biomes that have rules
    for (u32 r = 0; r < t.cave_rules; ++r)
        ruled |= 1u << t.cave_rule[r].biome;
    if (((d.possible | 1u) & ruled) == 0) return; // the first has what no biome wants
    u32 open[kTerrainHeight / 32 + 1];            // of any lane
    for (i32 w = 0; w < kTerrainHeight / 32; ++w)
        open[w] = lanes_or<L>(L::load(caves.open[w] + row.index));
    open[kTerrainHeight / 32] = 0;

    const i32 end = lanes_most<L>(top);
    for (i32 y = kTerrainMinY; y < end; y += kCaveRuleLevels) {
        // Which levels change with depth; the weights of the others are found once.
        i32 next = 0;
        const bool steady = !is_vague<L>(t, d, y, next) && next >= y + kCaveRuleLevels;
        if (steady && d.steady_to != next) find_steady<L>(t, y, next, d);
        const u32 biomes = steady ? d.steady_biomes : d.possible | 1u;
        if ((biomes & ruled) == 0) continue;
        U drawn_biome[kCaveRuleLevels];
        u32 known = 0;
        i32 weighed_from = 0, weighed_to = 0; // levels that share the weights found last
        for (u32 r = 0; r < t.cave_rules; ++r) {
            const CaveRuleRow& rule = t.cave_rule[r];
            if ((biomes >> rule.biome & 1) == 0) continue;
            const U biome = L::u(rule.biome);
            U levels = L::u(0xffu);
            if (rule.place != CavePlace::rock) {
                const bool floor = rule.place == CavePlace::floor;
                const i32 depth = rule.depth < kCaveRuleDepthMost ? rule.depth : kCaveRuleDepthMost;
                // Blocks from y + 1 to y + 7 + depth, or from y - depth to y + 6: in these words or in none.
                const i32 word = y >> 5;
                u32 close = open[word];
                if (floor)
                    close |= open[word + 1];
                else if (word > 0)
                    close |= open[word - 1];
                if (close == 0) continue;
                levels = near_open<L>(caves, row.index, y, depth, floor);
            }
            if (steady && d.alone) levels = select(d.biome == biome, levels, L::u(0));
            const u32 some = lanes_or<L>(levels);
            if (some == 0) continue;
            const U bits = rule.chance < 1.0f ? random_bits(rule.key, row.block_x(), row.block_z()) : L::u(0);
            const SetProbe<L> from(rule.from);
            F vein[3];
            bool veins_known = rule.veins == 0;
            for (i32 i = 0; i < kCaveRuleLevels; ++i) {
                if ((some >> i & 1) == 0 || y + i == kTerrainMinY) continue;
                const U block = get<L>(out, row.index, y + i);
                const auto there = (levels >> u32(i) & 1u) != L::u(0), changes = from.has(block);
                const auto ground_there = top > L::i(y + i); // a rule may take air, but not what lies above
                auto hit = there & changes & ground_there;
                if (!L::any(hit)) continue;
                if (rule.veins != 0) {
                    if (!veins_known)
                        for (i32 n = 0; n < 3; ++n)
                            vein[n] = vein_noise<L>(t, r, y / kCoarseStep + n, row, fields);
                    veins_known = true;
                    const F low = vein[i >> 2], high = vein[(i >> 2) + 1];
                    const auto in_vein =
                        absolute<L>(low + (high - low) * (float(i & 3) * 0.25f)) < L::f(rule.vein_width);
                    hit = hit & in_vein;
                    if (!L::any(hit)) continue;
                }
                if (!(steady && d.alone)) {
                    if ((known >> i & 1) == 0) {
                        if (!steady && (y + i < weighed_from || y + i >= weighed_to)) {
                            const bool changing = is_vague<L>(t, d, y + i, next);
                            find_weights<L>(t, y + i, d);
                            weighed_from = y + i;
                            weighed_to = changing ? y + i + 1 : next;
                        }
                        drawn_biome[i] = draw<L>(t, y + i, d);
                        known |= 1u << i;
                    }
                    const auto here = drawn_biome[i] == biome;
                    hit = hit & here;
                }
                if (!L::any(hit)) continue;
                if (rule.chance < 1.0f) {
                    const auto chosen = drawn<L>(bits, y + i, rule.chance);
                    hit = hit & chosen;
                }
                L::store_bytes(out.block + ((y + i) << 8) + row.index, select(hit, L::u(rule.to), block));
            }
        }
        if (!steady) d.steady_to = -1; // the weights are those of another level now
    }
}

} // namespace vitrail
