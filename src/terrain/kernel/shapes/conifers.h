// Redwoods, the leaning pines of cliffs, and shrubs.
#pragma once

#include "terrain/kernel/shapes/builder.h"
#include "terrain/kernel/shapes/parts.h"

namespace vitrail {

// A tapering trunk on buttress roots, bare below, with drooping tiers of needles above; a few are giants.
template <class L>
VX_HD_FN void build_redwood(ShapeBuilder<L>& b) {
    namespace p = parts::redwood;
    float height = b.range(b.number(p::height_least), b.number(p::height_most));
    if (b.chance(b.number(p::giant_share))) height = height * b.range(1.35f, 1.7f);
    const float radius = 0.8f + height * 0.03f;
    const float turn = b.unit();
    const Vec3 lean = b.around(turn) * b.range(0.0f, 1.4f);
    const Vec3 foot{0.5f, -5.0f, 0.5f};
    const Vec3 waist = Vec3{0.5f, height * 0.16f, 0.5f} + lean * 0.15f;
    const Vec3 top = Vec3{0.5f, height, 0.5f} + lean;
    b.cone(foot, waist, radius * 1.45f, radius, b.paint(p::trunk));
    b.cone(waist, top - Vec3{0.0f, 2.5f, 0.0f}, radius, 0.5f, b.paint(p::trunk));
    const u32 roots = 4 + b.below(3);
    for (u32 i = 0; i < roots; ++i) {
        const Vec3 away = b.around(turn + (float(i) + b.range(-0.25f, 0.25f)) / float(roots));
        const float out = radius * 1.3f + b.range(1.4f, 2.8f);
        Vec3 from = Vec3{0.5f, 0.0f, 0.5f} + away * (radius * 0.75f), to = Vec3{0.5f, -3.0f, 0.5f} + away * out;
        from.y = 2.0f + height * b.range(0.04f, 0.1f);
        b.cone(from, to, 0.8f, 1.0f, b.log(p::trunk, to - from));
    }
    const float low = height * b.range(0.28f, 0.42f);
    const float spread = 3.8f + height * b.range(0.06f, 0.095f);
    const u32 tiers = 5 + u32(height * 0.085f);
    const float step = (height - 1.0f - low) / float(tiers - 1);
    for (u32 i = 0; i < tiers; ++i) {
        const float s = float(i) / float(tiers - 1);
        // Widest a quarter up the crown, pointed above.
        const float r = spread * least(1.0f, 0.7f + 1.6f * s) * (1.12f - s) * b.range(0.85f, 1.1f) + 0.6f;
        const float away = b.unit();
        const Vec3 at =
            Vec3{0.5f, low + step * float(i), 0.5f} + lean * (0.3f + 0.7f * s) + b.around(away) * (r * 0.1f);
        const float high = step * b.range(0.85f, 1.3f);
        b.dome(at, {r * 0.84f, high, r * 0.84f}, 0.0f, b.sparse(p::leaves, 0.1f));
        // Boughs that reach further and hang lower; the slender top has none.
        const u32 boughs = r > 2.4f ? 2 + (i & 1) : 0;
        for (u32 k = 0; k < boughs; ++k) {
            const Vec3 out = b.around(away + (float(k) + b.range(-0.2f, 0.2f)) / float(boughs)) * (r * 0.62f);
            const float wide = r * b.range(0.38f, 0.52f);
            b.dome(at + out - Vec3{0.0f, 0.7f, 0.0f}, {wide, high * 0.8f, wide}, 0.0f, b.sparse(p::leaves, 0.1f));
        }
    }
    b.cone(top - Vec3{0.0f, step + 1.0f, 0.0f}, top + Vec3{0.0f, 2.6f, 0.0f}, 1.7f, 0.5f, b.paint(p::leaves));
}

// Grows out of a cliff to one side and up again, under flat pads of needles.
template <class L>
VX_HD_FN void build_pine(ShapeBuilder<L>& b) {
    namespace p = parts::pine;
    const float height = b.range(b.number(p::height_least), b.number(p::height_most));
    const float turn = b.unit();
    const float lean = least(height * b.number(p::lean) * b.range(0.4f, 1.2f), 6.5f);
    const Vec3 side = b.around(turn);
    const Vec3 foot{0.5f, -2.0f, 0.5f};
    const Vec3 knee = Vec3{0.5f, height * 0.3f, 0.5f} + side * (lean * 0.9f);
    const Vec3 top = Vec3{0.5f, height, 0.5f} + side * lean;
    b.log_spline(foot, knee, top, 0.85f, 0.72f, 3, p::trunk);
    const u32 pads = 3 + b.below(3);
    Vec3 ends[6];
    for (u32 i = 0; i < pads; ++i) {
        const float s = 0.5f + 0.4f * float(i) / float(pads - 1);
        const Vec3 from = b.curve(foot, knee, top, s);
        // More of them on the side it leans to.
        const float away = turn + (i % 3 == 1 ? 0.5f : 0.0f) + b.range(-0.17f, 0.17f);
        const float out = b.range(1.6f, 3.2f) * (1.35f - 0.5f * s);
        ends[i] = from + b.around(away) * out + Vec3{0.0f, 0.5f, 0.0f};
        b.cone(from, ends[i], 0.72f, 0.72f, b.log(p::trunk, ends[i] - from));
    }
    for (u32 i = 0; i < pads; ++i) {
        const float r = b.range(1.7f, 2.7f);
        b.ball(ends[i] + Vec3{0.0f, 0.5f, 0.0f}, {r, b.range(0.9f, 1.3f), r}, b.sparse(p::leaves, 0.1f));
    }
    const float r = b.range(2.0f, 2.9f);
    b.ball(top + Vec3{0.0f, 0.5f, 0.0f}, {r, 1.4f, r}, b.sparse(p::leaves, 0.1f));
}

// A low heap of leaves around a short stem.
template <class L>
VX_HD_FN void build_shrub(ShapeBuilder<L>& b) {
    namespace p = parts::shrub;
    const float radius = b.range(b.number(p::radius_least), b.number(p::radius_most));
    const Vec3 foot{0.5f, 0.0f, 0.5f};
    b.cone(foot, foot + Vec3{0.0f, radius * 0.3f, 0.0f}, 0.5f, 0.5f, b.paint(p::trunk));
    b.ball(foot + Vec3{0.0f, radius * 0.45f, 0.0f}, {radius, radius * 0.85f, radius}, b.paint(p::leaves));
    const u32 more = b.below(3);
    for (u32 i = 0; i < more; ++i) {
        const Vec3 away = b.around(b.unit());
        const Vec3 aside = away * (radius * b.range(0.6f, 0.95f));
        const float r = radius * b.range(0.5f, 0.75f);
        b.ball(foot + aside + Vec3{0.0f, r * 0.4f, 0.0f}, {r, r * 0.9f, r}, b.sparse(p::leaves, 0.1f));
    }
}

} // namespace vitrail
