// Sun, moon and dome as lights: as much irradiance as the sky says.
#include "scene/sky.h"
#include "trace/kernel/sampler.h"
#include "trace/kernel/sky.h"

#include <gtest/gtest.h>

namespace vitrail::trace {

TEST(SkyLight, DiscGivesTheSunsIrradiance) {
    SkyView sky;
    sky.sun_light = {1.5f, 1.2f, 0.9f};
    for (float radius : {0.005f, 0.030f, 0.2f})
        for (const Vec3 towards : {normalized({0.3f, 0.8f, 0.2f}), Vec3{0, 1, 0}, normalized({-1, 0.05f, 0})}) {
            sky.light_radius = radius, sky.light_direction = towards;
            // What faces the light: irradiance over pi is sun_light. By samples, and by summing over the disc.
            double sampled = 0, summed = 0;
            constexpr u32 count = 4096, rings = 64;
            for (u32 i = 0; i < count; ++i) {
                Sampler s = make_sampler(0, 0, i, 1);
                const SunSample sun = sample_sun(sky, next_2d(s));
                EXPECT_NEAR(length(sun.dir), 1, 1e-5);
                EXPECT_LT(length(sun.dir - towards), 2 * std::sin(radius / 2) + 1e-6);
                sampled += double(dot(sun.dir, towards) * sun.radiance.y / (sun.pdf * kPi)) / count;
            }
            const Frame f = frame_of(towards);
            for (u32 i = 0; i < rings; ++i)
                for (u32 k = 0; k < rings; ++k) {
                    const float angle = radius * 1.1f * (float(i) + 0.5f) / rings;
                    const Vec2 turn = on_circle((float(k) + 0.5f) / rings);
                    const Vec3 d = to_world(f, {std::sin(angle) * turn.x, std::sin(angle) * turn.y, std::cos(angle)});
                    summed += double(sun_radiance(sky, d).y * std::cos(angle) * std::sin(angle)) * 2 * double(radius) *
                              1.1 / (rings * rings);
                    EXPECT_EQ(sun_pdf(sky, d) > 0, sun_radiance(sky, d).y > 0);
                }
            EXPECT_NEAR(sampled, 1.2, 0.002) << radius;
            EXPECT_NEAR(summed, 1.2, 0.04) << radius;
            // pdf: even over the disc.
            EXPECT_NEAR(sun_pdf(sky, towards) * 2 * kPi * (1 - std::cos(double(radius))), 1, 0.02) << radius;
        }
    sky.sun_light = {};
    EXPECT_EQ(sample_sun(sky, {0.5f, 0.5f}).pdf, 0);
    EXPECT_EQ(sun_pdf(sky, sky.light_direction), 0);
}

// Lit from all around as scene::surrounding_light says, hour by hour.
TEST(SkyLight, DomeAndGroundAreTheScenes) {
    for (float time : {300.0f, 6000.0f, 12500.0f, 18000.0f}) {
        const scene::SkyState state = scene::sky_at(time);
        SkyView sky;
        sky.dome = &state.dome;
        sky.sun_azimuth = state.sun_azimuth;
        sky.ground = scene::surrounding_light(state, {0, -1, 0});
        for (u32 i = 0; i < 300; ++i) {
            Sampler s = make_sampler(1, 2, i, 3);
            const Vec2 u = next_2d(s);
            const float y = 1 - 2 * u.x, r = std::sqrt(1 - y * y);
            const Vec3 d{r * on_circle(u.y).x, y, r * on_circle(u.y).y};
            const Vec3 a = sky_light(sky, d), b = scene::surrounding_light(state, d);
            EXPECT_NEAR(a.x, b.x, 1e-6f);
            EXPECT_NEAR(a.z, b.z, 1e-6f);
        }
        sky.open = false;
        EXPECT_EQ(sky_light(sky, {0, 1, 0}).y, sky.ground.y);
    }
}

} // namespace vitrail::trace
