// Trees and flowers of the jungle.
#pragma once

#include "terrain/kernel/shapes/builder.h"
#include "terrain/kernel/shapes/parts.h"

namespace vitrail {

// An emergent: buttress roots, a long trunk, branches into clouds of leaves at several heights.
template <class L>
VX_HD_FN void build_jungle_tree(ShapeBuilder<L>& b) {
    namespace p = parts::jungle_tree;
    const float height = b.range(b.number(p::height_least), b.number(p::height_most));
    const float radius = 0.7f + height * 0.03f;
    const float turn = b.unit();
    const Vec3 lean = b.around(turn) * b.range(0.0f, 2.5f);
    const Vec3 foot{0.5f, -4.0f, 0.5f};
    const Vec3 waist = Vec3{0.5f, height * 0.5f, 0.5f} + lean * 0.8f;
    const Vec3 top = Vec3{0.5f, height, 0.5f} + lean;
    b.cone(foot, waist, radius * 1.15f, radius * 0.85f, b.paint(p::trunk));
    b.cone(waist, top, radius * 0.85f, 0.7f, b.paint(p::trunk));
    const u32 roots = 4 + b.below(3);
    for (u32 i = 0; i < roots; ++i) { // thin walls, as high as a man or two
        const Vec3 away = b.around(turn + (float(i) + b.range(-0.3f, 0.3f)) / float(roots));
        Vec3 from = Vec3{0.5f, 0.0f, 0.5f} + away * (radius * 0.6f),
             to = Vec3{0.5f, -2.0f, 0.5f} + away * (radius + b.range(2.5f, 4.0f));
        from.y = height * b.range(0.1f, 0.2f);
        b.cone(from, to, 0.72f, 0.9f, b.log(p::trunk, to - from));
    }
    const u32 branches = 6 + b.below(3);
    Vec3 ends[8];
    for (u32 i = 0; i < branches; ++i) {
        const float s = float(i) / float(branches - 1);
        const float y = height * (0.5f + 0.42f * s);
        Vec3 from = Vec3{0.5f, 0.0f, 0.5f} + lean * (0.8f + 0.2f * s);
        from.y = y;
        const float away = turn + float(i) * 0.382f + b.range(-0.07f, 0.07f);
        const float out = (4.5f + height * 0.16f) * (1.0f - 0.3f * s) * b.range(0.75f, 1.1f);
        Vec3 end = from + b.around(away) * out;
        end.y = y + b.range(2.0f, 4.5f);
        Vec3 bow = from + (end - from) * 0.6f;
        bow.y = y + 0.5f;
        b.log_spline(from, bow, end, 0.9f, 0.72f, 2, p::trunk);
        ends[i] = end;
    }
    for (u32 i = 0; i < branches; ++i) {
        const float r = b.range(3.8f, 5.6f);
        b.ball(ends[i] + Vec3{0.0f, 0.6f, 0.0f}, {r, r * b.range(0.45f, 0.6f), r}, b.sparse(p::leaves, 0.08f));
        if (b.chance(0.45f)) { // a curtain of creepers
            const Vec3 at = ends[i] + b.around(b.unit()) * (r * 0.6f);
            b.cone(at, at - Vec3{0.0f, b.range(3.0f, 8.0f), 0.0f}, 0.72f, 0.5f, b.paint(p::leaves));
        }
    }
    const float r = 4.0f + height * 0.075f;
    b.ball(top + Vec3{0.0f, 0.5f, 0.0f}, {r, r * 0.55f, r}, b.sparse(p::leaves, 0.08f));
    for (u32 i = 0; i < 2; ++i) {
        const Vec3 aside = b.around(turn + 0.5f * float(i) + b.range(0.0f, 0.2f)) * (r * 0.55f);
        b.ball(top + aside + Vec3{0.0f, b.range(1.0f, 2.4f), 0.0f}, {r * 0.65f, r * 0.45f, r * 0.65f},
               b.sparse(p::leaves, 0.1f));
    }
}

// The storeys below: a bent stem with a crown of a few clouds; down to bushes of two or three blocks.
template <class L>
VX_HD_FN void build_small_jungle_tree(ShapeBuilder<L>& b) {
    namespace p = parts::small_jungle_tree;
    const float height = b.range(b.number(p::height_least), b.number(p::height_most));
    const float crown = b.range(b.number(p::crown_least), b.number(p::crown_most));
    const float turn = b.unit();
    const Vec3 foot{0.5f, -1.0f, 0.5f};
    const Vec3 bend = b.around(turn) * (height * b.range(0.0f, 0.16f));
    const Vec3 knee = Vec3{0.5f, height * 0.5f, 0.5f} + bend, top = Vec3{0.5f, height, 0.5f} + bend * 0.7f;
    b.log_spline(foot, knee, top, 0.75f, 0.72f, 2, p::trunk);
    const u32 clouds = (height > 6.0f ? 2 : 1) + b.below(2);
    Vec3 ends[4];
    for (u32 i = 0; i < clouds; ++i) {
        const float s = 0.72f + 0.2f * float(i) / float(clouds);
        const Vec3 from = b.curve(foot, knee, top, s);
        const float away = turn + (float(i) + b.range(-0.2f, 0.2f)) / float(clouds);
        const float out = crown * b.range(0.6f, 0.95f);
        const float up = crown * b.range(0.1f, 0.4f);
        ends[i] = from + b.around(away) * out + Vec3{0.0f, up, 0.0f};
        if (height > 6.0f) b.cone(from, ends[i], 0.72f, 0.72f, b.log(p::trunk, ends[i] - from));
    }
    for (u32 i = 0; i < clouds; ++i) {
        const float r = crown * b.range(0.6f, 0.8f);
        b.ball(ends[i], {r, r * b.range(0.55f, 0.75f), r}, b.sparse(p::leaves, 0.1f));
    }
    b.ball(top + Vec3{0.0f, 0.3f, 0.0f}, {crown * 0.9f, crown * b.range(0.5f, 0.7f), crown * 0.9f},
           b.sparse(p::leaves, 0.1f));
}

// A giant flower: five thick petals, flecked, that rise from a bowl and droop at their ends.
template <class L>
VX_HD_FN void build_rafflesia(ShapeBuilder<L>& b) {
    namespace p = parts::rafflesia;
    const float stem = b.range(b.number(p::stem_least), b.number(p::stem_most));
    const float petal = b.range(b.number(p::petal_least), b.number(p::petal_most));
    const float turn = b.unit();
    const Vec3 foot{0.5f, -2.0f, 0.5f};
    const Vec3 head = Vec3{0.5f, stem, 0.5f} + b.around(turn) * b.range(0.0f, 1.5f);
    b.cone(foot, head, petal * 0.16f, petal * 0.13f, b.paint(p::stem));
    const float bowl = petal * 0.36f;
    // The bowl: a floor that glows, within a rim.
    b.ball(head + Vec3{0.0f, 0.5f, 0.0f}, {bowl * 0.8f, 1.2f, bowl * 0.8f}, b.paint(p::core));
    const u32 rim = 10;
    const float lip = bowl * 0.3f + 0.5f;
    for (u32 i = 0; i < rim; ++i) {
        const Vec3 at = head + b.around(turn + float(i) / float(rim)) * bowl;
        b.ball(at + Vec3{0.0f, 1.1f, 0.0f}, {lip, 1.5f, lip}, b.paint(p::petal));
    }
    // Petals rise a little and droop at their ends; no two alike, all flecked with the core.
    const float rise = b.range(0.06f, 0.2f) * petal;
    for (u32 i = 0; i < 5; ++i) {
        const Vec3 away = b.around(turn + 0.2f * (float(i) + b.range(-0.06f, 0.06f)));
        const float far = petal * b.range(0.95f, 1.1f);
        const float width = petal * b.range(0.36f, 0.42f);
        const Vec3 middle = head + away * (far * 0.72f) + Vec3{0.0f, rise, 0.0f};
        const Vec3 tip = head + away * (far * 1.12f) + Vec3{0.0f, rise - b.range(0.3f, 1.6f), 0.0f};
        const Brush flesh = b.paint(p::petal, p::core, 0.06f);
        b.cone(head, middle, 1.2f, 1.2f, b.paint(p::petal));
        b.ball(middle, {width, 1.25f, width}, flesh);
        b.ball(middle + (tip - middle) * 0.5f, {width * 0.9f, 1.2f, width * 0.9f}, flesh);
        b.ball(tip, {width * 0.62f, 1.1f, width * 0.62f}, flesh);
    }
    for (u32 i = 0; i < 4; ++i) { // leaves at the foot
        const Vec3 away = b.around(turn + 0.25f * float(i) + b.range(0.0f, 0.15f));
        const Vec3 from{0.5f, 0.3f, 0.5f};
        const Vec3 to = from + away * (petal * b.range(0.45f, 0.7f)) + Vec3{0.0f, 0.8f, 0.0f};
        b.cone(from, to, 0.72f, 1.0f, b.sparse(p::leaves, 0.05f));
    }
}

} // namespace vitrail
