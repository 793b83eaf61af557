// Light from beyond the land: the dome, the ground below the horizon, sun or moon. Kernel-safe.
#pragma once

#include "trace/kernel/microfacet.h"
#include "trace/kernel/sky_view.h"

namespace vitrail::trace {

// What lights things: the dome, and below the horizon the land; without the disc, which sample_sun() knows.
VX_HD Vec3 sky_light(const SkyView& sky, Vec3 dir) {
    if (!sky.open || dir.y < 0) return sky.ground;
    return scene::sky_table_at(*sky.dome, scene::sky_table_place(dir, sky.sun_azimuth));
}

// The disc of sun or moon, even all over: as bright as needed for sun_light on what faces it.
VX_HD float sun_scale(const SkyView& sky) {
    const float s = std::sin(sky.light_radius);
    return 1 / (s * s); // sun_light is irradiance over pi
}
// 1 - cosine of the disc's radius, exact where it is small.
VX_HD float sun_cap(const SkyView& sky) {
    const float s = std::sin(0.5f * sky.light_radius);
    return 2 * s * s;
}
VX_HD bool in_sun(const SkyView& sky, Vec3 dir) {
    const Vec3 off = dir - sky.light_direction; // twice the sine of half the angle
    return dot(off, off) <= 2 * sun_cap(sky) && dot(sky.sun_light, sky.sun_light) > 0;
}

struct SunSample {
    Vec3 dir;
    Vec3 radiance;
    float pdf; // per solid angle; 0: there is no such light
};

// Even over the disc's solid angle. u: 0..1.
VX_HD SunSample sample_sun(const SkyView& sky, Vec2 u) {
    if (!(dot(sky.sun_light, sky.sun_light) > 0)) return {sky.light_direction, {}, 0};
    const float cap = sun_cap(sky), h = u.x * cap, s = std::sqrt(h * (2 - h));
    const Vec2 turn = on_circle(u.y);
    const Frame f = frame_of(sky.light_direction);
    return {to_world(f, {s * turn.x, s * turn.y, 1 - h}), sky.sun_light * sun_scale(sky), 1 / (2 * kPi * cap)};
}
VX_HD float sun_pdf(const SkyView& sky, Vec3 dir) {
    return in_sun(sky, dir) ? 1 / (2 * kPi * sun_cap(sky)) : 0.0f;
}
// 0 off the disc.
VX_HD Vec3 sun_radiance(const SkyView& sky, Vec3 dir) {
    return in_sun(sky, dir) ? sky.sun_light * sun_scale(sky) : Vec3{};
}

} // namespace vitrail::trace
