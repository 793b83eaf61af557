// Which cave biome a block belongs to. Cave attributes change with the depth below the land and with noise that is the
// same over a block column (CaveTile::offset); the biomes' weights are products of them, as on the surface, and every
// block draws by them, so that borders mix. A floor asks at its own lowest open block and a ceiling at its own highest
// one (kernel/cave_layers.h): neither takes the other's biome.
#pragma once

#include "terrain/kernel/biome_kernel.h"

namespace vitrail {

// Values 0..1 of the cave attributes of blocks at height y: out[0 .. t.cave_attributes). The land's height, not the
// eroded one, counts, so that a ditch does not move what lies below it.
template <class L>
VX_HD_FN void cave_attributes_at(const TerrainTables& t, const GroundTile& ground, const CaveTile& caves, i32 index,
                                 typename L::I y, typename L::F* out) {
    const typename L::F depth = L::load(ground.land + index) - to_float(y);
    for (u32 i = 0; i < t.cave_attributes; ++i) {
        const CaveAttributeRow& a = t.cave_attribute[i];
        out[i] = step_between<L>(a.low, a.high, depth * a.with_depth + L::load(caves.offset[i] + index));
    }
}

// Weights of all cave biomes, their sum 1: out[0 .. t.cave_biomes). Where no biome wants the place, the first has it.
template <class L>
VX_HD_FN void cave_biome_weights(const TerrainTables& t, const typename L::F* attributes, typename L::F* out) {
    using F = typename L::F;
    F sum = L::f(0.0f);
    for (u32 i = 0; i < t.cave_biomes; ++i) {
        out[i] = wants_weight<L>(t.cave_biome[i].wants, t.cave_attributes, attributes);
        sum = sum + out[i];
    }
    const auto some = sum > L::f(0.0f);
    const F scale = 1.0f / select(some, sum, L::f(1.0f));
    for (u32 i = 0; i < t.cave_biomes; ++i)
        out[i] = select(some, out[i] * scale, L::f(i == 0 ? 1.0f : 0.0f));
}

// The cave biome of the blocks at height y of a row: an index into t.cave_biome. Heights may differ by lane.
template <class L>
VX_HD_FN typename L::U pick_cave_biome(const TerrainTables& t, const GroundTile& ground, const CaveTile& caves,
                                       const Row<L>& row, typename L::I y) {
    using F = typename L::F;
    using U = typename L::U;
    F attributes[kAttributesMost];
    cave_attributes_at<L>(t, ground, caves, row.index, y, attributes);
    F upto[kCaveBiomesMost]; // sums of the weights so far
    F sum = L::f(0.0f);
    for (u32 i = 0; i < t.cave_biomes; ++i)
        upto[i] = sum = sum + wants_weight<L>(t.cave_biome[i].wants, t.cave_attributes, attributes);
    // drawn < sum even after rounding, because unit_of stays 2^-24 below 1: a biome without weight is never drawn.
    const F drawn = unit_of(random_bits(t.cave_pick_key, row.block_x(), as_uint(y), row.block_z())) * sum;
    U picked = L::u(0);
    for (u32 i = 0; i + 1 < t.cave_biomes; ++i)
        picked = picked + select(upto[i] > drawn, L::u(0), L::u(1));
    return select(sum > L::f(0.0f), picked, L::u(0));
}

// The same for one block: of block column `index` (x | z << 4) of the column `at`. Within a stage<L> call
// cave_biome_at<L>: the code for one lane too is then that build's own.
template <class L>
struct OneLane : ScalarLanes {};
template <class L = ScalarLanes>
VX_HD u32 cave_biome_at(const TerrainTables& t, const GroundTile& ground, const CaveTile& caves, ColumnPos at,
                        i32 index, i32 y) {
    const Row<ScalarLanes> r = thread_row(at, index);
    const Row<OneLane<L>> row{r.x, r.z, r.index, r.dx, r.dz};
    return pick_cave_biome<OneLane<L>>(t, ground, caves, row, y);
}

} // namespace vitrail
