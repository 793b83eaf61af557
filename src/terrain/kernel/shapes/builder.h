// ShapeBuilder: what a shape's builder gets, and how it emits the solids its feature consists of. A builder is
// `template <class L> VX_HD_FN void build_NAME(ShapeBuilder<L>& b)`, called by build_shape.h, one thread a placement.
//
// Positions are blocks relative to the placement's corner: its block spans 0..1 on each axis, its middle is .5, .5, .5
// (b.root()). Which numbers and blocks b.number(i), b.row.blocks[i] are stands in compile/shape_info.cpp. The solid
// emitted first wins where solids overlap: wood before leaves. Chance comes from b.unit() and its like alone, which
// follow from the placement, so that a shape is the same whoever asks - and at most one random number an expression
// (braces {a, b} are in order): compilers differ in the order of operands. A feature whose solids do not all find room
// is not placed; voxels beyond the row's reach and bounds are cut off, so shape_info must state true ones.
#pragma once

#include "terrain/kernel/power_kernel.h"
#include "terrain/tiles.h"

namespace vitrail {

// What a solid is made of.
struct Brush {
    Block block = kAir, other = kAir;
    u8 other_share = 0, missing_share = 0; // of 255, a voxel each
    u8 flags = 0;                          // SolidFlag
    float wobble = 0;                      // blocks
    u16 noise = 0;
};

template <class L>
struct ShapeBuilder {
    const TerrainTables& t;
    const FeatureRow& row;
    Placement& placement; // x, y, z, bits, room, feature, first are set
    FeatureTile& out;
    u32 counter = 0;
    bool fits = true;

    VX_HD Vec3 root() const { return {0.5f, 0.5f, 0.5f}; }
    VX_HD float number(u32 i) const { return row.numbers[i]; }
    VX_HD float room() const { return float(placement.room); } // height of the cave layer, depth of the water

    // Chance.
    VX_HD u32 bits() { return random_next(placement.bits, counter++); }
    VX_HD float unit() { return unit_of(bits()); }                             // [0, 1)
    VX_HD float range(float a, float b) { return a + (b - a) * unit(); }       // [a, b)
    VX_HD u32 below(u32 bound) { return below_of(bits(), bound); }             // [0, bound)
    VX_HD i32 between(i32 a, i32 b) { return a + i32(below(u32(b - a + 1))); } // a..b
    VX_HD bool chance(float p) { return unit() < p; }

    // Directions. turn: whole turns, 0 = +x, a quarter = +z.
    VX_HD_FN Vec3 around(float turn) const {
        return {sine_of<L>((turn + 0.25f) * 6.28318531f), 0.0f, sine_of<L>(turn * 6.28318531f)};
    }
    // tilt: upwards from the level, turns; a quarter = up.
    VX_HD_FN Vec3 towards(float turn, float tilt) const {
        const float level = sine_of<L>((tilt + 0.25f) * 6.28318531f);
        const Vec3 d = around(turn);
        return {d.x * level, sine_of<L>(tilt * 6.28318531f), d.z * level};
    }
    static VX_HD float size(Vec3 v) { return square_root(v.x * v.x + v.y * v.y + v.z * v.z); }

    // Brushes. i: which of the row's blocks.
    VX_HD Brush paint(u32 i) const {
        Brush p;
        p.block = row.blocks[i];
        return p;
    }
    VX_HD Brush paint(u32 i, u32 other, float other_share) const {
        Brush p = paint(i);
        p.other = row.blocks[other];
        p.other_share = u8(other_share * 255.0f);
        return p;
    }
    // As `paint`, with holes.
    VX_HD Brush sparse(u32 i, float missing_share) const {
        Brush p = paint(i);
        p.missing_share = u8(missing_share * 255.0f);
        return p;
    }
    // The surface moves in and out by up to `blocks`: fine bumps (some 6 blocks long) or coarse ones (some 25).
    VX_HD Brush wobbly(Brush p, float blocks, bool coarse = false) const {
        p.wobble = blocks;
        p.noise = t.shape_noise[coarse ? 1 : 0];
        return p;
    }
    // Logs lie along their branch: row.blocks[first] stands upright, [first + 1] lies along x, [first + 2] along z.
    VX_HD Brush log(u32 first, Vec3 direction) const {
        const float x = absolute<ScalarLanes>(direction.x), y = absolute<ScalarLanes>(direction.y),
                    z = absolute<ScalarLanes>(direction.z);
        return paint(y >= x && y >= z ? first : x >= z ? first + 1 : first + 2);
    }

