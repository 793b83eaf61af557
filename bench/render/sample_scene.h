// A seeded landscape for tests and benchmarks of the renderer alone: hills, a lake, trees, lamps, glass. It brings its
// own plain voxel grid, light flood and greedy mesher (slow and simple), so that it needs neither content nor world.
#pragma once

#include "base/rng.h"
#include "render/renderer.h"

#include <array>
#include <cmath>
#include <deque>
#include <string>
#include <vector>

namespace vitrail::bench {

class SampleScene {
public:
    enum Block : u8 { air, stone, dirt, grass, sand, water, log, leaves, glowstone, glass, planks, count };

    // radius in chunks around the origin; height 96 blocks from y = 0; the lake's surface lies at y = 40.
    explicit SampleScene(i32 radius_chunks, bool trees = true)
        : radius_(radius_chunks)
        , side_((2 * radius_chunks + 1) * 16) {
        registry.content_roots = {std::string(VITRAIL_SOURCE_DIR) + "/content/base"};
        cells_.resize(std::size_t(side_) * side_ * kHeight);
        light_.resize(cells_.size());
        for (i32 z = 0; z < side_; ++z)
            for (i32 x = 0; x < side_; ++x)
                fill_column(x, z);
        if (trees) plant();
        build_things();
    }
    BlockRegistry registry;

    i32 ground(i32 x, i32 z) const { // world coordinates
        for (i32 y = kHeight - 1; y > 0; --y) {
            const Block b = at(x, y, z);
            if (b != air && b != leaves && b != log) return y + 1;
        }
        return 0;
    }
    void set(i32 x, i32 y, i32 z, Block b) {
        const i32 gx = x + radius_ * 16, gz = z + radius_ * 16;
        if (gx >= 0 && gz >= 0 && gx < side_ && gz < side_ && y >= 0 && y < kHeight) cells_[index(gx, y, gz)] = b;
    }
    Block at(i32 x, i32 y, i32 z) const { return grid(x + radius_ * 16, y, z + radius_ * 16); }

    // Lights, meshes and hands every section to the renderer, moved by `base` chunks.
    void give(render::Renderer& renderer, ChunkPos base = {}) {
        flood();
        render::SectionMesh mesh;
        render::LightBrick brick;
        for (i32 cy = 0; cy < kHeight / 16; ++cy)
            for (i32 cz = 0; cz <= 2 * radius_; ++cz)
                for (i32 cx = 0; cx <= 2 * radius_; ++cx) {
                    mesh_section(cx, cy, cz, mesh);
                    const ChunkPos at{base.x + cx - radius_, base.y + cy, base.z + cz - radius_};
                    renderer.set_section(at, DimensionId::overworld, mesh);
                    if (mesh.empty()) continue;
                    make_brick(cx, cy, cz, brick);
                    renderer.set_section_light(at, DimensionId::overworld, brick);
                }
    }

    static scene::FrameView frame(u32 width, u32 height, WorldPos eye, float yaw_deg, float pitch_deg, i32 chunks);

private:
    static constexpr i32 kHeight = 96, kSea = 40;
    static constexpr float kDegree = 0.017453293f;

    std::size_t index(i32 x, i32 y, i32 z) const { return (std::size_t(y) * side_ + z) * side_ + x; }
    Block grid(i32 x, i32 y, i32 z) const {
        if (y < 0) return stone;
        if (y >= kHeight || x < 0 || z < 0 || x >= side_ || z >= side_) return air;
        return Block(cells_[index(x, y, z)]);
    }
    static bool opaque(Block b) { return b != air && b != water && b != leaves && b != glass; }

