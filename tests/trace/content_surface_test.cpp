// Surface points: places and sides, albedo as the raster renderer decodes it, tints, relief, waves, media.
#include "tests/trace/content_fixture.h"

#include "base/rng.h"
#include "trace/kernel/surface.h"
#include "trace/kernel/traverse.h"

#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

Ray ray_between(Vec3 from, Vec3 to) {
    return {{{i32(std::floor(from.x)), i32(std::floor(from.y)), i32(std::floor(from.z))},
             {from.x - std::floor(from.x), from.y - std::floor(from.y), from.z - std::floor(from.z)}},
            normalized(to - from)};
}
Vec3 place_of(Place p) {
    return Vec3{float(p.cell.x), float(p.cell.y), float(p.cell.z)} + p.at;
}
Hit hit_of(const SceneView& s, const Ray& ray, u32 medium = 0) {
    Hit hit;
    EXPECT_TRUE(closest_hit(s, ray, kFar, medium, hit));
    return hit;
}
void expect_near(Vec3 a, Vec3 b, float off, const std::string& what = "") {
    EXPECT_NEAR(a.x, b.x, off) << what;
    EXPECT_NEAR(a.y, b.y, off) << what;
    EXPECT_NEAR(a.z, b.z, off) << what;
}
// What lighting.screen.glsl makes of bytes of texture and tint.
Vec3 rasters(u32 texel, Vec3 tint) {
    const Vec3 c = Vec3{float(texel & 255), float(texel >> 8 & 255), float(texel >> 16 & 255)} * (1.0f / 255) * tint;
    const auto linear = [](float v) { return v * (v * (v * 0.305306011f + 0.682171111f) + 0.012522878f); };
    return {linear(c.x), linear(c.y), linear(c.z)};
}

TEST(TraceSurface, CubesFromAllSides) {
    ContentChunk chunk;
    chunk.set(8, 8, 8, "oak_log[axis=x]");
    const SceneView& s = chunk.scene();
    const StateRecord& r = base_content().record("oak_log[axis=x]");
    Rng rng(5);
    for (u32 i = 0; i < 600; ++i) {
        const u32 face = i % 6, axis = face >> 1;
        Vec3 at{8 + rng.unit(), 8 + rng.unit(), 8 + rng.unit()};
        (axis == 0 ? at.x : axis == 1 ? at.y : at.z) = face & 1 ? 9.0f : 8.0f;
        const Vec3 from = at + axis_of_face(face) * 2 + Vec3{rng.unit() - 0.5f, rng.unit() - 0.5f, rng.unit() - 0.5f};
        const Ray ray = ray_between(from, at);
        const Hit hit = hit_of(s, ray);
        ASSERT_EQ(hit.face, face);
        const SurfacePoint p = surface_at(s, ray, hit, 0);
        expect_near(place_of(p.at), at, 1e-4f);
        EXPECT_EQ(p.inner, (IVec3{8, 8, 8}));
        EXPECT_EQ(p.at.cell, next_cell({8, 8, 8}, face));
        expect_near(p.face, axis_of_face(face), 0);
        EXPECT_GT(-dot(p.normal, ray.dir), 0);
        EXPECT_NEAR(length(p.normal), 1, 1e-5f);
        EXPECT_GT(dot(p.normal, p.face), 0.3f);
        EXPECT_EQ(p.optics, Optics::matte);
        EXPECT_EQ(p.ior, 1.5f);
        const u32 texel = s.textures.albedo[texel_index(s.textures, look_texture(r.faces[face]),
                                                        face_uv(r.faces[face], at - Vec3{8, 8, 8}))];
        expect_near(p.albedo, rasters(texel, {1, 1, 1}), 0.15f); // a neighbor texel by rounding, now and then
        expect_near(p.emission, {}, 0);
    }
}

