// Where the layers of the ground begin. Strata lie from y = 0 up, each max(0, thickness + amplitude * noise) * weight
// blocks thick, weight being the share-weighted mean of the biomes' weights of that material; the remainder takes what
// the others leave up to where the hung strata begin, which hang under the loose layers; where the others leave
// nothing, the upper ones are cut. Loose layers are what erosion left.
//
// A block of strata belongs to the layer that covers its floor, height y: it is of layer l where begin(l) <= y <
// begin(l + 1). Ground ends where GroundTile::top says. Loose layers are asked at a height within the block that is
// drawn once for each block column (in the topmost block: within its part that is ground), so that a layer thinner than
// a block is strewn over the land and does not follow its contour lines.
#pragma once

#include "terrain/kernel/biome_kernel.h"
#include "terrain/kernel/coarse_kernel.h"

namespace vitrail {

inline constexpr u32 kLayersMost = kStrataMost + kLooseMost + 1;

// Layers bottom up; layer l lies at y >= begin[l], y < begin[l + 1]; begin[count] is the end of the ground. Values are
// whole, ascending, 0..kTerrainHeight.
template <class L>
struct LayerStack {
    u32 count = 0;
    Block block[kLayersMost];
    typename L::I begin[kLayersMost + 1];
};

// The least y that is not below v.
template <class L>
VX_HD typename L::I block_above(typename L::F v) {
    return -floor_int<L>(-greatest(least(v, L::f(float(kTerrainMaxY))), L::f(float(kTerrainMinY))));
}

template <class L>
VX_HD_FN LayerStack<L> layer_stack(const TerrainTables& t, const GroundTile& ground, const Row<L>& row,
                                   const typename L::F* attribute, CoarseStrata* coarse) {
    using F = typename L::F;
    const F zero = L::f(0.0f);
    F share[kStrataMost];
    for (u32 s = 0; s < t.strata; ++s)
        share[s] = zero;
    F weights = zero;
    for (u32 b = 0; b < t.biomes; ++b) {
        const F weight = surface_weight<L>(t, b, attribute);
        if (!L::any(weight > zero)) continue; // adding 0 changes nothing
        weights = weights + weight;
        for (u32 s = 0; s < t.strata; ++s)
            share[s] = share[s] + weight * t.biome[b].strata[s];
    }
    const F scale = 1.0f / select(weights > zero, weights, L::f(1.0f));

    // From the top down: the loose layers, then what hangs under them.
    const F top = L::load(ground.top + row.index);
    F loose_from[kLooseMost];
    F from = top;
    for (u32 l = t.loose; l-- > 0;) {
        from = greatest(from - L::load(ground.loose[l] + row.index), zero);
        loose_from[l] = from;
    }
    F thick[kStrataMost];
    F stacked = zero;
    bool remainder = false;
    for (u32 s = 0; s < t.strata; ++s) {
        const StratumRow& stratum = t.stratum[s];
        thick[s] = zero;
        if (!stratum.hung && stratum.block == t.remainder) {
            remainder = true;
            continue;
        }
        if (!L::any(share[s] > zero)) continue;
        const F t0 = stratum.thickness + stratum_noise<L>(t, s, row, coarse) * stratum.amplitude;
        thick[s] = greatest(t0, zero) * (share[s] * scale);
        if (!stratum.hung) stacked = stacked + thick[s];
    }
    F hung_from[kStrataMost];
    for (u32 s = t.strata; s-- > 0;)
        if (t.stratum[s].hung) hung_from[s] = from = greatest(from - thick[s], zero);
    const F left = greatest(from - stacked, zero);

    LayerStack<L> out;
    const auto add = [&](Block block, F begin) {
        out.block[out.count] = block;
        out.begin[out.count++] = block_above<L>(begin);
    };
    F at = zero;
    for (u32 s = 0; s < t.strata; ++s) {
        if (t.stratum[s].hung) continue;
        const bool rest = t.stratum[s].block == t.remainder;
        if (rest || L::any(thick[s] > zero)) add(t.stratum[s].block, at);
        at = least(at + (rest ? left : thick[s]), from);
    }
    if (!remainder) add(t.remainder != kAir ? t.remainder : t.deepest_stone, at);
    for (u32 s = 0; s < t.strata; ++s)
        if (t.stratum[s].hung && L::any(thick[s] > zero)) add(t.stratum[s].block, hung_from[s]);
    const typename L::I end = block_above<L>(top);
    const F within = unit_of(random_next(clump_bits(t.pick_key, row.block_x(), row.block_z()), 0));
    const F last = to_float(end - 1), asked = last + within * (top - last); // of the topmost block
    for (u32 l = 0; l < t.loose; ++l) {
        const F next = l + 1 < t.loose ? loose_from[l + 1] : top;
        if (!L::any(next > loose_from[l])) continue;
        add(t.loose_layer[l].block, loose_from[l] - within);
        typename L::I& begin = out.begin[out.count - 1];
        const auto reached = asked >= loose_from[l], some = loose_from[l] < top;
        const auto topmost = begin >= end - 1;
        begin = select(topmost, select(reached & some, end - 1, end), begin);
    }
    out.begin[out.count] = end;
    return out;
}

} // namespace vitrail
