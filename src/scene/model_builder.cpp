#include "scene/model_builder.h"

#include "math/angle.h"

#include <algorithm>
#include <cmath>

namespace vitrail::scene {

namespace {

constexpr IVec3 kRight[6] = {{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {1, 0, 0}, {-1, 0, 0}, {1, 0, 0}};
constexpr IVec3 kDown[6] = {{0, -1, 0}, {0, -1, 0}, {0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {0, -1, 0}};

i16 unit256(float sixteenths) {
    return i16(std::lround(std::clamp(sixteenths * 16.0f, -8192.0f, 8192.0f)));
}

// Coordinate in 0..16 along a signed axis: 16 - v where the axis points down.
float along(IVec3 axis, float x, float y, float z) {
    const float v = float(axis.x) * x + float(axis.y) * y + float(axis.z) * z;
    return axis.x + axis.y + axis.z < 0 ? 16.0f + v : v;
}

Face nearest_face(float x, float y, float z) {
    const float ax = std::fabs(x), ay = std::fabs(y), az = std::fabs(z);
    if (ay >= ax && ay >= az) return y < 0 ? Face::down : Face::up;
    if (ax >= az) return x < 0 ? Face::west : Face::east;
    return z < 0 ? Face::north : Face::south;
}

} // namespace

IVec3 texture_right(Face face) {
    return kRight[u32(face)];
}
IVec3 texture_down(Face face) {
    return kDown[u32(face)];
}

u32 turns_towards(Face face, IVec3 up) {
    const IVec3 r = kRight[u32(face)], d = kDown[u32(face)];
    const auto dot3 = [](IVec3 a, IVec3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    if (dot3(up, d) < 0) return 0;
    if (dot3(up, r) > 0) return 1;
    if (dot3(up, d) > 0) return 2;
    return dot3(up, r) < 0 ? 3 : 0;
}

void ModelBuilder::tilt(float degrees, float y, float z) {
    tilt_ = degrees;
    tilt_y_ = y;
    tilt_z_ = z;
}

void ModelBuilder::reset() {
    const std::array<TextureId, 6> keep = faces_;
    std::vector<BuiltQuad> quads = std::move(quads_);
    *this = ModelBuilder();
    faces_ = keep;
    quads_ = std::move(quads);
}

ModelBuilder::Point ModelBuilder::place(Point p, bool direction) const {
    const float c = direction ? 0.0f : 8.0f; // turns are about the middle; directions have none
    if (tilt_ != 0) {
        const float a = tilt_ * kRadiansADegree, s = std::sin(a), k = std::cos(a);
        const float cy = direction ? 0 : tilt_y_, cz = direction ? 0 : tilt_z_;
        const float y = p.y - cy, z = p.z - cz;
        p.y = cy + y * k + z * s;
        p.z = cz - y * s + z * k;
    }
    if (mount_ == Mount::wall)
        p = {p.x, c + (p.z - c), c - (p.y - c)};
    else if (mount_ == Mount::ceiling)
        p = {p.x, c - (p.y - c), c - (p.z - c)};
    if (turn_ != 0) {
        const float x = p.x - c, z = p.z - c;
        const int whole = int(turn_);
        if (float(whole) == turn_) { // exact
            Point q{x, p.y, z};
            for (int i = 0; i < (whole & 3); ++i)
                q = {-q.z, q.y, q.x};
            p = {c + q.x, q.y, c + q.z};
        } else {
            const float a = turn_ * 1.57079633f, s = std::sin(a), k = std::cos(a);
            p = {c + x * k - z * s, p.y, c + x * s + z * k};
        }
    }
    return p;
}

void ModelBuilder::emit(const std::array<Point, 4>& corners, Point normal, const std::array<Vec2, 4>& model_uv,
                        TextureId texture, u8 flags) {
    BuiltQuad q;
    const Point n = place(normal, true);
    q.facing = nearest_face(n.x, n.y, n.z);
    q.texture = texture;
    q.geometry.normal = {i8(std::lround(n.x * 127)), i8(std::lround(n.y * 127)), i8(std::lround(n.z * 127))};
    q.geometry.flags = flags;
    const bool straight = std::fabs(std::fabs(n.x) + std::fabs(n.y) + std::fabs(n.z) - 1.0f) < 1e-3f;
    const bool lock = !follow_model_ && straight;
    bool on_border = straight;
    for (u32 i = 0; i < 4; ++i) {
        const Point p = place(corners[i], false);
        Vec2 uv = model_uv[i];
        if (lock)
            uv = {along(texture_right(q.facing), p.x, p.y, p.z), along(texture_down(q.facing), p.x, p.y, p.z)};
        else if (mirror_)
            uv.x = 16 - uv.x;
        q.geometry.corners[i] = {unit256(p.x), unit256(p.y), unit256(p.z), unit256(uv.x)};
        q.geometry.t[i] = unit256(uv.y);
        const IVec3 f = kFaceNormal[u32(q.facing)];
        const float depth = float(f.x) * p.x + float(f.y) * p.y + float(f.z) * p.z;
        on_border &= std::fabs(depth - (f.x + f.y + f.z > 0 ? 16.0f : 0.0f)) < 1e-3f;
    }
    // A quad in the plane of the cell's face is hidden by an opaque cube there; it must also lie inside the cell.
    if (on_border) {
        for (const ModelQuad::Corner& corner : q.geometry.corners)
            on_border &=
                std::min({corner.x, corner.y, corner.z}) >= 0 && std::max({corner.x, corner.y, corner.z}) <= kModelUnit;
        if (on_border) q.cull = u8(q.facing);
    }
    quads_.push_back(q);
}

void ModelBuilder::box(const Span3& b, u32 faces) {
    const bool flat[3] = {b.x0 == b.x1, b.y0 == b.y1, b.z0 == b.z1};
    const bool any_flat = flat[0] || flat[1] || flat[2];
    for (u32 f = 0; f < 6; ++f) {
        if (!(faces >> f & 1)) continue;
        if (any_flat && (!flat[f >> 1] || (f & 1) == 0)) continue; // one quad, facing the growing side
        const IVec3 n = kFaceNormal[f], r = kRight[f], d = kDown[f];
        const float lo[3] = {b.x0, b.y0, b.z0}, hi[3] = {b.x1, b.y1, b.z1};
        const int nr[3] = {r.x, r.y, r.z}, nd[3] = {d.x, d.y, d.z}, nn[3] = {n.x, n.y, n.z};
        // Counterclockwise from outside, starting at the picture's lower left.
        std::array<Point, 4> corners;
        std::array<Vec2, 4> uv;
        for (u32 i = 0; i < 4; ++i) {
            const bool right = i == 1 || i == 2, up = i >= 2;
            float p[3];
            for (int a = 0; a < 3; ++a) {
                if (nn[a] != 0)
                    p[a] = nn[a] > 0 ? hi[a] : lo[a];
                else if (nr[a] != 0)
                    p[a] = (nr[a] > 0) == right ? hi[a] : lo[a];
                else
                    p[a] = (nd[a] > 0) == up ? lo[a] : hi[a];
            }
            corners[i] = {p[0], p[1], p[2]};
            uv[i] = {along(r, p[0], p[1], p[2]), along(d, p[0], p[1], p[2])};
        }
        const Point normal{float(n.x), float(n.y), float(n.z)};
        const Point placed = place(normal, true);
        const u32 final_face = u32(nearest_face(placed.x, placed.y, placed.z));
        emit(corners, normal, uv, faces_[by_model_ ? f : final_face], any_flat ? ModelQuad::kTwoSided : u8(0));
    }
}

void ModelBuilder::box_with_uv(const Span3& b, Face face, const std::array<Vec2, 4>& uv) {
    box(b, face_bit(face));
    ModelQuad& g = quads_.back().geometry;
    for (u32 i = 0; i < 4; ++i) {
        g.corners[i].s = unit256(uv[i].x);
        g.t[i] = unit256(uv[i].y);
    }
}

void ModelBuilder::upright(float x0, float z0, float x1, float z1, float y0, float y1, bool unshaded, float s0,
                           float s1) {
    const float dx = x1 - x0, dz = z1 - z0, l = std::sqrt(dx * dx + dz * dz);
    const Point normal{-dz / l, 0, dx / l};
    const bool keep = follow_model_;
    follow_model_ = true;
    emit({Point{x0, y0, z0}, Point{x1, y0, z1}, Point{x1, y1, z1}, Point{x0, y1, z0}}, normal,
         {Vec2{s0, 16 - y0}, Vec2{s1, 16 - y0}, Vec2{s1, 16 - y1}, Vec2{s0, 16 - y1}}, faces_[2],
         u8(ModelQuad::kTwoSided | (unshaded ? ModelQuad::kUnshaded : 0)));
    follow_model_ = keep;
}

void ModelBuilder::sheet(float y_north, float y_south, const Span3& e) {
    const float rise = (y_south - y_north) / 16, l = std::sqrt(1 + rise * rise);
    const bool keep = follow_model_;
    follow_model_ = true;
    emit({Point{e.x0, y_south, e.z1}, Point{e.x1, y_south, e.z1}, Point{e.x1, y_north, e.z0},
          Point{e.x0, y_north, e.z0}},
         {0, 1 / l, -rise / l}, {Vec2{e.x0, e.z1}, Vec2{e.x1, e.z1}, Vec2{e.x1, e.z0}, Vec2{e.x0, e.z0}}, faces_[3],
         ModelQuad::kTwoSided);
    follow_model_ = keep;
}

void ModelBuilder::half_cells(u32 occupied) {
    const auto at = [&](int x, int y, int z) {
        return x >= 0 && x < 2 && y >= 0 && y < 2 && z >= 0 && z < 2 && (occupied >> (x | z << 1 | y << 2) & 1);
    };
    for (u32 f = 0; f < 6; ++f) {
        const int axis = int(f >> 1), ua = axis == 0 ? 2 : 0, va = axis == 1 ? 2 : 1;
        for (int layer = 0; layer < 2; ++layer) {
            const auto shown = [&](int u, int v) {
                int c[3];
                c[axis] = layer, c[ua] = u, c[va] = v;
                const IVec3 n = kFaceNormal[f];
                return at(c[0], c[1], c[2]) && !at(c[0] + n.x, c[1] + n.y, c[2] + n.z);
            };
            const auto add = [&](int u, int v, int w, int h) {
                float lo[3], hi[3];
                lo[axis] = float(layer * 8), hi[axis] = float(layer * 8 + 8);
                lo[ua] = float(u * 8), hi[ua] = float((u + w) * 8);
                lo[va] = float(v * 8), hi[va] = float((v + h) * 8);
                box({lo[0], lo[1], lo[2], hi[0], hi[1], hi[2]}, 1u << f);
            };
            const bool a = shown(0, 0), b = shown(1, 0), c = shown(0, 1), d = shown(1, 1);
            if (a && b && c && d)
                add(0, 0, 2, 2);
            else if (a && c && !(b && d)) {
                add(0, 0, 1, 2);
                if (b) add(1, 0, 1, 1);
                if (d) add(1, 1, 1, 1);
            } else if (b && d) {
                add(1, 0, 1, 2);
                if (a) add(0, 0, 1, 1);
                if (c) add(0, 1, 1, 1);
            } else {
                if (a || b) add(a ? 0 : 1, 0, a && b ? 2 : 1, 1);
                if (c || d) add(c ? 0 : 1, 1, c && d ? 2 : 1, 1);
            }
        }
    }
}

} // namespace vitrail::scene
