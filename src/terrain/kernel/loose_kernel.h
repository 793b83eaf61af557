// Loose layers as they lie before erosion: thick on flat land, thin on slopes, none where it is too steep. Reach one
// block.
#pragma once

#include "terrain/kernel/land_kernel.h"

namespace vitrail {

inline constexpr float kDiagonal = 1.41421356f, kDiagonalInverse = 0.707106781f;
// Whatever content says, eight layers over the highest land stay below the top of the world, and rock lies under them.
inline constexpr float kLooseMostThick = 32.0f, kRockLowest = 1.0f;

// Steepest difference to the eight neighbors, blocks a block; a diagonal one is sqrt 2 away. height points at the block
// (GPU) or the first of the row's blocks (CPU) in a plane with `stride` between rows. Rounding keeps order, so the
// differences of the extremes are the extremes of the differences.
template <class L>
VX_HD typename L::F slope_at(const float* height, i32 stride) {
    using F = typename L::F;
    const F here = L::load(height);
    const F west = L::load(height - 1), east = L::load(height + 1), north = L::load(height - stride),
            south = L::load(height + stride);
    const F nw = L::load(height - stride - 1), ne = L::load(height - stride + 1);
    const F sw = L::load(height + stride - 1), se = L::load(height + stride + 1);
    const F high = greatest(greatest(west, east), greatest(north, south)),
            low = least(least(west, east), least(north, south));
    const F far_high = greatest(greatest(nw, ne), greatest(sw, se)), far_low = least(least(nw, ne), least(sw, se));
    return greatest(greatest(high - here, here - low), greatest(far_high - here, here - far_low) * kDiagonalInverse);
}

// Thickness of each loose layer, blocks; `loose` takes t.loose values.
template <class L>
VX_HD_FN void lay_loose(const TerrainTables& t, const typename L::F* attribute, typename L::F slope,
                        typename L::F* loose) {
    using F = typename L::F;
    const F zero = L::f(0.0f);
    for (u32 l = 0; l < t.loose; ++l)
        loose[l] = zero;
    F weights = zero;
    const SettledAttributes settled = settled_attributes<L>(t.attributes, attribute);
    for (u32 b = 0; b < t.biomes; ++b) {
        if (weightless(t.biome[b].wants, settled)) continue;
        const F weight = surface_weight<L>(t, b, attribute);
        if (!L::any(weight > zero)) continue; // adding 0 changes nothing
        weights = weights + weight;
        for (u32 l = 0; l < t.loose; ++l)
            loose[l] = loose[l] + weight * t.biome[b].loose[l];
    }
    for (u32 l = 0; l < t.loose; ++l) {
        const LooseRow& layer = t.loose_layer[l];
        const F kept = greatest(1.0f - slope / layer.steepest, zero);
        loose[l] = held_between<L>(layer.thickness * kept * (loose[l] / weights), 0.0f, kLooseMostThick);
    }
}

// Where rock ends below untouched loose layers.
template <class L>
VX_HD typename L::F rock_below(const TerrainTables& t, typename L::F height, const typename L::F* loose) {
    typename L::F sum = L::f(0.0f);
    for (u32 l = 0; l < t.loose; ++l)
        sum = sum + loose[l];
    return greatest(height - sum, L::f(kRockLowest));
}

} // namespace vitrail
