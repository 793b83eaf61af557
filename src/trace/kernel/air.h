// Air and liquids on the eye's way: what they leave of the light behind, where along the way they scatter light towards
// the eye, and in which directions. Scattered once: light that reaches the scattering place is not dimmed again, so
// that white fog under a white sky is white. Kernel-safe.
//
//     const AirStretch air = air_stretch(sky, from, dir, t);
//     const AirPoint at = sample_air_point(air, u);   // light from w there reaches the eye as at.weight * air_phase *
//     L(w) background *= air_passes(air); surface: lerp(light, sky_dome(sky, dir), far_share(sky, distance)), then the
//     air before it
#pragma once

#include "scene/mist_air.h"
#include "trace/kernel/microfacet.h"
#include "trace/kernel/sky.h"

namespace vitrail::trace {

// 1 - exp(-x) and its inverse, x >= 0, exact where small.
VX_HD float taken_by(float depth) {
    return depth < 1e-2f ? depth * (1 - depth * (0.5f - depth * (1.0f / 6))) : 1 - exp_of(-depth);
}
VX_HD float depth_of(float taken) {
    return taken < 1e-2f ? taken * (1 + taken * (0.5f + taken * (1.0f / 3)))
                         : -log_of(1 - (taken < 0.9999999f ? taken : 0.9999999f));
}

struct AirStretch {
    scene::Mist mist;
    float above = 0, rise = 0, length = 0; // blocks over the sea at its start; of the direction; blocks
    float haze_takes = 0, mist_takes = 0;  // share of light that each would take alone
};

// What follows is made of single numbers: loops over many stretches become vectors so.

VX_HD float above_sea(const SkyView& sky, Place p) {
    return float(p.cell.y - sky.sea_level) + p.at.y;
}
// A stretch of a ray, blocks; above: over the sea at its start; `length` of kFar: to the end of view.
VX_HD void set_stretch(const SkyView& sky, float above, float rise, float length, AirStretch& a) {
    a.mist = {sky.haze, sky.mist, sky.mist_height};
    a.above = above, a.rise = rise;
    a.length = length < kFar ? length : sky.view_distance;
    a.haze_takes = taken_by(a.mist.haze * a.length);
    a.mist_takes = taken_by(a.mist.mist * a.length * scene::mean_mist_density(a.mist, a.above, a.rise, a.length));
}
VX_HD AirStretch air_stretch(const SkyView& sky, Place from, Vec3 dir, float length) {
    AirStretch a;
    set_stretch(sky, above_sea(sky, from), dir.y, length, a);
    return a;
}
// Extinction a block after t blocks.
VX_HD float air_extinction(const AirStretch& a, float t) {
    return a.mist.haze + a.mist.mist * scene::mist_density(a.mist, a.above + a.rise * t);
}
// Share of light that the first t blocks leave.
VX_HD float air_passes(const AirStretch& a, float t) {
    return exp_of(-scene::mist_depth(a.mist, a.above, a.rise, t));
}
VX_HD float air_passes(const AirStretch& a) {
    return (1 - a.haze_takes) * (1 - a.mist_takes);
}

// Blocks after which the mist alone, without the haze, has this optical depth; the inverse of its integral.
VX_HD float mist_way(const AirStretch& a, float depth) {
    // Even below the sea's height; above it the column thins, and a way of optical depth d from a density e has gone
    // -height / rise log(1 - d rise / (mist height e)).
    const float m = a.mist.mist, h = a.mist.height;
    const auto thinning = [&](float e, float d) {
        const float even = d / (m * e), k = even * a.rise / h;
        if (std::abs(k) < 1e-2f) return even * (1 + k * (0.5f + k * (1.0f / 3 + k * 0.25f)));
        return k < 1 ? even * (-log_of(1 - k) / k) : a.length;
    };
    if (a.above < 0) {
        const float flat = a.rise > 0 ? m * -a.above / a.rise : kFar;
        return depth < flat ? depth / m : -a.above / a.rise + thinning(1, depth - flat);
    }
    const float e = scene::mist_density(a.mist, a.above);
    const float down = a.rise < 0 ? m * h * (1 - e) / -a.rise : kFar;
    return depth < down ? thinning(e, depth) : a.above / -a.rise + (depth - down) / m;
}

struct AirPoint {
    float t = 0;      // blocks from the stretch's start
    float weight = 0; // share of light scattered there that reaches the eye, over pdf; 0: nothing scatters
    float pdf = 0;    // per block
};

// One place where air scatters, nearly in proportion to what comes from there: haze or mist, each by its own law, and
// the pdf of both together. The weight is at most haze_takes + mist_takes; its mean is 1 - air_passes(). u: 0 <= u < 1.
VX_HD void find_air_point(const AirStretch& a, float u, AirPoint& p) {
    const float both = a.haze_takes + a.mist_takes;
    if (!(both > 1e-7f)) return;
    const float which = u * both;
    if (which < a.haze_takes)
        p.t = depth_of(which) / a.mist.haze;
    else
        p.t = mist_way(a, depth_of(clamp(which - a.haze_takes, 0.0f, a.mist_takes)));
    p.t = clamp(p.t, 0.0f, a.length);
    const float mist = a.mist.mist * scene::mist_density(a.mist, a.above + a.rise * p.t);
    const float by_haze = exp_of(-a.mist.haze * p.t),
                by_mist = exp_of(-a.mist.mist * p.t * scene::mean_mist_density(a.mist, a.above, a.rise, p.t));
    const float density = a.mist.haze * by_haze + mist * by_mist;
    p.pdf = density / both;
    if (density > 0) p.weight = (a.mist.haze + mist) * by_haze * by_mist / p.pdf;
}
VX_HD AirPoint sample_air_point(const AirStretch& a, float u) {
    AirPoint p;
    find_air_point(a, u, p);
    return p;
}

// Share of scattered light that turns by an angle of this cosine, per solid angle: forward (Henyey and Greenstein
// 1941), and a part evenly, which stands for what scatters more than once.
inline constexpr float kAirForward = 0.6f, kAirEven = 0.15f;
VX_HD float air_phase(float cosine) {
    constexpr float g = kAirForward;
    const float base = 1 + g * g - 2 * g * cosine;
    return (1 / (4 * kPi)) * (kAirEven + (1 - kAirEven) * (1 - g * g) / (base * std::sqrt(base)));
}
// A direction to look into from a place on a ray along `dir`; pdf: air_phase(dot(dir, result)). u.x chooses the part
// too.
VX_HD Vec3 sample_air_phase(Vec3 dir, Vec2 u) {
    constexpr float g = kAirForward;
    float c;
    if (u.x < kAirEven) {
        c = 1 - 2 * (u.x / kAirEven);
    } else {
        const float v = (u.x - kAirEven) / (1 - kAirEven), f = (1 - g * g) / (1 - g + 2 * g * v);
        c = clamp((1 + g * g - f * f) / (2 * g), -1.0f, 1.0f);
    }
    const float s = std::sqrt(clamp(1 - c * c, 0.0f, 1.0f));
    const Vec2 turn = on_circle(u.y);
    return to_world(frame_of(dir), {s * turn.x, s * turn.y, c});
}

// ---- A liquid, even all over; extinction and scattering a block, by color.

VX_HD Vec3 liquid_passes(Vec3 extinction, float t) {
    return {exp_of(-extinction.x * t), exp_of(-extinction.y * t), exp_of(-extinction.z * t)};
}

struct LiquidPoint {
    float t = 0;
    Vec3 weight; // as AirPoint, by color; 0: nothing scatters
    float pdf = 0;
};
// A place by one color's law, with the pdf of all three: no color's weight is more than three times what it loses.
VX_HD LiquidPoint sample_liquid_point(Vec3 extinction, Vec3 scattering, float length, float u) {
    const Vec3 e = extinction, end = length < kFar ? liquid_passes(e, length) : Vec3{};
    const float color = u * 3;
    const u32 k = color < 1 ? 0 : color < 2 ? 1 : 2;
    const float rate = k == 0 ? e.x : k == 1 ? e.y : e.z, last = k == 0 ? end.x : k == 1 ? end.y : end.z;
    LiquidPoint p;
    if (!(rate > 1e-6f) || !(last < 1)) return p;
    p.t = depth_of((color - float(k)) * (1 - last)) / rate;
    if (p.t > length) p.t = length;
    const Vec3 left = liquid_passes(e, p.t);
    const auto law = [](float r, float l, float at_end) { return at_end < 1 ? r * l / (1 - at_end) : 0.0f; };
    p.pdf = (law(e.x, left.x, end.x) + law(e.y, left.y, end.y) + law(e.z, left.z, end.z)) * (1.0f / 3);
    if (p.pdf > 0) p.weight = scattering * left * (1 / p.pdf);
    return p;
}

// ----

// How much of the land that far away has faded into the sky behind it (sky_dome), so that the end of what is loaded is
// never seen: as common/fog.glsl. Nothing fades before an eye deep in a cave.
VX_HD float far_share(const SkyView& sky, float distance) {
    const float x = distance / sky.view_distance, x2 = x * x;
    return clamp(x2 * x2 * 0.90f + 0.12f * x2, 0.0f, 1.0f) * sky.open_air;
}

} // namespace vitrail::trace
