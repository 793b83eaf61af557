// The walk of a ray through air, as next_stop (trace/kernel/grid_walk.h) wants it, in few instructions: what a GPU
// spends on rays is little else. Kernel-safe.
//
// Cells, and the planes crossed, are those that walk.h finds in double, always; only most of its decisions are made in
// float, and where float is not sure of one that step is walk.h's own (step_exactly). Distances of stops are computed
// in double, from the plane.
//
// Coordinates are mirrored on axes where the ray runs down (cell ~c, place -at), so that all rays run up: the planes
// ahead are the upper ones, and a ray that is in the range of chunks that hold anything leaves it once, at a distance
// that is known beforehand. Mirrored cells are held as the bits of a float, 2^23 + cell, with the cell taken from an
// origin that the window's size divides: one word is integer and float alike, its low bits say where in the (wrapping)
// window the cell is, and adding 2^23 to a place rounds it to its cell.
//
// What float may get wrong. u = 2^-24 is half a unit in the last place; a component of a direction is 1.1 at most.
// - Distance t of a plane: (cell - start) is exact, less the place in its cell 1 u, times an inverse with 2 u (a GPU's
//   own reciprocal): 4 u of t in all. kTie, 16 u, keeps two of them apart.
// - Place on an axis at the distance t where another axis' plane is met, p = at + dir t. From t 4 u |dir t|; product
// and
//   sum round by 1 u each, of |dir t| and of the place; walk.h looks closer where it finds less than 1e-7 (1.7 u) to an
//   integer: in all less than 8 u (t + 1), kNear.
// So where on two axes p is farther than kNear (t + 1) from an integer, their cells are known, and neither's plane is
// met at t or, as far as float can tell, before: the third axis' plane is the one that is crossed.
#pragma once

#include "trace/kernel/brick_box.h"
#include "trace/kernel/grid_walk.h"

