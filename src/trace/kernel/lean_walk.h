// Rays whose way is air up to an opaque cube or out of range: most, where land is blocks. What that takes needs no
// calls and no memory but the grid's, so that a GPU's kernel of nothing else stays small; whoever calls traces the
// others as traverse.h does. Kernel-safe.
#pragma once

#include "trace/kernel/air_walk.h"
#include "trace/kernel/cell_hit.h"

namespace vitrail::trace {

enum class LeanEnd : u8 {
    stopped, // the walk stands in a cell that stops rays through air
    passed,  // nothing is met before t_max
    unsure,  // float cannot tell: lean_exactly goes on
    hard,    // not known: ask closest_hit or shadowed
};

// False: hard.
VX_HD bool lean_start(const SceneView& s, const Ray& ray, float t_max, u32 medium, AirWalk& w) {
    const GridView& g = s.grid;
    if (medium != 0 || s.box_count != 0 || !g.skips || !in_air_range(g, ray.from.cell)) return false;
    w = start_air(g, ray, {0, 0, 0}, 3, t_max);
    return true;
}

// Why step_air did not go on.
VX_HD LeanEnd lean_end(const GridView& g, const AirWalk& w, float t_max) {
    if (stops_here(g, w)) return w.axis == 3 ? LeanEnd::hard : LeanEnd::stopped;
    if (w.t > w.end * (1 + 4 * kTie)) return LeanEnd::passed;
    if (!(w.t >= w.end) || w.end == t_max * (1 - kTie)) return LeanEnd::unsure;
    // The box ends where the range does. On the axis of that plane the ray is so close to it; if on that one alone, it
    // is the plane that the ray leaves by.
    float x, y, z;
    place_at(w.at.x, w.dir.x, w.origin.x, w.t, x);
    place_at(w.at.y, w.dir.y, w.origin.y, w.t, y);
    place_at(w.at.z, w.dir.z, w.origin.z, w.t, z);
    const float most = (0.5f - 16 * kNear) - 16 * kNear * w.t;
    return u32(x < most) + u32(y < most) + u32(z < most) == 2 ? LeanEnd::passed : LeanEnd::unsure;
}

// The step of walk.h instead. False: passed.
VX_HD bool lean_exactly(const GridView& g, const Ray& ray, float t_max, AirWalk& w) {
    const AirPlace p = step_exactly(g, ray, {cell_of(w), w.axis, true}, t_max);
    if (p.inside) put_cell(g, w, p.r, p.axis);
    return p.inside;
}

// Distance at which the walk has come into its cell, as stop_distance tells it but for one in a million, which is
// rounded the other way.
VX_HD float lean_distance(const AirWalk& w) {
    const auto of = [&](float x, float y, float z) { return w.axis == 0 ? x : w.axis == 1 ? y : z; };
    const float q = float_of(w.axis == 0   ? w.x
                             : w.axis == 1 ? w.y
                                           : w.z),
                at = of(w.at.x, w.at.y, w.at.z), inverse = of(w.inverse.x, w.inverse.y, w.inverse.z),
                dir = of(w.dir.x, w.dir.y, w.dir.z);
    const float cells = q - of(w.origin.x, w.origin.y, w.origin.z), near = (cells - at) * inverse;
    // A step of Newton's, in which all but the sum is exact.
    const double left = (double(cells) - double(at)) - double(dir) * double(near);
    return float(double(near) + left * double(inverse));
}

// The hit of a walk that was stopped. False: not known.
VX_HD bool lean_hit(const SceneView& s, const AirWalk& w, Hit& hit) {
    if (!opaque_in(s.grid, w)) return false;
    const GridView& g = s.grid;
    const IVec3 c = window_cell(g, w);
    const u32 state = state_in(g, chunk_at(g, c), u32(c.x & 15) | u32(c.z & 15) << 4 | u32(c.y & 15) << 8);
    const auto world = [](i32 cell, i32 first, u32 bits) {
        return i32(u32(first) * 16 + ((u32(cell) - u32(first) * 16) & ((16u << bits) - 1)));
    };
    const IVec3 cell{world(c.x, g.first.x, g.bits_x), world(c.y, g.first.y, g.bits_y), world(c.z, g.first.z, g.bits_z)};
    face_hit(hit, lean_distance(w), cell, state, face_of(w), false);
    return true;
}

// steps: more are hard.
template <class Boxes>
VX_HD LeanEnd lean_walk(const SceneView& s, const Ray& ray, float t_max, u32 medium, AirWalk& w, Boxes&& boxes,
                        u32 steps = kCellsMost) {
    if (!lean_start(s, ray, t_max, medium, w)) return LeanEnd::hard;
    while (steps-- != 0) {
        if (step_air(s.grid, w, boxes)) continue;
        const LeanEnd end = lean_end(s.grid, w, t_max);
        if (end != LeanEnd::unsure) return end;
        if (!lean_exactly(s.grid, ray, t_max, w)) return LeanEnd::passed;
    }
    return LeanEnd::hard;
}

// As closest_hit; false: not known.
template <class Boxes>
VX_HD bool lean_closest(const SceneView& s, const Ray& ray, u32 medium, Hit& hit, Boxes&& boxes) {
    AirWalk w;
    const LeanEnd end = lean_walk(s, ray, kFar, medium, w, boxes);
    if (end == LeanEnd::stopped) return lean_hit(s, w, hit);
    hit = Hit{};
    return end == LeanEnd::passed;
}

// Whether something opaque lies before t_max, where nothing that light may pass does: passed or stopped.
template <class Boxes>
VX_HD LeanEnd lean_shadow(const SceneView& s, const Ray& ray, float t_max, u32 medium, Boxes&& boxes) {
    AirWalk w;
    const LeanEnd end = lean_walk(s, ray, t_max, medium, w, boxes);
    return end == LeanEnd::stopped && !opaque_in(s.grid, w) ? LeanEnd::hard : end;
}

} // namespace vitrail::trace
