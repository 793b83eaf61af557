// Cypresses of the swamp.
#pragma once

#include "terrain/kernel/shapes/builder.h"
#include "terrain/kernel/shapes/parts.h"

namespace vitrail {

// A bald cypress: swollen foot with roots and knees, a bare trunk, level branches into a wide flat crown hung with
// moss.
template <class L>
VX_HD_FN void build_cypress(ShapeBuilder<L>& b) {
    namespace p = parts::cypress;
    const float height = b.range(b.number(p::height_least), b.number(p::height_most));
    const u32 branches = u32(b.between(i32(b.number(p::branches_least)), i32(b.number(p::branches_most))));
    const float radius = 0.75f + height * 0.018f;
    const float turn = b.unit();
    const Vec3 lean = b.around(turn) * b.range(0.0f, 1.8f);
    const Vec3 foot{0.5f, -3.0f, 0.5f};
    const Vec3 waist = Vec3{0.5f, height * 0.24f, 0.5f} + lean * 0.25f;
    const Vec3 top = Vec3{0.5f, height, 0.5f} + lean;
    Brush bark = b.paint(p::trunk); // what may stand in water
    bark.flags = solid_in_water;
    b.cone(foot, waist, radius * 2.3f, radius, bark);
    b.cone(waist, top, radius, 0.7f, b.paint(p::trunk));
    const u32 roots = 4 + b.below(3);
    for (u32 i = 0; i < roots; ++i) {
        const Vec3 away = b.around(turn + (float(i) + b.range(-0.3f, 0.3f)) / float(roots));
        Vec3 from = Vec3{0.5f, 0.0f, 0.5f} + away * radius,
             to = Vec3{0.5f, -2.5f, 0.5f} + away * (radius * 2.0f + b.range(2.0f, 4.0f));
        from.y = height * b.range(0.08f, 0.15f);
        Brush root = b.log(p::trunk, to - from);
        root.flags = solid_in_water;
        b.cone(from, to, 0.8f, 0.9f, root);
    }
    const u32 knees = b.below(4); // stand beside the tree, on their own roots
    for (u32 i = 0; i < knees; ++i) {
        const Vec3 away = b.around(b.unit());
        const Vec3 at = foot + away * (radius * 2.0f + b.range(1.0f, 2.5f));
        b.cone(at, at + Vec3{0.0f, b.range(4.0f, 6.5f), 0.0f}, 0.9f, 0.5f, bark);
    }
    Vec3 ends[10];
    for (u32 i = 0; i < branches; ++i) {
        const float s = float(i) / float(branches);
        const float y = height * (0.56f + 0.4f * s);
        Vec3 from = Vec3{0.5f, 0.0f, 0.5f} + lean * (0.56f + 0.4f * s);
        from.y = y;
        const float away = turn + float(i) * 0.382f + b.range(-0.06f, 0.06f);
        const float out = (6.5f + height * 0.14f) * (1.05f - 0.35f * s) * b.range(0.75f, 1.05f);
        Vec3 end = from + b.around(away) * out;
        end.y = y + height * 0.05f + b.range(0.0f, 2.0f);
        const Vec3 bow = from + (end - from) * 0.5f + Vec3{0.0f, -0.8f, 0.0f};
        b.log_spline(from, bow, end, 0.85f, 0.72f, 2, p::trunk);
        ends[i] = end;
    }
    for (u32 i = 0; i < branches; ++i) {
        const float r = b.range(3.2f, 4.6f);
        b.ball(ends[i] + Vec3{0.0f, 0.6f, 0.0f}, {r, b.range(1.2f, 1.7f), r}, b.sparse(p::leaves, 0.1f));
        if (b.chance(0.6f)) { // moss
            const Vec3 at = ends[i] + b.around(b.unit()) * (r * 0.55f);
            b.cone(at, at - Vec3{0.0f, b.range(2.5f, 6.0f), 0.0f}, 0.72f, 0.5f, b.paint(p::leaves));
        }
    }
    const float r = 4.0f + height * 0.06f;
    b.ball(top + Vec3{0.0f, 0.8f, 0.0f}, {r, 2.0f, r}, b.sparse(p::leaves, 0.1f));
    b.ball(top + Vec3{0.0f, 2.4f, 0.0f}, {r * 0.6f, 1.5f, r * 0.6f}, b.sparse(p::leaves, 0.1f));
}

} // namespace vitrail
