#include "base/rng.h"
#include "math/color.h"
#include "scene/atmosphere.h"
#include "scene/sky.h"

#include <gtest/gtest.h>

namespace vitrail::scene {

static constexpr double kPi = 3.14159265358979;

static std::vector<Vec3> normals() {
    std::vector<Vec3> out{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    for (int i = 0; i < 40; ++i) { // a Fibonacci sphere
        const float y = 1 - (float(i) + 0.5f) / 20, flat = std::sqrt(1 - y * y), turn = 2.3999632f * float(i);
        out.push_back({flat * std::cos(turn), y, flat * std::sin(turn)});
    }
    return out;
}

TEST(SkyTable, TexelsStandWhereTheySay) {
    SkyTable table{};
    for (u32 i = 0; i < SkyTable::kWidth * SkyTable::kHeight; ++i)
        table.texels[i] = {float(i), 0, 0};
    const Vec2 azimuth{0.6f, -0.8f};
    for (u32 row = 0; row < SkyTable::kHeight - 1; ++row)
        for (u32 column = 0; column < SkyTable::kWidth; ++column) {
            const float s = float(column) / (SkyTable::kWidth - 1), along = 1 - 2 * s * s,
                        across = std::sqrt(1 - along * along), v = float(row) / (SkyTable::kHeight - 1), y = v * v,
                        flat = std::sqrt(1 - y * y);
            for (float side : {-1.0f, 1.0f}) {
                const Vec3 d{flat * (along * azimuth.x - side * across * azimuth.y), y,
                             flat * (along * azimuth.y + side * across * azimuth.x)};
                const float found = sky_table_at(table, sky_table_place(d, azimuth)).x;
                ASSERT_NEAR(found, float(row * SkyTable::kWidth + column), 0.15f);
            }
        }
    double sphere = 0;
    for (u32 row = 0; row < SkyTable::kHeight; ++row)
        for (u32 column = 0; column < SkyTable::kWidth; ++column)
            sphere += double(sky_texel_solid_angle(column, row));
    EXPECT_NEAR(sphere, 2 * kPi, 1e-4);
}

// Straight up the way through the air has a closed form.
TEST(Atmosphere, LightFromTheZenithLosesWhatTheAirTakes) {
    const Vec3 left = light_through_air(1);
    const double rayleigh[3] = {5.802e-3, 13.558e-3, 33.1e-3}, ozone[3] = {0.650e-3, 1.881e-3, 0.085e-3};
    const float* found = &left.x;
    for (int k = 0; k < 3; ++k) {
        const double depth =
            rayleigh[k] * 8 * std::exp(-0.25 / 8) + 4.44e-3 * 1.2 * std::exp(-0.25 / 1.2) + ozone[k] * 15;
        EXPECT_NEAR(double(found[k]), std::exp(-depth), 0.003);
    }
    for (float sine = -0.05f; sine < 0.999f; sine += 0.01f) { // higher is brighter, and bluer
        const Vec3 low = light_through_air(sine), high = light_through_air(sine + 0.01f);
        ASSERT_LE(low.x, high.x + 1e-6f);
        ASSERT_LE(low.z, high.z + 1e-6f);
        ASSERT_LE(low.z * high.x, high.z * low.x + 1e-5f);
    }
    EXPECT_EQ(luminance_of(light_through_air(-0.05f)), 0);
}

// Walks photons backwards through the same air by chance, every scattering followed, ground and curvature included.
static Vec3 sky_by_chance(double sine, u32 walks) {
    constexpr double ground = 6360, top = 6460;
    const double rayleigh[3] = {5.802e-3, 13.558e-3, 33.1e-3}, ozone[3] = {0.650e-3, 1.881e-3, 0.085e-3};
    struct P {
        double x, y, z;
    };
    const auto dot3 = [](P a, P b) { return a.x * b.x + a.y * b.y + a.z * b.z; };
    const P sun{std::sqrt(1 - sine * sine), sine, 0};
    Rng rng(7);
    const auto unit = [&] { return double(rng.unit()); };
    float result[3];
    for (int k = 0; k < 3; ++k) {
        const auto extinction = [&](double h, double& scatter_r, double& scatter_m) {
            scatter_r = rayleigh[k] * std::exp(-h / 8), scatter_m = 3.996e-3 * std::exp(-h / 1.2);
            return scatter_r + 4.44e-3 * std::exp(-h / 1.2) + ozone[k] * std::max(0.0, 1 - std::abs(h - 25) / 15);
        };
        const auto boundary = [&](P p, P d, bool& hits_ground) {
            const double b = dot3(p, d), c = dot3(p, p), g = b * b - c + ground * ground;
            hits_ground = b < 0 && g > 0;
            return hits_ground ? -b - std::sqrt(g) : -b + std::sqrt(b * b - c + top * top);
        };
        const auto through = [&](P p) { // towards the sun, by fine steps
            bool blocked;
            const double d = boundary(p, sun, blocked);
            if (blocked) return 0.0;
            double depth = 0, r, m;
            for (int i = 0; i < 60; ++i) {
                const double a = i / 60.0, b = (i + 1) / 60.0, t = d * (a * a + b * b) / 2;
                const P q{p.x + sun.x * t, p.y + sun.y * t, p.z + sun.z * t};
                depth += extinction(std::sqrt(dot3(q, q)) - ground, r, m) * d * (b * b - a * a);
            }
            return std::exp(-depth);
        };
        const auto towards = [&](P axis, double cosine) {
            const double turn = 2 * kPi * unit(), flat = std::sqrt(std::max(1 - cosine * cosine, 0.0));
            const P helper = std::abs(axis.y) < 0.9 ? P{0, 1, 0} : P{1, 0, 0};
            P a{axis.y * helper.z - axis.z * helper.y, axis.z * helper.x - axis.x * helper.z,
                axis.x * helper.y - axis.y * helper.x};
            const double l = std::sqrt(dot3(a, a));
            a = {a.x / l, a.y / l, a.z / l};
            const P b{axis.y * a.z - axis.z * a.y, axis.z * a.x - axis.x * a.z, axis.x * a.y - axis.y * a.x};
            const double c = flat * std::cos(turn), s = flat * std::sin(turn);
            return P{axis.x * cosine + a.x * c + b.x * s, axis.y * cosine + a.y * c + b.y * s,
                     axis.z * cosine + a.z * c + b.z * s};
        };
        const auto phase_m = [](double nu) {
            const double g = 0.8;
            return 3 / (8 * kPi) * (1 - g * g) / (2 + g * g) * (1 + nu * nu) / std::pow(1 + g * g - 2 * g * nu, 1.5);
        };
        double sum = 0;
        const double most = rayleigh[k] + 4.44e-3 + ozone[k];
        for (u32 w = 0; w < walks; ++w) {
            P p{0, ground + 0.25, 0}, d = towards({0, 1, 0}, std::sqrt(unit())); // cosine-weighted: the mean itself
            double weight = 1;
            for (int bounce = 0; bounce < 40 && weight > 1e-4; ++bounce) {
                bool hits_ground;
                const double end = boundary(p, d, hits_ground);
                double t = 0, r = 0, m = 0, e = 0;
                for (;;) { // delta tracking
                    t -= std::log(1 - unit()) / most;
                    if (t >= end) break;
                    const P q{p.x + d.x * t, p.y + d.y * t, p.z + d.z * t};
                    e = extinction(std::max(std::sqrt(dot3(q, q)) - ground, 0.0), r, m);
                    if (unit() * most < e) break;
                }
                if (t >= end) {
                    if (!hits_ground) break;
                    p = {p.x + d.x * end, p.y + d.y * end, p.z + d.z * end};
                    const double l = std::sqrt(dot3(p, p));
                    const P n{p.x / l, p.y / l, p.z / l};
                    p = {n.x * (ground + 1e-3), n.y * (ground + 1e-3), n.z * (ground + 1e-3)};
                    weight *= 0.25;
                    sum += weight / kPi * std::max(dot3(n, sun), 0.0) * through(p);
                    d = towards(n, std::sqrt(unit()));
                    continue;
                }
                p = {p.x + d.x * t, p.y + d.y * t, p.z + d.z * t};
                weight *= (r + m) / e;
                const double nu = dot3(d, sun);
                sum += weight * through(p) * (r * 3 / (16 * kPi) * (1 + nu * nu) + m * phase_m(nu)) / (r + m);
                if (unit() * (r + m) < r) { // a new direction by the phase function, by rejection
                    double c;
                    do
                        c = 2 * unit() - 1;
                    while (unit() * 2 > 1 + c * c);
                    d = towards(d, c);
                } else {
                    const double g = 0.8, x = (1 - g * g) / (1 - g + 2 * g * unit());
                    d = towards(d, std::clamp((1 + g * g - x * x) / (2 * g), -1.0, 1.0));
                }
            }
        }
        result[k] = float(sum / walks);
    }
    return {result[0], result[1], result[2]};
}

TEST(Atmosphere, DomeIsAsBrightAsPhotonsWalkedByChance) {
    for (float sine : {0.85f, 0.35f}) {
        const Vec3 walked = sky_by_chance(double(sine), 6000);
        EXPECT_NEAR(clear_sky_brightness(sine) / luminance_of(walked), 1, 0.10) << "sine " << sine;
        SkyTable dome{};
        add_clear_sky(dome, sine, false, {}, {1, 1, 1});
        Vec3 mean;
        for (u32 row = 0; row < SkyTable::kHeight; ++row)
            for (u32 column = 0; column < SkyTable::kWidth; ++column) {
                const float v = float(row) / (SkyTable::kHeight - 1);
                mean += dome.texels[row * SkyTable::kWidth + column] *
                        (v * v * sky_texel_solid_angle(column, row) / float(kPi));
            }
        EXPECT_NEAR(luminance_of(mean), 1, 0.01);
        EXPECT_NEAR(mean.z / mean.x / (walked.z / walked.x), 1, 0.12) << "its color";
    }
}

// What shaders read of nine numbers is the integral over every direction.
TEST(Sky, IrradianceIsTheIntegralOfWhatSurrounds) {
    for (float time : {300.0f, 2500.0f, 6000.0f, 11700.0f, 12150.0f, 12500.0f, 13500.0f, 18000.0f, 23300.0f}) {
        const SkyState sky = sky_at(time, 1);
        const auto all = normals();
        std::vector<Vec3> sums(all.size());
        constexpr int rings = 120, sectors = 120;
        for (int ring = 0; ring < rings; ++ring)
            for (int sector = 0; sector < sectors; ++sector) {
                // Rings crowd at the horizon, where the dome changes fast.
                const auto edge = [](int i) {
                    const float x = 2 * float(i) / rings - 1;
                    return x * std::abs(x);
                };
                const float y = 0.5f * (edge(ring) + edge(ring + 1)), flat = std::sqrt(1 - y * y);
                const float turn = 6.2831853f * (float(sector) + 0.5f) / sectors;
                const Vec3 d{flat * std::cos(turn), y, flat * std::sin(turn)};
                const Vec3 light =
                    surrounding_light(sky, d) * ((edge(ring + 1) - edge(ring)) * 2 / float(sectors)); // over pi
                for (std::size_t i = 0; i < all.size(); ++i)
                    sums[i] += light * std::max(dot(all[i], d), 0.0f);
            }
        float most = 0;
        for (const Vec3& s : sums)
            most = std::max(most, luminance_of(s));
        double off = 0;
        for (std::size_t i = 0; i < all.size(); ++i) {
            const Vec3 found = irradiance_of(sky.irradiance, all[i]);
            EXPECT_GT(std::min({found.x, found.y, found.z}), 0) << time;
            EXPECT_NEAR(luminance_of(found) / most, luminance_of(sums[i]) / most, 0.06)
                << "time " << time << " normal " << all[i].x << ' ' << all[i].y << ' ' << all[i].z;
            off += double(std::abs(luminance_of(found) - luminance_of(sums[i])) / most);
        }
        EXPECT_LT(off / double(all.size()), 0.03) << time;
        EXPECT_NEAR(luminance_of(sky.ambient) / luminance_of(sums[2]), 1, 0.02);
    }
}

TEST(Sky, WestFacesGlowAtDuskAndEastFacesAtDawn) {
    const auto ratio = [](float time) {
        const SkyState sky = sky_at(time);
        return luminance_of(irradiance_of(sky.irradiance, {-1, 0, 0})) /
               luminance_of(irradiance_of(sky.irradiance, {1, 0, 0}));
    };
    for (float time : {12150.0f, 12250.0f, 12400.0f, 12600.0f})
        EXPECT_GT(ratio(time), 1.5f) << time;
    for (float time : {23850.0f, 23600.0f})
        EXPECT_LT(ratio(time), 1 / 1.5f) << time;
    EXPECT_NEAR(ratio(6000), 1, 0.01);
}

TEST(Sky, SunsetIsOrangeAtTheSunAndPinkOverTheEarthsShadowOpposite) {
    const SkyState sky = sky_at(12200);
    const Vec3 west = sky_color(sky, normalized({-1, 0.05f, 0})), east_low = sky_color(sky, normalized({1, 0.02f, 0})),
               east = sky_color(sky, normalized({1, 0.25f, 0}));
    EXPECT_GT(west.x, 2 * west.y);
    EXPECT_GT(west.y, 2 * west.z);
    EXPECT_GT(east.x, 1.3f * east.y); // the belt of Venus
    EXPECT_GT(east.z, 1.1f * east.y);
    EXPECT_LT(luminance_of(east_low), luminance_of(east)); // the shadow
    EXPECT_LT(east_low.x / east_low.z, 0.8f * east.x / east.z);
    const Vec3 zenith = sky_color(sky_at(12650), {0, 1, 0}); // the blue hour
    EXPECT_GT(zenith.z, 1.8f * zenith.x);
    const Vec3 noon = sky_color(sky_at(6000), {0, 1, 0});
    EXPECT_GT(noon.z, 2 * noon.x);
}

// The unit of sky.h.
TEST(Sky, WhiteSendsBackTwoAtNoon) {
    const SkyState noon = sky_at(6000), midnight = sky_at(18000, 0), dark = sky_at(18000, 4);
    const auto white = [](const SkyState& sky) {
        return luminance_of(sky.ambient) + luminance_of(sky.sun_light) * std::abs(sky.sun_direction.y);
    };
    EXPECT_NEAR(white(noon), 2, 0.1);
    EXPECT_NEAR(luminance_of(noon.ambient), 0.5, 0.12);
    EXPECT_NEAR(white(midnight), 2.0 / 22, 0.03);
    EXPECT_NEAR(white(dark) / white(midnight), 0.36, 0.12);
}

TEST(Sky, MoonPhasesFollowTheDays) {
    for (u64 day = 0; day < 24; ++day) {
        EXPECT_EQ(sky_at(18000, day).moon_phase, day % 8);
        EXPECT_EQ(sky_at(23999, day).moon_phase, sky_at(0, day + 1).moon_phase) << "no change in sight of the moon";
        EXPECT_EQ(sky_at(5999, day + 1).moon_phase, day % 8);
    }
}

TEST(Sky, NothingJumps) {
    SkyState a = sky_at(0, 3);
    for (float t = 10; t <= 24000; t += 10) {
        const SkyState b = sky_at(t, t < 24000 ? 3 : 4);
        const float scale = luminance_of(a.ambient) + luminance_of(a.sun_light);
        const auto near = [&](Vec3 x, Vec3 y) { return length(x - y) < 0.12f * scale; };
        ASSERT_LT(length(a.sun_light - b.sun_light), std::min(0.06f, 0.16f * scale)) << "at " << t;
        ASSERT_TRUE(near(a.ambient, b.ambient)) << "at " << t;
        for (u32 i = 0; i < 9; ++i)
            ASSERT_TRUE(near(a.irradiance.c[i], b.irradiance.c[i])) << "at " << t;
        for (Vec3 d : {Vec3{0, 1, 0}, Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0.6f, 0, 0.8f}, Vec3{-0.6f, 0.64f, 0.48f}})
            ASSERT_LT(length(sky_color(a, d) - sky_color(b, d)), 0.35f * length(sky_color(a, d)) + 0.02f * scale)
                << "at " << t;
        // Direct light is gone when sun and moon take over from each other.
        if (std::abs(a.sun_direction.y) < 0.01f) {
            ASSERT_LT(length(a.sun_light), 0.2f) << "at " << t;
        }
        a = b;
    }
}

} // namespace vitrail::scene