    static float noise(float x, float z, u32 octave) {
        const float ix = std::floor(x), iz = std::floor(z);
        float fx = x - ix, fz = z - iz;
        fx = fx * fx * (3 - 2 * fx), fz = fz * fz * (3 - 2 * fz);
        auto corner = [&](i32 dx, i32 dz) {
            return random_unit({.seed = 5, .purpose = octave}, i32(ix) + dx, 0, i32(iz) + dz);
        };
        return lerp(lerp(corner(0, 0), corner(1, 0), fx), lerp(corner(0, 1), corner(1, 1), fx), fz);
    }
    void fill_column(i32 gx, i32 gz) {
        const float x = float(gx - radius_ * 16), z = float(gz - radius_ * 16);
        float h = 0, amplitude = 26, scale = 1.0f / 96;
        for (u32 o = 0; o < 5; ++o, amplitude *= 0.48f, scale *= 2.1f)
            h += (noise(x * scale, z * scale, o) - 0.5f) * 2 * amplitude;
        const i32 top = std::clamp(i32(44 + h * 0.85f), 4, kHeight - 12);
        for (i32 y = 0; y <= top; ++y) {
            Block b = y < top - 3 ? stone : dirt;
            if (y == top)
                b = top <= kSea ? sand : top > 70 ? stone : grass;
            else if (y > top - 3 && top <= kSea)
                b = sand;
            cells_[index(gx, y, gz)] = b;
        }
        for (i32 y = top + 1; y <= kSea - 1; ++y)
            cells_[index(gx, y, gz)] = water;
    }
    void plant() {
        const i32 r = radius_ * 16;
        for (i32 z = -r + 3; z < r + 13; ++z)
            for (i32 x = -r + 3; x < r + 13; ++x) {
                if (random_unit({.seed = 9, .purpose = 1}, x, 0, z) > 0.012f) continue;
                const i32 y = ground(x, z);
                if (at(x, y - 1, z) != grass || y > kHeight - 12) continue;
                const i32 tall = 4 + i32(random_u64({.seed = 9, .purpose = 2}, x, 0, z) % 3);
                for (i32 dy = tall - 2; dy <= tall + 1; ++dy)
                    for (i32 dz = -2; dz <= 2; ++dz)
                        for (i32 dx = -2; dx <= 2; ++dx) {
                            const i32 reach = dy > tall - 1 ? 1 : 2;
                            if (std::abs(dx) > reach || std::abs(dz) > reach ||
                                (std::abs(dx) == reach && std::abs(dz) == reach && (dy & 1)))
                                continue;
                            if (at(x + dx, y + dy, z + dz) == air) set(x + dx, y + dy, z + dz, leaves);
                        }
                for (i32 dy = 0; dy < tall; ++dy)
                    set(x, y + dy, z, log);
            }
    }
    void build_things() {
        // A hut with a glass front and a lamp inside, by the origin.
        const i32 y = ground(6, 18);
        for (i32 dz = 0; dz < 7; ++dz)
            for (i32 dx = 0; dx < 7; ++dx)
                for (i32 dy = -2; dy < 5; ++dy) {
                    const bool wall = dx == 0 || dx == 6 || dz == 0 || dz == 6 || dy == 4 || dy < 0;
                    const bool window = dz == 0 && dx > 1 && dx < 5 && dy > 0 && dy < 3;
                    set(3 + dx, y + dy, 15 + dz, window ? glass : wall ? planks : air);
                }
        set(6, y + 3, 18, glowstone);
        set(-6, ground(-6, 12), 12, glowstone);
    }

