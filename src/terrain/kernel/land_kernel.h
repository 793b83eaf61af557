// The land before erosion: attributes from warped noise fields, heights as the biomes' weighted mean. Reach 0.
#pragma once

#include "terrain/kernel/biome_kernel.h"
#include "terrain/kernel/program_kernel.h"

namespace vitrail {

// Heights stay between bedrock and the top with room to spare. The order of the comparisons turns a NaN into the lower
// bound.
inline constexpr float kLandLowest = 4.0f, kLandHighest = 380.0f;
// Farther warps would leave the range that a Spot's offsets are exact in; content uses 20 blocks.
inline constexpr float kFieldWarpMost = 1024.0f;

template <class L>
VX_HD typename L::F held_between(typename L::F v, float low, float high) {
    return least(greatest(v, L::f(low)), L::f(high));
}

// attribute: makes kAttributesMost values in 0..1, whatever the fields give; those that the tables lack are 0, so that
// whole tiles can be compared.
template <class L>
VX_HD_FN void surface_attributes(const TerrainTables& t, const Row<L>& row, typename L::F* attribute) {
    using F = typename L::F;
    const Spot<L> here = row.spot(L::f(0.0f));
    Spot<L> warped = here;
    warped.dx = here.dx + held_between<L>(run_program<L>(t, t.warp_x, here, nullptr), -kFieldWarpMost, kFieldWarpMost);
    warped.dz = here.dz + held_between<L>(run_program<L>(t, t.warp_z, here, nullptr), -kFieldWarpMost, kFieldWarpMost);
    F field[kAttributesMost];
    for (u32 i = 0; i < t.fields; ++i)
        field[i] = run_program<L>(t, t.field[i], warped, nullptr);
    for (u32 i = 0; i < t.attributes; ++i) {
        const AttributeRow& a = t.attribute[i];
        attribute[i] = step_between<L>(a.low, a.high, field[a.field]);
    }
    for (u32 i = t.attributes; i < kAttributesMost; ++i)
        attribute[i] = L::f(0.0f);
}

// Weighted mean of the biomes' own heights, blocks. A biome without weight is not asked: elsewhere in the row it may
// be, so what it says there must not touch this lane (0 * infinity would).
template <class L>
VX_HD_FN typename L::F land_height(const TerrainTables& t, const Row<L>& row, const typename L::F* attribute) {
    using F = typename L::F;
    const F zero = L::f(0.0f);
    F inputs[kInputs];
    for (u32 i = 0; i < kAttributesMost; ++i)
        inputs[i] = attribute[i];
    inputs[kInputHeight] = zero;
    const Spot<L> here = row.spot(zero);
    F weights = zero, heights = zero;
    const SettledAttributes settled = settled_attributes<L>(t.attributes, attribute);
    for (u32 b = 0; b < t.biomes; ++b) {
        if (weightless(t.biome[b].wants, settled)) continue;
        const F weight = surface_weight<L>(t, b, attribute);
        const auto has = weight > zero;
        if (!L::any(has)) continue;
        const F height = run_program<L>(t, t.biome[b].height, here, inputs);
        weights = weights + weight;
        heights = select(has, heights + weight * height, heights);
    }
    return held_between<L>(heights / weights, kLandLowest, kLandHighest);
}

template <class L>
VX_HD_FN void land_row(const TerrainTables& t, const Row<L>& row, LandTile& out) {
    typename L::F attribute[kAttributesMost];
    surface_attributes<L>(t, row, attribute);
    for (u32 i = 0; i < kAttributesMost; ++i)
        L::store(out.attribute[i] + row.index, attribute[i]);
    L::store(out.height + row.index, land_height<L>(t, row, attribute));
}

} // namespace vitrail
