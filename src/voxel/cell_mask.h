// CellMask: one bit for each of a chunk's 4096 cells, in LocalPos order: word y * 4 + z / 4, bit (z % 4) * 16 + x.
// Surfaces, connectivity and light work on whole rows and slices of these instead of cells.
#pragma once

#include "base/types.h"
#include "voxel/block_storage.h"

#include <array>

namespace vitrail {

using CellMask = std::array<u64, 64>;

inline constexpr u64 kRowLow = 0x0001000100010001ull;  // x = 0 of the four rows in a word
inline constexpr u64 kRowHigh = 0x8000800080008000ull; // x = 15

inline bool test_cell(const CellMask& m, LocalPos at) {
    return m[at.index >> 6] >> (at.index & 63) & 1;
}
inline bool any_cell(const CellMask& m) {
    u64 any = 0;
    for (u64 w : m)
        any |= w;
    return any != 0;
}

// classes[p] tells up to 8 properties of palette entry p (one byte for each entry of blocks.palette()); fills out[k]
// with the cells whose entry has bit k, for k < count.
void classify_cells(const BlockStorage& blocks, const u8* classes, u32 count, CellMask* out);

// out[cell] = values[palette entry of the cell]; one byte in `values` for each entry of blocks.palette(), 4096 bytes
// out.
void map_cells(const BlockStorage& blocks, const u8* values, u8* out);

// The cells whose state has any of these bits in the flat array `flags` (StateTable::flags_data()).
CellMask cells_with_flag(const BlockStorage& blocks, const u8* flags, u8 bits);

} // namespace vitrail
