// Light scattered once towards the eye by mist or by what floats in water: a place on a stretch of a ray, and a
// direction from it to the sun, the sky or a lamp (air.h says how much). Kernel-safe.
#pragma once

#include "trace/kernel/air.h"
#include "trace/kernel/passage.h"

namespace vitrail::trace {

struct Speck {
    float distance = 0;
    Vec3 weight;           // what light that comes in there counts for
    bool scatters = false; // false: there is none
};

// Thin air is asked seldom, and counts more then.
inline constexpr float kThinAir = 0.1f;

struct Stretch {
    Speck speck;
    Vec3 left{1, 1, 1}; // share of the light behind it that passes
};

// What air does on such a way, the same for all colors; weight 0: nothing scatters.
struct AirCrossing {
    float left = 1, t = 0, weight = 0;
};
// above: over the sea at its start, rise: of its direction.
VX_HD void cross_air(const SkyView& sky, float above, float rise, float length, float u, AirCrossing& out) {
    AirStretch air;
    set_stretch(sky, above, rise, length, air);
    out.left = air_passes(air);
    const float takes = air.haze_takes + air.mist_takes;
    const float asked = takes < kThinAir ? takes * (1 / kThinAir) : 1.0f;
    if (takes > 1e-6f && u < asked) {
        AirPoint p;
        find_air_point(air, u / asked < kBelowOne ? u / asked : kBelowOne, p);
        out.t = p.t, out.weight = p.weight / asked;
    }
}
VX_HD Stretch stretch_of(const AirCrossing& air) {
    return {{air.t, {air.weight, air.weight, air.weight}, air.weight > 0}, {air.left, air.left, air.left}};
}

// A ray's way of `length` blocks (kFar: up to the sky) through mist or a medium. u: 0..1, where it scatters.
VX_COLD Stretch cross_stretch(const SceneView& s, const SkyView& sky, const Ray& ray, float length, u32 medium,
                              float u) {
    if (medium == 0) {
        AirCrossing air;
        cross_air(sky, above_sea(sky, ray.from), ray.dir.y, length, u, air);
        return stretch_of(air);
    }
    Stretch out;
    const scene::LiquidOptics optics = medium_optics(s, ray.from, medium);
    if (greatest(optics.scattering) > 0) {
        const LiquidPoint p = sample_liquid_point(optics.absorption, optics.scattering, length, u);
        out.speck = {p.t, p.weight, p.pdf > 0};
    }
    out.left = liquid_passes(optics.absorption, length);
    return out;
}

// A direction from there to a light, and what it brings to the eye if nothing is in its way. False: nothing.
VX_COLD bool aim_speck(const SceneView& s, const SkyView& sky, bool lamps, const Ray& ray, u32 medium,
                       const Speck& speck, float choose, float which, Vec2 u, Place& from, Vec3& dir, float& distance,
                       Vec3& value) {
    from = moved(ray.from, ray.dir, speck.distance);
    distance = kFar;
    const bool even = medium != 0;
    const float to_sun = greatest(sky.sun_light) > 0 ? 0.5f : 0.0f, to_lamp = lamps ? 0.25f : 0.0f;
    if (choose < to_sun) {
        const SunSample sun = sample_sun(sky, u);
        dir = sun.dir;
        value = sun.radiance * (1 / (sun.pdf * to_sun));
    } else if (choose < to_sun + to_lamp) {
        EmitterSample lamp;
        if (!sample_emitter(s, from, {}, which, u, lamp)) return false;
        dir = lamp.dir, distance = lamp.distance;
        value = lamp_emission(s, from, lamp) * (1 / (lamp.pdf * to_lamp));
    } else {
        if (even) {
            const float y = 1 - 2 * u.x, r = std::sqrt(clamp(1 - y * y, 0.0f, 1.0f));
            const Vec2 turn = on_circle(u.y);
            dir = {r * turn.x, y, r * turn.y};
        } else {
            dir = sample_air_phase(ray.dir, u);
        }
        value = speck.weight * sky_light(sky, dir) * (1 / (1 - to_sun - to_lamp));
        return true;
    }
    value = value * speck.weight * (even ? 0.25f / kPi : air_phase(dot(dir, ray.dir)));
    return true;
}

} // namespace vitrail::trace
