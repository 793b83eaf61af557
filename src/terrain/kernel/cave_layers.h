// Caves of one block column as layers: runs of open blocks, bottom up. For whatever stands on a cave's floor or hangs
// from its ceiling, and for a GPU thread as for a CPU.
//
//     CaveLayer layer;
//     for (i32 from = 0; next_cave_layer(caves, index, from, layer); from = layer.end + 2) ...
#pragma once

#include "terrain/tiles.h"

namespace vitrail {

struct CaveLayer {
    i32 start = 0, end = 0; // y of the lowest and of the highest open block
    VX_HD i32 height() const { return end - start + 1; }
    // Whether rock closes it above; false where it opens to the sky. top: GroundTile::top of the block column.
    VX_HD bool has_ceiling(float top) const { return float(end + 1) < top; }
};

namespace cave_detail {
// How many low bits are 0; bits != 0.
VX_HD i32 trailing_zeros(u32 bits) {
#ifdef __CUDA_ARCH__
    return __ffs(i32(bits)) - 1;
#else
    return __builtin_ctz(bits);
#endif
}

// The least y >= from, y < kTerrainHeight, whose bit is set (flip 0) or clear (flip ~0); kTerrainHeight where none is.
VX_HD i32 next_bit(const u32 (*open)[kColumnCells], i32 index, i32 from, u32 flip) {
    if (from >= kTerrainHeight) return kTerrainHeight;
    i32 word = from >> 5;
    u32 bits = (open[word][index] ^ flip) & (~0u << (from & 31));
    while (bits == 0) {
        if (++word == kTerrainHeight / 32) return kTerrainHeight;
        bits = open[word][index] ^ flip;
    }
    return (word << 5) + trailing_zeros(bits);
}
} // namespace cave_detail

// The lowest layer of block column `index` (x | z << 4) among the blocks y >= from, from >= 0; false: there is none.
VX_HD bool next_cave_layer(const CaveTile& caves, i32 index, i32 from, CaveLayer& out) {
    out.start = cave_detail::next_bit(caves.open, index, from, 0u);
    if (out.start == kTerrainHeight) return false;
    out.end = cave_detail::next_bit(caves.open, index, out.start, ~0u) - 1;
    return true;
}

VX_HD bool cave_open(const CaveTile& caves, i32 index, i32 y) {
    return (caves.open[y >> 5][index] >> (y & 31) & 1) != 0;
}

} // namespace vitrail