namespace vitrail::trace {

struct AirWalk {
    u32 x, y, z;  // bits of 2^23 + mirrored cell
    u32 word;     // of GridView::skips, of its brick
    u32 axis;     // crossed last; 3: none yet
    Vec3 origin;  // 2^23 + cell, less origin: relative to the start, mirrored (-1 is the start cell of a mirrored axis)
    Vec3 at, dir; // mirrored
    Vec3 inverse; // 1 / dir
    float end;    // distance up to which the ray surely goes on and stays in range
    float t;      // where the box of the last step tried is left
    u32 flip;     // mirrored axes: bits of the byte in GridView::skips,
    u32 flip_bit; // and of the cell in its brick
    u32 octant_shift; // of four times the octant's value in a skip word
    u32 boxes;        // the octant's, in BrickBoxes
};

inline constexpr u32 kCellBits = 0x4b000000; // of 2^23
inline constexpr float kTie = 1.0f / (1 << 20), kNear = 1.0f / (1 << 21);
inline constexpr float kAirMost = 1e28f; // distances beyond are walk.h's; planes that are never met are at 5e29 or more

VX_HD u32 bits_of(float f) {
    return __builtin_bit_cast(u32, f);
}
VX_HD float float_of(u32 bits) {
    return __builtin_bit_cast(float, bits);
}

// Of kDirLeast and more, to 2 u.
VX_HD float near_inverse(float f) {
#ifdef __CUDA_ARCH__
    float r;
    asm("rcp.approx.ftz.f32 %0, %1;" : "=f"(r) : "f"(f)); // an instruction
    return r;
#else
    return 1 / f;
#endif
}

// One axis. cell: now, of the world, in the range least .. least + size - 1; r: relative to the start.
VX_HD void start_air_axis(float from, float speed, u32 cell, i32 r, u32 least, u32 size, u32 window, u32& q,
                          float& origin, float& at, float& inverse, float& dir, float& end, bool& down) {
    const float fast = std::fabs(speed);
    const bool still = !(fast > kDirLeast);
    down = !still && speed < 0;
    const u32 sign = down ? ~0u : 0u;
    at = still ? 0.5f : down ? -from : from;
    inverse = still ? 1e30f : near_inverse(still ? 1.0f : fast);
    dir = still ? 0.0f : fast;
    const u32 mirrored = ((cell ^ sign) & (window - 1)) + window; // not 0: sums that are rounded stay above 2^23
    q = kCellBits + mirrored;
    origin = float(i32((1u << 23) + mirrored - (u32(r) ^ sign)));
    const u32 inside = cell - least, ahead = down ? inside + 1 : size - inside;
    const float out = ((float_of(q + ahead) - origin) - at) * inverse;
    end = out < end ? out : end;
}

// Loads and shifts in the few instructions that they take on a GPU, where its compiler finds others.
template <class T>
VX_HD T read_at(const T* at) {
#ifdef __CUDA_ARCH__
    return __ldg(at);
#else
    return *at;
#endif
}
// The low half of mask >> by.
VX_HD u32 shifted(u64 mask, u32 by) {
#ifdef __CUDA_ARCH__
    u32 low;
    asm("{ .reg .u64 all; shr.u64 all, %1, %2; cvt.u32.u64 %0, all; }" : "=r"(low) : "l"(mask), "r"(by));
    return low;
#else
    return u32(mask >> by);
#endif
}

VX_HD u32 skip_word(const GridView& g, const AirWalk& w) {
    const u32 byte =
        (w.x & g.skip_x) ^ w.flip ^ (w.z << g.skip_shift_z & g.skip_z) ^ (w.y << g.skip_shift_y & g.skip_y);
    return read_at(reinterpret_cast<const u32*>(reinterpret_cast<const u8*>(g.skips) + byte));
}
// What the walk of a ray needs that is now in a cell `r`, relative to its start, having crossed `axis` last. The cell
// is in range (in_air_range).
VX_HD AirWalk start_air(const GridView& g, const Ray& ray, IVec3 r, u32 axis, float t_max) {
    AirWalk w;
    const IVec3 c = ray.from.cell;
    float end = t_max < kAirMost ? t_max : kAirMost;
    bool x, y, z;
    start_air_axis(ray.from.at.x, ray.dir.x, u32(c.x) + u32(r.x), r.x, u32(g.least.x) * 16, g.extent_x * 16,
                   16u << g.bits_x, w.x, w.origin.x, w.at.x, w.inverse.x, w.dir.x, end, x);
    start_air_axis(ray.from.at.y, ray.dir.y, u32(c.y) + u32(r.y), r.y, u32(g.least.y) * 16, g.extent_y * 16,
                   16u << g.bits_y, w.y, w.origin.y, w.at.y, w.inverse.y, w.dir.y, end, y);
    start_air_axis(ray.from.at.z, ray.dir.z, u32(c.z) + u32(r.z), r.z, u32(g.least.z) * 16, g.extent_z * 16,
                   16u << g.bits_z, w.z, w.origin.z, w.at.z, w.inverse.z, w.dir.z, end, z);
    w.end = end * (1 - kTie);
    w.t = 0;
    w.flip = (x ? g.skip_x : 0u) | (y ? g.skip_y : 0u) | (z ? g.skip_z : 0u);
    w.flip_bit = (x ? 3u : 0u) | (z ? 12u : 0u) | (y ? 48u : 0u);
    w.octant_shift = (x ? 0u : 3u) + (y ? 0u : 6u) + (z ? 0u : 12u);
    static_assert(skip_shift(0) == 2);
    w.boxes = (x ? 0u : 64u) | (y ? 0u : 128u) | (z ? 0u : 256u);
    w.axis = axis;
    w.word = skip_word(g, w);
    return w;
}

VX_HD u32 mask_bit(const AirWalk& w) {
    return w.flip_bit ^ (w.x & 3) ^ (w.z << 2 & 12) ^ (w.y << 4 & 48);
}

VX_HD float lesser(float a, float b) {
#ifdef __CUDA_ARCH__
    return fminf(a, b); // an instruction
#else
    return a < b ? a : b;
#endif
}

// The mask of a brick that stops rays.
VX_HD u64 brick_mask(const GridView& g, u32 word) {
    static_assert(sizeof(unsigned long long) == sizeof(u64));
    return read_at(reinterpret_cast<const unsigned long long*>(g.masks) + brick_mask_index(word));
}

// At distance t: the (mirrored) cell on an axis, and how far it is from the cell's middle.
VX_HD u32 place_at(float at, float dir, float origin, float t, float& off) {
    const float p = (at - 0.5f) + dir * t, cell = p + origin; // is rounded to a whole one
    off = std::fabs(p - (cell - origin));
    return bits_of(cell);
}

// Of a cell in a brick with this mask: the low bits of coordinates that leaving a box of empty cells sets: 0 where it
// is of one cell, which may stop the ray, 1 of the 2^3 around it, 3 of all that lie ahead in the brick. box: of
// BrickBoxes.
VX_HD u32 empty_inside(u64 mask, u32 bit, u64 box) {
    const bool two = (shifted(mask, bit & 42) & 0x00330033) == 0;
    return (mask & box) == 0 ? 3u : two ? 1u : 0u;
}

// To the next cell that may matter. False: the walk is as it was but for t, since its cell stops rays (stops_here), or
// because step_exactly has to make this step, as it does where the way ends or leaves the range. No branches: lanes of
// a GPU do all parts anyway. boxes: u32 -> u64, as BrickBoxes.
template <class Boxes>
VX_HD bool step_air(const GridView& g, AirWalk& w, Boxes&& boxes) {
    const u32 word = w.word;
    const bool filled = i32(word) < 0;
    static_assert(kBrickStops == 1u << 31 && kNoStops == 3);
    const u32 bit = mask_bit(w);
    u64 mask = 0;
    if (filled) mask = brick_mask(g, word);
    const u64 box = boxes(w.boxes + bit);
    const bool stop = (shifted(mask, bit) & 1) != 0;
    // The box to leave: cells of a brick, or a cube of empty bricks.
    const u32 free = filled ? empty_inside(mask, bit, box) : word, keep = free & 3,
              far = (free >> w.octant_shift & 28) + 1;
    const u32 px = (w.x | keep) + far, py = (w.y | keep) + far, pz = (w.z | keep) + far;
    const float tx = ((float_of(px) - w.origin.x) - w.at.x) * w.inverse.x,
                ty = ((float_of(py) - w.origin.y) - w.at.y) * w.inverse.y,
                tz = ((float_of(pz) - w.origin.z) - w.at.z) * w.inverse.z;
    const float first = lesser(lesser(tx, ty), tz);
    const bool by_x = tx <= first, by_y = !by_x & (ty <= first), by_z = !by_x & !(ty <= first);
    float off_x, off_y, off_z;
    const u32 x = place_at(w.at.x, w.dir.x, w.origin.x, first, off_x),
              y = place_at(w.at.y, w.dir.y, w.origin.y, first, off_y),
              z = place_at(w.at.z, w.dir.z, w.origin.z, first, off_z);
    const float most = (0.5f - kNear) - kNear * first;
    const bool sure = (by_x | (off_x < most)) & (by_y | (off_y < most)) & (by_z | (off_z < most)) & (first < w.end);
    const bool moves = sure & !stop;
    w.t = first;
    if (moves) {
        w.x = by_x ? px : x;
        w.y = by_y ? py : y;
        w.z = by_z ? pz : z;
        w.axis = by_z ? 2u : by_y ? 1u : 0u;
    }
    w.word = skip_word(g, w); // early: whoever waits for other lanes waits for it too
    return moves;
}

// Where there is no table of boxes.
struct NoBoxes {
    VX_HD u64 operator()(u32) const { return ~u64(0); }
};

VX_HD bool stops_here(const GridView& g, const AirWalk& w) {
    return (w.word & kBrickStops) && (shifted(brick_mask(g, w.word), mask_bit(w)) & 1);
}

// The cell, relative to the start.
VX_HD IVec3 cell_of(const AirWalk& w) {
    const auto axis = [](u32 q, float origin, bool down) {
        const i32 r = i32(float_of(q) - origin);
        return down ? ~r : r;
    };
    return {axis(w.x, w.origin.x, w.flip_bit & 3), axis(w.y, w.origin.y, w.flip_bit & 48),
            axis(w.z, w.origin.z, w.flip_bit & 12)};
}
// Goes on in another cell.
VX_HD void put_cell(const GridView& g, AirWalk& w, IVec3 r, u32 axis) {
    const auto bits = [](i32 c, float origin, bool down) { return bits_of(float(down ? ~c : c) + origin); };
    w.x = bits(r.x, w.origin.x, w.flip_bit & 3);
    w.y = bits(r.y, w.origin.y, w.flip_bit & 48);
    w.z = bits(r.z, w.origin.z, w.flip_bit & 12);
    w.axis = axis;
    w.word = skip_word(g, w);
}

VX_HD bool in_air_range(const GridView& g, IVec3 cell) {
    return u32(cell.x) - u32(g.least.x) * 16 < g.extent_x * 16 && u32(cell.y) - u32(g.least.y) * 16 < g.extent_y * 16 &&
           u32(cell.z) - u32(g.least.z) * 16 < g.extent_z * 16;
}

// A walk in a cell where it has come by way of `axis`.
VX_HD Walk walk_in(const Ray& ray, IVec3 r, u32 axis) {
    Walk w = start_walk(ray);
    w.x = r.x, w.y = r.y, w.z = r.z, w.axis = axis;
    const bool up = w.up >> axis & 1;
    if (axis != 3) w.t = axis == 0 ? plane_x(w, r.x + !up) : axis == 1 ? plane_y(w, r.y + !up) : plane_z(w, r.z + !up);
    return w;
}

// Distance at which walk_in's walk has come into its cell, and the face (Face order).
VX_HD double stop_distance(const Ray& ray, IVec3 r, u32 axis) {
    double a, inverse;
    start_axis(axis == 0   ? ray.from.at.x
               : axis == 1 ? ray.from.at.y
                           : ray.from.at.z,
               axis == 0   ? ray.dir.x
               : axis == 1 ? ray.dir.y
                           : ray.dir.z,
               a, inverse);
    const i32 c = axis == 0 ? r.x : axis == 1 ? r.y : r.z;
    return (double(c + (inverse > 0 ? 0 : 1)) - a) * inverse;
}
VX_HD u32 face_of(const AirWalk& w) {
    const u32 down = w.axis == 0 ? w.flip_bit & 3 : w.axis == 1 ? w.flip_bit & 48 : w.flip_bit & 12;
    return w.axis * 2 + (down ? 1 : 0);
}

// A place on a ray, without what follows from the ray.
struct AirPlace {
    IVec3 r;     // relative to the start
    u32 axis;    // crossed last
    bool inside; // false: the way ends before t_max
};

// From any cell on: as step_air does it, in double, up to a cell in range.
VX_HD AirPlace step_exactly(const GridView& g, const Ray& ray, AirPlace from, float t_max) {
    Walk w = walk_in(ray, from.r, from.axis);
    const IVec3 first{g.least.x * 16, g.least.y * 16, g.least.z * 16},
        size{i32(g.extent_x * 16), i32(g.extent_y * 16), i32(g.extent_z * 16)};
    u32 steps = kCellsMost;
    do {
        const IVec3 cell = w.cell();
        if (!in_air_range(g, cell)) {
            if (!approach(first, size, ray, w) || steps-- == 0) return {{0, 0, 0}, 3, false};
        } else {
            const u32 word = g.skips[skip_index(g, {cell.x >> 2, cell.y >> 2, cell.z >> 2})];
            if (word & kBrickStops)
                step_cell(w);
            else
                leave_box(w, ray, skip_planes(w, cell, word));
        }
        if (!(w.t < double(t_max))) return {{0, 0, 0}, 3, false};
    } while (!in_air_range(g, w.cell()));
    return {{w.x, w.y, w.z}, w.axis, true};
}

// Where it is one of many things that a kernel does.
VX_HD_CALL AirPlace call_step_exactly(const GridView& g, const Ray& ray, AirPlace from, float t_max) {
    return step_exactly(g, ray, from, t_max);
}

// The cell in the window, from 0, as it is without mirrors.
VX_HD IVec3 window_cell(const GridView& g, const AirWalk& w) {
    const auto axis = [](u32 q, bool down, u32 bits) { return i32((q ^ (down ? ~0u : 0u)) & ((16u << bits) - 1)); };
    return {axis(w.x, w.flip_bit & 3, g.bits_x), axis(w.y, w.flip_bit & 48, g.bits_y),
            axis(w.z, w.flip_bit & 12, g.bits_z)};
}

VX_HD const GridChunk& chunk_at(const GridView& g, IVec3 window_cell) {
    return g.chunks[u32(window_cell.x) >> 4 | u32(window_cell.z) >> 4 << g.bits_x |
                    u32(window_cell.y) >> 4 << (g.bits_x + g.bits_z)];
}

// A cell that stops rays through air is an opaque cube and nothing more.
VX_HD bool opaque_in(const GridView& g, const AirWalk& w) {
    if (w.word & kBrickPlain) return true;
    const IVec3 c = window_cell(g, w);
    return shifted(g.masks[chunk_at(g, c).opaque * 64 + brick_of(c)], mask_bit(w)) & 1;
}

// Moves to the next cell, beyond the one it is in, that stops a ray through air; ended: none that is entered before
// t_max; lost: not within so many steps, which count down. By GridView::skips, which there have to be. In double where
// that is faster: on CPUs.
VX_HD Walked next_in_air(const GridView& g, const Ray& ray, Walk& w, float t_max, u32& steps) {
#ifdef __CUDA_ARCH__
    const IVec3 from{w.x, w.y, w.z};
    AirPlace p{from, w.axis, true};
    if (!in_air_range(g, w.cell())) p = call_step_exactly(g, ray, p, t_max);
    if (!p.inside) return Walked::ended;
    AirWalk a = start_air(g, ray, p.r, p.axis, t_max);
    for (;;) {
        while (step_air(g, a, NoBoxes{}) && steps != 0)
            --steps;
        if (steps == 0) return Walked::lost;
        --steps;
        p = {cell_of(a), a.axis, true};
        if (!(p.r == from) && stops_here(g, a)) {
            w = walk_in(ray, p.r, p.axis);
            return Walked::stopped;
        }
        p = call_step_exactly(g, ray, p, t_max);
        if (!p.inside) return Walked::ended;
        put_cell(g, a, p.r, p.axis);
    }
#else
    const IVec3 first{g.least.x * 16, g.least.y * 16, g.least.z * 16},
        size{i32(g.extent_x * 16), i32(g.extent_y * 16), i32(g.extent_z * 16)};
    for (bool fresh = true; steps != 0; fresh = false, --steps) {
        const IVec3 cell = w.cell();
        if (in_air_range(g, cell)) {
            const u32 word = g.skips[skip_index(g, {cell.x >> 2, cell.y >> 2, cell.z >> 2})];
            if (word & kBrickStops) {
                if (g.masks[brick_mask_index(word)] >> bit_of(cell) & 1 && !fresh) return Walked::stopped;
                step_cell(w);
            } else {
                leave_box(w, ray, skip_planes(w, cell, word));
            }
        } else if (!approach(first, size, ray, w)) {
            return Walked::ended;
        }
        if (!(w.t < double(t_max))) return Walked::ended;
    }
    return Walked::lost;
#endif
}

} // namespace vitrail::trace