    // Solids. A capsule with round ends, thin ones included: a radius of .5 is one block wide, .9 makes a line without
    // gaps.
    VX_HD void cone(Vec3 a, Vec3 b, float ra, float rb, Brush p) { add(Solid::cone, a, b, ra, rb, p); }
    VX_HD void ball(Vec3 centre, float radius, Brush p) { ball(centre, Vec3{radius, radius, radius}, p); }
    VX_HD void ball(Vec3 centre, Vec3 radii, Brush p) { add(Solid::ball, centre, radii, 0.0f, 0.0f, p); }
    // A shell `thick` blocks thick, inwards from the radius; what is inside stays as it is.
    VX_HD void shell(Vec3 centre, Vec3 radii, float thick, Brush p) {
        p.flags = u8(p.flags | solid_hollow);
        add(Solid::ball, centre, radii, thick, 0.0f, p);
    }
    // The upper half of an ellipsoid; thick > 0: only a shell, open below.
    VX_HD void dome(Vec3 centre, Vec3 radii, float thick, Brush p) {
        if (thick > 0.0f) p.flags = u8(p.flags | solid_hollow);
        add(Solid::dome, centre, radii, thick, 0.0f, p);
    }
    VX_HD void cylinder(Vec3 a, Vec3 b, float ra, float rb, Brush p) { add(Solid::cylinder, a, b, ra, rb, p); }
    // Six sides; radius: from the axis to the middle of a side. rb = 0 ends in a point.
    VX_HD void prism(Vec3 a, Vec3 b, float ra, float rb, Brush p) { add(Solid::prism, a, b, ra, rb, p); }
    VX_HD void box(Vec3 low, Vec3 high, Brush p) { add(Solid::box, low, high, 0.0f, 0.0f, p); }
    // One block, by its offset from the placement's.
    VX_HD void voxel(i32 x, i32 y, i32 z, Brush p) {
        const Vec3 at{float(x), float(y), float(z)};
        box(at + Vec3{0.1f, 0.1f, 0.1f}, at + Vec3{0.9f, 0.9f, 0.9f}, p);
    }

    // Bezier curves: `parts` cones, the radius going evenly from ra to rb. logs: the brush's block is the upright one
    // of three (see log), given as the index `first`.
    VX_HD_FN Vec3 curve(Vec3 a, Vec3 c, Vec3 b, float s) const {
        const float r = 1.0f - s;
        return a * (r * r) + c * (2.0f * r * s) + b * (s * s);
    }
    VX_HD_FN Vec3 curve(Vec3 a, Vec3 c, Vec3 d, Vec3 b, float s) const {
        const float r = 1.0f - s;
        return a * (r * r * r) + c * (3.0f * r * r * s) + d * (3.0f * r * s * s) + b * (s * s * s);
    }
    VX_HD_FN void spline(Vec3 a, Vec3 c, Vec3 b, float ra, float rb, u32 parts, Brush p) {
        spline(a, a + (c - a) * (2.0f / 3.0f), b + (c - b) * (2.0f / 3.0f), b, ra, rb, parts, p);
    }
    VX_HD_FN void spline(Vec3 a, Vec3 c, Vec3 d, Vec3 b, float ra, float rb, u32 parts, Brush p) {
        const float step = 1.0f / float(parts);
        Vec3 from = a;
        for (u32 i = 1; i <= parts; ++i) {
            const float s = float(i) * step;
            const Vec3 to = curve(a, c, d, b, s);
            cone(from, to, ra + (rb - ra) * (s - step), ra + (rb - ra) * s, p);
            from = to;
        }
    }
    VX_HD_FN void log_spline(Vec3 a, Vec3 c, Vec3 b, float ra, float rb, u32 parts, u32 first) {
        const float step = 1.0f / float(parts);
        Vec3 from = a;
        for (u32 i = 1; i <= parts; ++i) {
            const float s = float(i) * step;
            const Vec3 to = curve(a, c, b, s);
            cone(from, to, ra + (rb - ra) * (s - step), ra + (rb - ra) * s, log(first, to - from));
            from = to;
        }
    }

