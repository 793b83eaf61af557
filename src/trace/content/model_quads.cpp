#include "trace/content/model_quads.h"

#include "trace/kernel/texture.h"

namespace vitrail::trace {

namespace {

struct Corner {
    i32 x, y, z, s, t;
};
Corner operator-(const Corner& a, const Corner& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z, a.s - b.s, a.t - b.t};
}
bool operator==(const Corner& a, const Corner& b) {
    return a.x == b.x && a.y == b.y && a.z == b.z && a.s == b.s && a.t == b.t;
}

constexpr float kUnit = 1.0f / float(scene::kModelUnit);

void add(TraceQuad q, const Corner& corner, const Corner& a, const Corner& b, const Vec3& front,
         std::vector<TraceQuad>& out) {
    q.corner = Vec3{float(corner.x), float(corner.y), float(corner.z)} * kUnit;
    q.edge_a = Vec3{float(a.x), float(a.y), float(a.z)} * kUnit;
    q.edge_b = Vec3{float(b.x), float(b.y), float(b.z)} * kUnit;
    q.u0 = float(corner.s) * kUnit, q.v0 = float(corner.t) * kUnit;
    q.ua = float(a.s) * kUnit, q.va = float(a.t) * kUnit;
    q.ub = float(b.s) * kUnit, q.vb = float(b.t) * kUnit;
    const Vec3 across = cross(q.edge_a, q.edge_b);
    if (dot(across, across) == 0) return;
    q.normal = normalized(across);
    if (dot(q.normal, front) < 0) q.normal = -q.normal;
    out.push_back(q);
}

} // namespace

void add_trace_quads(const scene::ModelQuad& g, const scene::StateQuad& look, Optics optics, u32 medium,
                     std::vector<TraceQuad>& out) {
    TraceQuad q;
    q.texture = look_texture(look.bits);
    q.look = look_tint(look.bits) | look_fixed_tint(look.bits) << 8 | u32(optics) << 16;
    q.medium = medium;
    // A clear body's faces are met from within, too.
    if (g.flags & scene::ModelQuad::kTwoSided || medium) q.look |= TraceQuad::kTwoSided;
    if (g.flags & scene::ModelQuad::kUnshaded) q.look |= TraceQuad::kUnshaded;
    // Holes in glass are panes.
    if (look.pass == scene::ModelPass::cutout && optics != Optics::thin) q.look |= TraceQuad::kCutout;

    Corner c[4];
    for (std::size_t i = 0; i < 4; ++i)
        c[i] = {g.corners[i].x, g.corners[i].y, g.corners[i].z, g.corners[i].s, g.t[i]};
    const Vec3 front{float(g.normal[0]), float(g.normal[1]), float(g.normal[2])};
    if (c[1] - c[0] == c[2] - c[3]) {
        add(q, c[0], c[1] - c[0], c[3] - c[0], front, out);
        return;
    }
    q.look |= TraceQuad::kTriangle;
    add(q, c[0], c[1] - c[0], c[2] - c[0], front, out);
    add(q, c[0], c[2] - c[0], c[3] - c[0], front, out);
}

} // namespace vitrail::trace