    void flood() {
        std::array<std::deque<u32>, 16> queue;
        const std::size_t layer = std::size_t(side_) * side_;
        for (std::size_t column = 0; column < layer; ++column) {
            u32 level = 15;
            for (i32 y = kHeight - 1; y >= 0; --y) {
                const std::size_t c = std::size_t(y) * layer + column;
                const Block b = Block(cells_[c]);
                if (opaque(b))
                    level = 0;
                else if (b == leaves || b == water)
                    level = level > 1 ? level - 1 : 0;
                light_[c] = u8(level);
            }
        }
        spread(4, false);
        for (std::size_t c = 0; c < cells_.size(); ++c)
            if (cells_[c] == glowstone) light_[c] = u8(light_[c] | 0xf0);
        spread(4, true);
    }
    // Plain flood of one nibble.
    void spread(u32, bool lamps) {
        const u32 shift = lamps ? 4 : 0;
        const std::ptrdiff_t layer = std::ptrdiff_t(side_) * side_;
        std::vector<u32> now, next;
        for (u32 c = 0; c < cells_.size(); ++c)
            if ((light_[c] >> shift & 15) > 1) {
                // Only cells beside darker ones start.
                const i32 x = i32(c) % side_, z = i32(c) / side_ % side_, y = i32(c / u32(layer));
                const u32 l = light_[c] >> shift & 15;
                if ((x > 0 && (light_[c - 1] >> shift & 15) + 1 < l) ||
                    (x + 1 < side_ && (light_[c + 1] >> shift & 15) + 1 < l) ||
                    (z > 0 && (light_[c - u32(side_)] >> shift & 15) + 1 < l) ||
                    (z + 1 < side_ && (light_[c + u32(side_)] >> shift & 15) + 1 < l) ||
                    (y > 0 && (light_[c - u32(layer)] >> shift & 15) + 1 < l) || lamps)
                    now.push_back(c);
            }
        while (!now.empty()) {
            next.clear();
            for (u32 c : now) {
                const u32 l = light_[c] >> shift & 15;
                if (l <= 1) continue;
                const i32 x = i32(c) % side_, z = i32(c) / side_ % side_, y = i32(c / u32(layer));
                auto visit = [&](bool inside, std::ptrdiff_t d) {
                    if (!inside) return;
                    const u32 n = u32(std::ptrdiff_t(c) + d);
                    const Block b = Block(cells_[n]);
                    if (opaque(b) || (light_[n] >> shift & 15) >= l - 1) return;
                    light_[n] = u8((light_[n] & (lamps ? 0x0f : 0xf0)) | (l - 1) << shift);
                    next.push_back(n);
                };
                visit(x > 0, -1), visit(x + 1 < side_, 1), visit(z > 0, -side_), visit(z + 1 < side_, side_);
                visit(y > 0, -layer), visit(y + 1 < kHeight, layer);
            }
            now.swap(next);
        }
    }
    // Sky and lamp light; opaque cells borrow from the brightest open neighbor.
    Light light_near(i32 x, i32 y, i32 z) const {
        auto level = [&](i32 ax, i32 ay, i32 az) -> u32 {
            if (ay >= kHeight || ax < 0 || az < 0 || ax >= side_ || az >= side_) return 15;
            return ay < 0 ? 0 : light_[index(ax, ay, az)];
        };
        u32 l = level(x, y, z);
        if (opaque(grid(x, y, z))) {
            u32 sky = 0, lamp = 0, n = 0;
            for (const IVec3& d : kFaceNormal) {
                if (opaque(grid(x + d.x, y + d.y, z + d.z))) continue;
                const u32 m = level(x + d.x, y + d.y, z + d.z);
                sky += m & 15, lamp += m >> 4, ++n;
            }
            l = n ? (sky / n) | (lamp / n) << 4 : 0;
        }
        const u32 lamp = l >> 4;
        return Light(l & 15, lamp, lamp * 14 / 15, lamp * 12 / 15);
    }
    void make_brick(i32 cx, i32 cy, i32 cz, render::LightBrick& brick) const {
        brick.uniform = true;
        for (i32 y = -1; y <= 16; ++y)
            for (i32 z = -1; z <= 16; ++z)
                for (i32 x = -1; x <= 16; ++x) {
                    const Light l = light_near(cx * 16 + x, cy * 16 + y, cz * 16 + z);
                    brick.cells[render::LightBrick::index(x, y, z)] = l.bits;
                    if (l.bits != brick.cells[0]) brick.uniform = false;
                }
        brick.value = Light(brick.cells[0]);
    }

