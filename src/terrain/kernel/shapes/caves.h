// Shapes of caves, and the cactus.
#pragma once

#include "terrain/kernel/shapes/builder.h"
#include "terrain/kernel/shapes/parts.h"

namespace vitrail {

// A ball of glass with a glowing core: on the floor with roots that hold it, or hanging by a cord with tendrils below.
// numbers: radius; hanging.
template <class L>
VX_HD_FN void build_stormlight(ShapeBuilder<L>& b) {
    const bool hanging = b.number(parts::stormlight::hanging) > 0.5f;
    const float room = b.room();
    float r = b.range(b.number(parts::stormlight::radius_least), b.number(parts::stormlight::radius_most));
    r = least(r, (room - 1.0f) * 0.5f);
    if (r < 1.4f) return;
    const float spare = least(greatest(room - 2.0f * r - 1.0f, 0.0f), 22.0f - 2.0f * r);
    const Brush core = b.paint(parts::stormlight::core), glass = b.paint(parts::stormlight::shell),
                cord = b.paint(parts::stormlight::cord);
    Vec3 middle = b.root();
    float pole = 1.0f; // which way the cord goes
    if (hanging) {
        middle.y = 1.0f - r - greatest(spare * b.range(0.25f, 0.7f), 0.0f);
        const Vec3 away = b.around(b.unit());
        middle = middle + away * b.range(0.0f, 1.2f);
    } else {
        middle.y = r + least(spare, b.range(0.2f, 1.4f));
        pole = -1.0f;
    }
    // On the middle of a block and of half a block more than a whole radius: rounder so.
    middle = {to_float(floor_int<L>(middle.x)) + 0.5f, to_float(floor_int<L>(middle.y)) + 0.5f,
              to_float(floor_int<L>(middle.z)) + 0.5f};
    r = to_float(floor_int<L>(r)) + 0.4f;
    b.ball(middle, greatest(r * 0.46f, 0.9f), core);
    // What holds the core within the ball.
    b.cone(middle, middle + Vec3{0.0f, pole * r, 0.0f}, 0.5f, 0.5f, cord);
    b.shell(middle, Vec3{r, r, r}, 1.15f, glass);
    const u32 tendrils = 4 + b.below(4);
    const float turn = b.unit();
    for (u32 i = 0; i < tendrils; ++i) {
        const float at = turn + (float(i) + b.range(-0.25f, 0.25f)) / float(tendrils);
        const Vec3 out = b.around(at);
        if (hanging) {
            // From the ball's lower half down, a little inwards.
            const Vec3 from = middle + b.towards(at, b.range(-0.17f, -0.1f)) * (r + 0.2f);
            const float fall = least(b.range(1.5f, 3.5f) + r * 0.5f, greatest(from.y + room - 2.0f, 1.0f));
            b.spline(from, from + out * 0.9f + Vec3{0.0f, -fall * 0.4f, 0.0f},
                     from - out * 0.3f + Vec3{0.0f, -fall, 0.0f}, 0.75f, 0.6f, 3, cord);
        } else {
            const Vec3 from = middle + b.towards(at, b.range(-0.12f, 0.03f)) * (r + 0.1f);
            const Vec3 to = b.root() + out * (r + b.range(1.0f, 3.0f)) + Vec3{0.0f, -1.5f, 0.0f};
            b.spline(from, Vec3{from.x, from.y, from.z} + out * b.range(0.8f, 2.0f), to, 0.85f, 0.75f, 4, cord);
        }
    }
    if (hanging) b.cone(middle + Vec3{0.0f, r - 1.2f, 0.0f}, b.root() + Vec3{0.0f, 2.0f, 0.0f}, 0.8f, 0.8f, cord);
}

// A six-sided crystal from floor to ceiling, with smaller ones about its foot and its head. numbers: radius.
template <class L>
VX_HD_FN void build_crystal_pillar(ShapeBuilder<L>& b) {
    const float room = b.room();
    if (room > 84.0f) return; // no crystal grows so long
    float r = b.range(b.number(parts::crystal_pillar::radius_least), b.number(parts::crystal_pillar::radius_most));
    r = greatest(least(r, room * 0.16f), 1.0f);
    const Brush p = b.paint(b.below(3));
    const Vec3 foot = b.root() + Vec3{0.0f, -3.0f, 0.0f};
    const Vec3 away = b.around(b.unit());
    const Vec3 head = b.root() + Vec3{0.0f, room + 2.5f, 0.0f} + away * least(room * b.range(0.0f, 0.16f), 7.0f);
    b.prism(foot, head, r, r * b.range(0.7f, 1.05f), p);
    const u32 shards = 3 + b.below(4);
    const float turn = b.unit();
    for (u32 i = 0; i < shards; ++i) {
        const bool up = (i & 1) == 0; // from the floor
        const float wide = greatest(r * b.range(0.4f, 0.65f), 0.95f), far = least(room * b.range(0.25f, 0.5f), 12.0f);
        const float where = turn + (float(i) + b.range(-0.3f, 0.3f)) / float(shards);
        Vec3 out = b.towards(where, b.range(0.12f, 0.2f));
        Vec3 from = foot;
        if (!up) {
            from = head;
            out.y = -out.y;
        }
        const Vec3 neck = from + out * (far * 0.7f + 2.0f);
        b.prism(from, neck, wide, wide * 0.9f, p);
        b.prism(neck, neck + out * (far * 0.3f + 1.5f), wide * 0.9f, 0.3f, p);
    }
}

// Glowing lumps that hang from the ceiling and drip. numbers: size.
template <class L>
VX_HD_FN void build_glowstone_cluster(ShapeBuilder<L>& b) {
    const float size =
        b.range(b.number(parts::glowstone_cluster::size_least), b.number(parts::glowstone_cluster::size_most));
    const float deepest = least(b.room() * 0.6f, 14.0f);
    const Brush p = b.sparse(parts::glowstone_cluster::glow, 0.08f), solid = b.paint(parts::glowstone_cluster::glow);
    b.ball(b.root() + Vec3{0.0f, 1.0f, 0.0f}, Vec3{size * 0.8f, size * 0.4f + 1.0f, size * 0.8f}, b.wobbly(p, 0.8f));
    const u32 drops = 3 + b.below(u32(size) + 1);
    for (u32 i = 0; i < drops; ++i) {
        const Vec3 away = b.around(b.unit());
        Vec3 at = b.root() + away * (size * b.range(0.0f, 0.75f)) + Vec3{0.0f, 1.0f, 0.0f};
        float r = size * b.range(0.2f, 0.36f);
        const u32 links = 2 + b.below(4);
        for (u32 k = 0; k < links; ++k) {
            b.ball(at, Vec3{greatest(r, 0.55f), greatest(r * 1.3f, 0.7f), greatest(r, 0.55f)},
                   k + 1 == links ? solid : p);
            const Vec3 side = b.around(b.unit());
            const float out = r * b.range(0.2f, 0.8f), down = r * b.range(1.0f, 1.7f) + 0.5f;
            const Vec3 next = at + side * out - Vec3{0.0f, down, 0.0f};
            if (next.y < -deepest) break;
            if (k + 1 < links && r < 1.0f) b.cone(at, next, 0.8f, 0.8f, solid);
            at = next;
            r = r * b.range(0.6f, 0.9f);
        }
    }
}

// One block wide, down from the ceiling; some of it glows. numbers: length, glowing share.
template <class L>
VX_HD_FN void build_cave_vine(ShapeBuilder<L>& b) {
    const i32 wanted =
        b.between(i32(b.number(parts::cave_vine::length_least)), i32(b.number(parts::cave_vine::length_most)));
    const i32 room = b.placement.room - 1;
    const i32 length = wanted < room ? wanted : room;
    if (length < 1) return;
    const Brush vine =
        b.paint(parts::cave_vine::vine, parts::cave_vine::glowing, b.number(parts::cave_vine::glowing_share));
    if (length > 1) b.box({0.1f, 2.1f - float(length), 0.1f}, {0.9f, 0.9f, 0.9f}, vine);
    b.voxel(0, 1 - length, 0, b.paint(parts::cave_vine::tip));
}

// A great fungus: a stem that bends a little, under a bell, tiers or a wide hat with hanging ends; lights in the cap.
// numbers: height, radius of the cap.
template <class L>
VX_HD_FN void build_fungus(ShapeBuilder<L>& b) {
    float height = b.range(b.number(parts::fungus::height_least), b.number(parts::fungus::height_most));
    height = least(height, b.room() - 3.0f);
    if (height < 2.0f) return;
    float r = b.range(b.number(parts::fungus::cap_radius_least), b.number(parts::fungus::cap_radius_most));
    r = least(r, height * 0.7f + 0.5f);
    const float thick = height > 7.0f ? 0.95f : 0.5f;
    const Vec3 side = b.around(b.unit());
    const Vec3 lean = side * (height * b.range(0.0f, 0.16f));
    const Vec3 top = b.root() + lean + Vec3{0.0f, height, 0.0f};
    b.spline(b.root() + Vec3{0.0f, -1.5f, 0.0f}, b.root() + Vec3{0.0f, height * 0.6f, 0.0f}, top, thick + 0.25f, thick,
             4, b.paint(parts::fungus::stem));
    const Brush cap = b.paint(parts::fungus::cap, parts::fungus::light, 0.07f), light = b.paint(parts::fungus::light);
    const Brush rag = b.sparse(parts::fungus::cap, 0.35f);
    const u32 form = b.below(3);
    if (form == 0) { // a bell with a ragged hem
        b.ball(top + Vec3{0.0f, -0.6f, 0.0f}, 0.75f, light);
        b.dome(top + Vec3{0.0f, -r * 0.35f, 0.0f}, Vec3{r, r * 1.15f, r}, 1.3f, cap);
        b.cylinder(top + Vec3{0.0f, -r * 0.35f - 1.3f, 0.0f}, top + Vec3{0.0f, -r * 0.35f + 0.2f, 0.0f}, r * 0.98f,
                   r * 0.98f, rag);
        return;
    }
    if (form == 1) { // tiers, smaller upwards
        const u32 tiers = height > 6.0f ? 3 : 2;
        for (u32 i = 0; i < tiers; ++i) {
            const float share = 1.0f - float(i) * 0.3f, down = (float(tiers - 1 - i)) * (1.2f + r * 0.45f);
            b.dome(top + Vec3{0.0f, -down, 0.0f}, Vec3{r * share + 0.3f, r * 0.4f * share + 0.9f, r * share + 0.3f},
                   0.0f, cap);
        }
        return;
    }
    // A wide hat; lights hang below its edge.
    const float wide = r * 1.25f;
    b.dome(top + Vec3{0.0f, -0.4f, 0.0f}, Vec3{wide, r * 0.45f + 1.0f, wide}, 0.0f, cap);
    const u32 ends = 3 + b.below(4);
    const float turn = b.unit();
    for (u32 i = 0; i < ends; ++i) {
        const Vec3 edge = top + b.around(turn + float(i) / float(ends)) * (wide * 0.8f);
        const float fall = least(b.range(1.0f, 3.2f), height * 0.5f);
        b.cone(edge, edge + Vec3{0.0f, -fall, 0.0f}, 0.5f, 0.5f, b.paint(parts::fungus::cap));
        if (b.chance(0.5f)) b.ball(edge + Vec3{0.0f, -fall - 0.5f, 0.0f}, 0.6f, light);
    }
}

// A pillar with arms that bend upwards. numbers: height, arms.
template <class L>
VX_HD_FN void build_cactus(ShapeBuilder<L>& b) {
    const float height = b.range(b.number(parts::cactus::height_least), b.number(parts::cactus::height_most));
    const Brush p = b.paint(parts::cactus::body);
    const bool thick = height > 8.5f && b.chance(0.6f); // a plus of five blocks across
    const float r = thick ? 1.2f : 0.55f;
    b.cone(b.root() + Vec3{0.0f, -2.0f, 0.0f}, b.root() + Vec3{0.0f, height - 1.0f - r, 0.0f}, r, r, p);
    const i32 arms = b.between(i32(b.number(parts::cactus::arms_least)), i32(b.number(parts::cactus::arms_most)));
    const u32 side = b.below(4);
    for (i32 i = 0; i < arms && height >= 5.0f; ++i) {
        const Vec3 out = b.around(float((side + u32(i)) & 3) * 0.25f); // along an axis, so that the arm holds together
        const float at = height * b.range(0.35f, 0.62f), reach = r + b.range(1.6f, 2.6f),
                    rise = height * b.range(0.2f, 0.36f);
        const Vec3 from = b.root() + Vec3{0.0f, at, 0.0f}, elbow = from + out * reach;
        b.cone(from, elbow, 0.6f, 0.6f, p);
        b.cone(elbow, elbow + Vec3{0.0f, rise, 0.0f}, 0.6f, 0.55f, p);
    }
}

} // namespace vitrail
