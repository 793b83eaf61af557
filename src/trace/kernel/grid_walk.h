// The next cell that matters to a ray: one flat loop that steps over empty areas, chunks, bricks and cells alike.
// Rays through air have a faster one (trace/kernel/air_walk.h). Kernel-safe.
#pragma once

#include "trace/kernel/grid_view.h"
#include "trace/kernel/walk.h"

namespace vitrail::trace {

inline constexpr u32 kCellsMost = 16384; // steps of one ray

// What a ray looks for: cells that stop rays through air, what is not calm water (trace/kernel/water_walk.h), or each
// cell (in media without masks).
enum class Seek : u8 { air = 0, water = 1, any = 2 };

// Log2 of the empty aligned box around a cell of the window, in cells; stop: the cell itself counts, the box is 1.
VX_HD u32 empty_box(const GridView& g, IVec3 cell, bool& stop) {
    stop = false;
    constexpr u32 set = u32(Through::air);
    const IVec3 chunk{cell.x >> 4, cell.y >> 4, cell.z >> 4};
    const GridChunk& c = g.chunks[slot_of(g, chunk)];
    if (c.bricks[set] == 0) return g.areas[area_slot_of(g, chunk)] == 0 ? 6 : 4;
    const u32 brick = brick_of(cell);
    if (!(c.bricks[set] >> brick & 1)) return 2;
    stop = g.masks[c.masks[set] * 64 + brick] >> bit_of(cell) & 1;
    return 0;
}

// Last plane, relative to `start`, of the aligned box of 2^bits cells around `cell`, for a ray that runs up or down.
VX_HD i32 box_plane(i32 cell, i32 start, u32 bits, bool up) {
    return i32(((u32(cell >> bits) + (up ? 1u : 0u)) << bits) - u32(start));
}

// One axis of `approach`.
VX_HD bool approach_axis(u32 cell, u32 size, bool up, bool still, i32 at, i32& plane) {
    if (cell < size) {
        plane = at + (up ? i32(size - cell) : -i32(cell));
        return true;
    }
    const i32 from_low = i32(cell); // outside: below, or beyond
    const bool below = from_low < 0;
    const u32 away = below ? u32(-from_low) : cell - size;
    if (still || below != up || away > u32(kReach)) return false;
    plane = at + (below ? i32(away) : -i32(away));
    return true;
}

VX_HD bool in_window_cell(const GridView& g, IVec3 cell) {
    return (u32(cell.x) - u32(g.first.x) * 16) >> (g.bits_x + 4) == 0 &&
           (u32(cell.y) - u32(g.first.y) * 16) >> (g.bits_y + 4) == 0 &&
           (u32(cell.z) - u32(g.first.z) * 16) >> (g.bits_z + 4) == 0;
}

// Outside of a range: moves to the range's next plane on some axis, or says that the ray never comes in. first, size:
// cells. In range an axis' plane is where the ray goes out.
VX_HD bool approach(IVec3 first, IVec3 size, const Ray& ray, Walk& w) {
    const IVec3 c = w.cell();
    IVec3 p;
    if (!approach_axis(u32(c.x) - u32(first.x), u32(size.x), w.up & 1, w.ix > 1e100, w.x, p.x) ||
        !approach_axis(u32(c.y) - u32(first.y), u32(size.y), w.up & 2, w.iy > 1e100, w.y, p.y) ||
        !approach_axis(u32(c.z) - u32(first.z), u32(size.z), w.up & 4, w.iz > 1e100, w.z, p.z))
        return false;
    leave_box(w, ray, p);
    return true;
}

enum class Walked : u8 { stopped, ended, lost };

// Planes by which the ray leaves the empty cube of bricks that a skip word tells of.
VX_HD IVec3 skip_planes(const Walk& w, IVec3 cell, u32 word) {
    const i32 far = i32(brick_skip(word, w.up) - 1) * 4;
    const auto plane = [far](i32 c, i32 at, bool up) { return at - (c & 3) + (up ? 4 + far : -far); };
    return {plane(cell.x, w.x, w.up & 1), plane(cell.y, w.y, w.up & 2), plane(cell.z, w.z, w.up & 4)};
}

// Moves to the next cell, beyond the one it is in, that stops the ray; ended: none that is entered before t_most.
// `steps` counts down. Outside of the window there is air: a ray in another medium stops there.
VX_HD Walked next_stop(const GridView& g, const Ray& ray, Walk& w, Seek seek, double t_most, u32& steps) {
    bool fresh = true;
    for (;;) {
        const IVec3 cell = w.cell();
        if (in_window_cell(g, cell)) {
            bool stop = true;
            const u32 bits = seek == Seek::air ? empty_box(g, cell, stop) : 0;
            if (stop && !fresh) return Walked::stopped;
            if (bits == 0)
                step_cell(w);
            else
                leave_box(w, ray,
                          {box_plane(cell.x, w.start.x, bits, w.up & 1), box_plane(cell.y, w.start.y, bits, w.up & 2),
                           box_plane(cell.z, w.start.z, bits, w.up & 4)});
        } else if (seek != Seek::air) {
            if (!fresh) return Walked::stopped;
            step_cell(w);
        } else if (!approach({i32(u32(g.first.x) * 16), i32(u32(g.first.y) * 16), i32(u32(g.first.z) * 16)},
                             {16 << g.bits_x, 16 << g.bits_y, 16 << g.bits_z}, ray, w)) {
            return Walked::ended;
        }
        fresh = false;
        if (!(w.t < t_most)) return Walked::ended;
        if (steps-- == 0) return Walked::lost;
    }
}

} // namespace vitrail::trace
