#include "render/meshing/light_brick.h"

#include "render/meshing/mesh_kernels.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <type_traits>
#include <vector>

namespace vitrail::render {

namespace {

// Cells -3..18 of each axis: the brick (-1..16), one more for the neighbors of its filled cells, one for theirs.
constexpr i32 kReach = 3, kRows = 16 + 2 * kReach, kLanes = 32;
constexpr u32 kInner = ((1u << kRows) - 1) & ~1u & ~(1u << (kRows - 1)); // lanes 1..20

struct Window {
    alignas(64) u16 pad[32];
    alignas(64) u16 even[kRows][kRows][kLanes]; // [y][z][x]
    alignas(64) u16 odd[kRows][kRows][kLanes];
    alignas(64) u16 even_filled[kRows][kRows][kLanes]; // rows that a pass changed, until it ends
    alignas(64) u16 odd_filled[kRows][kRows][kLanes];
    u32 closed[kRows + 2][kRows + 2]; // bit a lane; row and layer indices from 1
    u32 wanted[kRows][kRows];
    std::vector<u8> table;
};

struct Part {
    i32 from, to, shift; // cells of a chunk along an axis, and what leads from them to the window
};
constexpr Part part_of(i32 d) {
    if (d < 0) return {16 - kReach, 16, kReach - 16};
    if (d > 0) return {0, kReach, 16 + kReach};
    return {0, 16, kReach};
}

bool lit(const Chunk* c) {
    return c && c->light;
}

// True, with the value, where every lit chunk has one and the same light everywhere.
bool uniform_light(const MeshInput& input, Light& value) {
    bool any = false;
    for (const Chunk* c : input.chunks) {
        if (!lit(c)) continue;
        if (!c->light->uniform()) return false;
        const Light v = c->light->get(LocalPos());
        if (any && !(v == value)) return false;
        value = v;
        any = true;
    }
    if (!any) value = Light{};
    return true;
}

// Light and closed bits of three chunks that lie along x, rows of the window.
void read_rows(const MeshInput& input, i32 dy, i32 dz, const MeshKernels& kernels, Window& w) {
    const Part py = part_of(dy), pz = part_of(dz);
    struct Source {
        const Light* cells = nullptr;
        u16 fill = 0;
        const BlockStorage* blocks = nullptr; // null: `closed` says it for all cells
        u16 closed = 0;
        std::size_t table = 0;
    } sources[3];
    w.table.clear();
    for (i32 dx = -1; dx <= 1; ++dx) {
        const Chunk* c = input.chunks[MeshInput::index(dx, dy, dz)];
        Source& s = sources[dx + 1];
        s.closed = 0xffff;
        if (!lit(c)) continue;
        if (c->light->uniform())
            s.fill = c->light->get(LocalPos()).bits;
        else
            s.cells = c->light->cells()->data();
        const auto palette = c->blocks.palette();
        s.table = w.table.size();
        u8 any = 0, all = 1;
        for (const StateId id : palette) {
            const u8 opaque = scene::hides(input.models->kinds()[u32(id)]);
            w.table.push_back(opaque);
            any |= opaque, all &= opaque;
        }
        w.table.resize(w.table.size() + 256); // kernels read whole tables
        if (any != all)
            s.blocks = &c->blocks;
        else
            s.closed = any ? 0xffff : 0;
    }
    // Closed bits of the rows of one slice, first row `row`.
    const u32 count = u32(pz.to - pz.from);
    const auto closed_rows = [&](const Source& s, u32 row, u16* bits) {
        if (!s.blocks) {
            std::fill_n(bits, count, s.closed);
            return;
        }
        const u8* table = w.table.data() + s.table;
        if (s.blocks->bits() <= 8) {
            u16 unused[16];
            kernels.classify_rows(s.blocks->words().data(), s.blocks->bits(), table, row, 1, count, bits, unused);
            return;
        }
        const u16* cells = reinterpret_cast<const u16*>(s.blocks->words().data()) + row * 16;
        for (u32 i = 0; i < count; ++i) {
            u32 row_bits = 0;
            for (u32 x = 0; x < 16; ++x)
                row_bits |= u32(table[cells[i * 16 + x]]) << x;
            bits[i] = u16(row_bits);
        }
    };
    constexpr u32 kSideBits = (1u << kReach) - 1;
    for (i32 y = py.from; y < py.to; ++y) {
        u16 bits[3][16];
        for (u32 i = 0; i < 3; ++i)
            closed_rows(sources[i], u32(y * 16 + pz.from), bits[i]);
        for (u32 i = 0; i < count; ++i) {
            const u32 row = u32(y * 16 + pz.from) + i;
            alignas(64) u16 light[kLanes] = {};
            const auto put = [&](const Source& s, u32 from, u32 to, auto cells) {
                if (s.cells)
                    std::memcpy(light + to, s.cells + row * 16 + from, sizeof(u16) * cells());
                else
                    std::fill_n(light + to, cells(), s.fill);
            };
            put(sources[0], 16 - kReach, 0, std::integral_constant<u32, kReach>());
            put(sources[1], 0, kReach, std::integral_constant<u32, 16>());
            put(sources[2], 0, kReach + 16, std::integral_constant<u32, kReach>());
            const u32 closed = ~((1u << kRows) - 1) | u32(bits[0][i] >> (16 - kReach)) | u32(bits[1][i]) << kReach |
                               (bits[2][i] & kSideBits) << (kReach + 16);
            const i32 wy = y + py.shift, wz = pz.from + i32(i) + pz.shift;
            w.closed[wy + 1][wz + 1] = closed;
            kernels.split_light_row(light, closed, w.even[wy][wz], w.odd[wy][wz]);
        }
    }
}

// Closed cells beside cells with light get theirs. `margin`: rows left out at the window's edge.
void fill_closed(Window& w, i32 margin, const MeshKernels& kernels) {
    const auto lit_bits = [&](i32 y, i32 z) { return ~w.closed[y + 1][z + 1]; };
    constexpr u32 step_z = sizeof w.even[0][0], step_y = sizeof w.even[0];
    for (i32 y = margin; y < kRows - margin; ++y)
        for (i32 z = margin; z < kRows - margin; ++z) {
            const u32 here = lit_bits(y, z);
            const u32 around = here << 1 | here >> 1 | lit_bits(y - 1, z) | lit_bits(y + 1, z) | lit_bits(y, z - 1) |
                               lit_bits(y, z + 1);
            const u32 wanted = ~here & around & kInner;
            w.wanted[y][z] = wanted;
            if (!wanted) continue;
            kernels.fill_light_row(reinterpret_cast<const u8*>(w.even[y][z]), step_z, step_y, wanted,
                                   reinterpret_cast<u8*>(w.even_filled[y][z]));
            kernels.fill_light_row(reinterpret_cast<const u8*>(w.odd[y][z]), step_z, step_y, wanted,
                                   reinterpret_cast<u8*>(w.odd_filled[y][z]));
        }
    for (i32 y = margin; y < kRows - margin; ++y)
        for (i32 z = margin; z < kRows - margin; ++z) {
            if (!w.wanted[y][z]) continue;
            w.closed[y + 1][z + 1] &= ~w.wanted[y][z];
            std::memcpy(w.even[y][z], w.even_filled[y][z], sizeof w.even[y][z]);
            std::memcpy(w.odd[y][z], w.odd_filled[y][z], sizeof w.odd[y][z]);
        }
}

} // namespace

void build_light_brick(const MeshInput& input, LightBrick& out) {
    out.uniform = uniform_light(input, out.value);
    if (out.uniform) return;
    thread_local const std::unique_ptr<Window> window = std::make_unique<Window>();
    Window& w = *window;
    const MeshKernels& kernels = mesh_kernels();
    for (i32 dy = -1; dy <= 1; ++dy)
        for (i32 dz = -1; dz <= 1; ++dz)
            read_rows(input, dy, dz, kernels, w);
    fill_closed(w, 1, kernels);
    fill_closed(w, 2, kernels);
    for (i32 y = -1; y <= 16; ++y)
        for (i32 z = -1; z <= 16; ++z)
            kernels.join_light_row(w.even[y + kReach][z + kReach] + kReach - 1,
                                   w.odd[y + kReach][z + kReach] + kReach - 1,
                                   out.cells.data() + LightBrick::index(-1, y, z));
    out.uniform = std::all_of(out.cells.begin(), out.cells.end(), [&](u16 c) { return c == out.cells[0]; });
    if (out.uniform) out.value = Light(out.cells[0]);
}

} // namespace vitrail::render
