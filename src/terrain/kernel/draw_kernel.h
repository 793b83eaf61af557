// Draws one solid of a feature into blocks. Solids come in one absolute order (columns by z then x, placements,
// primitives) and the first that takes a voxel keeps it, so the blocks are the same whichever column asks.
#pragma once

#include "terrain/kernel/noise_kernel.h"
#include "terrain/kernel/solid_kernel.h"
#include "terrain/tiles.h"

namespace vitrail {

// What a voxel offers to features; taken ones and what must stay (bedrock, lava) offer nothing.
enum VoxelRoom : u8 { room_none = 0, room_open = 1, room_water = 2, room_ground = 4 };

template <class L>
VX_HD typename L::U voxel_room(typename L::U block) {
    using U = typename L::U;
    const U none = L::u(room_none);
    const U rest = select((block == L::u(kBedrock)) | (block == L::u(kLava)), none, L::u(room_ground));
    return select(block == L::u(kAir), L::u(room_open), select(block == L::u(kWater), L::u(room_water), rest));
}

// VoxelRoom bits that a solid takes.
VX_HD u32 solid_takes(u8 flags) {
    if (flags & solid_only_water) return room_water;
    u32 takes = room_open;
    if (flags & solid_over_ground) takes |= room_ground;
    if (flags & solid_in_water) takes |= room_water;
    return takes;
}

// A primitive as seen from one column. dx, dz: the column's corner relative to the placement's block; first and last
// voxels in the column's own x and z and in y.
struct DrawSpan {
    i32 dx = 0, dz = 0, y = 0; // y: of the placement
    i32 first_x = 0, last_x = 0, first_y = 0, last_y = 0, first_z = 0, last_z = 0;
    VX_HD bool empty() const { return (first_x > last_x) | (first_y > last_y) | (first_z > last_z); }
};
// low, high: a box relative to the placement (its own or a primitive's).
VX_HD DrawSpan draw_span(const Placement& p, const i16* low, const i16* high, ColumnPos at) {
    DrawSpan s;
    s.dx = i32((u32(at.x) << 4) - u32(p.x)); // near each other: the difference is small even where coordinates wrap
    s.dz = i32((u32(at.z) << 4) - u32(p.z));
    s.y = p.y;
    s.first_x = low[0] - s.dx > 0 ? low[0] - s.dx : 0;
    s.last_x = high[0] - s.dx < 15 ? high[0] - s.dx : 15;
    s.first_z = low[2] - s.dz > 0 ? low[2] - s.dz : 0;
    s.last_z = high[2] - s.dz < 15 ? high[2] - s.dz : 15;
    s.first_y = p.y + low[1] > kTerrainMinY ? p.y + low[1] : kTerrainMinY;
    s.last_y = p.y + high[1] < kTerrainMaxY - 1 ? p.y + high[1] : kTerrainMaxY - 1;
    return s;
}

// Which voxels of a row at level y the solid takes, and the blocks it puts there. The row's z (and on a GPU its x) lies
// in the span, y too. room: VoxelRoom; key: of the feature's row.
template <class L>
VX_HD typename L::M draw_row(const TerrainTables& t, const Primitive& s, const SolidFrame& frame, const DrawSpan& span,
                             RandomKey key, const Row<L>& row, i32 y, typename L::U room, typename L::U& block) {
    using F = typename L::F;
    using U = typename L::U;
    using M = typename L::M;
    const F lane = row.dx;
    const M wanted = (room & solid_takes(s.flags)) != L::u(0);
    const M from = lane >= L::f(float(span.first_x)), to = lane <= L::f(float(span.last_x));
    M in = wanted & from & to;
    if (!L::any(in)) return in;
    const F x = lane + (float(span.dx) + 0.5f);
    F d = solid_distance<L>(s, frame, x, L::f(float(y - span.y) + 0.5f), L::f(row.dz + (float(span.dz) + 0.5f)));
    if (s.wobble > 0.0f) {
        // Noise counts only near the surface: elsewhere it cannot change the sign.
        const M near = absolute<L>(d) <= L::f(s.wobble);
        if (L::any(in & near)) {
            const Noise noise = t.noise[s.noise];
            const F n = fractal3<L>(&t.octave[noise.first], noise.octaves, row.spot(L::f(float(y))));
            d = d + greatest(least(n, L::f(1.0f)), L::f(-1.0f)) * s.wobble;
        }
    }
    const M inside = d < L::f(0.0f);
    in = in & inside;
    block = L::u(s.block);
    if ((s.missing_share | s.other_share) != 0 && L::any(in)) {
        const U bits = random_bits(key, row.block_x(), L::u(u32(y)), row.block_z());
        const M kept = (bits & 255u) >= L::u(s.missing_share);
        in = in & kept;
        block = select((bits >> 8 & 255u) < L::u(s.other_share), L::u(s.other), block);
    }
    return in;
}

} // namespace vitrail
