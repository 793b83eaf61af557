// Palms.
#pragma once

#include "terrain/kernel/shapes/builder.h"
#include "terrain/kernel/shapes/parts.h"

namespace vitrail {

// A leaning trunk that straightens, and fronds that rise, arch and hang.
template <class L>
VX_HD_FN void build_palm(ShapeBuilder<L>& b) {
    namespace p = parts::palm;
    const float height = b.range(b.number(p::height_least), b.number(p::height_most));
    const float turn = b.unit();
    const float lean = least(height * b.range(0.05f, 0.5f), 7.0f);
    const Vec3 side = b.around(turn);
    const Vec3 foot{0.5f, -1.5f, 0.5f};
    const Vec3 knee = Vec3{0.5f, height * 0.45f, 0.5f} + side * (lean * 0.9f);
    const Vec3 top = Vec3{0.5f, height, 0.5f} + side * lean;
    b.log_spline(foot, knee, top, 0.74f, 0.71f, 4, p::trunk);
    const u32 fronds = 8 + b.below(3);
    const float reach = 4.6f + height * 0.13f;
    const Vec3 from = top + Vec3{0.0f, 0.6f, 0.0f};
    for (u32 i = 0; i < fronds; ++i) {
        const Vec3 away = b.around(turn + (float(i) + b.range(-0.2f, 0.2f)) / float(fronds));
        const bool old = i % 3 == 2; // old fronds hang, young ones stand and arch
        const float out = reach * b.range(0.85f, 1.1f) * (old ? 0.72f : 1.0f);
        const float up = old ? b.range(-0.2f, 0.5f) : b.range(1.0f, 2.2f);
        const float fall = b.range(2.0f, 3.4f) + (old ? 1.2f : 0.0f);
        const Vec3 bow = from + away * (out * 0.6f) + Vec3{0.0f, up, 0.0f};
        const Vec3 tip = from + away * out + Vec3{0.0f, up - fall, 0.0f};
        b.cone(from, bow, 0.72f, 0.8f, b.paint(p::leaves));
        b.cone(bow, tip, 0.8f, 0.62f, b.paint(p::leaves));
    }
}

} // namespace vitrail
