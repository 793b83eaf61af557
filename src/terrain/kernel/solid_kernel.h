// Signed distances of the solids that features consist of (tiles.h, Solid). Formulas: I. Quilez, "Distance functions"
// (ellipsoid by its gradient bound, capsule, capped cylinder, hexagonal prism). Below 0 inside; where only the sign is
// wanted, square roots are left out.
#pragma once

#include "terrain/tiles.h"

namespace vitrail {

// What follows from a primitive alone, for all of its voxels.
struct SolidFrame {
    Vec3 w, u, v; // axis of length 1 and two directions square to it; a cone: w = b - a; ball: 1 / radius, 1 / radius^2
    float length = 0, inverse = 0; // of the axis; a cone: 1 / length^2; a ball: least radius
    u8 even = 0;                   // a ball with one radius
    u8 sign_only = 0;
};

VX_HD SolidFrame solid_frame(const Primitive& s) {
    SolidFrame f;
    f.sign_only = !(s.wobble > 0.0f) && (s.flags & solid_hollow) == 0;
    if (s.solid == Solid::ball || s.solid == Solid::dome) {
        const Vec3 r{greatest(s.b.x, 0.01f), greatest(s.b.y, 0.01f), greatest(s.b.z, 0.01f)};
        f.even = r.x == r.y && r.y == r.z;
        f.u = {1.0f / r.x, 1.0f / r.y, 1.0f / r.z};
        f.v = f.u * f.u;
        f.inverse = least(r.x, least(r.y, r.z));
        return f;
    }
    if (s.solid == Solid::box) {
        f.w = (s.a + s.b) * 0.5f;
        f.u = {absolute<ScalarLanes>(s.b.x - s.a.x) * 0.5f, absolute<ScalarLanes>(s.b.y - s.a.y) * 0.5f,
               absolute<ScalarLanes>(s.b.z - s.a.z) * 0.5f};
        return f;
    }
    const Vec3 d = s.b - s.a;
    const float square = d.x * d.x + d.y * d.y + d.z * d.z;
    if (s.solid == Solid::cone) {
        f.w = d;
        f.inverse = square > 1e-6f ? 1.0f / square : 0.0f;
        return f;
    }
    f.length = square_root(square);
    f.inverse = f.length > 1e-3f ? 1.0f / f.length : 0.0f;
    f.w = f.length > 1e-3f ? d * f.inverse : Vec3{0.0f, 1.0f, 0.0f};
    // Square to the axis: u level, or along x where the axis stands upright.
    const float level = square_root(f.w.x * f.w.x + f.w.z * f.w.z);
    f.u = level > 1e-3f ? Vec3{f.w.z / level, 0.0f, -f.w.x / level} : Vec3{1.0f, 0.0f, 0.0f};
    f.v = cross(f.w, f.u);
    return f;
}

namespace solid_detail {

template <class L>
struct Lanes3 {
    typename L::F x, y, z;
};
template <class L>
VX_HD typename L::F along(const Lanes3<L>& p, Vec3 d) {
    return p.x * d.x + p.y * d.y + p.z * d.z;
}
template <class L>
VX_HD typename L::F square(const Lanes3<L>& p) {
    return p.x * p.x + p.y * p.y + p.z * p.z;
}

template <class L>
VX_HD typename L::F ball_distance(const Primitive& s, const SolidFrame& f, const Lanes3<L>& p) {
    using F = typename L::F;
    F d;
    if (f.even) {
        d = f.sign_only ? square<L>(p) - s.b.x * s.b.x : square_root(square<L>(p)) - s.b.x;
    } else {
        const F k = square<L>({p.x * f.u.x, p.y * f.u.y, p.z * f.u.z});
        if (f.sign_only) {
            d = k - 1.0f;
        } else {
            const F g = square<L>({p.x * f.v.x, p.y * f.v.y, p.z * f.v.z}), root = square_root(k);
            const auto middle = g < L::f(1e-10f); // no gradient there
            const F scale = select(middle, L::f(f.inverse), root / square_root(greatest(g, L::f(1e-10f))));
            d = (root - 1.0f) * scale;
        }
    }
    if (s.flags & solid_hollow) d = greatest(d, -d - s.ra);
    if (s.solid == Solid::dome) d = greatest(d, -p.y);
    return d;
}

template <class L>
VX_HD typename L::F axis_distance(const Primitive& s, const SolidFrame& f, const Lanes3<L>& p) {
    using F = typename L::F;
    const F t = along<L>(p, f.w);
    if (s.solid == Solid::cone) {
        const F h = clamp01<L>(t * f.inverse);
        const Lanes3<L> q{p.x - h * f.w.x, p.y - h * f.w.y, p.z - h * f.w.z};
        const F r = h * (s.rb - s.ra) + s.ra;
        return f.sign_only ? square<L>(q) - r * r : square_root(square<L>(q)) - r;
    }
    const F r = clamp01<L>(t * f.inverse) * (s.rb - s.ra) + s.ra;
    const F ends = greatest(-t, t - f.length);
    if (s.solid == Solid::cylinder) {
        const Lanes3<L> q{p.x - t * f.w.x, p.y - t * f.w.y, p.z - t * f.w.z};
        return greatest(square_root(square<L>(q)) - r, ends);
    }
    const F u = absolute<L>(along<L>(p, f.u)), v = absolute<L>(along<L>(p, f.v));
    return greatest(greatest(v, u * 0.866025404f + v * 0.5f) - r, ends);
}

template <class L>
VX_HD typename L::F box_distance(const SolidFrame& f, const Lanes3<L>& p) {
    return greatest(absolute<L>(p.x) - f.u.x, greatest(absolute<L>(p.y) - f.u.y, absolute<L>(p.z) - f.u.z));
}

} // namespace solid_detail

// Without wobble; x, y, z: the middle of a voxel, relative to the placement's corner. Below 0: inside. Not a true
// length where the frame says sign_only.
template <class L>
VX_HD typename L::F solid_distance(const Primitive& s, const SolidFrame& f, typename L::F x, typename L::F y,
                                   typename L::F z) {
    using namespace solid_detail;
    if (s.solid == Solid::box) return box_distance<L>(f, {x - f.w.x, y - f.w.y, z - f.w.z});
    const Lanes3<L> p{x - s.a.x, y - s.a.y, z - s.a.z};
    if (s.solid == Solid::ball || s.solid == Solid::dome) return ball_distance<L>(s, f, p);
    return axis_distance<L>(s, f, p);
}

} // namespace vitrail