// Exactly the raster's decode, tints included: grass of two colors, blended, and the mask of its side.
TEST(TraceSurface, TintsAreBlendedAndMasked) {
    u32 tints[kTintWords];
    for (u32 i = 0; i < kTintWords; ++i) // grass grows red with x
        tints[i] = 0xff000000u | (i < 36 ? (40 + 30 * (i % 6)) | 160u << 8 | 64u << 16 : 0x808080u);
    ContentChunk chunk;
    for (i32 x = 0; x < 16; ++x)
        chunk.set(x, 4, 7, "grass_block");
    const SceneView& s = chunk.scene(tints);
    const StateRecord& r = base_content().record("grass_block");
    for (i32 x = 0; x < 16; ++x)
        for (const u32 face : {u32(Face::up), u32(Face::south)}) {
            const Vec3 at = face == u32(Face::up) ? Vec3{float(x) + 0.64f, 5, 7.36f} : Vec3{float(x) + 0.64f, 4.98f, 8};
            const Ray ray = ray_between(at + Vec3{0, 2, 2}, at);
            const SurfacePoint p = surface_at(s, ray, hit_of(s, ray), 0);
            const float column = std::min(std::max((at.x) / 4 + 0.5f, 0.0f), 5.0f); // between the middles of texels
            const Vec3 tint = Vec3{40 + 30 * column, 160, 64} * (1.0f / 255);
            const u64 look = r.faces[face];
            const u32 texel =
                s.textures
                    .albedo[texel_index(s.textures, look_texture(look), face_uv(look, at - Vec3{float(x), 4, 7}))];
            const float share = float(texel >> 24) / 255;
            const bool tinted = look_tint(look) != u32(TintKind::none);
            expect_near(p.albedo, rasters(texel, tinted ? lerp(Vec3{1, 1, 1}, tint, share) : Vec3{1, 1, 1}), 2e-3f);
        }
    EXPECT_EQ(look_tint(r.faces[u32(Face::up)]), u32(TintKind::grass));
}

// A bump whose right side rises: its normal leans against the picture's right, on every face and turn.
TEST(TraceSurface, ReliefFollowsThePicture) {
    for (u32 face = 0; face < 6; ++face)
        for (u32 turns = 0; turns < 4; ++turns) {
            const u64 look = u64(face) << 20 | u64(turns) << 62;
            const Vec3 at{0.4f, 0.45f, 0.55f};
            const PicturePlace p = picture_of_face(look, at);
            const float e = 0.01f;
            for (const auto& [axis, du, dv] : {std::tuple{p.right, e, 0.0f}, std::tuple{p.down, 0.0f, e}}) {
                const Vec2 there = face_uv(look, at + axis * e);
                EXPECT_NEAR(there.x - p.uv.x, du, 1e-4f) << face << ' ' << turns;
                EXPECT_NEAR(there.y - p.uv.y, dv, 1e-4f) << face << ' ' << turns;
            }
        }
    // Quads: along their own coordinates, whichever way these lie.
    Rng rng(9);
    for (u32 i = 0; i < 200; ++i) {
        const auto any = [&] { return rng.unit() * 2 - 1; };
        TraceQuad q;
        q.edge_a = {any(), any(), any()}, q.edge_b = {any(), any(), any()};
        q.ua = any(), q.va = any(), q.ub = any(), q.vb = any();
        if (length(cross(q.edge_a, q.edge_b)) < 0.1f) continue;
        const PicturePlace p = picture_of_quad(q, {});
        // How u and v change along an axis: its parts along the edges.
        const Vec3 n = cross(q.edge_a, q.edge_b);
        const auto change = [&](Vec3 way) {
            const float nn = dot(n, n), a = dot(cross(way, q.edge_b), n) / nn, b = dot(cross(q.edge_a, way), n) / nn;
            return Vec2{a * q.ua + b * q.ub, a * q.va + b * q.vb};
        };
        // Steepest ascent: no way of the same length in the plane rises more.
        const Vec3 e1 = normalized(q.edge_a), e2 = normalized(cross(n, e1));
        for (u32 k = 0; k < 32; ++k) {
            const float turn = float(k) * 0.19635f;
            const Vec2 c = change(e1 * std::cos(turn) + e2 * std::sin(turn));
            EXPECT_LE(c.x, change(p.right).x + 1e-4f);
            EXPECT_LE(c.y, change(p.down).y + 1e-4f);
        }
        EXPECT_NEAR(dot(p.right, n), 0, 1e-5f);
    }
}

