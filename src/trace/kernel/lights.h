// Lamps sampled directly: a direction to a point of one, and the density of such directions for what was met by chance.
// Kernel-safe.
//
// An emitter is chosen by the tree (light_tree.h), then one of its faces and quads by what they may give, then a point:
// near faces evenly in solid angle, all else evenly in area, of quads where they shine. What shines at the point
// follows from its texel (surface_at of the returned hit), and nothing does where a quad's texel is a hole or another
// part of the lamp stands before it.
#pragma once

#include "trace/kernel/light_tree.h"
#include "trace/kernel/liquid.h"
#include "trace/kernel/spherical_rect.h"
#include "trace/kernel/texture.h"

namespace vitrail::trace {

struct EmitterSample {
    Vec3 dir;           // unit, towards the lamp
    float distance = 0; // blocks
    float pdf = 0;      // per solid angle, all choices together; 0: no sample
    Hit hit;            // as closest_hit would tell of the point
};

inline constexpr float kNearFace2 = 12.0f; // squared blocks to a face's middle, below which directions are even

VX_HD float part_of(Vec3 v, u32 axis) {
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}
VX_HD bool any_side(Vec3 normal) { // stands for "from all sides"
    return normal.x == 0 && normal.y == 0 && normal.z == 0;
}

// What a flat piece may give: area x cosine over the squared distance, softened near it. h: height over its plane.
VX_HD float piece_weight(float area, float h, Vec3 way) {
    const float d2 = dot(way, way) + 0.25f;
    return area * h / (d2 * std::sqrt(d2));
}

// Of a cube face. q: place relative to the cell. top: height of a liquid's level surface, else 1.
VX_HD float face_weight(u32 face, Vec3 q, Vec3 normal, float top) {
    const u32 axis = face >> 1;
    const float plane = face & 1 ? 1.0f : 0.0f, at = part_of(q, axis);
    // A liquid's surface may slope: it is seen from below its level, too.
    const float h = face == 3 ? at - 0.5f * top : face & 1 ? at - 1 : -at;
    if (h <= 0) return 0;
    const Vec3 way = Vec3{axis == 0 ? plane : 0.5f, axis == 1 ? plane * top : 0.5f, axis == 2 ? plane : 0.5f} - q;
    if (!any_side(normal)) {
        const float across =
            std::fabs(normal.x) + std::fabs(normal.y) + std::fabs(normal.z) - std::fabs(part_of(normal, axis));
        if (dot(normal, way) + 0.5f * across + (1 - top) <= 0) return 0;
    }
    return piece_weight(1, h, way);
}
// The part of a quad that shines, along its edges; of a triangle all.
struct ShiningPart {
    float a, b, wide_a, wide_b;
};
VX_HD ShiningPart shining_part(const TraceQuad& q) {
    const auto end = [&](u32 i) { return float(q.shining_part >> (8 * i) & 255) * (1.0f / 255); };
    return {end(0), end(2), end(1) - end(0), end(3) - end(2)};
}
VX_HD float shining_area(const TraceQuad& q) {
    const float whole = length(cross(q.edge_a, q.edge_b));
    if (q.look & TraceQuad::kTriangle) return 0.5f * whole;
    const ShiningPart p = shining_part(q);
    return whole * (p.wide_a * p.wide_b);
}
// Light goes by shine over the whole quad.
VX_HD float quad_weight(const TraceQuad& quad, Vec3 q) {
    const ShiningPart p = shining_part(quad);
    const Vec3 way = quad.corner + quad.edge_a * (p.a + 0.5f * p.wide_a) + quad.edge_b * (p.b + 0.5f * p.wide_b) - q;
    float h = -dot(quad.normal, way);
    if (quad.look & TraceQuad::kTwoSided) h = std::fabs(h);
    const float area = length(cross(quad.edge_a, quad.edge_b)) * (quad.look & TraceQuad::kTriangle ? 0.5f : 1.0f);
    return h > 0 ? piece_weight(area * quad.emission_scale * quad.shine, h, way) : 0;
}

// An emitter seen from a place.
struct EmitterView {
    const Emitter* emitter;
    const StateRecord* state;
    Vec3 q;        // the place, relative to the emitter's cell
    Vec3 normal;   // of the surface there; 0: light from all sides
    float top = 1; // liquids
};
VX_HD EmitterView view_of_emitter(const SceneView& s, u32 emitter, Place at, Vec3 normal) {
    const Emitter& e = s.lights.emitters[emitter];
    const StateRecord& r = s.states[e.state];
    return {&e, &r, offset({e.cell, {}}, at), normal,
            r.kind == CellKind::liquid ? float(r.liquid_height + 1) * (1.0f / 256) : 1.0f};
}
// Pieces: 0..5 faces, 6.. quads of the state.
VX_HD u32 piece_end(const EmitterView& v) {
    return v.emitter->faces & Emitter::kQuads ? 6 + v.state->quads : 6;
}
VX_HD float weight_of_piece(const SceneView& s, const EmitterView& v, u32 piece) {
    if (piece >= 6) return quad_weight(s.quads[v.state->first_quad + piece - 6], v.q);
    return v.emitter->faces >> piece & 1 ? face_weight(piece, v.q, v.normal, v.top) : 0;
}
VX_HD float weight_of_pieces(const SceneView& s, const EmitterView& v) {
    float sum = 0;
    for (u32 i = 0; i < piece_end(v); ++i)
        sum += weight_of_piece(s, v, i);
    return sum;
}

// A whole face as seen from q (on its outer side); solid_angle 0: too small or too far to be worth the trouble.
VX_HD SphericalRect rect_of_face(u32 face, Vec3 q) {
    const u32 axis = face >> 1, b = axis == 2 ? 0 : axis + 1, c = axis == 0 ? 2 : axis - 1;
    const float h = face & 1 ? part_of(q, axis) - 1 : -part_of(q, axis), x = part_of(q, b), y = part_of(q, c);
    const float dx = x - 0.5f, dy = y - 0.5f;
    if (dx * dx + dy * dy + h * h > kNearFace2) return {};
    SphericalRect r = make_spherical_rect(-x, 1 - x, -y, 1 - y, -h);
    if (!(r.solid_angle > 2e-3f)) r.solid_angle = 0;
    return r;
}

// A point of an emitter that choose_emitter has chosen: choose and chance as it left them; u: where on it. False: none
// (pdf 0).
VX_HD_CALL bool sample_chosen(const SceneView& s, Place at, Vec3 normal, u32 emitter, float choose, float chance,
                              Vec2 u, EmitterSample& out) {
    out.pdf = 0;
    if (emitter == kNoEmitter) return false;
    const EmitterView v = view_of_emitter(s, emitter, at, normal);
    const float sum = weight_of_pieces(s, v);
    if (!(sum > 0)) return false;
    u32 piece = 0;
    float weight = 0, left = choose * sum;
    for (u32 i = 0; i < piece_end(v); ++i) {
        const float w = weight_of_piece(s, v, i);
        if (!(w > 0)) continue;
        piece = i, weight = w;
        if (left < w) break;
        left -= w;
    }
    out.hit.cell = v.emitter->cell;
    out.hit.state = v.emitter->state;
    Vec3 target;
    float area = 1, even = 0; // even: density in solid angle, where it is that
    Vec3 facing;
    if (piece >= 6) {
        const u32 index = v.state->first_quad + piece - 6;
        const TraceQuad& quad = s.quads[index];
        if (!(quad.look & TraceQuad::kTriangle)) {
            const ShiningPart p = shining_part(quad);
            u = {p.a + u.x * p.wide_a, p.b + u.y * p.wide_b};
        } else if (u.x + u.y > 1) {
            u = {1 - u.x, 1 - u.y};
        }
        target = quad.corner + quad.edge_a * u.x + quad.edge_b * u.y;
        facing = quad.normal;
        area = shining_area(quad);
        const Vec2 uv = quad_uv(quad, u.x, u.y);
        if (quad.look & TraceQuad::kCutout && hole_at(s.textures, quad.texture, uv)) return false;
        out.hit.kind = HitKind::quad;
        out.hit.quad = index;
        out.hit.u = uv.x, out.hit.v = uv.y;
    } else if (piece == 3 && v.state->kind == CellKind::liquid) {
        const LiquidTop top = liquid_top(s, v.emitter->cell, v.state->medium);
        if (top.full) return false;
        target = {u.x, liquid_height_at(top, u.x, u.y), u.y};
        facing = liquid_normal(top, u.x, u.y);
        area = 1 / facing.y;
        out.hit.kind = HitKind::quad;
        out.hit.quad = kLiquidSurface;
        out.hit.u = u.x, out.hit.v = u.y;
    } else {
        const u32 axis = piece >> 1;
        const float plane = piece & 1 ? 1.0f : 0.0f, side = piece & 1 ? 1.0f : -1.0f;
        const SphericalRect rect = rect_of_face(piece, v.q);
        if (rect.solid_angle > 0) {
            const Vec2 p = place_on_rect(rect, u);
            u = {p.x - rect.x0, p.y - rect.y0}; // relative to the cell
            even = 1 / rect.solid_angle;
        }
        target = axis == 0 ? Vec3{plane, u.x, u.y} : axis == 1 ? Vec3{u.y, plane, u.x} : Vec3{u.x, u.y, plane};
        facing = {axis == 0 ? side : 0, axis == 1 ? side : 0, axis == 2 ? side : 0};
        if (v.state->kind == CellKind::liquid && axis != 1) {
            const LiquidTop top = liquid_top(s, v.emitter->cell, v.state->medium);
            if (target.y > liquid_height_at(top, target.x, target.z)) return false;
        } else if (v.state->kind == CellKind::cutout) {
            const u64 look = v.state->faces[piece];
            if (hole_at(s.textures, look_texture(look), face_uv(look, target))) return false;
        }
        out.hit.kind = HitKind::cube;
        out.hit.face = u8(piece);
    }
    const Vec3 way = target - v.q;
    const float d2 = dot(way, way);
    if (!(d2 > 1e-8f)) return false;
    out.distance = std::sqrt(d2);
    out.dir = way * (1 / out.distance);
    const float cosine = std::fabs(dot(out.dir, facing));
    if (!(cosine > 1e-6f)) return false;
    if (out.hit.quad == kLiquidSurface && dot(out.dir, facing) > 0) return false; // from below
    out.hit.t = out.distance;
    out.pdf = chance * (weight / sum) * (even > 0 ? even : d2 / (cosine * area));
    return true;
}

// choose: 0..1, which lamp and piece of it.
VX_HD bool sample_emitter(const SceneView& s, Place at, Vec3 normal, float choose, Vec2 u, EmitterSample& out) {
    float chance;
    const u32 emitter = choose_emitter(s.lights, light_place(s.lights, at), normal, choose, chance);
    return sample_chosen(s, at, normal, emitter, choose, chance, u, out);
}

// Density of directions with which sample_emitter finds this hit from `at`. facing: geometric normal there.
VX_HD_CALL float emitter_pdf(const SceneView& s, Place at, Vec3 normal, Vec3 dir, const Hit& hit, Vec3 facing) {
    if (hit.kind != HitKind::cube && hit.kind != HitKind::quad) return 0;
    const u32 emitter = find_emitter(s.lights, hit.cell);
    if (emitter == kNoEmitter || s.lights.emitters[emitter].state != hit.state) return 0;
    const EmitterView v = view_of_emitter(s, emitter, at, normal);
    u32 piece = hit.face;
    float area = 1;
    if (hit.kind == HitKind::quad) {
        if (hit.quad == kLiquidSurface) {
            if (hit.leaving) return 0;
            piece = 3;
            area = 1 / (facing.y > 0.01f ? facing.y : 0.01f);
        } else {
            piece = 6 + hit.quad - v.state->first_quad;
            if (piece < 6 || piece >= piece_end(v)) return 0;
            area = shining_area(s.quads[hit.quad]);
        }
    }
    const float weight = weight_of_piece(s, v, piece);
    if (!(weight > 0)) return 0;
    const float chance = chance_of_emitter(s.lights, emitter, light_place(s.lights, at), normal);
    const float share = chance * weight / weight_of_pieces(s, v);
    if (hit.kind == HitKind::cube) {
        const SphericalRect rect = rect_of_face(piece, v.q);
        if (rect.solid_angle > 0) return share / rect.solid_angle;
    }
    const float cosine = std::fabs(dot(dir, facing));
    return cosine > 1e-6f ? share * hit.t * hit.t / (cosine * area) : 0;
}

} // namespace vitrail::trace
