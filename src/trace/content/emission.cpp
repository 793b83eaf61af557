#include "trace/content/emission.h"

#include "math/color.h"
#include "scene/lamp_light.h"
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

Vec3 wall_middle(u32 face, float distance) {
    return Vec3{0.5f, 0.5f, 0.5f} + axis_of(face) * distance;
}

} // namespace

std::array<Vec3, 6> wall_returns(std::span<const TraceQuad> pieces, Vec3 emission, const TextureView& textures,
                                 const u32* fixed_tints, float distance) {
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
                const Vec3 axis = axis_of(f), way = wall_middle(f, distance) - place;
                const float d2 = dot(way, way), facing = dot(way, q.normal);
                const float leaves = q.look & TraceQuad::kTwoSided ? std::fabs(facing) : facing;
                if (leaves <= 0) continue;
                if (seen[f][part] < 0)
                    seen[f][part] = !std::any_of(pieces.begin(), pieces.end(), [&](const TraceQuad& other) {
                        return &other != &q && blocks(other, textures, place, wall_middle(f, distance));
                    });
                if (seen[f][part]) sums[f] += radiance * emission * (leaves * dot(way, axis) * area / (kPi * d2 * d2));
            }
        });
    }
    return sums;
}

Vec3 lamp_emission(const std::array<u8, 3>& levels, std::span<const TraceQuad> pieces, const TextureView& textures,
                   const u32* fixed_tints, bool alike) {
    const u32 strongest = std::max({levels[0], levels[1], levels[2]});
    const std::array<Vec3, 6> plain =
        wall_returns(pieces, {1, 1, 1}, textures, fixed_tints, scene::lamp_distance(float(strongest)));
    const Vec3 seen =
        *std::max_element(plain.begin(), plain.end(), [](Vec3 a, Vec3 b) { return luminance_of(a) < luminance_of(b); });
    if (luminance_of(seen) <= 0) return {};

    // The light's hue: between that of its levels at the wall and that of what shines.
    const float lost = scene::lamp_distance(float(strongest)) - 0.5f;
    const auto there = [&](u8 level) { return std::max(float(level) - lost, 0.0f) / scene::kLevelMost; };
    const auto pure = [](Vec3 v) { return v * (1 / std::max({v.x, v.y, v.z, 1e-6f})); };
    const Vec3 told =
        strongest > 1 ? pure(scene::lamp_light({there(levels[0]), there(levels[1]), there(levels[2])})) : Vec3{1, 1, 1};
    const Vec3 painted = pure(seen), hue = (told + painted) * 0.5f;
    // Where a picture lacks a color, no strength brings it back.
    const auto gain = [](float wanted, float found) { return wanted / std::max(found, 0.05f); };
    Vec3 out{gain(hue.x, painted.x), gain(hue.y, painted.y), gain(hue.z, painted.z)};
    out = out * (scene::lamp_return(float(strongest)) / (luminance_of(seen * out) * (alike ? kAlike : 1.0f)));

    float brightest = 0;
    for (const TraceQuad& q : pieces)
        each_place(q, textures, fixed_tints, [&](Vec3, float, float, Vec3 radiance, float) {
            brightest = std::max(brightest, luminance_of(radiance * out));
        });
    const float held = std::min(kRadianceMost / std::max(brightest, 1e-6f),
                                kEmissionMost / std::max({out.x, out.y, out.z})); // hues stay
    return held < 1 ? out * held : out;
}

void set_shining_part(TraceQuad& piece, const TextureView& textures, const u32* fixed_tints, bool moves) {
    float least_a = 1, most_a = 0, least_b = 1, most_b = 0, sum = 0;
    each_place(piece, textures, fixed_tints, [&](Vec3, float a, float b, Vec3 light, float) {
        least_a = std::min(least_a, a), most_a = std::max(most_a, a);
        least_b = std::min(least_b, b), most_b = std::max(most_b, b);
        sum += luminance_of(light);
    });
    piece.shine = piece.emission_scale > 0 ? sum / (piece.emission_scale * kGrid * kGrid) : 0;
    piece.shining_part = TraceQuad{}.shining_part;
    if (moves || !(sum > 0)) return;
    // A texel reaches less than a place beyond those of its middles that were looked at.
    constexpr float kReach = 1.5f / kGrid;
    const auto down = [](float v) { return u32(std::floor(clamp(v - kReach, 0, 1) * 255)); };
    const auto up = [](float v) { return u32(std::ceil(clamp(v + kReach, 0, 1) * 255)); };
    piece.shining_part = down(least_a) | up(most_a) << 8 | down(least_b) << 16 | up(most_b) << 24;
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
