// Sun and moon as the eye sees them: render/passes/sky/discs.glsl in C++ (tests/render/sky_twin_test.cpp compares the
// pictures). Drawn five times as wide as they are, as players expect them. Kernel-safe.
#pragma once

#include "trace/kernel/sky_view.h"

namespace vitrail::trace {

inline constexpr float kSunRadius = 0.030f, kMoonRadius = 0.036f; // radians

// The disc with its darker limb, and the glare around it. edge: radians of a pixel.
VX_HD Vec3 sun_seen(const SkyView& sky, Vec3 d, float edge) {
    const float angle = length(d - sky.sun_direction), q = angle / kSunRadius;
    const float inner = std::sqrt(clamp(1 - q * q, 0.0f, 1.0f)),
                cover = clamp((kSunRadius - angle) / edge + 0.5f, 0.0f, 1.0f);
    const Vec3 limb = Vec3{1, 1, 1} - Vec3{0.35f, 0.48f, 0.62f} * (1 - inner);
    const float glare = 0.55f / (1 + q * q * 0.55f) * clamp(1 - angle * 1.4f, 0.0f, 1.0f);
    return sky.sun_disc * (limb * (14 * cover) + Vec3{1, 1, 1} * (glare * glare * 1.4f));
}

VX_HD float noise_or_even(const SkyView& sky, u32 channel, Vec2 at, float level) {
    return sky.cloud_noise ? scene::cloud_noise_at(sky.cloud_noise, channel, at, level) : 0.5f;
}

// Brightness of a place on the moon's disc, -1..1: the seas and a few rayed craters.
VX_HD float moon_face(const SkyView& sky, Vec2 p) {
    const float seas = noise_or_even(sky, 0, {p.x * 0.21f + 0.37f, p.y * 0.21f + 0.61f}, 1) * 0.7f +
                       noise_or_even(sky, 0, {p.x * 0.63f + 0.17f, p.y * 0.63f + 0.17f}, 1) * 0.3f;
    const float fine = noise_or_even(sky, 1, {p.x * 1.9f, p.y * 1.9f}, 0);
    const float face = lerp(1.0f, 0.52f, smoothstep(0.46f, 0.60f, seas)) * (0.86f + 0.28f * fine);
    const float x = p.x - 0.12f, y = p.y + 0.62f, c2 = x * x + y * y;
    return face + 0.30f * std::exp(-c2 * 90) + 0.10f * std::exp(-c2 * 8);
}

struct MoonSeen {
    Vec3 light;      // to add
    float cover = 0; // share of the stars behind that is hidden
};
VX_HD MoonSeen moon_seen(const SkyView& sky, Vec3 d, float edge) {
    const float angle = length(d - sky.moon_direction), cover = clamp((kMoonRadius - angle) / edge + 0.5f, 0.0f, 1.0f);
    const float q = angle / kMoonRadius, lit_part = 0.5f + 0.5f * std::cos(sky.moon_phase);
    const float glare = clamp(1 - angle * 2, 0.0f, 1.0f) / (1 + q * q * 0.30f);
    const Vec3 around = sky.moon_disc * Vec3{0.55f, 0.75f, 1.1f} * (0.055f * lit_part * glare);
    if (cover <= 0) return {around, 0};
    // The pole of the sky's turning is up on the disc.
    const Vec3 right = normalized(cross(sky.pole, sky.moon_direction));
    const Vec2 p{dot(d, right) / kMoonRadius, dot(d, sky.pole) / kMoonRadius};
    const float z = std::sqrt(clamp(1 - p.x * p.x - p.y * p.y, 0.0f, 1.0f));
    const float sun = p.x * std::sin(sky.moon_phase) + z * std::cos(sky.moon_phase), day = sun > 0 ? sun : 0;
    // A dusty ball (Lommel and Seeliger), and earthshine.
    const float lit = clamp(sun * 14 + 0.5f, 0.0f, 1.0f) * 2 * day / (day + z + 0.02f);
    const Vec3 face = Vec3{1, 0.97f, 0.92f} * (lit * 0.75f) + Vec3{0.006f, 0.009f, 0.014f};
    return {lerp(around, sky.moon_disc * face * moon_face(sky, p), cover), cover};
}

} // namespace vitrail::trace
