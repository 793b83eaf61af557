// Birches.
#pragma once

#include "terrain/kernel/shapes/builder.h"
#include "terrain/kernel/shapes/parts.h"

namespace vitrail {

// A slender trunk, slightly bowed, in an airy column of small clumps; some are tall, some golden, some orange.
template <class L>
VX_HD_FN void build_birch(ShapeBuilder<L>& b) {
    namespace p = parts::birch;
    float height = b.range(b.number(p::height_least), b.number(p::height_most));
    const bool tall = b.chance(b.number(p::tall_share));
    if (tall) height = height * 1.6f;
    const float color = b.unit();
    const float yellow = b.number(p::yellow_share), orange = b.number(p::orange_share);
    const u32 leaves = color < yellow ? p::leaves_yellow : color < yellow + orange ? p::leaves_orange : p::leaves;
    const float turn = b.unit();
    const Vec3 bow = b.around(turn) * b.range(0.0f, 1.3f);
    const Vec3 foot{0.5f, 0.0f, 0.5f}, top = foot + Vec3{0.0f, height, 0.0f} + bow * 0.6f;
    const Vec3 waist = foot + Vec3{0.0f, height * 0.5f, 0.0f} + bow;
    b.spline(foot, waist, top, 0.72f, 0.72f, 2, b.paint(p::trunk));
    const u32 clumps = tall ? 8 : 5 + b.below(2);
    const float low = b.range(0.36f, 0.5f);
    for (u32 i = 0; i < clumps; ++i) {
        const float s = float(i) / float(clumps); // up the crown
        const float width = (0.8f + 1.3f * s * (1.0f - s)) * (1.1f - 0.4f * s);
        const Vec3 away = b.around(turn + float(i) * 0.382f + b.range(-0.06f, 0.06f));
        const float r = width * b.range(1.9f, 2.5f);
        const Vec3 at = b.curve(foot, waist, top, low + (1.0f - low) * s) + away * (r * b.range(0.5f, 0.85f));
        b.ball(at, {r, r * b.range(0.5f, 0.75f), r}, b.sparse(leaves, 0.14f));
    }
    b.ball(top, {1.6f, 2.3f, 1.6f}, b.sparse(leaves, 0.1f));
}

} // namespace vitrail
