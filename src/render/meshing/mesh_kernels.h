// The mesher's hot loops, compiled once for each vector width from mesh_kernels.inl and chosen at run time; all give
// the same quads. Masks are rows of bits along x (or z, transposed), with one border cell around the section.
#pragma once

#include "base/types.h"

#include <array>

namespace vitrail::render {

// rows[y + 1][z + 1], bit x + 1; transposed: rows[y + 1][x + 1], bit z + 1. Coordinates -1..16.
struct PaddedMask {
    alignas(64) u32 rows[18][18];
};

// Rows without border: index y * 16 + z, bit x (transposed: y * 16 + x, bit z). That is LocalPos order.
using RowMask = std::array<u16, 256>;

// The faces of one direction to merge and write.
struct DirectionJob {
    u32 face = 0;                          // Face; for west and east all masks are transposed ones
    const PaddedMask* cells = nullptr;     // cells that draw
    const PaddedMask* blockers = nullptr;  // cells that hide a face towards them
    const PaddedMask* occluders = nullptr; // for ambient occlusion; null: every corner open
    const RowMask* equal_u = nullptr;      // bit: same look as the next cell along u; null: all looks are equal
    const RowMask* equal_v = nullptr;
    const u8* narrow = nullptr; // palette index of each cell; or
    const u16* wide = nullptr;  // the same for large palettes; both null: looks[0] for all
    const u64* looks = nullptr; // by palette index
};

struct MeshKernels {
    const char* name;
    // Palette indices of `bits` (1, 2, 4 or 8) a cell to bytes.
    void (*expand)(const u64* words, u32 bits, u8* cells);
    // Bits of cells whose class (by palette index, 256 entries) has `bit`.
    void (*classify)(const u8* cells, u32 palette_size, const u8* classes, u8 bit, RowMask& out);
    // Class bits 0 and 1 of `count` rows of a packed storage (bits 1, 2, 4 or 8); row numbers first_row + i * row_step.
    void (*classify_rows)(const u64* words, u32 bits, const u8* classes, u32 first_row, u32 row_step, u32 count,
                          u16* first, u16* second);
    // The same for the 256 cells of one x, 0 or 1 each, index y * 16 + z.
    void (*classify_column)(const u64* words, u32 bits, const u8* classes, u32 x, u32* first, u32* second);
    // Cells whose palette index is that of the next cell along an axis (0 x, 1 y, 2 z); none at the far border.
    void (*equal_next)(const u8* cells, u32 axis, RowMask& out);
    void (*equal_next_wide)(const u16* cells, u32 axis, RowMask& out);
    // out[i] = table[in[i]], 4096 times.
    void (*translate)(const u8* in, u32 palette_size, const u8* table, u8* out);
    void (*transpose)(const PaddedMask& in, PaddedMask& out);
    void (*transpose_rows)(const RowMask& in, RowMask& out);
    // Bit f: some cell draws a face towards f. Masks not transposed.
    u32 (*exposed)(const PaddedMask& cells, const PaddedMask& blockers);
    // Writes at most 4096 quads; the end.
    u64* (*mesh_direction)(const DirectionJob& job, u64* out);
    // light_kernels.inl
    void (*split_light_row)(const u16* row, u32 closed, u16* even, u16* odd);
    void (*fill_light_row)(const u8* row, u32 step_z, u32 step_y, u32 wanted, u8* out);
    void (*join_light_row)(const u16* even, const u16* odd, u16* out);
};

extern const MeshKernels kMeshKernelsPortable, kMeshKernelsAvx2, kMeshKernelsAvx512;
const MeshKernels& mesh_kernels(); // the ones in use

// Corner occlusion of a face from the 3 x 3 cells before it: index bit = du + dv * 3 (0..2 each), value as in Quad.
extern const std::array<u8, 512> kOcclusionTable;

} // namespace vitrail::render
