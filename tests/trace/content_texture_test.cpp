// Texels and texture coordinates of the tracer against the axes that scene/block_model.h documents.
#include "trace/kernel/texture.h"

#include "scene/model_builder.h"
#include "world/block_def.h"

#include <array>
#include <gtest/gtest.h>
#include <vector>

namespace vitrail::trace {
namespace {

u64 look_of(u32 face, u32 turns) {
    return u64(face) << 20 | u64(turns) << 62;
}

// A picture turned clockwise by a quarter: what was at its top is at its right.
Vec2 unturned(Vec2 place, u32 turns) { // of the picture as drawn: where that texel is in the picture as stored
    for (u32 i = 0; i < turns; ++i)
        place = {place.y, 1 - place.x};
    return place;
}

TEST(TraceTexture, FacesFollowTheDocumentedAxes) {
    for (u32 face = 0; face < 6; ++face)
        for (u32 turns = 0; turns < 4; ++turns)
            for (const Vec3 at : {Vec3{0.25f, 0.375f, 0.125f}, Vec3{0.9f, 0.2f, 0.6f}}) {
                // As seen from outside: right and down of the face, measured from the corner where both begin.
                const IVec3 right = scene::texture_right(Face(face)), down = scene::texture_down(Face(face));
                const auto along = [&](IVec3 axis) {
                    const float d = at.x * float(axis.x) + at.y * float(axis.y) + at.z * float(axis.z);
                    return axis.x + axis.y + axis.z > 0 ? d : 1 + d;
                };
                const Vec2 expected = unturned({along(right), along(down)}, turns);
                const Vec2 uv = face_uv(look_of(face, turns), at);
                EXPECT_NEAR(uv.x, expected.x, 1e-6f) << "face " << face << ", " << turns << " turns";
                EXPECT_NEAR(uv.y, expected.y, 1e-6f) << "face " << face << ", " << turns << " turns";
            }
}

// The same numbers as the vertex shader's: s, t in block space, then its turns, repeated by the sampler.
TEST(TraceTexture, FacesEqualTheRasters) {
    for (u32 face = 0; face < 6; ++face)
        for (u32 turns = 0; turns < 4; ++turns) {
            const Vec3 at{0.3f, 0.65f, 0.8f};
            const float side = face & 1 ? 1.0f : -1.0f;
            const u32 axis = face >> 1;
            const float s = axis == 0 ? -side * at.z : axis == 1 ? at.x : side * at.x;
            const float t = axis == 1 ? side * at.z : -at.y;
            const Vec2 by_turn[4] = {{s, t}, {t, -s}, {-s, -t}, {-t, s}};
            Vec2 expected = by_turn[turns];
            expected = {expected.x - std::floor(expected.x), expected.y - std::floor(expected.y)};
            const Vec2 uv = face_uv(look_of(face, turns), at);
            EXPECT_NEAR(uv.x, expected.x, 1e-5f) << face << ' ' << turns;
            EXPECT_NEAR(uv.y, expected.y, 1e-5f) << face << ' ' << turns;
        }
}

TEST(TraceTexture, EdgesTakeTexelsOfTheirOwnSide) {
    for (u32 face = 0; face < 6; ++face)
        for (u32 turns = 0; turns < 4; ++turns)
            for (u32 corner = 0; corner < 8; ++corner) {
                const Vec3 at{float(corner & 1), float(corner >> 1 & 1), float(corner >> 2)};
                const Vec2 uv = face_uv(look_of(face, turns), at);
                EXPECT_GE(uv.x, 0);
                EXPECT_LT(uv.x, 1);
                EXPECT_GE(uv.y, 0);
                EXPECT_LT(uv.y, 1);
            }
    TraceQuad q;
    q.ua = 0.25f, q.vb = 1;
    EXPECT_LT(quad_uv(q, 1, 1).x, 0.25f);
    EXPECT_LT(quad_uv(q, 1, 1).y, 1.0f);
    EXPECT_GT(quad_uv(q, 0, 0).x, 0.0f);
}

TEST(TraceTexture, LevelsFollowEachOtherInALayer) {
    TextureView view;
    for (u32 bits = 0; bits <= 9; ++bits) {
        u32 sum = 0;
        for (u32 level = 0; level <= bits; ++level) {
            EXPECT_EQ(mip_offset(bits, level), sum);
            sum += 1u << 2 * (bits - level);
        }
    }
    view.size_bits = 5, view.levels = 6, view.layers = 3, view.layer_words = 1365;
    EXPECT_EQ(mip_level(view, 0), 0u);
    EXPECT_EQ(mip_level(view, 1.9f), 0u);
    EXPECT_EQ(mip_level(view, 2), 1u);
    EXPECT_EQ(mip_level(view, 9), 3u);
    EXPECT_EQ(mip_level(view, 1e9f), 5u);
    EXPECT_EQ(texel_index(view, 2, {0, 0}), 2u * 1365);
    EXPECT_EQ(texel_index(view, 0, {0.999f, 0.5f}), 31u + 16 * 32);
    EXPECT_EQ(texel_index(view, 0, {-0.01f, 1.5f}), 31u + 16 * 32) << "pictures repeat";
    EXPECT_EQ(texel_index(view, 1, {0.75f, 0.25f}, 4), 1365u + 1024 + 256 + 64 + 16 + 1);
    EXPECT_EQ(texel_index(view, 1, {0.75f, 0.25f}, 5), 1365u + 1364);
}

TEST(TraceTexture, TexelsDecode) {
    EXPECT_TRUE(is_hole(0x7fffffff)) << "127 of 255 is below a half";
    EXPECT_FALSE(is_hole(0x80000000));
    for (u32 i = 0; i < 256; ++i) { // the transfer curve of IEC 61966-2-1
        const double c = i / 255.0, exact = c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
        EXPECT_NEAR(linear_from_srgb(color_of(i).x), exact, 0.002) << i;
    }
    EXPECT_EQ(color_of(0x00ff8000).z, 1.0f);
    EXPECT_EQ(material_of(0x00e68080).slope.x, 0.0f) << "128 is flat";
    EXPECT_NEAR(material_of(0xffe6ff00).slope.y, 1, 0.01);
    EXPECT_NEAR(material_of(0xffe6ff00).roughness, 0.902, 0.001);
    EXPECT_EQ(material_of(0xffe6ff00).emission, 1.0f);
}

// Bits as scene::FaceLook documents them.
TEST(TraceTexture, LooksUnpack) {
    const u64 look = u64(4) << 20 | u64(0x1234) << 32 | u64(TintKind::fixed) << 48 | u64(0xab) << 51 | u64(3) << 62;
    EXPECT_EQ(look_face(look), 4u);
    EXPECT_EQ(look_texture(look), 0x1234u);
    EXPECT_EQ(look_tint(look), u32(TintKind::fixed));
    EXPECT_EQ(look_fixed_tint(look), 0xabu);
    EXPECT_EQ(look_turns(look), 3u);
}

} // namespace
} // namespace vitrail::trace
