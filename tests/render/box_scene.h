// Unit blocks for tests of screen-space effects: each visible face is a quad of its own without the mesher's corner
// occlusion, and the same blocks answer rays on the CPU.
#pragma once

#include "render_fixture.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

namespace vitrail::render {

class BoxScene {
public:
    BlockRegistry registry;

    BoxScene() { registry.content_roots = {test_content()}; }
    // Coordinates from -kHalf to kHalf - 1.
    void set(i32 x, i32 y, i32 z, const char* texture) {
        blocks_[{x, y, z}] = texture;
        filled_[index(x, y, z)] = true;
    }
    void clear(i32 x, i32 y, i32 z) {
        blocks_.erase({x, y, z});
        filled_[index(x, y, z)] = false;
    }
    void fill(IVec3 from, IVec3 to, const char* texture) { // both ends belong to it
        for (i32 y = from.y; y <= to.y; ++y)
            for (i32 z = from.z; z <= to.z; ++z)
                for (i32 x = from.x; x <= to.x; ++x)
                    set(x, y, z, texture);
    }
    bool solid(i32 x, i32 y, i32 z) const { return inside(x, y, z) && filled_[index(x, y, z)]; }

    void give(Renderer& renderer) {
        std::map<std::array<i32, 3>, std::array<std::vector<Quad>, 6>> sections;
        for (const auto& [at, texture] : blocks_) {
            const auto [x, y, z] = at;
            for (u32 f = 0; f < 6; ++f) {
                const IVec3 n = kFaceNormal[f];
                if (solid(x + n.x, y + n.y, z + n.z)) continue;
                sections[{x >> 4, y >> 4, z >> 4}][f].push_back(Quad::cube(
                    {x & 15, y & 15, z & 15}, 1, 1, Face(f), 255, registry.texture_id(texture), TintKind::none, 0));
            }
        }
        EXPECT_TRUE(renderer.load_textures(registry));
        for (const auto& [at, faces] : sections) {
            SectionMesh mesh;
            for (u32 g = 0; g < SectionMesh::kGroups; ++g) {
                mesh.first[g] = u32(mesh.quads.size());
                for (u32 f = 0; f < 6; ++f)
                    if (SectionMesh::group(QuadPass::opaque, f) == g)
                        mesh.quads.insert(mesh.quads.end(), faces[f].begin(), faces[f].end());
            }
            mesh.first[SectionMesh::kGroups] = u32(mesh.quads.size());
            mesh.connections = (u64(1) << 36) - 1;
            renderer.set_section({at[0], at[1], at[2]}, DimensionId::overworld, mesh);
        }
    }

    struct Hit {
        float distance = 0;
        IVec3 normal{};
    };
    // The first block on a ray that starts outside all, by walking the grid (Amanatides and Woo 1987).
    std::optional<Hit> trace(Vec3 from, Vec3 direction, float far) const {
        const float o[3] = {from.x, from.y, from.z}, d[3] = {direction.x, direction.y, direction.z};
        i32 cell[3], step[3];
        float next[3], each[3];
        for (u32 k = 0; k < 3; ++k) {
            cell[k] = i32(std::floor(o[k]));
            step[k] = d[k] > 0 ? 1 : -1;
            each[k] = d[k] == 0 ? 1e30f : std::abs(1 / d[k]);
            next[k] = d[k] == 0 ? 1e30f : (float(cell[k] + (d[k] > 0)) - o[k]) / d[k];
        }
        for (;;) {
            const u32 k = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
            const float t = next[k];
            if (t > far) return std::nullopt;
            cell[k] += step[k];
            next[k] += each[k];
            if (!solid(cell[0], cell[1], cell[2])) continue;
            Hit hit{t, {}};
            (k == 0 ? hit.normal.x : k == 1 ? hit.normal.y : hit.normal.z) = -step[k];
            return hit;
        }
    }

private:
    static constexpr i32 kHalf = 48;
    static bool inside(i32 x, i32 y, i32 z) { return std::max({x, y, z}) < kHalf && std::min({x, y, z}) >= -kHalf; }
    static std::size_t index(i32 x, i32 y, i32 z) {
        return (std::size_t(y + kHalf) * 2 * kHalf + std::size_t(z + kHalf)) * 2 * kHalf + std::size_t(x + kHalf);
    }
    std::vector<bool> filled_ = std::vector<bool>(8 * kHalf * kHalf * kHalf);
    std::map<std::array<i32, 3>, const char*> blocks_;
};

// The ray of a pixel's middle, world directions, as the shaders have it.
inline Vec3 pixel_ray(const scene::FrameView& frame, u32 x, u32 y) {
    const scene::View& view = frame.views[0];
    const float t = std::tan(view.fov_y * 0.5f), aspect = float(frame.width) / float(frame.height);
    const float right = (2 * (float(x) + 0.5f) / float(frame.width) - 1) * t * aspect;
    const float up = (1 - 2 * (float(y) + 0.5f) / float(frame.height)) * t;
    const auto& m = view.rotation.m;
    return normalized(Vec3{m[0], m[4], m[8]} * right + Vec3{m[1], m[5], m[9]} * up - Vec3{m[2], m[6], m[10]});
}

} // namespace vitrail::render