    // One solid, with the box of its voxels.
    VX_HD_FN void add(Solid solid, Vec3 a, Vec3 b, float ra, float rb, Brush p) {
        if (out.primitives >= kPrimitivesMost) {
            fits = false;
            return;
        }
        Vec3 low, high;
        extent(solid, a, b, ra, rb, p.wobble, low, high);
        Primitive s;
        s.a = a;
        s.b = b;
        s.ra = ra;
        s.rb = rb;
        s.wobble = p.wobble;
        s.noise = p.noise;
        s.solid = solid;
        s.flags = p.flags;
        s.block = p.block;
        s.other = p.other;
        s.other_share = p.other_share;
        s.missing_share = p.missing_share;
        const float side = float(row.reach);
        voxels(low.x, high.x, -side, side, s.low[0], s.high[0]);
        voxels(low.y, high.y, float(row.bound_low), float(row.bound_high), s.low[1], s.high[1]);
        voxels(low.z, high.z, -side, side, s.low[2], s.high[2]);
        for (i32 i = 0; i < 3; ++i)
            if (s.low[i] > s.high[i])
                return; // too thin to hold the centre of any voxel, or all of it beyond the bounds
        for (i32 i = 0; i < 3; ++i) {
            placement.low[i] = placement.count == 0 || s.low[i] < placement.low[i] ? s.low[i] : placement.low[i];
            placement.high[i] = placement.count == 0 || s.high[i] > placement.high[i] ? s.high[i] : placement.high[i];
        }
        out.primitive[out.primitives++] = s;
        ++placement.count;
    }

private:
    // The box of a solid, blocks; generous by less than a block.
    static VX_HD_FN void extent(Solid solid, Vec3 a, Vec3 b, float ra, float rb, float wobble, Vec3& low, Vec3& high) {
        if (solid == Solid::ball || solid == Solid::dome) {
            // The distance to an ellipsoid is a bound: wobble may show up to twice as far out.
            const Vec3 r = b + Vec3{2.0f * wobble, 2.0f * wobble, 2.0f * wobble};
            low = a - r;
            high = a + r;
            if (solid == Solid::dome) low.y = a.y - wobble;
            return;
        }
        Vec3 ea{wobble, wobble, wobble}, eb = ea;
        if (solid == Solid::cone) {
            ea += Vec3{ra, ra, ra};
            eb += Vec3{rb, rb, rb};
        } else if (solid != Solid::box) {
            // A disk square to the axis w reaches r sqrt(1 - w_i^2) along axis i; a hexagon's corners lie further out.
            const Vec3 w = b - a;
            const float length = size(w), inverse = length > 0.0f ? 1.0f / length : 0.0f;
            const float corner = solid == Solid::prism ? 1.15470054f : 1.0f;
            const Vec3 side{corner * disk(w.x * inverse), corner * disk(w.y * inverse), corner * disk(w.z * inverse)};
            // Wobble moves the sides by up to wobble / the slope of a cone's side: twice is plenty for cones to 60
            // degrees.
            ea = side * (ra + 2.0f * wobble) + ea;
            eb = side * (rb + 2.0f * wobble) + eb;
        }
        const Vec3 al = a - ea, ah = a + ea, bl = b - eb, bh = b + eb;
        low = {least(al.x, bl.x), least(al.y, bl.y), least(al.z, bl.z)};
        high = {greatest(ah.x, bh.x), greatest(ah.y, bh.y), greatest(ah.z, bh.z)};
    }
    static VX_HD float disk(float w) { return square_root(greatest(1.0f - w * w, 0.0f)); }
    // Voxels whose centres lie between low and high, held inside the bounds.
    static VX_HD_FN void voxels(float low, float high, float least_bound, float most_bound, i16& first, i16& last) {
        const float from = greatest(least(low - 0.51f, 1000.0f), least_bound),
                    to = least(greatest(high - 0.49f, -1000.0f), most_bound);
        first = i16(-floor_int<ScalarLanes>(-from));
        last = i16(floor_int<ScalarLanes>(to));
    }
};

} // namespace vitrail
