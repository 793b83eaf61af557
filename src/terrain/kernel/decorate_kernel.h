// Small plants and crystals, one block or two, after features are drawn: on the land, on the sea's floor, on the floors
// of caves and under their ceilings. Each place draws one random number, which the rows of its biome share: row after
// row takes its chance of it, so their order changes nothing. What is drawn stands only in a free block (air; on the
// sea's floor water) beside a block that its row wants, a tall one only where both its blocks are free. The land's
// biome is the one that its blocks come from; a cave's floor asks for the biome of its own lowest open block, a ceiling
// for that of its own highest one.
//
// One GPU thread a block column: decorate_row(t, index, thread_row(at, i), ground, caves, tile); the result is where
// the tile's content ends there, 0 where nothing was set.
#pragma once

#include "terrain/kernel/biome_kernel.h"
#include "terrain/kernel/cave_biome_kernel.h"
#include "terrain/kernel/cave_layers.h"
#include "terrain/kernel/strata_kernel.h"

namespace vitrail {

inline constexpr u32 kDecoratorPlaceCount = 4;
inline constexpr u64 kDecoratePurpose = 0x6465636f72617465ull; // names the random numbers
inline constexpr u8 kNoDecorator = 255;
static_assert(kDecoratorsMost <= kNoDecorator && kCaveBiomesMost <= kBiomesMost);

// Rows by place and biome; made from the tables alone.
struct DecoratorIndex {
    RandomKey key[kDecoratorPlaceCount];
    float most[kDecoratorPlaceCount];               // the largest `total`
    float total[kDecoratorPlaceCount][kBiomesMost]; // sum of the chances
    u8 first[kDecoratorPlaceCount][kBiomesMost];    // row, or kNoDecorator
    u8 next[kDecoratorsMost];                   // further row of the same place and biome
};

// L keeps code for different vector sets apart.
template <class L>
VX_HD_FN void make_decorator_index(const TerrainTables& t, DecoratorIndex& out) {
    for (u32 p = 0; p < kDecoratorPlaceCount; ++p) {
        out.key[p] = random_key(t.seed, hash_combine(kDecoratePurpose, p));
        out.most[p] = 0;
        for (u32 b = 0; b < kBiomesMost; ++b) {
            out.total[p][b] = 0;
            out.first[p][b] = kNoDecorator;
        }
    }
    for (u32 r = t.decorators; r-- > 0;) {
        const DecoratorRow& row = t.decorator[r];
        u8& first = out.first[u32(row.place)][row.biome];
        out.next[r] = first;
        first = u8(r);
    }
    for (u32 r = 0; r < t.decorators; ++r) {
        const DecoratorRow& row = t.decorator[r];
        float& total = out.total[u32(row.place)][row.biome];
        total = total + row.chance;
        out.most[u32(row.place)] = greatest(out.most[u32(row.place)], total);
    }
}

namespace decorate_detail {

// Sets what `unit` draws at y, if anything. step: towards the free blocks, 1 on floors, -1 under ceilings. The end of
// what was set, 0: nothing.
template <class L>
VX_HD_FN i32 decorate_at(const TerrainTables& t, const DecoratorIndex& index, DecoratorPlace place, u32 biome,
                         float unit, i32 column, i32 y, i32 step, BlockTile& tile) {
    u32 r = index.first[u32(place)][biome];
    float begin = 0;
    for (; r != kNoDecorator; r = index.next[r]) {
        begin = begin + t.decorator[r].chance;
        if (unit < begin) break;
    }
    if (r == kNoDecorator) return 0;
    const DecoratorRow& row = t.decorator[r];
    const i32 support = y - step, second = y + step;
    if (support <= kTerrainMinY || support >= kTerrainMaxY || second <= kTerrainMinY || second >= kTerrainMaxY)
        return 0;
    const Block free = place == DecoratorPlace::sea_floor ? kWater : kAir;
    Block* const blocks = tile.block + column;
    const Block on = blocks[support << 8];
    if (blocks[y << 8] != free || !row.on.has(on) || on == kLava) return 0;
    const bool tall = row.upper != kAir;
    if (tall && blocks[second << 8] != free) return 0;
    blocks[y << 8] = row.block;
    if (tall) blocks[second << 8] = row.upper;
    return (tall && step > 0 ? second : y) + 1;
}

// Floors or ceilings of one block column's caves; bits: random_bits of the block column.
template <class L>
VX_HD_FN i32 decorate_caves(const TerrainTables& t, const DecoratorIndex& index, DecoratorPlace place,
                            const Row<L>& row, i32 column, u32 bits, const GroundTile& ground, const CaveTile& caves,
                            BlockTile& tile) {
    const bool floor = place == DecoratorPlace::cave_floor;
    const float most = index.most[u32(place)];
    const ColumnPos at{row.x >> 4, row.z >> 4};
    i32 end = 0;
    constexpr i32 words = kTerrainHeight / 32;
    for (i32 w = 0; w < words; ++w) {
        const u32 open = caves.open[w][column];
        if (open == 0) continue;
        u32 ends;
        if (floor)
            ends = open & ~(open << 1 | (w > 0 ? caves.open[w - 1][column] >> 31 : 0));
        else
            ends = open & ~(open >> 1 | (w + 1 < words ? caves.open[w + 1][column] << 31 : 0));
        for (; ends != 0; ends &= ends - 1) {
            const i32 y = (w << 5) + cave_detail::trailing_zeros(ends);
            const float unit = unit_of(random_at(bits, u32(y)));
            if (!(unit < most) || tile.block[(y << 8) + column] != kAir) continue;
            const u32 biome = cave_biome_at<L>(t, ground, caves, at, column, y);
            if (!(unit < index.total[u32(place)][biome])) continue;
            end = greatest(end, decorate_at<L>(t, index, place, biome, unit, column, y, floor ? 1 : -1, tile));
        }
    }
    return end;
}

} // namespace decorate_detail

// tile: as features left it. The least y that everything set here lies below; 0: nothing was set.
template <class L>
VX_HD_FN i32 decorate_row(const TerrainTables& t, const DecoratorIndex& index, const Row<L>& row,
                          const GroundTile& ground, const CaveTile& caves, BlockTile& tile) {
    using U = typename L::U;
    using namespace decorate_detail;
    const U x = row.block_x(), z = row.block_z();
    i32 y[L::kWidth];
    u32 biome[L::kWidth], bits[kDecoratorPlaceCount][L::kWidth];
    L::store(y, block_above<L>(L::load(ground.top + row.index)));
    L::store(biome, surface_biome_row<L>(t, ground, row));
    for (u32 p = 0; p < kDecoratorPlaceCount; ++p)
        L::store(bits[p], random_bits(index.key[p], x, z));
    i32 end = 0;
    for (i32 l = 0; l < L::kWidth; ++l) {
        const i32 column = row.index + l;
        if (y[l] > kTerrainMinY && y[l] < kTerrainMaxY - 1) {
            const bool sea = tile.block[(y[l] << 8) + column] == kWater;
            const DecoratorPlace place = sea ? DecoratorPlace::sea_floor : DecoratorPlace::surface;
            const float unit = unit_of(bits[u32(place)][l]);
            if (unit < index.total[u32(place)][biome[l]])
                end = greatest(end, decorate_at<L>(t, index, place, biome[l], unit, column, y[l], 1, tile));
        }
        for (u32 p = u32(DecoratorPlace::cave_floor); p <= u32(DecoratorPlace::cave_ceiling); ++p)
            if (index.most[p] > 0)
                end = greatest(
                    end, decorate_caves<L>(t, index, DecoratorPlace(p), row, column, bits[p][l], ground, caves, tile));
    }
    return end;
}

} // namespace vitrail
