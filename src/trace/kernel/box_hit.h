// Entity boxes under a small tree. Kernel-safe. A ray that starts in a box does not see it.
#pragma once

#include "trace/kernel/scene_view.h"

namespace vitrail::trace {

inline constexpr u32 kBoxDepthMost = 32; // of the tree

// Where a ray enters a box; false where it does not, starts inside, or comes later than t_most.
VX_HD bool enter_box(Vec3 from, Vec3 dir, Vec3 least, Vec3 most, float t_most, float& t, u32& face) {
    float t0 = -1, t1 = t_most;
    u32 axis = 3;
    const auto slab = [&](float o, float d, float a, float b, u32 which) {
        if (d == 0) return o >= a && o <= b;
        const float x = (a - o) / d, y = (b - o) / d, in = x < y ? x : y, out = x < y ? y : x;
        if (in > t0) t0 = in, axis = which * 2 + (d > 0 ? 0 : 1);
        if (out < t1) t1 = out;
        return true;
    };
    if (!slab(from.x, dir.x, least.x, most.x, 0) || !slab(from.y, dir.y, least.y, most.y, 1) ||
        !slab(from.z, dir.z, least.z, most.z, 2) || !(t0 <= t1))
        return false;
    t = t0, face = axis;
    return true;
}

// The nearest box before hit.t. any: the first one found will do.
VX_HD bool meet_boxes(const SceneView& s, const Ray& ray, float t_most, bool any, Hit& hit) {
    if (s.box_count == 0) return false;
    const Vec3 from = offset(s.boxes_from, ray.from);
    u32 stack[kBoxDepthMost + 1];
    u32 depth = 0;
    stack[depth++] = 0;
    bool found = false;
    while (depth != 0) {
        const BoxNode& node = s.box_nodes[stack[--depth]];
        float t;
        u32 face;
        if (!enter_box(from, ray.dir, node.least, node.most, t_most, t, face)) continue;
        if (node.count == 0) {
            if (depth + 2 > kBoxDepthMost + 1) continue;
            stack[depth++] = node.first + 1;
            stack[depth++] = node.first;
            continue;
        }
        for (u32 i = node.first; i < node.first + node.count; ++i) {
            const EntityBox& b = s.boxes[i];
            // Relative to the box: nothing is lost where both are far from boxes_from.
            const Vec3 o = offset(b.least, ray.from);
            if (!enter_box(o, ray.dir, {0, 0, 0}, b.size, t_most, t, face) || t < 0 || !(t < t_most)) continue;
            const Vec3 p = o + ray.dir * t;
            const u32 axis = face >> 1;
            const float u = axis == 0 ? p.z / b.size.z : p.x / b.size.x,
                        v = axis == 1 ? p.z / b.size.z : 1 - p.y / b.size.y;
            hit.t = t_most = t;
            hit.kind = HitKind::box, hit.face = u8(face), hit.leaving = false, hit.quad = i, hit.state = b.state;
            hit.u = clamp(u, 0.0f, 1.0f), hit.v = clamp(v, 0.0f, 1.0f);
            hit.cell = moved(ray.from, ray.dir, t).cell;
            found = true;
            if (any) return true;
        }
    }
    return found;
}

} // namespace vitrail::trace
