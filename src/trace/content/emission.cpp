#include "trace/content/emission.h"

#include "math/color.h"
#include "trace/kernel/texture.h"
#include "world/block_def.h"

#include <algorithm>
#include <cmath>

namespace vitrail::trace {

namespace {

constexpr float kPi = 3.14159265f;
constexpr u32 kGrid = 32; // places along each edge of a piece: every texel of content's pictures

Vec3 axis_of(u32 face) {
    const float side = face & 1 ? 1.0f : -1.0f;
    return {face >> 1 == 0 ? side : 0, face >> 1 == 1 ? side : 0, face >> 1 == 2 ? side : 0};
}

// Calls use(place, a, b, albedo x channel, area) for each place of a piece that shines.
template <class Use>
void each_place(const TraceQuad& q, const TextureView& textures, const u32* fixed_tints, Use&& use) {
    const bool triangle = q.look & TraceQuad::kTriangle;
    const float area = length(cross(q.edge_a, q.edge_b)) / (kGrid * kGrid);
    // Biomes color no lamps.
    const Vec3 tint = (q.look & 7) == u32(TintKind::fixed) ? color_of(fixed_tints[q.look >> 8 & 255]) : Vec3{1, 1, 1};
    for (u32 i = 0; i < kGrid * kGrid; ++i) {
        const float a = (float(i % kGrid) + 0.5f) / kGrid, b = (float(i / kGrid) + 0.5f) / kGrid;
        // The diagonal's places belong half to the triangle.
        const float share = !triangle || a + b < 0.999f ? 1.0f : a + b < 1.001f ? 0.5f : 0.0f;
        const u32 at = texel_index(textures, q.texture, quad_uv(q, a, b));
        const float channel = alpha_of(textures.material[at]);
        if (share == 0 || channel == 0 || (q.look & TraceQuad::kCutout && is_hole(textures.albedo[at]))) continue;
        const Vec3 albedo = linear_from_srgb(color_of(textures.albedo[at]) * tint);
        use(q.corner + q.edge_a * a + q.edge_b * b, a, b, albedo * (channel * q.emission_scale), area * share);
    }
}

} // namespace

float lamp_return(u32 level) {
    const auto law = [](float s) { return s * (0.16f + 1.24f * s); };
    return level == 0 ? 0 : law(std::max(float(level) - 1, 0.5f) / 15) / law(14.0f / 15);
}

namespace {

// Does the quad stand between the two places, both off its plane?
bool blocks(const TraceQuad& q, const TextureView& textures, Vec3 from, Vec3 to) {
    const Vec3 way = to - from;
    const float facing = dot(way, q.normal);
    if (facing == 0 || (facing > 0 && !(q.look & TraceQuad::kTwoSided))) return false; // seen from behind
    const float t = dot(q.corner - from, q.normal) / facing;
    if (t <= 1e-4f || t >= 1 - 1e-4f) return false;
    const Vec3 p = from + way * t - q.corner;
    const float aa = dot(q.edge_a, q.edge_a), ab = dot(q.edge_a, q.edge_b), bb = dot(q.edge_b, q.edge_b),
                pa = dot(p, q.edge_a), pb = dot(p, q.edge_b), det = aa * bb - ab * ab;
    const float a = (pa * bb - pb * ab) / det, b = (pb * aa - pa * ab) / det;
    if (a < 0 || b < 0 || (q.look & TraceQuad::kTriangle ? a + b > 1 : a > 1 || b > 1)) return false;
    const auto optics = Optics(q.look >> 16 & 15);
    if (optics == Optics::thin || optics == Optics::dielectric) return false;
    return !(q.look & TraceQuad::kCutout && hole_at(textures, q.texture, quad_uv(q, a, b)));
}

Vec3 wall_middle(u32 face) {
    return Vec3{0.5f, 0.5f, 0.5f} + axis_of(face) * 1.5f;
}

} // namespace

std::array<Vec3, 6> wall_returns(std::span<const TraceQuad> pieces, Vec3 emission, const TextureView& textures,
                                 const u32* fixed_tints) {
    std::array<Vec3, 6> sums{};
    for (const TraceQuad& q : pieces) {
        if (!textures.material || q.emission_scale == 0) continue;
        // Parts of a lamp may stand before each other; found for 8 x 8 parts of a piece, where something shines.
        constexpr u32 kParts = 8;
        std::array<std::array<i8, kParts * kParts>, 6> seen;
        for (auto& side : seen)
            side.fill(-1);
        each_place(q, textures, fixed_tints, [&](Vec3 place, float a, float b, Vec3 radiance, float area) {
            const u32 part = u32(a * kParts) + u32(b * kParts) * kParts;
            for (u32 f = 0; f < 6; ++f) {
                const Vec3 axis = axis_of(f), way = wall_middle(f) - place;
                const float d2 = dot(way, way), facing = dot(way, q.normal);
                const float leaves = q.look & TraceQuad::kTwoSided ? std::fabs(facing) : facing;
                if (leaves <= 0) continue;
                if (seen[f][part] < 0)
                    seen[f][part] = !std::any_of(pieces.begin(), pieces.end(), [&](const TraceQuad& other) {
                        return &other != &q && blocks(other, textures, place, wall_middle(f));
                    });
                if (seen[f][part]) sums[f] += radiance * emission * (leaves * dot(way, axis) * area / (kPi * d2 * d2));
            }
        });
    }
    return sums;
}

Vec3 lamp_emission(const std::array<u8, 3>& levels, std::span<const TraceQuad> pieces, const TextureView& textures,
                   const u32* fixed_tints, float radiance_most) {
    const u32 strongest = std::max({levels[0], levels[1], levels[2]});
    const std::array<Vec3, 6> plain = wall_returns(pieces, {1, 1, 1}, textures, fixed_tints);
    const Vec3 seen =
        *std::max_element(plain.begin(), plain.end(), [](Vec3 a, Vec3 b) { return luminance_of(a) < luminance_of(b); });
    if (luminance_of(seen) <= 0) return {};

    // The light's hue: between that of its levels (warmed as shade.glsl warms them) and that of what shines.
    const float by_level = 1 / float(strongest);
    const Vec3 told = Vec3{1.10f * float(levels[0]), 0.97f * float(levels[1]), 0.84f * float(levels[2])} * by_level;
    const Vec3 painted = seen * (1 / std::max({seen.x, seen.y, seen.z}));
    const Vec3 hue = (told + painted) * 0.5f;
    // Where a picture lacks a color, no strength brings it back.
    const auto gain = [](float wanted, float there) { return wanted / std::max(there, 0.2f); };
    Vec3 out{gain(hue.x, painted.x), gain(hue.y, painted.y), gain(hue.z, painted.z)};
    out = out * (lamp_return(strongest) / luminance_of(seen * out));

    float brightest = 0;
    for (const TraceQuad& q : pieces)
        each_place(q, textures, fixed_tints, [&](Vec3, float, float, Vec3 radiance, float) {
            brightest = std::max(brightest, luminance_of(radiance * out));
        });
    return brightest > radiance_most ? out * (radiance_most / brightest) : out;
}

TraceQuad quad_of_face(u64 look) {
    const u32 face = look_face(look), axis = face >> 1;
    const float plane = face & 1 ? 1.0f : 0.0f;
    TraceQuad q;
    q.texture = look_texture(look);
    q.look = look_tint(look) | look_fixed_tint(look) << 8;
    q.normal = axis_of(face);
    q.corner = q.normal * plane;
    q.edge_a = axis == 0 ? Vec3{0, 1, 0} : axis == 1 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
    q.edge_b = axis == 0 ? Vec3{0, 0, 1} : axis == 1 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    const Vec2 at = face_uv(look, q.corner), a = face_uv(look, q.corner + q.edge_a),
               b = face_uv(look, q.corner + q.edge_b);
    q.u0 = at.x, q.v0 = at.y;
    q.ua = a.x - at.x, q.va = a.y - at.y;
    q.ub = b.x - at.x, q.vb = b.y - at.y;
    return q;
}

} // namespace vitrail::trace
