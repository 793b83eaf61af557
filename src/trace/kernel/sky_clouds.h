// Clouds: a slab that hangs in the world, drifts, and bends down with a small globe to the horizon; marched in a few
// steps, each shadowed by what stands between it and the light. render/passes/sky/clouds.glsl (CLOUDS 2) in C++
// (tests/render/sky_twin_test.cpp compares the pictures). Kernel-safe.
#pragma once

#include "math/exp.h"
#include "trace/kernel/sky_view.h"

namespace vitrail::trace {

inline constexpr float kCloudBase = 520, kCloudThick = 150, kCloudGlobe = 9000; // blocks
inline constexpr float kCloudCoarse = 1.0f / 4096, kCloudFine = 1.0f / 1024;    // texture a block
inline constexpr Vec2 kCloudWind{3.1f, 1.2f};                                   // blocks a second

// Way along a ray of this slope to the shell that high above the eye.
VX_HD float way_to_shell(float slope, float above) {
    const float x = 2 * above / kCloudGlobe;
    return (std::sqrt(slope * slope + x + 0.25f * x * x) - slope) * kCloudGlobe;
}

// 0..1: how much cloud stands over that place, before details.
VX_HD float cloud_shape(const u8* noise, Vec2 at, float level) {
    const float x = at.x * kCloudCoarse, y = at.y * kCloudCoarse;
    const float wide = scene::cloud_noise_at(noise, 0, {x, y}, level);
    if (wide <= 0.42f) return 0; // details add 0.05 at most
    const float more = scene::cloud_noise_at(noise, 0, {x * 3 + 0.31f, y * 3 + 0.31f}, level + 2);
    return smoothstep(0.47f, 0.74f, wide + 0.10f * (more - 0.5f));
}

// Forward with a silver lining, a little back (two lobes of Henyey and Greenstein 1941).
VX_HD float cloud_phase(float cosine) {
    const float f = 1.7225f - 1.7f * cosine, b = 1.09f + 0.6f * cosine;
    return 0.30f * (1 - 0.7225f) / (f * std::sqrt(f)) + 0.70f * (1 - 0.09f) / (b * std::sqrt(b));
}

struct CloudsSeen {
    Vec3 light;
    float through = 1; // share of what lies behind that is seen
};
// edge: radians of a pixel; dither: 0..1, where in its stretch each step looks.
VX_HD CloudsSeen clouds_seen(const SkyView& sky, Vec3 d, float edge, float dither) {
    if (d.y < 0.005f || !sky.clouds || !sky.cloud_noise) return {};
    const float above = sky.cloud_above, near = way_to_shell(d.y, above);
    const float haze = exp_of(-near * near * (1.0f / (3600.0f * 3600.0f))) * smoothstep(0.005f, 0.06f, d.y);
    if (haze < 1e-3f) return {};
    const float wide = near * edge / (d.y > 0.08f ? d.y : 0.08f) * 256 * kCloudCoarse;
    const float level = wide > 1 ? std::log2(wide) : 0.0f;
    const Vec3 towards = sky.cloud_direction;
    const float phase = cloud_phase(dot(d, towards));
    float far = way_to_shell(d.y, above + kCloudThick);
    far = far < near + 4 * kCloudThick ? far : near + 4 * kCloudThick;
    const float stride = (far - near) / float(sky.cloud_steps);
    const float lean = kCloudThick / (towards.y > 0.22f ? towards.y : 0.22f);
    Vec3 light;
    float through = 1;
    for (u32 i = 0; i < sky.cloud_steps; ++i) {
        const float t = near + stride * (float(i) + dither);
        const float high = clamp((t * d.y + t * t * (0.5f / kCloudGlobe) - above) / kCloudThick, 0.0f, 1.0f);
        const Vec2 at{sky.cloud_place.x + d.x * t, sky.cloud_place.y + d.z * t};
        const float shape = cloud_shape(sky.cloud_noise, at, level);
        if (shape <= 0) continue;
        // Flat below, heaped above: the higher, the more of the shape is gone.
        const float low = 0.12f - high, heap = shape * 1.45f - high * high * 1.1f - (low > 0 ? low : 0) * 3;
        const float most = heap > 0 ? heap : 0;
        if (most <= 0.004f) continue; // details only take away
        const float slow = sky.seconds * 0.0005f;
        const float fine = scene::cloud_noise_at(
            sky.cloud_noise, 1,
            {at.x * kCloudFine * 2 + high * 0.13f + slow, at.y * kCloudFine * 2 - high * 0.09f + slow}, level + 2);
        const float density = clamp(heap - (1 - fine) * (0.50f + 0.25f * high), 0.0f, 1.0f);
        if (density <= 0.004f) continue;
        // What stands towards the light, by two looks; less of it the higher we are.
        const auto ahead = [&](float share, float more) {
            const Vec2 there{at.x + towards.x * (lean * share), at.y + towards.z * (lean * share)};
            const float up = high + share;
            const float d2 = cloud_shape(sky.cloud_noise, there, level + more) * 1.45f - up * up * 1.1f - 0.22f;
            return d2 > 0 ? d2 : 0.0f;
        };
        const float depth = density * 0.9f + ahead(0.22f, 0) * 2.1f + ahead(0.65f, 1) * 2.6f;
        // Light that was scattered many times goes deeper (an octave of Wrenninge et al. 2013).
        const float direct = exp_of(-depth * 1.25f) * phase + 0.42f * exp_of(-depth * 0.30f);
        const Vec3 lit = sky.cloud_light * (direct * 1.25f) +
                         lerp(sky.below, sky.above, 0.35f + 0.65f * high) * (0.62f + 0.38f * high);
        const float passes = exp_of(-density * stride * 0.030f);
        light += lit * (through * (1 - passes));
        through *= passes;
        if (through < 0.02f) {
            through = 0;
            break;
        }
    }
    return {light * haze, lerp(1.0f, through, haze)};
}

} // namespace vitrail::trace
