// Reading what the mesher needs from a section and its neighbors: class bits of every cell in bit masks with a border.
#pragma once

#include "render/meshing/mesh_kernels.h"
#include "render/meshing/mesher.h"

#include <vector>

namespace vitrail::render {

// The state at section coordinates -16..31; `absent` in absent chunks.
inline StateId state_at(const MeshInput& input, i32 x, i32 y, i32 z, StateId absent) {
    const Chunk* c = input.chunks[MeshInput::index(x >> 4, y >> 4, z >> 4)];
    return c ? c->blocks.get({x & 15, y & 15, z & 15}) : absent;
}

// Palette indices of the section's cells, a byte or two each.
struct CellIndices {
    alignas(64) std::array<u8, 4096 + 64> narrow;
    alignas(64) std::array<u16, 4096> wide;
    std::vector<StateId> palette;
    bool is_wide = false, uniform = false, read = false;

    void start(const BlockStorage& blocks); // copies the palette only
    void expand(const BlockStorage& blocks);
    u32 at(u32 cell) const { return is_wide ? wide[cell] : narrow[cell]; }
    // Cells whose class has `bit`; classes by palette index, at least 256 entries. Expands where it must.
    void classify(const BlockStorage& blocks, const u8* classes, u8 bit, RowMask& out);
};

// Class bits 0 and 1 of every cell in the section and one cell around it.
struct ClassMasks {
    PaddedMask first, second;
    bool differ = false; // else second is not filled and equal to first
};

// class_of(StateId) -> u8 with bits 1 and 2. all_around: the 20 neighbors that touch by an edge or a corner too (else
// their cells are 0). want_second: false leaves `second` out.
template <class ClassOf>
void gather_classes(const MeshInput& input, CellIndices& cells, ClassOf class_of, u8 absent_class, bool all_around,
                    bool want_second, std::vector<u8>& table, ClassMasks& out);

// The non-template parts.
void put_center(const RowMask& rows, PaddedMask& out);
void put_neighbor(const BlockStorage* blocks, u8 uniform_class, const u8* table, i32 dx, i32 dy, i32 dz,
                  PaddedMask& first, PaddedMask& second);

template <class ClassOf>
void gather_classes(const MeshInput& input, CellIndices& cells, ClassOf class_of, u8 absent_class, bool all_around,
                    bool want_second, std::vector<u8>& table, ClassMasks& out) {
    // Classes of all palettes first, to see whether both masks are needed.
    u8 any = 0, all = 3, both_equal = 1;
    const auto fill = [&](std::span<const StateId> palette) {
        if (table.size() < palette.size() + 256) table.resize(palette.size() + 256);
        any = 0, all = 3;
        for (std::size_t i = 0; i < palette.size(); ++i) {
            u8 c = class_of(palette[i]);
            if (!want_second) c = u8((c & 1) * 3);
            table[i] = c;
            any |= c, all &= c;
            both_equal &= u8((c ^ (c >> 1) ^ 1) & 1);
        }
    };
    RowMask rows;
    const auto rows_of = [&](u8 bit) -> const RowMask& {
        if (all & bit)
            rows.fill(0xffff);
        else if (!(any & bit))
            rows.fill(0);
        else
            cells.classify(input.chunks[MeshInput::kCenter]->blocks, table.data(), bit, rows);
        return rows;
    };
    fill(cells.palette);
    put_center(rows_of(1), out.first);
    put_center(rows_of(2), out.second);
    for (i32 dy = -1; dy <= 1; ++dy)
        for (i32 dz = -1; dz <= 1; ++dz)
            for (i32 dx = -1; dx <= 1; ++dx) {
                const i32 steps = dx * dx + dy * dy + dz * dz;
                if (steps == 0 || (steps > 1 && !all_around)) continue;
                const Chunk* c = input.chunks[MeshInput::index(dx, dy, dz)];
                u8 uniform = want_second ? absent_class : u8((absent_class & 1) * 3);
                const BlockStorage* blocks = nullptr;
                if (c) {
                    fill(c->blocks.palette());
                    uniform = any;
                    if (any != all) blocks = &c->blocks;
                } else
                    both_equal &= u8((uniform ^ (uniform >> 1) ^ 1) & 1);
                put_neighbor(blocks, uniform, table.data(), dx, dy, dz, out.first, out.second);
            }
    out.differ = want_second && !both_equal;
}

} // namespace vitrail::render
