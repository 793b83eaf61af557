// The blocks of one row of a tile before features: bedrock at y = 0, layers (kernel/strata_kernel.h), caves with lava
// below kTerrainLavaLevel, water above ground below kTerrainSeaLevel, then the rules (kernel/{,cave_}rule_kernel.h). A
// pure function of the column's own ground and caves.
//
// One GPU thread a block column: fill_row(t, thread_row(at, index), ground, caves, strata, nullptr, end, out), strata shared
// by the column's threads with all planes made, or null.
#pragma once

#include "terrain/kernel/cave_layers.h"
#include "terrain/kernel/cave_rule_kernel.h"

namespace vitrail {

namespace fill_detail {

template <class L>
VX_HD void put(BlockTile& out, i32 index, i32 y, typename L::U block) {
    L::store_bytes(out.block + (y << 8) + index, block);
}

// Lanes from `begin` on are `block`, which goes on over all lanes up to the level `end`; below the highest `begin` the
// tile already holds what lies under it.
template <class L>
VX_HD void paint(BlockTile& out, i32 index, typename L::I begin, i32 end, Block block) {
    const i32 low = lanes_least<L>(begin), high = least(lanes_most<L>(begin), end);
    const typename L::U all = L::u(block);
    for (i32 y = low; y < high; ++y)
        put<L>(out, index, y, select(begin > L::i(y), rule_detail::get<L>(out, index, y), all));
    for (i32 y = greatest(low, high); y < end; ++y)
        put<L>(out, index, y, all);
}

template <class L>
VX_HD_FN void carve(BlockTile& out, const CaveTile& caves, i32 index, i32 end) {
    for (i32 first = 0; first < end; first += 32) {
        const typename L::U open = L::load(caves.open[first >> 5] + index);
        u32 levels = lanes_or<L>(open);
        if (first == 0) levels &= ~1u; // bedrock
        while (levels != 0) {
            const i32 bit = cave_detail::trailing_zeros(levels), y = first + bit;
            levels &= levels - 1;
            if (y >= end) break;
            const auto hit = as_int(open << u32(31 - bit)) < L::i(0);
            put<L>(out, index, y,
                   select(hit, L::u(y < kTerrainLavaLevel ? kLava : kAir), rule_detail::get<L>(out, index, y)));
        }
    }
}

} // namespace fill_detail

// strata, fields: kept points of this column, or null. Writes every level y < end; above the ground and the sea they are air. 16 <= end <= kTerrainHeight.
template <class L>
VX_HD_FN void fill_row(const TerrainTables& t, const Row<L>& row, const GroundTile& ground, const CaveTile& caves,
                       CoarseStrata* strata, CoarseFields* fields, i32 end, BlockTile& out) {
    using namespace fill_detail;
    using I = typename L::I;
    typename L::F inputs[kInputs];
    for (u32 i = 0; i < kInputs; ++i)
        inputs[i] = L::f(0.0f);
    load_attributes<L>(t, ground, row.index, inputs);
    inputs[kInputHeight] = L::load(ground.land + row.index);

    const LayerStack<L> stack = layer_stack<L>(t, ground, row, inputs, strata);
    for (u32 l = 0; l < stack.count; ++l)
        paint<L>(out, row.index, stack.begin[l], lanes_most<L>(stack.begin[l + 1]), stack.block[l]);
    const I top = stack.begin[stack.count];
    i32 filled = lanes_most<L>(top);
    carve<L>(out, caves, row.index, filled);
    if (lanes_least<L>(top) < kTerrainSeaLevel) {
        filled = greatest(filled, kTerrainSeaLevel);
        paint<L>(out, row.index, top, kTerrainSeaLevel, kWater);
    }
    // The air between, where one lane's ground or water lies lower than another's.
    const I wet_top = select(top < L::i(kTerrainSeaLevel), L::i(kTerrainSeaLevel), top);
    paint<L>(out, row.index, wet_top, end, kAir);
    put<L>(out, row.index, 0, L::u(kBedrock));

    surface_rules_row<L>(t, row, top, inputs, out);
    cave_rules_row<L>(t, row, ground, caves, top, fields, out);
}

} // namespace vitrail
