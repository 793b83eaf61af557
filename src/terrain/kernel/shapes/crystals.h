// Crystals on the surface.
#pragma once

#include "terrain/kernel/shapes/builder.h"
#include "terrain/kernel/shapes/parts.h"

namespace vitrail {

// A six-sided prism with a pointed tip.
template <class L>
VX_HD_FN void build_spike(ShapeBuilder<L>& b, Vec3 foot, Vec3 direction, float size, float radius, Brush p) {
    const float point = least(radius * 2.2f, size * 0.4f);
    const Vec3 shoulder = foot + direction * (size - point);
    b.prism(foot, shoulder, radius * 0.85f, radius, p);
    b.prism(shoulder, shoulder + direction * (point + 0.5f), radius, 0.0f, p);
}

// A tall crystal, a little aslant, in a crown of shards that lean away from it.
template <class L>
VX_HD_FN void build_crystal(ShapeBuilder<L>& b) {
    namespace p = parts::crystal;
    const float tall = b.range(b.number(p::height_least), b.number(p::height_most));
    const float radius = b.range(b.number(p::radius_least), b.number(p::radius_most));
    const u32 shards = u32(b.between(i32(b.number(p::shards_least)), i32(b.number(p::shards_most))));
    const Brush body = b.paint(b.below(3));
    const float turn = b.unit();
    const float sunk = least(2.0f + radius, 8.0f);
    const Vec3 foot{0.5f, -sunk, 0.5f};
    // Upright ones keep their faces smooth; the more a crystal leans, the more it is broken into steps.
    build_spike(b, foot, b.towards(turn, b.range(0.237f, 0.25f)), tall + sunk, radius, body);
    for (u32 i = 0; i < shards; ++i) {
        const float away = turn + float(i) * 0.382f + b.range(-0.06f, 0.06f);
        const bool upright = i % 3 == 0;
        const float tilt = upright ? b.range(0.225f, 0.245f) : b.range(0.13f, 0.2f);
        const float size = tall * (upright ? b.range(0.4f, 0.75f) : b.range(0.22f, 0.45f)) + sunk;
        const float thick = greatest(radius * b.range(0.36f, 0.62f), 0.85f);
        const Vec3 from = foot + b.around(away) * (upright ? radius + thick * 0.4f : radius * 0.5f);
        build_spike(b, from, b.towards(away, tilt), size, thick, body);
    }
}

} // namespace vitrail
