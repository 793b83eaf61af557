// The cells that a ray passes, in order, and steps over boxes of empty ones. Kernel-safe.
//
// Planes are integers relative to the cell that the ray starts in; the ray meets plane k of an axis at
// t = (k - at) / dir, computed from there each time, never by adding up. Which of two planes comes first is decided in
// double, planes met at once in the order x, y, z. A long step crosses exactly the planes that single steps would
// cross, so what lies beside the ray never depends on how it got there, and successive cells share a face: nothing
// leaks through edges where blocks touch.
//
// After J. Amanatides and A. Woo, "A Fast Voxel Traversal Algorithm for Ray Tracing", 1987.
#pragma once

#include "trace/kernel/ray.h"

namespace vitrail::trace {

inline constexpr float kDirLeast = 1e-18f; // a direction's smaller components count as 0
inline constexpr i32 kReach = 1 << 20;     // blocks; planes farther off are not told apart

// The cell that lies so far from `start`; the world wraps around.
VX_HD IVec3 cell_off(IVec3 start, IVec3 r) {
    return {i32(u32(start.x) + u32(r.x)), i32(u32(start.y) + u32(r.y)), i32(u32(start.z) + u32(r.z))};
}

struct Walk {
    double ax, ay, az; // where the ray starts, in its cell
    double ix, iy, iz; // 1 / direction
    IVec3 start;       // of the world
    i32 x, y, z;       // the cell now, relative to `start`
    u32 up;            // bit a: runs towards growing coordinates on axis a
    u32 axis;          // crossed last; 3: none yet
    double t;          // of that plane, 0 at first

    VX_HD IVec3 cell() const { return cell_off(start, {x, y, z}); }
    // Face of the cell by which the ray came in, Face order.
    VX_HD u32 face() const { return axis * 2 + (up >> axis & 1 ? 0 : 1); }
};

// Distances to planes. A ray that does not move on an axis meets none of its planes.
VX_HD double plane_x(const Walk& w, i32 k) {
    return (double(k) - w.ax) * w.ix;
}
VX_HD double plane_y(const Walk& w, i32 k) {
    return (double(k) - w.ay) * w.iy;
}
VX_HD double plane_z(const Walk& w, i32 k) {
    return (double(k) - w.az) * w.iz;
}

VX_HD void start_axis(float at, float dir, double& a, double& inverse) {
    const bool still = !(dir > kDirLeast || dir < -kDirLeast);
    a = still ? 0.5 : double(at);
    inverse = still ? 1e200 : 1 / double(dir);
}

VX_HD Walk start_walk(const Ray& ray) {
    Walk w;
    start_axis(ray.from.at.x, ray.dir.x, w.ax, w.ix);
    start_axis(ray.from.at.y, ray.dir.y, w.ay, w.iy);
    start_axis(ray.from.at.z, ray.dir.z, w.az, w.iz);
    w.start = ray.from.cell;
    w.x = w.y = w.z = 0;
    w.up = (w.ix > 0 ? 1u : 0u) | (w.iy > 0 ? 2u : 0u) | (w.iz > 0 ? 4u : 0u);
    w.axis = 3;
    w.t = 0;
    return w;
}

// Plane by which the ray leaves its cell, on each axis.
VX_HD IVec3 next_planes(const Walk& w) {
    return {w.x + i32(w.up & 1), w.y + i32(w.up >> 1 & 1), w.z + i32(w.up >> 2 & 1)};
}

// Of three planes, one an axis, the first; and its distance.
VX_HD u32 first_plane(const Walk& w, IVec3 p, double& t) {
    const double tx = plane_x(w, p.x), ty = plane_y(w, p.y), tz = plane_z(w, p.z);
    const bool x_before_y = tx <= ty;
    const double xy = x_before_y ? tx : ty;
    const bool xy_before_z = xy <= tz;
    t = xy_before_z ? xy : tz;
    return xy_before_z ? (x_before_y ? 0u : 1u) : 2u;
}

VX_HD void step_cell(Walk& w) {
    w.axis = first_plane(w, next_planes(w), w.t);
    const i32 by = w.up >> w.axis & 1 ? 1 : -1;
    w.x += w.axis == 0 ? by : 0;
    w.y += w.axis == 1 ? by : 0;
    w.z += w.axis == 2 ? by : 0;
}

// An axis' cell once all planes before distance t are crossed, and those at t too where the axis comes first (`ties`).
// r: cell now; last: the farthest that it may be.
VX_HD i32 settle(double a, double inverse, double dir, bool up, i32 r, i32 last, double t, bool ties) {
    const i32 least = up ? r : last, most = up ? last : r;
    // From the least cell's lower plane. Rounding is far below kNear.
    constexpr double kNear = 1e-7;
    const double in = a + dir * t - double(least), whole = double(most - least + 1);
    const double held = in > 0 ? (in < whole ? in : whole) : 0;
    i32 c = i32(held);
    const double part = in - double(c);
    c = c > most - least ? most : least + c;
    if (part > kNear && part < 1 - kNear) return c;
    if (in < -kNear || in > whole + kNear) return c;
    const auto crossed = [&](i32 k) {
        const double at = (double(k) - a) * inverse;
        return at < t || (ties && at == t);
    };
    if (up) {
        while (c < last && crossed(c + 1))
            ++c;
        while (c > r && !crossed(c))
            --c;
    } else {
        while (c > last && crossed(c))
            --c;
        while (c < r && !crossed(c + 1))
            ++c;
    }
    return c;
}

// Leaves a box that holds the cell and nothing else that matters; p: the plane of the box, on each axis, that the ray
// meets going out; axis, t: of the first of them.
VX_HD void leave_by(Walk& w, const Ray& ray, IVec3 p, u32 axis, double t) {
    const bool ux = w.up & 1, uy = w.up & 2, uz = w.up & 4;
    const i32 x = axis == 0 ? (ux ? p.x : p.x - 1)
                            : settle(w.ax, w.ix, double(ray.dir.x), ux, w.x, ux ? p.x - 1 : p.x, t, 0 < axis);
    const i32 y = axis == 1 ? (uy ? p.y : p.y - 1)
                            : settle(w.ay, w.iy, double(ray.dir.y), uy, w.y, uy ? p.y - 1 : p.y, t, 1 < axis);
    const i32 z =
        axis == 2 ? (uz ? p.z : p.z - 1) : settle(w.az, w.iz, double(ray.dir.z), uz, w.z, uz ? p.z - 1 : p.z, t, false);
    w.x = x, w.y = y, w.z = z;
    w.axis = axis, w.t = t;
}
VX_HD void leave_box(Walk& w, const Ray& ray, IVec3 p) {
    double t;
    const u32 axis = first_plane(w, p, t);
    leave_by(w, ray, p, axis, t);
}

} // namespace vitrail::trace
