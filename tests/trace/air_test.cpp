// Air and liquids: what they leave and scatter against sums over small steps.
#include "trace/kernel/air.h"
#include "trace/kernel/sampler.h"

#include <gtest/gtest.h>
#include <vector>

namespace vitrail::trace {

namespace {

struct Case {
    float haze, mist, above, rise, length;
};
std::vector<Case> cases() {
    std::vector<Case> out;
    for (float above : {-30.0f, -2.0f, 0.5f, 25.0f, 150.0f})
        for (float rise : {-0.9f, -0.1f, -1e-4f, 0.0f, 3e-3f, 0.1f, 0.9f})
            for (float length : {0.7f, 40.0f, 300.0f})
                for (const auto& [haze, mist] :
                     {std::pair{0.0018f, 0.023f}, {0.0f, 0.01f}, {0.003f, 0.0f}, {0.02f, 0.3f}})
                    out.push_back({haze, mist, above, rise, length});
    return out;
}
AirStretch stretch_of(const Case& c) {
    SkyView sky;
    sky.haze = c.haze, sky.mist = c.mist, sky.sea_level = 63;
    const float y = c.above + 63, cell = std::floor(y), flat = std::sqrt(1 - c.rise * c.rise);
    return air_stretch(sky, {{5, i32(cell), 9}, {0.5f, y - cell, 0.5f}}, {flat, c.rise, 0}, c.length);
}
double extinction(const Case& c, double t) {
    return double(c.haze) + double(c.mist) * std::exp(-std::max(double(c.above) + double(c.rise) * t, 0.0) / 10);
}

} // namespace

TEST(Air, TransmittanceIsTheIntegral) {
    for (const Case& c : cases()) {
        const AirStretch a = stretch_of(c);
        double depth = 0;
        constexpr u32 steps = 4000;
        for (u32 i = 0; i < steps; ++i)
            depth += extinction(c, (i + 0.5) / steps * double(c.length)) * double(c.length) / steps;
        EXPECT_NEAR(air_passes(a), std::exp(-depth), 2e-4) << c.above << ' ' << c.rise << ' ' << c.length;
        EXPECT_NEAR(air_passes(a, c.length), std::exp(-depth), 2e-4);
        EXPECT_NEAR(air_extinction(a, c.length * 0.3f), extinction(c, double(c.length) * 0.3), 1e-6);
    }
}

TEST(Air, WayIsTheInverseOfDepth) {
    for (const Case& c : cases()) {
        if (c.mist == 0) continue;
        const AirStretch a = stretch_of(c);
        for (float share : {0.01f, 0.3f, 0.8f, 0.999f}) {
            const float t = c.length * share;
            const float depth = c.mist * t * scene::mean_mist_density(a.mist, a.above, a.rise, t);
            if (depth < 1e-4f) continue;
            // High up there is so little mist that only the depth is well told.
            const float way = mist_way(a, depth);
            EXPECT_NEAR(c.mist * way * scene::mean_mist_density(a.mist, a.above, a.rise, way), depth, 2e-3f * depth)
                << c.above << ' ' << c.rise << ' ' << c.length;
            if (c.above + c.rise * t < 40) {
                EXPECT_NEAR(way, t, 0.01f * t + 0.02f) << c.above << ' ' << c.rise << ' ' << c.length;
            }
        }
    }
}

// What is scattered along the way, weighted by any function of the place, is the sum over small steps; and with 1 it is
// exactly what does not get through: white fog under white light loses nothing.
TEST(Air, SampledScatteringIsTheSum) {
    for (const Case& c : cases()) {
        const AirStretch a = stretch_of(c);
        double all = 0, far = 0, depth = 0, chance = 0;
        constexpr u32 steps = 2000, count = 1024;
        for (u32 i = 0; i < steps; ++i) {
            const double t = (i + 0.5) / steps * double(c.length), dt = double(c.length) / steps, e = extinction(c, t);
            const double part = std::exp(-depth) * -std::expm1(-e * dt);
            all += part, far += part * t / double(c.length), depth += e * dt;
        }
        double found = 0, found_far = 0;
        for (u32 i = 0; i < count; ++i) {
            Sampler s = make_sampler(3, 1, i, 7);
            const AirPoint p = sample_air_point(a, next_1d(s));
            ASSERT_TRUE(p.t >= 0 && p.t <= c.length && std::isfinite(p.weight));
            EXPECT_LE(p.weight, 1.02f * (a.haze_takes + a.mist_takes) + 1e-6f);
            found += double(p.weight) / count, found_far += double(p.weight * p.t / c.length) / count;
            chance += p.pdf > 0 ? double(1 / p.pdf) / count : 0;
        }
        EXPECT_NEAR(found, all, 0.006 * all + 1e-5) << c.above << ' ' << c.rise << ' ' << c.length << ' ' << c.mist;
        EXPECT_NEAR(found_far, far, 0.008 * far + 1e-5) << c.above << ' ' << c.rise << ' ' << c.length;
        EXPECT_NEAR(found + double(air_passes(a)), 1, 0.005);
        // The mean of 1 / pdf is the length: the pdf is that of the samples.
        if (c.haze > 0 && depth > 0.01 && depth < 3) {
            EXPECT_NEAR(chance, double(c.length), 0.06 * double(c.length))
                << c.above << ' ' << c.rise << ' ' << c.length;
        }
    }
}

TEST(Air, EndOfViewBoundsEndlessRays) {
    SkyView sky;
    sky.haze = 0.001f, sky.mist = 0.01f, sky.view_distance = 500;
    const AirStretch a = air_stretch(sky, {{0, 63, 0}, {0, 0, 0}}, {1, 0, 0}, kFar);
    EXPECT_NEAR(air_passes(a), std::exp(-0.011f * 500), 1e-4);
    EXPECT_EQ(far_share(sky, 0), 0);
    EXPECT_EQ(far_share(sky, 500), 1);
    EXPECT_EQ(far_share(sky, 5000), 1);
    for (float d = 10; d < 500; d += 10) {
        EXPECT_GT(far_share(sky, d), far_share(sky, d - 10));
        EXPECT_LT(far_share(sky, d), d / 500 + 0.05f);
    }
    sky.open_air = 0;
    EXPECT_EQ(far_share(sky, 500), 0);
    sky.haze = sky.mist = 0;
    const AirStretch none = air_stretch(sky, {{0, 63, 0}, {0, 0, 0}}, {1, 0, 0}, kFar);
    EXPECT_EQ(air_passes(none), 1);
    EXPECT_EQ(sample_air_point(none, 0.5f).weight, 0);
}

TEST(Air, PhaseIsWhatIsSampled) {
    const Vec3 dir = normalized({1, -2, 0.5f});
    double sum = 0, mean = 0;
    constexpr u32 rings = 2000, bins = 16, count = 1 << 14;
    std::vector<double> wanted(bins), found(bins);
    for (u32 i = 0; i < rings; ++i) {
        const double c = -1 + 2 * (i + 0.5) / rings, part = double(air_phase(float(c))) * 4 * 3.14159265358979 / rings;
        sum += part, mean += part * c, wanted[std::min(u32((c + 1) / 2 * bins), bins - 1)] += part;
    }
    EXPECT_NEAR(sum, 1, 1e-4);
    EXPECT_NEAR(mean, double(kAirForward * (1 - kAirEven)), 1e-3);
    Vec3 across;
    for (u32 i = 0; i < count; ++i) {
        Sampler s = make_sampler(5, 5, i, 5);
        const Vec3 d = sample_air_phase(dir, next_2d(s));
        EXPECT_NEAR(length(d), 1, 1e-4);
        const float c = dot(d, dir);
        found[std::min(u32((c + 1) / 2 * bins), bins - 1)] += 1.0 / count;
        across += (d - dir * c) * (1.0f / count);
    }
    for (u32 i = 0; i < bins; ++i)
        EXPECT_NEAR(found[i], wanted[i], 0.002) << i;
    EXPECT_LT(length(across), 0.01f);
}

TEST(Air, LiquidsScatterWhatTheySay) {
    for (const Vec3 absorbed : {Vec3{0.3f, 0.05f, 0.03f}, Vec3{0.01f, 0.0f, 2.0f}})
        for (const Vec3 scattering : {Vec3{0.03f, 0.034f, 0.038f}, Vec3{0.2f, 0.2f, 0.2f}})
            for (float length : {0.5f, 12.0f, 400.0f, kFar}) {
                const Vec3 e = absorbed + scattering;
                double found[3] = {}, ways = 0;
                constexpr u32 count = 4096;
                for (u32 i = 0; i < count; ++i) {
                    Sampler s = make_sampler(2, 5, i, 5);
                    const LiquidPoint p = sample_liquid_point(e, scattering, length, next_1d(s));
                    ASSERT_TRUE(p.t >= 0 && p.t <= length);
                    found[0] += double(p.weight.x) / count, found[1] += double(p.weight.y) / count,
                        found[2] += double(p.weight.z) / count;
                    EXPECT_TRUE(p.weight.x < 3.01f && p.weight.y < 3.01f && p.weight.z < 3.01f);
                    ways += double(1 / p.pdf) / count;
                }
                const float ex[3] = {e.x, e.y, e.z}, sc[3] = {scattering.x, scattering.y, scattering.z};
                for (u32 k = 0; k < 3; ++k) {
                    const double wanted =
                        double(sc[k] / ex[k]) * -std::expm1(-double(ex[k]) * std::min(double(length), 1e6));
                    EXPECT_NEAR(found[k], wanted, 0.01 * wanted) << k << ' ' << length;
                }
                if (length < 1) {
                    EXPECT_NEAR(ways, double(length), 0.01);
                }
                EXPECT_NEAR(liquid_passes(e, 2).x, std::exp(-2 * e.x), 1e-6);
            }
}

} // namespace vitrail::trace
