// The giant mushrooms of the purple forest.
#pragma once

#include "terrain/kernel/shapes/builder.h"
#include "terrain/kernel/shapes/parts.h"

namespace vitrail {

// A cap over `at`: a shell, gills like a vault inside it, spots on top.
template <class L>
VX_HD_FN void build_mushroom_cap(ShapeBuilder<L>& b, Vec3 at, float radius, float high, float thick, u32 spots) {
    namespace p = parts::mushroom;
    const float turn = b.unit();
    for (u32 i = 0; i < spots; ++i) {
        // On the ellipsoid, between its rim and its crown.
        const float s = b.range(0.25f, 0.95f), c = square_root(1.0f - s * s);
        const Vec3 away = b.around(turn + float(i) * 0.382f + b.range(-0.05f, 0.05f));
        const float r = radius * b.range(0.06f, 0.13f) + 0.35f;
        b.ball(at + away * (radius * c) + Vec3{0.0f, high * s - 0.3f, 0.0f}, {r, r * 0.8f, r}, b.paint(p::gills));
    }
    b.dome(at, {radius, high, radius}, thick, b.paint(p::cap));
    const float in = thick - 0.4f;
    b.dome(at + Vec3{0.0f, 0.6f, 0.0f}, {radius - in, high - in, radius - in}, 1.4f, b.paint(p::gills));
}

template <class L>
VX_HD_FN void build_mushroom(ShapeBuilder<L>& b) {
    namespace p = parts::mushroom;
    // The tall ones have the wide caps, so that a grove has storeys.
    const float age = b.unit();
    const float tall = b.number(p::height_least) + (b.number(p::height_most) - b.number(p::height_least)) * age;
    const float wide = 0.35f * b.unit() + 0.65f * age;
    const float radius =
        b.number(p::cap_radius_least) + (b.number(p::cap_radius_most) - b.number(p::cap_radius_least)) * wide;
    const float turn = b.unit();
    const float bend = b.range(2.0f, 5.0f) + tall * 0.06f;
    const Vec3 foot{0.5f, -4.0f, 0.5f};
    const float elsewhere = b.range(0.3f, 0.7f);
    const Vec3 low = Vec3{0.5f, tall * 0.35f, 0.5f} + b.around(turn) * bend;
    const Vec3 high = Vec3{0.5f, tall * 0.7f, 0.5f} + b.around(turn + elsewhere) * bend;
    const Vec3 top = Vec3{0.5f, tall, 0.5f} + b.around(turn + b.range(0.0f, 1.0f)) * (bend * 0.6f);
    const float thick = 1.6f + radius * 0.06f + tall * 0.008f;
    b.cone(foot, foot + Vec3{0.0f, 8.0f, 0.0f}, thick * 1.7f, thick, b.paint(p::stem));
    const float rise = radius * b.range(0.45f, 0.85f);
    const float shell = 1.8f + radius * 0.06f;
    // The stem ends inside the cap's shell.
    const Vec3 end = top + Vec3{0.0f, rise - shell, 0.0f};
    b.spline(foot, low, high, end, thick * 1.15f, thick * 0.75f, 7, b.paint(p::stem));
    if (b.chance(0.4f)) { // what is left of the veil, a skirt on the stem
        const Vec3 at = b.curve(foot, low, high, end, b.range(0.6f, 0.8f));
        b.dome(at, {thick + 2.6f, 2.6f, thick + 2.6f}, 1.2f, b.paint(p::gills));
    }
    build_mushroom_cap(b, top, radius, rise, shell, 8);
}

template <class L>
VX_HD_FN void build_medium_mushroom(ShapeBuilder<L>& b) {
    namespace p = parts::mushroom;
    const float tall = b.range(b.number(p::height_least), b.number(p::height_most));
    const float radius = b.range(b.number(p::cap_radius_least), b.number(p::cap_radius_most));
    const float turn = b.unit();
    const Vec3 foot{0.5f, -2.0f, 0.5f};
    const Vec3 bend = b.around(turn) * b.range(0.5f, 2.5f);
    const Vec3 back = b.around(turn + b.range(0.2f, 0.8f));
    const Vec3 top = Vec3{0.5f, tall, 0.5f} + back * b.range(0.0f, 2.0f);
    const float rise = radius * b.range(0.55f, 1.0f);
    const float thick = 0.72f + radius * 0.06f;
    b.log_spline(foot, Vec3{0.5f, tall * 0.5f, 0.5f} + bend, top + Vec3{0.0f, rise - 1.2f, 0.0f}, thick * 1.4f,
                 thick * 0.9f, 3, p::stem);
    build_mushroom_cap(b, top, radius, rise, 1.5f, 4);
}

} // namespace vitrail
