// Trees of the savanna.
#pragma once

#include "terrain/kernel/shapes/builder.h"
#include "terrain/kernel/shapes/parts.h"

namespace vitrail {

// A bent trunk that forks into limbs, each under a flat umbrella of one or two layers.
template <class L>
VX_HD_FN void build_acacia(ShapeBuilder<L>& b) {
    namespace p = parts::acacia;
    const float height = b.range(b.number(p::height_least), b.number(p::height_most));
    const float turn = b.unit();
    const float lean = b.range(0.6f, 2.2f);
    const float split = height * b.range(0.4f, 0.55f);
    const Vec3 foot{0.5f, 0.0f, 0.5f};
    const Vec3 fork = foot + b.around(turn) * lean + Vec3{0.0f, split, 0.0f};
    b.cone(foot, foot + Vec3{0.0f, split * 0.4f, 0.0f}, 0.85f, 0.72f, b.paint(p::trunk));
    b.cone(foot + Vec3{0.0f, split * 0.4f, 0.0f}, fork, 0.72f, 0.72f, b.paint(p::trunk));
    const u32 limbs = 2 + b.below(5) / 2; // 2, 3, rarely 4
    Vec3 ends[4];
    for (u32 i = 0; i < limbs; ++i) {
        const float away = turn + float(i) / float(limbs) + b.range(-0.08f, 0.08f);
        const float out = b.range(2.6f, 5.4f);
        const float rise = height * (i == 0 ? 1.0f : b.range(0.72f, 0.97f));
        Vec3 end = fork + b.around(away) * out;
        end.y = rise;
        // Limbs leave level and turn upwards.
        const Vec3 knee = fork + (end - fork) * 0.6f - Vec3{0.0f, 0.8f, 0.0f};
        b.cone(fork, knee, 0.72f, 0.72f, b.log(p::trunk, knee - fork));
        b.cone(knee, end, 0.72f, 0.72f, b.log(p::trunk, end - knee));
        ends[i] = end;
    }
    for (u32 i = 0; i < limbs; ++i) {
        const float radius = (i == 0 ? 1.0f : 0.85f) * b.range(3.8f, 5.6f);
        const float narrow = b.range(0.8f, 1.0f); // no umbrella is round
        const bool along = b.chance(0.5f);
        const Vec3 wide{along ? radius : radius * narrow, 1.25f, along ? radius * narrow : radius};
        b.ball(ends[i] + Vec3{0.0f, 0.2f, 0.0f}, wide, b.sparse(p::leaves, 0.08f));
        const Vec3 shift = b.around(b.unit()) * (radius * 0.2f);
        b.ball(ends[i] + shift + Vec3{0.0f, 1.2f, 0.0f}, {wide.x * 0.62f, 1.1f, wide.z * 0.62f},
               b.sparse(p::leaves, 0.1f));
    }
}

} // namespace vitrail