TEST(TraceSurface, WaterBothWays) {
    ContentChunk chunk;
    for (i32 z = 4; z < 12; ++z)
        for (i32 x = 4; x < 12; ++x) {
            chunk.set(x, 3, z, "sand");
            chunk.set(x, 4, z, "water"), chunk.set(x, 5, z, "water");
        }
    SceneView s = chunk.scene();
    s.seconds = 3.5f, s.wave_height = 0.06f;
    const u32 water = ContentTables::kWater;
    const Vec3 at{8.3f, 5 + 228.0f / 256, 8.6f};
    const scene::WaveSurface wave = scene::wave_at({8, 5, 8}, {0.3f, 0.6f}, 3.5f, 0.06f);
    const Vec3 wavy = normalized({-wave.slope.x, 1, -wave.slope.y});
    const Ray down = ray_between(at + Vec3{1, 3, 0.5f}, at);
    SurfacePoint p = surface_at(s, down, hit_of(s, down), 0);
    expect_near(place_of(p.at), at, 1e-4f);
    EXPECT_EQ(p.optics, Optics::water);
    EXPECT_EQ(p.medium_here, 0);
    EXPECT_EQ(p.medium_behind, water);
    EXPECT_NEAR(p.ior, 1.333f, 1e-6f);
    expect_near(p.normal, wavy, 1e-3f);
    expect_near(p.face, {0, 1, 0}, 1e-6f);
    EXPECT_EQ(p.inner, p.at.cell) << "the surface lies inside its cell";
    const Ray up = ray_between(at - Vec3{0.5f, 1.5f, 0.2f}, at);
    p = surface_at(s, up, hit_of(s, up, water), 0);
    EXPECT_EQ(p.medium_here, water);
    EXPECT_EQ(p.medium_behind, 0);
    EXPECT_NEAR(p.ior, 1 / 1.333f, 1e-6f);
    expect_near(p.normal, -wavy, 1e-3f);
    // A side of the pool, from the air and from the water.
    const Vec3 side{4, 4.5f, 8.5f};
    const Ray in = ray_between(side - Vec3{2, 0, 0.1f}, side);
    p = surface_at(s, in, hit_of(s, in), 0);
    EXPECT_EQ(p.medium_behind, water);
    EXPECT_EQ(p.at.cell, (IVec3{3, 4, 8}));
    EXPECT_EQ(p.inner, (IVec3{4, 4, 8}));
    const Ray out = ray_between(side + Vec3{2, 0, 0.1f}, side);
    p = surface_at(s, out, hit_of(s, out, water), 0);
    EXPECT_EQ(p.medium_here, water);
    EXPECT_EQ(p.medium_behind, 0);
    EXPECT_EQ(p.at.cell, (IVec3{4, 4, 8})) << "on the ray's side";
    EXPECT_EQ(p.inner, (IVec3{3, 4, 8}));
    expect_near(p.face, {1, 0, 0}, 0);
}

