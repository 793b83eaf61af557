// Shapes of the sea: five corals, kelp, icebergs.
#pragma once

#include "terrain/kernel/shapes/builder.h"
#include "terrain/kernel/shapes/parts.h"

namespace vitrail {

namespace coral_detail {

// Tubes that fork as they rise.
template <class L>
VX_HD_FN void tubes(ShapeBuilder<L>& b, float size, Brush p) {
    const u32 stems = 2 + b.below(3);
    const float first = b.unit();
    for (u32 i = 0; i < stems; ++i) {
        const float turn = first + (float(i) + b.range(-0.2f, 0.2f)) / float(stems);
        const Vec3 rising = b.towards(turn, b.range(0.13f, 0.2f));
        const Vec3 fork = b.root() + rising * (size * b.range(0.55f, 0.8f));
        b.cone(b.root(), fork, 0.75f, 0.65f, p);
        const u32 tips = 2 + b.below(2);
        for (u32 k = 0; k < tips; ++k) {
            const float aside = b.range(-0.18f, 0.18f);
            const Vec3 out = b.towards(turn + aside, b.range(0.12f, 0.22f));
            b.cone(fork, fork + out * (size * b.range(0.5f, 0.85f)), 0.65f, 0.5f, p);
        }
    }
}

// A lumpy head, wider than high.
template <class L>
VX_HD_FN void brain(ShapeBuilder<L>& b, float size, Brush p) {
    const float r = size * 0.55f;
    b.ball(b.root() + Vec3{0.0f, r * 0.35f, 0.0f}, Vec3{r * b.range(1.0f, 1.3f), r * 0.85f, r * b.range(1.0f, 1.3f)},
           b.wobbly(p, 0.45f));
    if (b.chance(0.6f)) {
        const Vec3 beside = b.around(b.unit()) * (r * 1.1f);
        b.ball(b.root() + beside, Vec3{r * 0.6f, r * 0.55f, r * 0.6f}, p);
    }
}

// Balls of many sizes in a heap.
template <class L>
VX_HD_FN void bubbles(ShapeBuilder<L>& b, float size, Brush p) {
    const u32 count = 4 + b.below(4);
    Vec3 at = b.root();
    for (u32 i = 0; i < count; ++i) {
        const float r = size * b.range(0.16f, 0.32f) + 0.4f;
        b.ball(at, r, p);
        const Vec3 away = b.around(b.unit());
        const float out = size * b.range(0.15f, 0.5f), up = size * b.range(0.05f, 0.75f);
        at = b.root() + away * out + Vec3{0.0f, up, 0.0f};
    }
}

// A fan of flames: thin blades in one plane.
template <class L>
VX_HD_FN void flames(ShapeBuilder<L>& b, float size, Brush p) {
    const float turn = b.unit();
    const u32 blades = 4 + b.below(4);
    for (u32 i = 0; i < blades; ++i) {
        const float lean = (float(i) + 0.5f) / float(blades); // over half a turn, from one side to the other
        const Vec3 out = b.towards(turn, 0.06f + lean * 0.38f);
        const float long_by = size * b.range(0.8f, 1.25f);
        const Vec3 middle = b.root() + out * (long_by * 0.5f),
                   tip = b.root() + out * (long_by * 0.8f) + Vec3{0.0f, long_by * 0.3f, 0.0f};
        b.spline(b.root(), middle, tip, 0.85f, 0.7f, 3, p);
    }
}

// A table on a foot, with a ragged edge and a smaller one above it.
template <class L>
VX_HD_FN void tables(ShapeBuilder<L>& b, float size, Brush p) {
    Vec3 foot = b.root();
    float radius = size * b.range(0.8f, 1.1f);
    const u32 floors = 1 + b.below(size > 4.0f ? 3 : 2);
    for (u32 i = 0; i < floors; ++i) {
        const Vec3 away = b.around(b.unit());
        const Vec3 top = foot + away * (size * 0.15f) + Vec3{0.0f, 1.0f + size * b.range(0.2f, 0.4f), 0.0f};
        b.cone(foot, top, 0.9f, 0.7f, p);
        b.cylinder(top, top + Vec3{0.0f, 0.9f, 0.0f}, radius, radius, b.wobbly(p, 0.8f));
        foot = top;
        radius = radius * b.range(0.55f, 0.7f);
    }
}

} // namespace coral_detail

// One of five kinds, each with a form and a block of its own. numbers: size. Grows in water only, never out of it.
template <class L>
VX_HD_FN void build_coral(ShapeBuilder<L>& b) {
    using namespace coral_detail;
    float size = b.range(b.number(parts::coral::size_least), b.number(parts::coral::size_most));
    // Forks and stacked tables rise to 1.8 times the size: what is cut at the waterline shows as rafts of coral.
    size = least(size, greatest((b.room() - 1.0f) * 0.55f, 1.0f));
    const u32 kind = b.below(5);
    Brush p = b.paint(kind); // parts::coral::tube and the following
    p.flags = solid_only_water;
    if (kind == parts::coral::tube) tubes(b, size, p);
    if (kind == parts::coral::brain) brain(b, size, p);
    if (kind == parts::coral::bubble) bubbles(b, size, p);
    if (kind == parts::coral::fire) flames(b, size, p);
    if (kind == parts::coral::horn) tables(b, size, p);
}

// A stalk one block wide that ends below the surface. numbers: height.
template <class L>
VX_HD_FN void build_kelp(ShapeBuilder<L>& b) {
    const i32 wanted = b.between(i32(b.number(parts::kelp::height_least)), i32(b.number(parts::kelp::height_most)));
    const i32 room = b.placement.room;
    const i32 height = wanted < room ? wanted : room;
    if (height < 1) return;
    Brush stalk = b.paint(parts::kelp::stalk), tip = b.paint(parts::kelp::tip);
    stalk.flags = tip.flags = solid_only_water;
    if (height > 1) b.box({0.1f, 0.1f, 0.1f}, {0.9f, float(height) - 1.1f, 0.9f}, stalk);
    b.voxel(0, height - 1, 0, tip);
}

namespace iceberg_detail {

// Blocks of an iceberg: the same wobble for all, so that snow and blue bands follow the ice they lie on.
struct Ice {
    Brush ice, blue, snow;
};
template <class L>
VX_HD_FN Ice brushes(ShapeBuilder<L>& b, float wobble) {
    Ice p{b.wobbly(b.paint(parts::iceberg::ice), wobble, true), b.wobbly(b.paint(parts::iceberg::core), wobble, true),
          b.wobbly(b.paint(parts::iceberg::snow), wobble, true)};
    p.ice.flags = p.blue.flags = solid_in_water;
    return p;
}

// What stands above the water: solids around an axis each.
constexpr u32 kBlocksOfIceMost = 7;
struct Bodies {
    Vec3 foot[kBlocksOfIceMost], top[kBlocksOfIceMost];
    float wide[kBlocksOfIceMost], sharp[kBlocksOfIceMost]; // radii at foot and top
    u32 count = 0;
    bool flat = false; // tables with cliffs, else peaks
};

// Tables: a few broad blocks with level or gently sloping tops, one higher than the others.
template <class L>
VX_HD_FN void tables(ShapeBuilder<L>& b, Vec3 middle, float radius, Bodies& out) {
    out.flat = true;
    out.count = 2 + b.below(3);
    const float turn = b.unit(), slope = b.range(0.0f, 0.3f);
    const Vec3 lean = b.around(b.unit());
    for (u32 i = 0; i < out.count; ++i) {
        const float away = i == 0 ? b.range(0.0f, 0.15f) : b.range(0.35f, 0.55f);
        const float high = i == 0 ? radius * b.range(0.5f, 0.95f) : radius * b.range(0.2f, 0.55f);
        const Vec3 axis = Vec3{0.0f, 1.0f, 0.0f} + lean * (slope * b.range(0.4f, 1.0f));
        const Vec3 at =
            middle + b.around(turn + (float(i) + b.range(-0.2f, 0.2f)) / float(out.count)) * (radius * away);
        out.foot[i] = at - axis * (radius * 0.3f);
        out.top[i] = at + axis * high;
        out.wide[i] = radius * (i == 0 ? b.range(0.5f, 0.66f) : b.range(0.3f, 0.46f));
        out.sharp[i] = out.wide[i] * b.range(0.78f, 0.95f);
    }
}

// Peaks: steep ones close together, the first the highest, leaning the same way.
template <class L>
VX_HD_FN void peaks(ShapeBuilder<L>& b, Vec3 middle, float radius, Bodies& out) {
    out.flat = false;
    out.count = 4 + b.below(4);
    const float turn = b.unit(), highest = radius * b.range(0.9f, 1.4f);
    const Vec3 side = b.around(b.unit());
    const Vec3 lean = side * (radius * b.range(0.05f, 0.25f));
    for (u32 i = 0; i < out.count; ++i) {
        const float share = i == 0 ? 1.0f : b.range(0.25f, 0.75f), away = i == 0 ? 0.1f : b.range(0.3f, 0.62f);
        const Vec3 at = middle + b.around(turn + float(i) * 0.38f + b.range(-0.1f, 0.1f)) * (radius * away);
        out.foot[i] = at - Vec3{0.0f, radius * 0.25f, 0.0f};
        out.top[i] = at + lean * share + Vec3{0.0f, highest * share, 0.0f};
        out.wide[i] = radius * (i == 0 ? b.range(0.42f, 0.52f) : b.range(0.24f, 0.4f));
        out.sharp[i] = greatest(out.wide[i] * b.range(0.06f, 0.22f), 1.2f);
    }
}

} // namespace iceberg_detail

// A mountain of ice that floats: tables or peaks above the water, a keel of lobes down to the floor or as deep as it is
// wide, blue ice below and in bands, snow on all that faces the sky, a few broken pieces around. Stands on the sea's
// surface or on its floor, the water's depth below. numbers: radius.
template <class L>
VX_HD_FN void build_iceberg(ShapeBuilder<L>& b) {
    using namespace iceberg_detail;
    const float radius = b.range(b.number(parts::iceberg::radius_least), b.number(parts::iceberg::radius_most));
    const float sea = b.row.place == FeaturePlace::sea_surface ? 0.0f : b.room();
    const float keel = least(b.room() + 2.0f, radius * b.range(1.1f, 1.7f));
    const Vec3 middle = b.root() + Vec3{0.0f, sea, 0.0f};
    const Ice above = brushes(b, 4.0f), below = brushes(b, 6.0f);
    Bodies body;
    if (b.chance(0.5f))
        tables(b, middle, radius, body);
    else
        peaks(b, middle, radius, body);

    // Blue ice first, it keeps its voxels: the heart of the keel, and bands through what stands above.
    b.ball(middle + Vec3{0.0f, -keel * 0.42f, 0.0f}, Vec3{radius * 0.66f, keel * 0.6f, radius * 0.66f}, below.blue);
    for (u32 i = 0; i < body.count; ++i) {
        if (!b.chance(0.55f)) continue;
        const float at = b.range(0.25f, 0.8f), thick = b.range(0.02f, 0.07f);
        const Vec3 axis = body.top[i] - body.foot[i];
        const float r = body.wide[i] + (body.sharp[i] - body.wide[i]) * at,
                    slope = (body.sharp[i] - body.wide[i]) * thick;
        b.cylinder(body.foot[i] + axis * at, body.foot[i] + axis * (at + thick), r - 0.4f, r + slope - 0.4f,
                   above.blue);
    }
    for (u32 i = 0; i < body.count; ++i) {
        if (body.flat)
            b.cylinder(body.foot[i], body.top[i], body.wide[i], body.sharp[i], above.ice);
        else
            b.cone(body.foot[i], body.top[i], body.wide[i], body.sharp[i], above.ice);
    }
    // The keel: lobes that meet at the water line, each as wide as what stands on it and more.
    const float turn = b.unit();
    b.ball(middle + Vec3{0.0f, -keel * 0.36f, 0.0f}, Vec3{radius * 0.72f, keel * 0.64f, radius * 0.72f}, below.ice);
    for (u32 i = 0; i < 4; ++i) {
        const float deep = keel * b.range(0.3f, 0.6f), wide = radius * b.range(0.34f, 0.5f);
        const Vec3 out = b.around(turn + (float(i) + b.range(-0.25f, 0.25f)) * 0.25f);
        const Vec3 at = middle + out * (radius * b.range(0.35f, 0.52f));
        b.ball(at + Vec3{0.0f, 1.0f - deep, 0.0f}, Vec3{wide, deep, wide}, below.ice);
    }
    const u32 pieces = b.below(4);
    for (u32 i = 0; i < pieces; ++i) {
        const float r = b.range(2.5f, 5.5f);
        const Vec3 out = b.around(b.unit());
        const Vec3 at = middle + out * (radius * b.range(0.95f, 1.2f)) - Vec3{0.0f, r * 0.35f, 0.0f};
        b.ball(at, Vec3{r * b.range(0.8f, 1.3f), r * b.range(0.5f, 0.9f), r}, b.wobbly(above.ice, 1.0f));
    }
    // Snow: the same solids a block or two higher, where they come out of the ice.
    const Vec3 up{0.0f, 1.6f, 0.0f};
    for (u32 i = 0; i < body.count; ++i) {
        const float at = body.flat ? 0.6f : 0.3f; // none low on steep sides
        const Vec3 from = body.foot[i] + (body.top[i] - body.foot[i]) * at + up;
        const float r = body.wide[i] + (body.sharp[i] - body.wide[i]) * at;
        if (body.flat)
            b.cylinder(from, body.top[i] + up, r, body.sharp[i], above.snow);
        else
            b.cone(from, body.top[i] + up, r, body.sharp[i], above.snow);
    }
}

} // namespace vitrail
