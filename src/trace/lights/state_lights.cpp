#include "trace/lights/state_lights.h"

#include "math/color.h"

#include <algorithm>
#include <optional>

namespace vitrail::trace {

namespace {

// Means of the emission texels of whole layers, each worked out once.
class LayerMeans {
public:
    explicit LayerMeans(const TextureView& textures)
        : textures_(textures)
        , means_(textures.layers) {}
    float mean(u32 layer) {
        if (!textures_.material || layer >= textures_.layers) return 0;
        if (!means_[layer]) {
            const u32 texels = 1u << (2 * textures_.size_bits);
            u64 sum = 0;
            for (u32 i = 0; i < texels; ++i)
                sum += texel(layer, i);
            means_[layer] = float(double(sum) / (255.0 * texels));
        }
        return *means_[layer];
    }
    // Of a quad: a grid of places on it.
    float mean(const TraceQuad& q) const {
        if (!textures_.material || q.texture >= textures_.layers) return 0;
        static constexpr u32 kGrid = 16;
        const u32 side = 1u << textures_.size_bits;
        u64 sum = 0;
        for (u32 i = 0; i < kGrid * kGrid; ++i) {
            const float a = (float(i % kGrid) + 0.5f) / kGrid, b = (float(i / kGrid) + 0.5f) / kGrid;
            const float u = q.u0 + a * q.ua + b * q.ub, v = q.v0 + a * q.va + b * q.vb;
            const u32 x = u32(clamp((u - std::floor(u)) * float(side), 0, float(side - 1))),
                      y = u32(clamp((v - std::floor(v)) * float(side), 0, float(side - 1)));
            sum += texel(q.texture, x + y * side);
        }
        return float(sum) / (255.0f * kGrid * kGrid);
    }

private:
    u32 texel(u32 layer, u32 i) const {
        return textures_.material[std::size_t(layer) * textures_.layer_words + i] >> 24;
    }
    TextureView textures_;
    std::vector<std::optional<float>> means_;
};

void add_quads(StateLight& out, const StateRecord& s, const SceneView& scene, float luminance,
               const LayerMeans& means) {
    for (u32 i = s.first_quad; i < s.first_quad + s.quads; ++i) {
        const TraceQuad& q = scene.quads[i];
        const bool both = q.look & TraceQuad::kTwoSided, triangle = q.look & TraceQuad::kTriangle;
        const float area = length(cross(q.edge_a, q.edge_b)) * (triangle ? 0.5f : 1.0f);
        const float power = luminance * q.emission_scale * area * means.mean(q);
        if (!(power > 0)) continue;
        const float sides[2] = {1, both ? 1.0f : 0.0f};
        const float n[3] = {q.normal.x, q.normal.y, q.normal.z};
        for (int a = 0; a < 3; ++a)
            for (int side = 0; side < 2; ++side) {
                const float c = side ? -n[a] : n[a];
                out.quad_shares[2 * a + (c > 0)] += power * sides[side] * std::abs(c);
            }
        for (int c = 0; c < 4; ++c) {
            const Vec3 p = q.corner + q.edge_a * float(c & 1) + q.edge_b * float(c >> 1);
            if (out.quad_power == 0 && c == 0) out.quad_least = out.quad_most = p;
            out.quad_least = {std::min(out.quad_least.x, p.x), std::min(out.quad_least.y, p.y),
                              std::min(out.quad_least.z, p.z)};
            out.quad_most = {std::max(out.quad_most.x, p.x), std::max(out.quad_most.y, p.y),
                             std::max(out.quad_most.z, p.z)};
        }
        out.quad_power += power * (both ? 2.0f : 1.0f);
    }
    for (float& share : out.quad_shares)
        share = out.quad_power > 0 ? share / out.quad_power : 0;
}

} // namespace

std::vector<StateLight> make_state_lights(const SceneView& scene, u32 quad_count) {
    std::vector<StateLight> lights(scene.state_count);
    LayerMeans means(scene.textures);
    for (u32 i = 0; i < scene.state_count; ++i) {
        const StateRecord& s = scene.states[i];
        StateLight& out = lights[i];
        out.hides = s.kind == CellKind::cube || s.kind == CellKind::detailed;
        out.joins = s.kind == CellKind::medium;
        out.fluid = s.medium;
        out.liquid = s.kind == CellKind::liquid;
        if (out.liquid) out.top = float(s.liquid_height + 1) / 256;
        const float luminance =
            luminance_of(float(s.emission[0]), float(s.emission[1]), float(s.emission[2])) * StateRecord::kEmissionUnit;
        if (!(luminance > 0)) continue;
        if (s.kind != CellKind::model && s.kind != CellKind::empty) {
            for (int f = 0; f < 6; ++f) {
                u32 look = u32(f);
                if (s.kind == CellKind::liquid) look = f == 2 || f == 3 ? 3 : 4; // still; flow on the sides
                const float area = s.kind == CellKind::liquid && f != 2 && f != 3 ? out.top : 1;
                out.face_power[f] = luminance * area * means.mean(u32(s.faces[look] >> 32 & 0xFFFF));
                out.emits |= out.face_power[f] > 0;
            }
        }
        if ((s.kind == CellKind::model || s.kind == CellKind::detailed) && s.first_quad + s.quads <= quad_count) {
            add_quads(out, s, scene, luminance, means);
            out.emits |= out.quad_power > 0;
        }
    }
    return lights;
}

} // namespace vitrail::trace