TEST(TraceSurface, GlassIsClearWhereItsPictureIs) {
    ContentChunk chunk;
    chunk.set(3, 3, 3, "glass");
    chunk.set(6, 3, 3, "red_stained_glass");
    chunk.set(9, 3, 3, "ice");
    chunk.set(12, 3, 3, "vitrail:cyan_crystal");
    const SceneView& s = chunk.scene();
    const auto from_above = [&](float x, float z) {
        const Ray ray = ray_between({x, 6, z}, {x, 4, z});
        return surface_at(s, ray, hit_of(s, ray), 0);
    };
    u32 clear = 0, framed = 0;
    for (u32 i = 0; i < 32 * 32; ++i) {
        const SurfacePoint p = from_above(3 + (float(i % 32) + 0.5f) / 32, 3 + (float(i / 32) + 0.5f) / 32);
        EXPECT_EQ(p.optics, Optics::thin);
        EXPECT_TRUE(p.opacity == 0 || p.opacity == 1) << p.opacity;
        if (p.opacity == 0) {
            expect_near(p.albedo, {1, 1, 1}, 1e-6f);
            ++clear;
        } else {
            ++framed;
        }
    }
    EXPECT_EQ(clear, 729u) << "clear texels of the picture";
    EXPECT_EQ(framed, 295u);
    // Two sheets of it take what the raster's pane takes.
    const SurfacePoint red = from_above(6.5f, 3.5f);
    EXPECT_GT(red.albedo.x, 0.85f);
    EXPECT_LT(red.albedo.y, 0.7f);
    EXPECT_LT(red.opacity, 0.2f);
    EXPECT_EQ(red.medium_behind, 0);
    const SurfacePoint ice = from_above(9.5f, 3.5f);
    EXPECT_EQ(ice.optics, Optics::dielectric);
    EXPECT_NEAR(ice.ior, 1.31f, 1e-5f);
    EXPECT_EQ(ice.medium_behind, base_content().record("ice").medium);
    const SurfacePoint crystal = from_above(12.5f, 3.5f);
    EXPECT_NEAR(crystal.ior, 2.3f, 1e-5f);
    EXPECT_EQ(crystal.roughness, 0);
}

// Every state, from random directions: nothing is out of range, whatever is hit.
TEST(TraceSurface, AnyBlockFromAnywhere) {
    const BaseContent& c = base_content();
    Rng rng(11);
    u32 hits = 0;
    for (u32 round = 0; round < 60; ++round) {
        ContentChunk chunk;
        for (u32 i = 0; i < 300; ++i) {
            const u32 id = rng.below(c.states->size());
            chunk.set(2 + i32(rng.below(12)), 2 + i32(rng.below(12)), 2 + i32(rng.below(12)),
                      c.states->info(StateId(id)).state.to_string());
        }
        const SceneView& s = chunk.scene();
        for (u32 i = 0; i < 300; ++i) {
            const Vec3 from{16 * rng.unit(), i & 1 ? 15.9f : 0.1f, 16 * rng.unit()},
                to{16 * rng.unit(), 16 * rng.unit(), 16 * rng.unit()};
            const Ray ray = ray_between(from, to);
            Hit hit;
            if (!closest_hit(s, ray, kFar, 0, hit)) continue;
            ++hits;
            const SurfacePoint p = surface_at(s, ray, hit, rng.unit() * 0.1f);
            const std::string what = c.states->info(StateId(hit.state)).state.to_string();
            expect_near(place_of(p.at), from + ray.dir * hit.t, 2e-3f, what);
            EXPECT_NEAR(length(p.face), 1, 1e-4f) << what;
            EXPECT_NEAR(length(p.normal), 1, 1e-4f) << what;
            EXPECT_LE(dot(p.face, ray.dir), 1e-4f) << what;
            if (!p.plant) EXPECT_LE(dot(p.normal, ray.dir), -0.01f) << what;
            for (const float v : {p.albedo.x, p.albedo.y, p.albedo.z, p.roughness, p.opacity})
                EXPECT_TRUE(v >= 0 && v <= 1.001f) << what << ' ' << v;
            for (const float v : {p.emission.x, p.emission.y, p.emission.z})
                EXPECT_TRUE(v >= 0 && v < 1000) << what << ' ' << v;
            EXPECT_LT(p.medium_here, c.tables.media().size()) << what;
            EXPECT_LT(p.medium_behind, c.tables.media().size()) << what;
            EXPECT_TRUE(p.ior > 0.2f && p.ior < 4) << what;
        }
    }
    EXPECT_GT(hits, 5000u);
}

} // namespace
} // namespace vitrail::trace
