// The grid as kernels read it: a window of chunks around the player that wraps around (a chunk's slot is its position
// modulo the window), in three levels of 4^3: areas of 4^3 chunks, chunks of 4^3 bricks, bricks of 4^3 cells; below
// them each chunk's palette indices as BlockStorage packs them. Kernel-safe; trace/grid/grid.h builds it.
//
// A second set of masks serves rays inside water: there a cell counts when it is not calm: anything but full water and
// water with a flat surface (trace/grid/calm_water.h). So in a box without such cells surfaces lie in its highest layer
// alone, all in one plane: above each is something else than water.
//
// Bit of a cell in its brick, of a brick in its chunk and of a chunk in its area: x | z << 2 | y << 4 (each 0..3).
#pragma once

#include "trace/kernel/ray.h"

namespace vitrail::trace {

// What traversal asks: where rays through air stop, or where rays through water stop.
enum class Through : u8 { air = 0, water = 1 };

inline constexpr u32 kNoMasks = 0;  // mask block 0: all empty
inline constexpr u32 kAllMasks = 1; // mask block 1: every cell

struct alignas(16) GridChunk {
    u64 bricks[2]; // by Through: bricks with a cell that stops such a ray
    u32 palette;   // first entry in GridView::palettes (state ids)
    u32 indices;   // first word in GridView::indices; 64 words a bit of `bits`; order of cells: LocalPos::index
    u32 bits;      // 0 (uniform), 1, 2, 4, 8, 16
    u32 tints;     // block of kTintWords words in GridView::tints
    u32 masks[2];  // by Through: block of 64 words in GridView::masks, a word a brick
    u32 opaque;    // block of masks: cells that are opaque cubes without anything more to ask (no cutout, no model)
    u32 layers;    // whose cells are all calm, bit y: some are full; bit 16 + y: some are level
};

struct GridView {
    IVec3 first;                            // least chunk of the window, in chunks; beyond the window there is air
    u32 bits_x = 0, bits_y = 0, bits_z = 0; // log2 of the window's size in chunks, 2..7
    const u64* areas = nullptr;             // chunks that stop rays through air; slot: as of a chunk, in units of 4
    const GridChunk* chunks = nullptr;      // by slot
    const u64* masks = nullptr;
    const u32* palettes = nullptr;
    const u64* indices = nullptr;
    const u32* tints = nullptr;
    // The medium that calm water is of, 0: which is calm is not known; and height of its surface, 1/256 block.
    u32 water = 0, water_top = 0;
    // By skip_index: how far rays through air may step from a brick (brick_skip), or where its mask is.
    const u32* skips = nullptr;
    // Of a cell in the window, as a byte in `skips`: x & skip_x | z << skip_shift_z & skip_z | y << skip_shift_y &
    // skip_y.
    u32 skip_x = 0, skip_y = 0, skip_z = 0, skip_shift_y = 0, skip_shift_z = 0;
    // Chunks that stop rays through air lie in least .. least + extent - 1: a ray that is past them is out.
    IVec3 least;
    u32 extent_x = 0, extent_y = 0, extent_z = 0;
};

// A word of GridView::skips. A brick with a cell that stops rays through air: kBrickStops | its index in `masks`, and
// kBrickPlain where all such cells are opaque cubes without anything more to ask (as GridChunk::opaque). Else
// kNoStops and for each octant of directions (bit a: towards growing coordinates on axis a), in 3 bits, the side of the
// largest empty cube of bricks that begins with this one and extends that way, less 1. Beyond the window all is empty.
inline constexpr u32 kBrickStops = 1u << 31, kBrickPlain = 1u << 30;
inline constexpr u32 kNoStops = 3;  // the bits of a cell in its brick, on one axis: which air_walk.h sets with it
inline constexpr u32 kSkipMost = 8; // bricks

VX_HD u32 brick_mask_index(u32 word) {
    return word & (kBrickPlain - 1);
}
VX_HD constexpr u32 skip_shift(u32 octant) {
    return 3 * octant + 2;
}
VX_HD u32 brick_skip(u32 word, u32 octant) { // bricks, 1..kSkipMost
    return (word >> skip_shift(octant) & 7) + 1;
}

// Bricks of the window lie in rows of x, then z, then y; it wraps around as slots do. brick: of the world.
VX_HD u32 skip_index(const GridView& g, IVec3 brick) {
    const u32 x = u32(brick.x) * 4 & g.skip_x, z = u32(brick.z) * 4 << g.skip_shift_z & g.skip_z,
              y = u32(brick.y) * 4 << g.skip_shift_y & g.skip_y;
    return (x | z | y) >> 2;
}

inline constexpr u32 kTintWords = 108; // grass, foliage, water: 36 sRGB RGBA8 texels each (scene/tint_grid.h)

VX_HD bool in_window(const GridView& g, IVec3 chunk) {
    return (u32(chunk.x) - u32(g.first.x)) >> g.bits_x == 0 && (u32(chunk.y) - u32(g.first.y)) >> g.bits_y == 0 &&
           (u32(chunk.z) - u32(g.first.z)) >> g.bits_z == 0;
}
VX_HD u32 slot_of(const GridView& g, IVec3 chunk) {
    const u32 x = u32(chunk.x) & ((1u << g.bits_x) - 1), y = u32(chunk.y) & ((1u << g.bits_y) - 1),
              z = u32(chunk.z) & ((1u << g.bits_z) - 1);
    return x | z << g.bits_x | y << (g.bits_x + g.bits_z);
}
// Of an area: any chunk of it. The window is aligned to areas.
VX_HD u32 area_slot_of(const GridView& g, IVec3 chunk) {
    const u32 x = (u32(chunk.x) & ((1u << g.bits_x) - 1)) >> 2, y = (u32(chunk.y) & ((1u << g.bits_y) - 1)) >> 2,
              z = (u32(chunk.z) & ((1u << g.bits_z) - 1)) >> 2;
    return x | z << (g.bits_x - 2) | y << (g.bits_x + g.bits_z - 4);
}

// In its palette, of a chunk that is not uniform. cell: LocalPos::index.
VX_HD u32 palette_index(const GridView& g, const GridChunk& c, u32 cell) {
    const u32 bit = cell * c.bits;
    return u32(g.indices[c.indices + (bit >> 6)] >> (bit & 63)) & ((1u << c.bits) - 1);
}
VX_HD u32 state_in(const GridView& g, const GridChunk& c, u32 cell) {
    return g.palettes[c.palette + (c.bits ? palette_index(g, c, cell) : 0)];
}
// 0 (air) outside of the window and where nothing is held.
VX_HD u32 state_at(const GridView& g, IVec3 cell) {
    const IVec3 chunk{cell.x >> 4, cell.y >> 4, cell.z >> 4};
    if (!in_window(g, chunk)) return 0;
    return state_in(g, g.chunks[slot_of(g, chunk)], u32(cell.x & 15) | u32(cell.z & 15) << 4 | u32(cell.y & 15) << 8);
}

// Numbers, as above, of a cell's brick in its chunk, and of the cell in its brick.
VX_HD u32 brick_of(IVec3 cell) {
    return u32(cell.x >> 2 & 3) | u32(cell.z >> 2 & 3) << 2 | u32(cell.y >> 2 & 3) << 4;
}
VX_HD u32 bit_of(IVec3 cell) {
    return u32(cell.x & 3) | u32(cell.z & 3) << 2 | u32(cell.y & 3) << 4;
}

// A cell that stops rays through air; false outside of the window.
VX_HD bool stops_air(const GridView& g, IVec3 cell) {
    const IVec3 chunk{cell.x >> 4, cell.y >> 4, cell.z >> 4};
    if (!in_window(g, chunk)) return false;
    const u32 block = g.chunks[slot_of(g, chunk)].masks[u32(Through::air)];
    return g.masks[block * 64 + brick_of(cell)] >> bit_of(cell) & 1;
}

// A cell of the window without anything that rays in water have to look at: full of water or level.
VX_HD bool is_calm(const GridView& g, IVec3 cell) {
    const u32 block = g.chunks[slot_of(g, {cell.x >> 4, cell.y >> 4, cell.z >> 4})].masks[u32(Through::water)];
    return !(g.masks[block * 64 + brick_of(cell)] >> bit_of(cell) & 1);
}

} // namespace vitrail::trace
