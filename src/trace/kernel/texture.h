// Texels of block pictures, and where on a picture a point of a face lies. Kernel-safe.
//
// Texels are taken singly (nearest): pictures have hard edges, and many samples a pixel smooth what a pixel covers.
// Colors and tints are multiplied as they are encoded, then decoded, as the raster renderer does.
#pragma once

#include "trace/kernel/scene_view.h"

namespace vitrail::trace {

// Fields of a scene::FaceLook (and of the look in StateQuad::bits).
VX_HD u32 look_face(u64 look) {
    return u32(look >> 20) & 7;
}
VX_HD u32 look_texture(u64 look) {
    return u32(look >> 32) & 0xffff;
}
VX_HD u32 look_tint(u64 look) { // TintKind
    return u32(look >> 48) & 7;
}
VX_HD u32 look_fixed_tint(u64 look) {
    return u32(look >> 51) & 255;
}
VX_HD u32 look_turns(u64 look) {
    return u32(look >> 62);
}

inline constexpr float kBelowOne = 0.99999994f; // the largest number below 1

// Texture coordinates, 0 <= s, t < 1, of a point of a cell (each 0..1) on the face of this look: to the right and down
// as seen from outside, turned clockwise by the look's quarter turns (axes: scene/block_model.h).
VX_HD Vec2 face_uv(u64 look, Vec3 at) {
    const u32 face = look_face(look), axis = face >> 1, turns = look_turns(look);
    const bool up = face & 1; // towards growing coordinates
    float s = axis == 0 ? at.z : at.x, t = axis == 1 ? at.z : 1 - at.y;
    if (axis == 0 ? up : axis == 2 && !up) s = 1 - s;
    if (axis == 1 && !up) t = 1 - t;
    if (turns & 1) {
        const float old = s;
        s = t, t = 1 - old;
    }
    if (turns & 2) s = 1 - s, t = 1 - t;
    return {clamp(s, 0.0f, kBelowOne), clamp(t, 0.0f, kBelowOne)};
}

// Texture coordinates of a quad at a, b along its edges; held a hair inside, so that a hit on the rim takes no texel of
// the other side of the picture.
VX_HD Vec2 quad_uv(const TraceQuad& q, float a, float b) {
    constexpr float kHair = 1.0f / 65536;
    a = clamp(a, kHair, 1 - kHair), b = clamp(b, kHair, 1 - kHair);
    return {q.u0 + a * q.ua + b * q.ub, q.v0 + a * q.va + b * q.vb};
}

// The level whose texels are nearest below what a ray's footprint covers: `across` is its narrow side in texels of
// level 0 (footprint in blocks * side of a layer). The long side of a slanting footprint is left to the samples.
VX_HD u32 mip_level(const TextureView& view, float across) {
    u32 level = 0;
    while (level + 1 < view.levels && across >= 2) {
        across *= 0.5f;
        ++level;
    }
    return level;
}

// Words before a level in its layer: 4^b + 4^(b-1) + ...
VX_HD u32 mip_offset(u32 size_bits, u32 level) {
    return ((4u << 2 * size_bits) - (4u << 2 * (size_bits - level))) / 3;
}

// Index into TextureView::albedo and material; coordinates beyond 0..1 repeat the picture.
VX_HD u32 texel_index(const TextureView& view, u32 layer, Vec2 uv, u32 level = 0) {
    const u32 bits = view.size_bits - level, side = 1u << bits;
    const u32 x = u32(i32(std::floor(uv.x * float(side)))) & (side - 1),
              y = u32(i32(std::floor(uv.y * float(side)))) & (side - 1);
    return layer * view.layer_words + (level ? mip_offset(view.size_bits, level) : 0) + (y << bits | x);
}

VX_HD Vec3 color_of(u32 texel) { // encoded as it is, 0..1
    return Vec3{float(texel & 255), float(texel >> 8 & 255), float(texel >> 16 & 255)} * (1.0f / 255);
}
VX_HD float alpha_of(u32 texel) {
    return float(texel >> 24) * (1.0f / 255);
}
// Cutout pictures: nothing is there.
VX_HD bool is_hole(u32 albedo_texel) {
    return albedo_texel >> 31 == 0; // alpha below a half
}
VX_HD bool hole_at(const TextureView& view, u32 layer, Vec2 uv, u32 level = 0) {
    return is_hole(view.albedo[texel_index(view, layer, uv, level)]);
}

// A material texel, decoded.
struct MaterialTexel {
    Vec2 slope;          // of the relief, -1..1: of the normal (slope.x right, slope.y down, rest out)
    float roughness = 1; // 0..1
    float emission = 0;  // 0..1
};
VX_HD MaterialTexel material_of(u32 texel) {
    const Vec3 c = color_of(texel);
    return {{c.x * 2 - 256.0f / 255, c.y * 2 - 256.0f / 255}, c.z, alpha_of(texel)};
}

// The transfer curve's cubic fit of render/passes/common/color.glsl, within 0.002 of it.
VX_HD float linear_from_srgb(float c) {
    return c * (c * (c * 0.305306011f + 0.682171111f) + 0.012522878f);
}
VX_HD Vec3 linear_from_srgb(Vec3 c) {
    return {linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z)};
}

} // namespace vitrail::trace
