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
        b.spline(b.root(), middle, tip, 0.8f, 0.5f, 3, p);
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
    size = least(size, greatest(b.room() - 1.0f, 1.0f));
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

// A mountain of ice that floats: peaks and a shelf above the water, a keel down to the floor or as deep as it is wide,
// blue ice within that shows where the packed ice around it is thin, snow on all that faces the sky. Stands on the
// sea's surface or on its floor, the water's depth below. numbers: radius.
template <class L>
VX_HD_FN void build_iceberg(ShapeBuilder<L>& b) {
    const float radius = b.range(b.number(parts::iceberg::radius_least), b.number(parts::iceberg::radius_most));
    const float sea = b.row.place == FeaturePlace::sea_surface ? 0.0f : b.room();
    const float keel = least(b.room() + 2.0f, radius * b.range(1.2f, 1.8f));
    Brush ice = b.wobbly(b.paint(parts::iceberg::ice), 2.5f),
          blue = b.wobbly(b.paint(parts::iceberg::core), 3.5f, true);
    Brush snow = b.wobbly(b.paint(parts::iceberg::snow), 2.5f);
    ice.flags = blue.flags = solid_in_water;
    const Vec3 middle = b.root() + Vec3{0.0f, sea, 0.0f};
    const float turn = b.unit();

    // Peaks: the first in the middle and highest, the others around it, all leaning the same way.
    constexpr u32 kPeaksMost = 6;
    Vec3 foot[kPeaksMost], top[kPeaksMost];
    float wide[kPeaksMost], sharp[kPeaksMost];
    const u32 peaks = 3 + b.below(kPeaksMost - 2);
    const Vec3 side = b.around(b.unit());
    const Vec3 lean = side * (radius * b.range(0.0f, 0.22f));
    const float highest = radius * b.range(0.75f, 1.35f);
    for (u32 i = 0; i < peaks; ++i) {
        const float away = i == 0 ? 0.08f : b.range(0.3f, 0.55f), share = i == 0 ? 1.0f : b.range(0.3f, 0.8f);
        foot[i] = middle + b.around(turn + float(i) * 0.27f + b.range(-0.08f, 0.08f)) * (radius * away);
        top[i] = foot[i] + lean * share + Vec3{0.0f, highest * share, 0.0f};
        wide[i] = radius * (i == 0 ? b.range(0.42f, 0.5f) : b.range(0.2f, 0.36f));
        sharp[i] = wide[i] * b.range(0.12f, 0.45f);
    }
    const float squeeze = b.range(0.72f, 1.0f), shelf = b.range(3.0f, 6.5f);
    const bool along_x = b.chance(0.5f);
    const float wide_x = radius * (along_x ? 1.0f : squeeze), wide_z = radius * (along_x ? squeeze : 1.0f);

    // Blue hearts first: they keep their voxels, the packed ice lies around them.
    b.ball(middle + Vec3{0.0f, -keel * 0.3f, 0.0f}, Vec3{wide_x * 0.8f, keel * 0.62f, wide_z * 0.8f}, blue);
    b.cone(foot[0], top[0] + Vec3{0.0f, -sharp[0] - 3.0f, 0.0f}, wide[0] * 0.78f, sharp[0] * 0.5f, blue);
    // The shelf and the keel below it.
    b.ball(middle, Vec3{wide_x, shelf, wide_z}, ice);
    b.ball(middle + Vec3{0.0f, -keel * 0.28f, 0.0f}, Vec3{wide_x * 0.9f, keel * 0.72f, wide_z * 0.9f}, ice);
    for (u32 i = 0; i < peaks; ++i)
        b.cone(foot[i], top[i], wide[i], sharp[i], ice);
    // Snow: the same solids a block higher, where they come out of the ice.
    const Vec3 up{0.0f, 1.3f, 0.0f};
    snow.flags = 0;
    b.ball(middle + up, Vec3{wide_x * 0.99f, shelf, wide_z * 0.99f}, snow);
    for (u32 i = 0; i < peaks; ++i)
        b.cone(foot[i] + up, top[i] + up, wide[i] - 0.3f, greatest(sharp[i] - 0.3f, 0.4f), snow);
}

} // namespace vitrail
