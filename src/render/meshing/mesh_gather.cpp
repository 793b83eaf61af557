#include "render/meshing/mesh_gather.h"

#include <cstring>

namespace vitrail::render {

void CellIndices::start(const BlockStorage& blocks) {
    palette.assign(blocks.palette().begin(), blocks.palette().end());
    is_wide = blocks.bits() > 8;
    uniform = blocks.uniform();
    read = false;
}

void CellIndices::expand(const BlockStorage& blocks) {
    if (read) return;
    read = true;
    if (uniform)
        narrow.fill(0);
    else if (is_wide)
        std::memcpy(wide.data(), blocks.words().data(), sizeof wide);
    else
        mesh_kernels().expand(blocks.words().data(), blocks.bits(), narrow.data());
}

void CellIndices::classify(const BlockStorage& blocks, const u8* classes, u8 bit, RowMask& out) {
    expand(blocks);
    if (!is_wide) return mesh_kernels().classify(narrow.data(), u32(palette.size()), classes, bit, out);
    for (u32 row = 0; row < 256; ++row) {
        u32 bits = 0;
        for (u32 x = 0; x < 16; ++x)
            bits |= u32((classes[wide[row * 16 + x]] & bit) != 0) << x;
        out[row] = u16(bits);
    }
}

void put_center(const RowMask& rows, PaddedMask& out) {
    std::memset(out.rows[0], 0, sizeof out.rows[0]);
    std::memset(out.rows[17], 0, sizeof out.rows[17]);
    for (u32 y = 0; y < 16; ++y) {
        u32* o = out.rows[y + 1];
        o[0] = o[17] = 0;
        for (u32 z = 0; z < 16; ++z)
            o[z + 1] = u32(rows[y * 16 + z]) << 1;
    }
}

namespace {

// A neighbor whose near cells all have one class.
void put_uniform(u8 c, i32 dx, i32 dy, i32 dz, PaddedMask& out) {
    if (!c) return;
    const u32 bits = dx == 0 ? 0x1fffeu : dx < 0 ? 1u : 1u << 17;
    const u32 y0 = dy == 0 ? 1 : dy < 0 ? 0 : 17, y1 = dy == 0 ? 17 : y0 + 1;
    const u32 z0 = dz == 0 ? 1 : dz < 0 ? 0 : 17, z1 = dz == 0 ? 17 : z0 + 1;
    for (u32 y = y0; y < y1; ++y)
        for (u32 z = z0; z < z1; ++z)
            out.rows[y][z] |= bits;
}

} // namespace

void put_neighbor(const BlockStorage* blocks, u8 uniform_class, const u8* table, i32 dx, i32 dy, i32 dz,
                  PaddedMask& first, PaddedMask& second) {
    if (!blocks) {
        put_uniform(uniform_class & 1, dx, dy, dz, first);
        put_uniform(uniform_class & 2, dx, dy, dz, second);
        return;
    }
    const i32 near_x = dx < 0 ? 15 : 0, near_y = dy < 0 ? 15 : 0, near_z = dz < 0 ? 15 : 0;
    const u32 border_y = dy < 0 ? 0 : 17, border_z = dz < 0 ? 0 : 17, shift = dx < 0 ? 0 : 17;
    const u64* words = blocks->words().data();
    const u32 bits = blocks->bits();
    if (dx == 0 && bits <= 8) { // whole rows
        u16 a[16], b[16];
        if (dz == 0) { // above or below
            mesh_kernels().classify_rows(words, bits, table, u32(near_y) * 16, 1, 16, a, b);
            for (u32 z = 0; z < 16; ++z) {
                first.rows[border_y][z + 1] |= u32(a[z]) << 1;
                second.rows[border_y][z + 1] |= u32(b[z]) << 1;
            }
        } else if (dy == 0) { // north or south
            mesh_kernels().classify_rows(words, bits, table, u32(near_z), 16, 16, a, b);
            for (u32 y = 0; y < 16; ++y) {
                first.rows[y + 1][border_z] |= u32(a[y]) << 1;
                second.rows[y + 1][border_z] |= u32(b[y]) << 1;
            }
        } else {
            mesh_kernels().classify_rows(words, bits, table, u32(near_y) * 16 + u32(near_z), 1, 1, a, b);
            first.rows[border_y][border_z] |= u32(a[0]) << 1;
            second.rows[border_y][border_z] |= u32(b[0]) << 1;
        }
        return;
    }
    if (dy == 0 && dz == 0 && bits <= 8) { // west or east
        alignas(64) u32 a[256], b[256];
        mesh_kernels().classify_column(words, bits, table, u32(near_x), a, b);
        for (u32 y = 0; y < 16; ++y)
            for (u32 z = 0; z < 16; ++z) {
                first.rows[y + 1][z + 1] |= a[y * 16 + z] << shift;
                second.rows[y + 1][z + 1] |= b[y * 16 + z] << shift;
            }
        return;
    }
    // Edges, corners and very large palettes: cell by cell.
    const u32 mask = (1u << bits) - 1;
    for (i32 y = dy ? near_y : 0; y <= (dy ? near_y : 15); ++y)
        for (i32 z = dz ? near_z : 0; z <= (dz ? near_z : 15); ++z)
            for (i32 x = dx ? near_x : 0; x <= (dx ? near_x : 15); ++x) {
                const u32 bit = u32(LocalPos(x, y, z).index) * bits;
                const u8 c = table[u32(words[bit >> 6] >> (bit & 63)) & mask];
                const u32 row_y = dy ? border_y : u32(y + 1), row_z = dz ? border_z : u32(z + 1);
                const u32 to = dx ? shift : u32(x + 1);
                first.rows[row_y][row_z] |= u32(c & 1) << to;
                second.rows[row_y][row_z] |= u32(c >> 1 & 1) << to;
            }
}

} // namespace vitrail::render