    struct Look {
        const char *side, *top, *bottom;
        TintKind top_tint;
        render::QuadPass pass;
    };
    static const Look& look_of(Block b) {
        using enum render::QuadPass;
        static const Look looks[count] = {{"", "", "", TintKind::none, opaque},
                                          {"stone", "stone", "stone", TintKind::none, opaque},
                                          {"dirt", "dirt", "dirt", TintKind::none, opaque},
                                          {"grass_block_side", "grass_block_top", "dirt", TintKind::grass, opaque},
                                          {"sand", "sand", "sand", TintKind::none, opaque},
                                          {"water_still", "water_still", "water_still", TintKind::water, translucent},
                                          {"oak_log", "oak_log_top", "oak_log_top", TintKind::none, opaque},
                                          {"oak_leaves", "oak_leaves", "oak_leaves", TintKind::foliage, cutout},
                                          {"glowstone", "glowstone", "glowstone", TintKind::none, opaque},
                                          {"glass", "glass", "glass", TintKind::none, translucent},
                                          {"oak_planks", "oak_planks", "oak_planks", TintKind::none, opaque}};
        return looks[b];
    }
    bool shown(Block b, Block other) const {
        if (b == air || opaque(other)) return false;
        return other != b;
    }
    u8 ambient(i32 x, i32 y, i32 z, u32 axis, i32 side, const i32 (&u)[3], const i32 (&v)[3]) const {
        i32 p[3] = {x, y, z};
        p[axis] += side;
        auto solid = [&](i32 du, i32 dv) {
            return opaque(
                       grid(p[0] + u[0] * du + v[0] * dv, p[1] + u[1] * du + v[1] * dv, p[2] + u[2] * du + v[2] * dv))
                       ? 1u
                       : 0u;
        };
        u8 out = 0;
        const i32 corner[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
        for (u32 c = 0; c < 4; ++c) {
            const u32 a = solid(corner[c][0], 0), b = solid(0, corner[c][1]);
            const u32 open = a && b ? 0 : 3 - (a + b + solid(corner[c][0], corner[c][1]));
            out = u8(out | open << (c * 2));
        }
        return out;
    }
    void mesh_section(i32 cx, i32 cy, i32 cz, render::SectionMesh& mesh) {
        std::array<std::vector<render::Quad>, render::SectionMesh::kGroups> groups;
        for (u32 f = 0; f < 6; ++f) {
            const u32 axis = f >> 1;
            const i32 side = f & 1 ? 1 : -1;
            const i32 u[3] = {axis == 0 ? 0 : 1, 0, axis == 0 ? 1 : 0},
                      v[3] = {0, axis == 1 ? 0 : 1, axis == 1 ? 1 : 0};
            for (i32 d = 0; d < 16; ++d) {
                u32 keys[16][16] = {};
                for (i32 j = 0; j < 16; ++j)
                    for (i32 i = 0; i < 16; ++i) {
                        i32 p[3] = {cx * 16 + u[0] * i + v[0] * j, cy * 16 + u[1] * i + v[1] * j,
                                    cz * 16 + u[2] * i + v[2] * j};
                        p[axis] += d;
                        const Block b = grid(p[0], p[1], p[2]);
                        i32 q[3] = {p[0], p[1], p[2]};
                        q[axis] += side;
                        if (!shown(b, grid(q[0], q[1], q[2]))) continue;
                        keys[j][i] = 1u << 16 | u32(b) << 8 | ambient(p[0], p[1], p[2], axis, side, u, v);
                    }
                for (i32 j = 0; j < 16; ++j)
                    for (i32 i = 0; i < 16; ++i) {
                        const u32 key = keys[j][i];
                        if (!key) continue;
                        const u8 ao = u8(key);
                        const bool merge_u = (ao & 3) == (ao >> 2 & 3) && (ao >> 4 & 3) == ao >> 6;
                        const bool merge_v = (ao & 3) == ao >> 6 && (ao >> 2 & 3) == (ao >> 4 & 3);
                        i32 w = 1, h = 1;
                        while (merge_u && i + w < 16 && keys[j][i + w] == key)
                            ++w;
                        auto row_equal = [&](i32 row) {
                            for (i32 k = 0; k < w; ++k)
                                if (keys[row][i + k] != key) return false;
                            return true;
                        };
                        while (merge_v && j + h < 16 && row_equal(j + h))
                            ++h;
                        for (i32 b = 0; b < h; ++b)
                            for (i32 a = 0; a < w; ++a)
                                keys[j + b][i + a] = 0;
                        const Block block = Block(key >> 8 & 255);
                        const Look& look = look_of(block);
                        i32 p[3] = {u[0] * i + v[0] * j, u[1] * i + v[1] * j, u[2] * i + v[2] * j};
                        p[axis] += d;
                        const char* texture = f == 3 ? look.top : f == 2 ? look.bottom : look.side;
                        const TintKind tint =
                            look.top_tint == TintKind::grass && f != 3 ? TintKind::none : look.top_tint;
                        groups[render::SectionMesh::group(look.pass, f)].push_back(render::Quad::cube(
                            {p[0], p[1], p[2]}, u32(w), u32(h), Face(f), ao, registry.texture_id(texture), tint, 0,
                            block == water ? render::kQuadLiquid : 0));
                    }
            }
        }
        mesh.quads.clear();
        for (u32 g = 0; g < groups.size(); ++g) {
            mesh.first[g] = u32(mesh.quads.size());
            mesh.quads.insert(mesh.quads.end(), groups[g].begin(), groups[g].end());
        }
        mesh.first[groups.size()] = u32(mesh.quads.size());
        bool solid = true;
        for (i32 y = 0; y < 16 && solid; ++y)
            for (i32 z = 0; z < 16 && solid; ++z)
                for (i32 x = 0; x < 16 && solid; ++x)
                    solid = opaque(grid(cx * 16 + x, cy * 16 + y, cz * 16 + z));
        mesh.connections = solid ? 0 : (u64(1) << 36) - 1;
    }

    i32 radius_, side_;
    std::vector<u8> cells_, light_; // light: sky | lamp << 4
};

} // namespace vitrail::bench

#include "scene/sky.h"

namespace vitrail::bench {

inline scene::FrameView SampleScene::frame(u32 width, u32 height, WorldPos eye, float yaw_deg, float pitch_deg,
                                           i32 chunks) {
    scene::FrameView frame;
    frame.width = width, frame.height = height;
    frame.sky = scene::sky_at(6000);
    frame.view_distance = float(chunks * 16);
    scene::View view;
    view.eye.at = eye;
    view.rotation = view_rotation(yaw_deg * kDegree, pitch_deg * kDegree);
    frame.views.push_back(view);
    return frame;
}

} // namespace vitrail::bench
