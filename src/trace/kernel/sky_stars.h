// Stars and the milky way: render/passes/sky/stars.glsl in C++ (tests/render/sky_twin_test.cpp compares the pictures).
// At most one star a cell on the faces of a cube that turns with the sky; none smaller than a pixel. Kernel-safe.
#pragma once

#include "trace/kernel/sky_discs.h"

namespace vitrail::trace {

VX_HD u32 star_hash(u32 x, u32 y, u32 z) {
    u32 h = x * 0x9E3779B1u ^ y * 0x85EBCA77u ^ z * 0xC2B2AE3Du;
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    h ^= h >> 12;
    h *= 0x297A2D39u;
    return h ^ h >> 15;
}

VX_HD Vec3 star_color(float t) { // cool to hot
    const Vec3 warm = lerp(Vec3{1, 0.62f, 0.38f}, Vec3{1, 0.92f, 0.78f}, smoothstep(0.0f, 0.45f, t));
    return lerp(warm, Vec3{0.66f, 0.78f, 1}, smoothstep(0.45f, 1.0f, t));
}

// d: in the stars' own frame; cells: a side of a face; share: of cells with a star; twinkle: 0..1.
VX_HD Vec3 star_layer(Vec3 d, float seconds, float cells, float share, float edge, float twinkle, u32 seed) {
    const float ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
    const float most = ax > ay ? (ax > az ? ax : az) : (ay > az ? ay : az);
    const u32 axis = most == ax ? 0 : most == ay ? 1 : 2;
    const float along = axis == 0 ? d.x : axis == 1 ? d.y : d.z;
    const Vec2 flat = axis == 0 ? Vec2{d.y, d.z} : axis == 1 ? Vec2{d.x, d.z} : Vec2{d.x, d.y};
    const float u = std::floor((flat.x / most * 0.5f + 0.5f) * cells),
                v = std::floor((flat.y / most * 0.5f + 0.5f) * cells);
    const float cx = u < cells - 1 ? u : cells - 1, cy = v < cells - 1 ? v : cells - 1;
    const u32 h = star_hash(u32(cx), u32(cy), axis * 2 + (along > 0 ? 0 : 1) + seed * 8);
    if (float(h & 0xffff) * (1.0f / 65536) >= share) return {};
    const u32 k = star_hash(h, h >> 7, 17);
    const float sx = (cx + 0.25f + 0.5f / 255 * float(k & 255)) / cells * 2 - 1,
                sy = (cy + 0.25f + 0.5f / 255 * float(k >> 8 & 255)) / cells * 2 - 1, side = along > 0 ? 1.0f : -1.0f;
    const Vec3 star = normalized(axis == 0 ? Vec3{side, sx, sy} : axis == 1 ? Vec3{sx, side, sy} : Vec3{sx, sy, side});
    const float magnitude = float(k >> 16 & 255) * (1.0f / 255), m2 = magnitude * magnitude, m4 = m2 * m2;
    const float bright = 0.02f + m4 * m4 * 1.4f, least = 0.0008f + 0.0005f * bright;
    const float width = least > edge * 0.5f ? least : edge * 0.5f;
    const Vec3 off = d - star;
    float light = bright * (0.0011f * 0.0011f) / (width * width) * std::exp(-dot(off, off) / (2 * width * width));
    light *= 1 + twinkle * std::sin(seconds * (2 + 0.2f * float(k >> 20 & 15)) + float(h >> 16));
    return star_color(float(k >> 24) * (1.0f / 255)) * light;
}

// Radiance of all stars and of the milky way in a direction of the world.
VX_HD Vec3 stars_seen(const SkyView& sky, Vec3 d, float edge) {
    const Vec3 pole = sky.pole, across{0, pole.z, -pole.y};
    const float fx = d.x, fy = dot(d, across), s = std::sin(sky.star_turn), c = std::cos(sky.star_turn);
    const Vec3 own{fx * c + fy * s, fy * c - fx * s, dot(d, pole)};
    const Vec3 galaxy{0.36f, 0.48f, 0.80f}, center{-0.8f, 0.6f, 0};
    const float latitude = dot(own, galaxy), along = dot(own, center), band = std::exp(-latitude * latitude * 16);
    Vec3 glow;
    float rift = 0;
    if (sky.cloud_noise) {
        const float turn = std::atan2(dot(own, cross(galaxy, center)), along) * 0.318309886f;
        const float cloudy = noise_or_even(sky, 0, {turn * 3, latitude * 1.3f}, 2) * 0.6f +
                             noise_or_even(sky, 0, {turn * 9 + 0.3f, latitude * 4.1f + 0.3f}, 1) * 0.4f;
        rift = smoothstep(0.10f, 0.0f, std::abs(latitude + 0.05f * (cloudy - 0.5f))) * smoothstep(0.42f, 0.62f, cloudy);
        const float core = 0.55f + 0.45f * along;
        glow = lerp(Vec3{0.55f, 0.70f, 1.05f}, Vec3{1.05f, 0.86f, 0.72f}, core * core * band) *
               (band * band * (0.25f + 1.2f * cloudy * cloudy) * core * (1 - 0.72f * rift) * 0.012f);
    }
    const float twinkle = 0.10f + 0.25f * (1 - clamp(d.y * 3, 0.0f, 1.0f));
    const Vec3 sum =
        glow + star_layer(own, sky.seconds, 40, 0.24f, edge, twinkle, 1) * 2.6f +
        star_layer(own, sky.seconds, 104, 0.16f + 0.50f * band * (1 - rift), edge, twinkle * 0.5f, 2) * 0.5f;
    return sum * (2 * smoothstep(-0.01f, 0.22f, d.y)); // low ones shine through more air
}

} // namespace vitrail::trace
