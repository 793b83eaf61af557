// Water as physics sees it, for raster and tracer alike: waves of its surface in world space, and what light loses on
// its way through. Shaders have the same in render/passes/water/waves.glsl and medium.glsl (a test compares them).
// Kernel-safe: values only.
#pragma once

#include "math/exp.h"
#include "math/vec.h"
#include "voxel/coords.h"

namespace vitrail::scene {

// Waves repeat after this many blocks along x and z and after as many seconds, exactly: a place of the world modulo the
// period has the same waves everywhere, in every section and at 2^31.
inline constexpr i32 kWavePeriod = 256;
inline constexpr u32 kSwells = 4, kRipples = 8;

// Sines: whole numbers of periods along x and z and in time; height is a share of the greatest height (swells, which
// sum to 1) or of 1 block at a wave height of 0.06 (ripples, which the geometry is too coarse to follow: they only
// tilt).
struct Wave {
    i32 x, z, t;
    float height;
};
struct WaveTable {
    Wave waves[kSwells + kRipples];
};
VX_HD constexpr WaveTable wave_table() { // by a function: device code knows no tables of the host
    return {{
        {15, 5, 44, 0.40f},
        {14, 21, 55, 0.30f},
        {38, 2, 68, 0.18f},
        {39, 40, 82, 0.12f},
        {19, 73, 95, 0.0150f},
        {95, 32, 110, 0.0122f},
        {-52, 122, 127, 0.0094f},
        {171, -31, 145, 0.0072f},
        {137, 180, 165, 0.0056f},
        {190, -229, 190, 0.0042f},
        {-119, 367, 216, 0.0030f},
        {421, 287, 249, 0.0020f},
    }};
}

struct WaveSurface {
    float swell = 0, ripple = 0; // blocks above the level surface; geometry is moved by the swell alone
    Vec2 slope;                  // of swell + ripple along x and z
};
// place: the block of the world; inside: 0..1 in it (any number); seconds: since the start; wave_height: blocks, the
// most that the swell rises or falls.
VX_HD WaveSurface wave_at(BlockPos place, Vec2 inside, float seconds, float wave_height) {
    constexpr float kTurn = 6.2831853f, kPer = 1.0f / float(kWavePeriod);
    constexpr WaveTable kTable = wave_table();
    const float x = float(place.x & (kWavePeriod - 1)) + inside.x, z = float(place.z & (kWavePeriod - 1)) + inside.y;
    const float t = std::fmod(seconds, float(kWavePeriod));
    WaveSurface out;
    for (u32 i = 0; i < kSwells + kRipples; ++i) {
        const Wave& w = kTable.waves[i];
        float turns = (float(w.x) * x + float(w.z) * z - float(w.t) * t) * kPer;
        turns -= std::floor(turns);
        const float height = i < kSwells ? w.height * wave_height : w.height * (wave_height / 0.06f);
        (i < kSwells ? out.swell : out.ripple) += height * std::sin(turns * kTurn);
        const float steep = height * kTurn * kPer * std::cos(turns * kTurn);
        out.slope.x += steep * float(w.x), out.slope.y += steep * float(w.z);
    }
    return out;
}

// Of two numbers, one along x and one along z.
struct Covariance {
    float xx = 0, xz = 0, zz = 0;
};

// A Gaussian patch of the level surface through which waves are looked at: covariance of its places along x and z,
// squared blocks. All 0: a point.
using WaveFilter = Covariance;
// The patch that a cone `width` blocks wide sees there, which comes along `dir` (unit): half as wide as the cone each
// way from the middle, and stretched along the ray, the more the flatter it comes.
VX_HD WaveFilter wave_filter(Vec3 dir, float width) {
    const float s2 = 0.25f * width * width, y2 = dir.y * dir.y, stretched = s2 / (y2 > 1e-6f ? y2 : 1e-6f);
    return {s2 + stretched * dir.x * dir.x, stretched * dir.x * dir.z, s2 + stretched * dir.z * dir.z};
}

// Waves of a patch: the mean of their slopes, and the covariance of slopes around it. A sine that a Gaussian filters
// keeps e^(-k C k / 2) of its height (k: turns of its phase a block), and its slope's variance over all places is half
// its squared steepness; what the mean does not show of that is spread: so moments of slopes stay as they are (Olano
// and Baker, "LEAN Mapping", 2010; Bruneton, Neyret and Holzschuch, "Real-time Realistic Ocean Lighting using Seamless
// Transitions from Geometry to BRDF", 2010).
struct WavesSeen {
    Vec2 slope;
    Covariance spread;
};
// As wave_at; the slope is its within 2e-5 where the patch is a point.
VX_HD WavesSeen waves_seen(BlockPos place, Vec2 inside, float seconds, float wave_height, WaveFilter filter) {
    constexpr float kTurn = 6.2831853f, kPer = 1.0f / float(kWavePeriod);
    constexpr WaveTable kTable = wave_table();
    const float x = float(place.x & (kWavePeriod - 1)) + inside.x, z = float(place.z & (kWavePeriod - 1)) + inside.y;
    const float t = std::fmod(seconds, float(kWavePeriod));
    WavesSeen out;
    for (u32 i = 0; i < kSwells + kRipples; ++i) {
        const Wave& w = kTable.waves[i];
        const float kx = kTurn * kPer * float(w.x), kz = kTurn * kPer * float(w.z);
        const float height = i < kSwells ? w.height * wave_height : w.height * (wave_height / 0.06f);
        const float seen = exp_of(-0.5f * (kx * kx * filter.xx + 2 * kx * kz * filter.xz + kz * kz * filter.zz));
        float turns = (float(w.x) * x + float(w.z) * z - float(w.t) * t) * kPer;
        turns -= std::floor(turns);
        // The cosine by the sine's series on a quarter turn.
        const float a = kTurn * (0.25f - std::fabs(turns - 0.5f)), a2 = a * a;
        const float cosine =
            -a * (1 - a2 * (1.0f / 6) * (1 - a2 * (1.0f / 20) * (1 - a2 * (1.0f / 42) * (1 - a2 * (1.0f / 72)))));
        out.slope.x += height * seen * cosine * kx, out.slope.y += height * seen * cosine * kz;
        const float lost = 0.5f * height * height * (1 - seen * seen);
        out.spread.xx += lost * kx * kx, out.spread.xz += lost * kx * kz, out.spread.zz += lost * kz * kz;
    }
    return out;
}

// What light loses a block (base e, by color) in water of this tint (sRGB 0..1): what the tint lacks is absorbed.
struct LiquidOptics {
    Vec3 absorption, scattering;
};
VX_HD LiquidOptics water_optics(Vec3 tint_srgb) {
    const auto absorbed = [](float srgb) {
        const float c = clamp(srgb, 0.0f, 1.0f);
        const float linear = c * (c * (c * 0.305306011f + 0.682171111f) + 0.012522878f);
        return -0.085f * std::log(linear > 0.012f ? linear : 0.012f);
    };
    // However blue a tint: what takes green takes some blue too, else deep water would be violet.
    const float green = absorbed(tint_srgb.y), blue = absorbed(tint_srgb.z), least = 0.35f * green;
    return {Vec3{absorbed(tint_srgb.x), green, blue > least ? blue : least} + Vec3{0.030f, 0.030f, 0.025f},
            {0.030f, 0.034f, 0.038f}};
}

} // namespace vitrail::scene
