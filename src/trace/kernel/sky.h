// Light from beyond the land. Two ways to look at the same sky: sky_seen() is the picture that the raster renderer
// draws, for the eye and for mirrors; sky_light() is what lights things, with the disc of sun or moon apart
// (sample_sun), so that none is counted twice. A path that met anything but mirrors takes sky_light, and sun_radiance
// by its share in multiple importance sampling. Kernel-safe.
#pragma once

#include "trace/kernel/microfacet.h"
#include "trace/kernel/sky_clouds.h"
#include "trace/kernel/sky_discs.h"
#include "trace/kernel/sky_stars.h"
#include "trace/kernel/sky_view.h"

namespace vitrail::trace {

VX_HD Vec3 sky_dome(const SkyView& sky, Vec3 dir) {
    return scene::sky_table_at(*sky.dome, scene::sky_table_place(dir, sky.sun_azimuth));
}

// What lights things: the dome, and below the horizon the land; without the disc, which sample_sun() knows.
VX_HD Vec3 sky_light(const SkyView& sky, Vec3 dir) {
    if (!sky.open || dir.y < 0) return sky.ground;
    return sky_dome(sky, dir);
}

// Dome, stars, moon, sun, clouds, from far to near, without the mist before them (kernel/air.h). edge: radians of a
// pixel; dither: 0..1, any number: hides the steps of the clouds' march.
VX_HD_CALL Vec3 sky_seen(const SkyView& sky, Vec3 dir, float edge, float dither = 0.5f) {
    if (!sky.open) return sky.ground;
    const float above = clamp(dir.y / edge + 0.5f, 0.0f, 1.0f); // the horizon hides what has set
    Vec3 color = lerp(sky_dome(sky, dir), sky.below, smoothstep(-0.02f, -0.45f, dir.y) * 0.8f);
    if (above > 0) {
        if (sky.stars > 0 || sky.moon_direction.y > -0.15f) {
            const MoonSeen moon = moon_seen(sky, dir, edge);
            if (sky.stars > 0 && sky.star_field && moon.cover < 1)
                color += stars_seen(sky, dir, edge) * (sky.stars * (1 - moon.cover));
            color += moon.light * above;
        }
        color += sun_seen(sky, dir, edge) * above;
    }
    const CloudsSeen clouds = clouds_seen(sky, dir, edge, dither);
    return color * clouds.through + clouds.light;
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
