// Surfaces of liquids inside a cell. Kernel-safe.
//
// A fluid is known by its medium: a cell holds it where its state's `medium` is the fluid's and the state is a liquid
// or a model that stands in it. Its surface lies inside the cell unless the cell above holds it too; its other borders
// are the cell's faces, as high as the surface. Hits of a surface are of HitKind::quad with Hit::quad = kLiquidSurface,
// u and v being x and z in the cell; hits of the faces are of HitKind::cube.
#pragma once

#include "scene/liquid_surface.h"
#include "trace/kernel/scene_view.h"

namespace vitrail::trace {

inline constexpr u32 kLiquidSurface = 0xffffffff;

// Where the fluid of this medium ends in a cell.
struct LiquidTop {
    scene::LiquidSlope slope; // 1/256 block
    bool full = false;        // the fluid lies above too: no surface
    bool covered = false;     // a block lies on it: no wind raises waves
    VX_HD bool level() const { return slope.h00 == slope.h10 && slope.h00 == slope.h11 && slope.h00 == slope.h01; }
};

// States of nine cells of a level, x then z. In the middle of a chunk its record is read once, and the look-ups do not
// wait for each other.
VX_HD void states_around(const GridView& g, IVec3 middle, u32 (&out)[9]) {
    const u32 x = u32(middle.x & 15), z = u32(middle.z & 15);
    const IVec3 chunk{middle.x >> 4, middle.y >> 4, middle.z >> 4};
    if (x - 1 >= 14 || z - 1 >= 14 || !in_window(g, chunk)) {
        for (i32 i = 0; i < 9; ++i)
            out[i] = state_at(g, {middle.x + i % 3 - 1, middle.y, middle.z + i / 3 - 1});
        return;
    }
    const GridChunk& c = g.chunks[slot_of(g, chunk)];
    const u32 first = u32(middle.y & 15) << 8 | (z - 1) << 4 | (x - 1);
    if (c.bits == 0) {
        const u32 state = g.palettes[c.palette];
        for (u32 i = 0; i < 9; ++i)
            out[i] = state;
        return;
    }
    for (u32 i = 0; i < 9; ++i)
        out[i] = palette_index(g, c, first + i % 3 + (i / 3 << 4));
    for (u32 i = 0; i < 9; ++i)
        out[i] = g.palettes[c.palette + out[i]];
}

// The fluid's surface in the cell is known: it is flat, or there is none.
VX_HD bool known_calm(const GridView& g, IVec3 cell, u32 medium) {
    return medium == g.water && in_window(g, {cell.x >> 4, cell.y >> 4, cell.z >> 4}) && is_calm(g, cell);
}

// A way through a fluid's cell, between these heights in it, is all above the surface, as few look-ups tell. False: not
// known.
VX_HD bool above_liquid(const SceneView& s, IVec3 cell, u32 medium, float y_in, float y_out) {
    const float top = float(s.media[medium].liquid_top) * (1.0f / 256) + 1e-4f;
    if (!(y_in > top && y_out > top)) return false;
    bool open = !stops_air(s.grid, {cell.x, cell.y + 1, cell.z});
    if (!open || known_calm(s.grid, cell, medium)) return open;
    for (i32 z = -1; z <= 1; ++z)
        for (i32 x = -1; x <= 1; ++x)
            open &= !stops_air(s.grid, {cell.x + x, cell.y + 1, cell.z + z});
    return open;
}

// The cell holds the fluid.
VX_HD LiquidTop liquid_top(const SceneView& s, IVec3 cell, u32 medium) {
    LiquidTop top;
    const StateRecord& over = s.states[state_at(s.grid, {cell.x, cell.y + 1, cell.z})];
    top.full = over.medium == medium;
    top.covered =
        !top.full && over.kind != CellKind::empty && over.kind != CellKind::model && over.kind != CellKind::liquid;
    if (top.full || known_calm(s.grid, cell, medium)) {
        const i32 height = top.full ? scene::kLiquidFull : i32(s.grid.water_top);
        top.slope = {height, height, height, height};
        return top;
    }
    u32 here[9], above[9];
    states_around(s.grid, {cell.x, cell.y + 1, cell.z}, above);
    states_around(s.grid, cell, here);
    i32 of[9]; // what scene/liquid_surface.h asks of each
    for (u32 i = 0; i < 9; ++i) {
        const StateRecord& r = s.states[here[i]];
        const i32 own = i32(r.liquid_height) + 1,
                  height = s.states[above[i]].medium == medium ? scene::kLiquidUnderLiquid : own;
        of[i] = r.medium == medium ? height : scene::kLiquidNone;
    }
    top.slope = scene::liquid_slope([&](i32 dx, i32 dz) { return of[(dx + 1) + (dz + 1) * 3]; });
    return top;
}

// Blocks above the cell's bottom, at x, z in the cell.
VX_HD float liquid_height_at(const LiquidTop& top, float x, float z) {
    const scene::LiquidSlope& h = top.slope;
    const float y = x + z <= 1 ? float(h.h00) + float(h.h10 - h.h00) * x + float(h.h01 - h.h00) * z
                               : float(h.h11) + float(h.h11 - h.h01) * (x - 1) + float(h.h11 - h.h10) * (z - 1);
    return y * (1.0f / 256);
}

// Unit, upwards.
VX_HD Vec3 liquid_normal(const LiquidTop& top, float x, float z) {
    const scene::LiquidSlope& h = top.slope;
    const float gx = x + z <= 1 ? float(h.h10 - h.h00) : float(h.h11 - h.h01),
                gz = x + z <= 1 ? float(h.h01 - h.h00) : float(h.h11 - h.h10);
    return normalized({-gx, 256, -gz});
}

// The first place where a ray goes through the surface downwards (`leaving`: upwards, out of the fluid), t_min <= t <=
// t_max. from: relative to the cell's least corner; dir: any length. The ray may run beyond the cell: places beside it
// do not count.
VX_HD bool hit_liquid_top(const LiquidTop& top, Vec3 from, Vec3 dir, float t_min, float t_max, bool leaving, float& t) {
    if (top.full) return false;
    const scene::LiquidSlope& h = top.slope;
    bool found = false;
    for (u32 part = 0; part < 2; ++part) {
        const bool far_part = part == 1; // the triangle at (1, 1)
        const float h0 = float(far_part ? h.h10 + h.h01 - h.h11 : h.h00) * (1.0f / 256),
                    gx = float(far_part ? h.h11 - h.h01 : h.h10 - h.h00) * (1.0f / 256),
                    gz = float(far_part ? h.h11 - h.h10 : h.h01 - h.h00) * (1.0f / 256);
        const float rise = dir.y - gx * dir.x - gz * dir.z; // above the plane, a unit of t
        if (leaving ? rise <= 0 : rise >= 0) continue;
        const float at = -(from.y - h0 - gx * from.x - gz * from.z) / rise;
        if (!(at >= t_min && at <= t_max)) continue;
        const float x = from.x + dir.x * at, z = from.z + dir.z * at;
        constexpr float kSeam = 1e-5f; // the triangles overlap by a hair, so that no ray slips between them
        if (far_part ? x + z < 1 - kSeam : x + z > 1 + kSeam) continue;
        if (x < -kSeam || x > 1 + kSeam || z < -kSeam || z > 1 + kSeam) continue;
        t = at, t_max = at, found = true;
    }
    return found;
}

} // namespace vitrail::trace
