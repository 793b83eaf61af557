#include "scene/pack_bake.h"

#include "math/angle.h"
#include "scene/model_builder.h"

#include <algorithm>
#include <cmath>

namespace vitrail::scene {

namespace {

using Point = std::array<float, 3>;

Point operator-(Point a, float b) {
    return {a[0] - b, a[1] - b, a[2] - b};
}

// As Minecraft turns models: x degrees first, from up over north; then y, from north over east. About the origin;
// quarters, so exact.
Point turned(Point p, u32 x_quarters, u32 y_quarters) {
    for (u32 i = 0; i < x_quarters; ++i)
        p = {p[0], p[2], -p[1]};
    for (u32 i = 0; i < y_quarters; ++i)
        p = {-p[2], p[1], p[0]};
    return p;
}

Point as_point(IVec3 v) {
    return {float(v.x), float(v.y), float(v.z)};
}

Face face_of(Point direction) {
    u32 best = 0;
    float most = -2;
    for (u32 f = 0; f < 6; ++f) {
        const Point n = as_point(kFaceNormal[f]);
        const float along = n[0] * direction[0] + n[1] * direction[1] + n[2] * direction[2];
        if (along > most + 1e-4f) most = along, best = f;
    }
    return Face(best);
}

// A turn of `degrees` about an axis through the origin, right-handed, in Minecraft's sense.
Point rotated(Point p, u32 axis, float degrees, bool rescale, bool direction) {
    const float a = degrees * kRadiansADegree, s = std::sin(a), c = std::cos(a);
    const u32 u = (axis + 1) % 3, v = (axis + 2) % 3;
    const float pu = p[u], pv = p[v];
    p[u] = pu * c - pv * s, p[v] = pu * s + pv * c;
    if (rescale && !direction) { // the turned faces reach as far as before
        const float grow = 1 / std::max(std::max(std::fabs(c), std::fabs(s)), 0.5f);
        p[u] *= grow, p[v] *= grow;
    }
    return p;
}

i16 unit256(float sixteenths) {
    return i16(std::lround(std::clamp(sixteenths * 16.0f, -32000.0f, 32000.0f)));
}

float along(IVec3 axis, Point p) {
    const float v = float(axis.x) * p[0] + float(axis.y) * p[1] + float(axis.z) * p[2];
    return axis.x + axis.y + axis.z < 0 ? 16.0f + v : v;
}

// Corners of a box's face, counterclockwise from outside, from the picture's lower left.
std::array<Point, 4> corners_of(const ModelElementJson& e, u32 face) {
    const IVec3 n = kFaceNormal[face], r = texture_right(Face(face)), d = texture_down(Face(face));
    const i32 nn[3] = {n.x, n.y, n.z}, nr[3] = {r.x, r.y, r.z}, nd[3] = {d.x, d.y, d.z};
    std::array<Point, 4> out{};
    for (u32 i = 0; i < 4; ++i) {
        const bool right = i == 1 || i == 2, up = i >= 2;
        for (u32 a = 0; a < 3; ++a) {
            if (nn[a] != 0)
                out[i][a] = nn[a] > 0 ? e.to[a] : e.from[a];
            else if (nr[a] != 0)
                out[i][a] = (nr[a] > 0) == right ? e.to[a] : e.from[a];
            else
                out[i][a] = (nd[a] > 0) == up ? e.from[a] : e.to[a];
        }
    }
    return out;
}

// The layer that a quad filling its face is.
PackFace::Layer layer_of(const PackQuad& q) {
    // uv at the face's upright corners: 0 lower left, 1 lower right, 2 upper right, 3 upper left.
    std::array<Vec2, 4> uv{};
    const IVec3 r = texture_right(q.facing), d = texture_down(q.facing);
    for (u32 i = 0; i < 4; ++i) {
        const ModelQuad::Corner& c = q.geometry.corners[i];
        const Point p{float(c.x) / 16, float(c.y) / 16, float(c.z) / 16};
        const bool right = along(r, p) > 8, down = along(d, p) > 8;
        uv[right ? (down ? 1u : 2u) : (down ? 0u : 3u)] = {float(c.s) / 16, float(q.geometry.t[i]) / 16};
    }
    PackFace::Layer layer;
    layer.texture = q.texture, layer.tint = q.tint;
    // Undo k clockwise quarter turns until s runs along the face; of the two k prefer the one that mirrors nothing.
    for (u32 k = 0; k < 4; ++k) {
        const Vec2 lower_left = uv[(0 + 4 - k) % 4], lower_right = uv[(1 + 4 - k) % 4],
                   upper_right = uv[(2 + 4 - k) % 4], upper_left = uv[(3 + 4 - k) % 4];
        if (upper_left.x != lower_left.x || upper_right.x != lower_right.x || upper_left.y != upper_right.y ||
            lower_left.y != lower_right.y)
            continue;
        const std::array<float, 4> rect{upper_left.x, upper_left.y, lower_right.x, lower_right.y};
        layer.uv = rect, layer.turns = u8(k);
        if (rect[1] <= rect[3]) break;
    }
    return layer;
}

bool fills_face(const PackQuad& q) {
    const IVec3 n = kFaceNormal[u32(q.facing)];
    const i32 depth = n.x + n.y + n.z > 0 ? kModelUnit : 0;
    u32 seen = 0;
    for (const ModelQuad::Corner& c : q.geometry.corners) {
        const i32 p[3] = {c.x, c.y, c.z};
        const i32 nn[3] = {n.x, n.y, n.z};
        u32 which = 0, bit = 0;
        for (u32 a = 0; a < 3; ++a) {
            if (nn[a] != 0) {
                if (p[a] != depth) return false;
                continue;
            }
            if (p[a] != 0 && p[a] != kModelUnit) return false;
            which |= u32(p[a] == kModelUnit) << bit++;
        }
        seen |= 1u << which;
    }
    return seen == 15;
}

} // namespace

BakedModel bake_model(const ResolvedModel& model, const ModelVariantJson& variant,
                      const std::function<TextureId(const std::string&)>& texture) {
    BakedModel out;
    const u32 x_quarters = variant.x / 90 % 4, y_quarters = variant.y / 90 % 4;
    for (const ModelElementJson& element : model.elements)
        for (u32 f = 0; f < 6; ++f) {
            if (!element.faces[f]) continue;
            const ModelFaceJson& face = *element.faces[f];
            PackQuad q;
            q.tint = face.tint;
            q.texture = texture(face.texture);
            if (!element.shade) q.geometry.flags = ModelQuad::kUnshaded;

            const std::array<Point, 4> corners = corners_of(element, f);
            std::array<Vec2, 4> uv{};
            for (u32 i = 0; i < 4; ++i) {
                if (!face.uv) {
                    uv[i] = {along(texture_right(Face(f)), corners[i]), along(texture_down(Face(f)), corners[i])};
                    continue;
                }
                const auto& r = *face.uv;
                const bool right = i == 1 || i == 2, up = i >= 2;
                uv[i] = {right ? r[2] : r[0], up ? r[1] : r[3]};
            }
            // A clockwise turn of the picture: the upper left corner (3) shows what the lower left (0) did.
            std::rotate(uv.begin(), uv.begin() + face.turns, uv.end());

            Point normal = as_point(kFaceNormal[f]);
            const auto place = [&](Point p, bool direction) {
                if (element.rotation) {
                    const auto& r = *element.rotation;
                    if (!direction)
                        for (u32 a = 0; a < 3; ++a)
                            p[a] -= r.origin[a];
                    p = rotated(p, r.axis, r.degrees, r.rescale, direction);
                    if (!direction)
                        for (u32 a = 0; a < 3; ++a)
                            p[a] += r.origin[a];
                }
                if (direction) return turned(p, x_quarters, y_quarters);
                return turned(p - 8, x_quarters, y_quarters) - -8;
            };
            normal = place(normal, true);
            q.facing = face_of(normal);
            for (u32 a = 0; a < 3; ++a)
                q.geometry.normal[a] = i8(std::lround(std::clamp(normal[a], -1.0f, 1.0f) * 127));

            if (variant.uv_lock && (x_quarters || y_quarters)) {
                // The picture stays with the world: its coordinates turn about the face's middle as the block does.
                const Face to = face_of(turned(as_point(kFaceNormal[f]), x_quarters, y_quarters));
                const Point right = turned(as_point(texture_right(Face(f))), x_quarters, y_quarters);
                const Point down = turned(as_point(texture_down(Face(f))), x_quarters, y_quarters);
                const Point to_right = as_point(texture_right(to)), to_down = as_point(texture_down(to));
                const auto dot3 = [](Point a, Point b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; };
                for (Vec2& v : uv) {
                    const float s = v.x - 8, t = v.y - 8;
                    v = {8 + s * dot3(right, to_right) + t * dot3(down, to_right),
                         8 + s * dot3(right, to_down) + t * dot3(down, to_down)};
                }
            }
            for (u32 i = 0; i < 4; ++i) {
                const Point p = place(corners[i], false);
                q.geometry.corners[i] = {unit256(p[0]), unit256(p[1]), unit256(p[2]), unit256(uv[i].x)};
                q.geometry.t[i] = unit256(uv[i].y);
                for (const float v : p)
                    q.outside |= v < -1e-3f || v > 16 + 1e-3f;
            }
            const auto& g = q.geometry.corners;
            // Flat elements have faces without a width.
            const auto same = [](const ModelQuad::Corner& a, const ModelQuad::Corner& b) {
                return a.x == b.x && a.y == b.y && a.z == b.z;
            };
            if (same(g[0], g[1]) || same(g[1], g[2])) continue;
            if (face.cull < 6) q.cull = u8(face_of(turned(as_point(kFaceNormal[face.cull]), x_quarters, y_quarters)));
            q.fills_face = !element.rotation && fills_face(q);
            out.quads.push_back(q);
        }

    std::array<PackFace, 6> faces;
    bool full = true, only = true;
    for (const PackQuad& q : out.quads) {
        if (q.fills_face) faces[u32(q.facing)].layers.push_back(layer_of(q));
        only &= q.fills_face;
    }
    for (const PackFace& face : faces)
        full &= !face.layers.empty() && face.layers.size() <= 4;
    if (full) out.cube = faces, out.only_cube = only;

    // Quads in one plane would fight: each later one is lifted by a hair.
    if (out.quads.size() <= 256)
        for (std::size_t i = 1; i < out.quads.size(); ++i) {
            ModelQuad& a = out.quads[i].geometry;
            u32 below = 0;
            for (std::size_t j = 0; j < i; ++j) {
                const PackQuad& b = out.quads[j];
                if (b.facing != out.quads[i].facing || b.geometry.normal != a.normal) continue;
                const auto key = [](const ModelQuad::Corner& c) { return std::array<i16, 3>{c.x, c.y, c.z}; };
                std::array<std::array<i16, 3>, 4> ka{}, kb{};
                for (u32 c = 0; c < 4; ++c)
                    ka[c] = key(a.corners[c]), kb[c] = key(b.geometry.corners[c]);
                std::sort(ka.begin(), ka.end()), std::sort(kb.begin(), kb.end());
                below += ka == kb;
            }
            for (u32 c = 0; c < 4 && below; ++c) {
                a.corners[c].x = i16(a.corners[c].x + a.normal[0] * i32(below) / 127);
                a.corners[c].y = i16(a.corners[c].y + a.normal[1] * i32(below) / 127);
                a.corners[c].z = i16(a.corners[c].z + a.normal[2] * i32(below) / 127);
            }
        }
    return out;
}

} // namespace vitrail::scene
