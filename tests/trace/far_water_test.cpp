// Water so far off that its waves are not seen one by one: what is filtered out of them, the lobe that it becomes, and
// the light of both, against waves as they are.
#include "base/rng.h"
#include "trace/kernel/bsdf.h"
#include "trace/kernel/sampler.h"
#include "trace/statistics.h"

#include <gtest/gtest.h>

namespace vitrail::test {
namespace {

using namespace trace;
using scene::Covariance;

constexpr float kHeight = 0.06f, kSeconds = 7.25f;

struct Moments { // of slopes, about 0
    double xx = 0, xz = 0, zz = 0;
    void add(Vec2 s, double weight) {
        xx += weight * double(s.x) * double(s.x), xz += weight * double(s.x) * double(s.y),
            zz += weight * double(s.y) * double(s.y);
    }
};

TEST(FarWater, APointSeesAllWaves) {
    Rng rng(1);
    for (int i = 0; i < 200; ++i) {
        const BlockPos at{i32(rng.next()), 3, i32(rng.next())};
        const Vec2 in{float(rng.below(1000)) / 1000, float(rng.below(1000)) / 1000};
        const scene::WaveSurface all = scene::wave_at(at, in, kSeconds, kHeight);
        const scene::WavesSeen seen = scene::waves_seen(at, in, kSeconds, kHeight, {});
        ASSERT_NEAR(seen.slope.x, all.slope.x, 2e-5f);
        ASSERT_NEAR(seen.slope.y, all.slope.y, 2e-5f);
        ASSERT_EQ(seen.spread.xx, 0);
        ASSERT_EQ(seen.spread.zz, 0);
    }
}

// The slope that is seen is the mean of those in the patch, weighted by its Gaussian; and what is seen and what is
// spread have the moments of all slopes together.
TEST(FarWater, WhatIsNotSeenIsSpread) {
    Rng rng(2);
    const auto unit = [&] { return float(rng.below(1 << 20)) / float(1 << 20); };
    Moments all;
    for (int i = 0; i < 40'000; ++i)
        all.add(
            scene::wave_at({i32(rng.below(256)), 0, i32(rng.below(256))}, {unit(), unit()}, kSeconds, kHeight).slope,
            1.0 / 40'000);
    for (const Vec3 to : {Vec3{0, -1, 0}, Vec3{0.8f, -0.5f, 0.3f}, Vec3{-0.7f, -0.2f, 0.9f}})
        for (const float width : {0.1f, 0.4f, 1.0f, 3.0f}) {
            const Vec3 dir = normalized(to);
            const Covariance patch = scene::wave_filter(dir, width);
            Moments kept;
            const int places = 4000;
            for (int i = 0; i < places; ++i) {
                const BlockPos at{i32(rng.below(256)), 0, i32(rng.below(256))};
                const Vec2 in{unit(), unit()};
                const scene::WavesSeen w = scene::waves_seen(at, in, kSeconds, kHeight, patch);
                kept.add(w.slope, 1.0 / places);
                kept.xx += double(w.spread.xx) / places, kept.xz += double(w.spread.xz) / places,
                    kept.zz += double(w.spread.zz) / places;
                if (i >= 4) continue;
                double x = 0, z = 0, weight = 0;
                constexpr int n = 40; // to four deviations each way
                const float a = std::sqrt(patch.xx), b = patch.xz / a, c = std::sqrt(patch.zz - b * b);
                for (int j = 0; j < n * n; ++j) {
                    const float p = (float(j % n) - 19.5f) * 0.2f, q = (float(j / n) - 19.5f) * 0.2f;
                    const double g = std::exp(-0.5 * double(p * p + q * q));
                    const Vec2 s = scene::wave_at(at, {in.x + a * p, in.y + b * p + c * q}, kSeconds, kHeight).slope;
                    x += g * double(s.x), z += g * double(s.y), weight += g;
                }
                EXPECT_NEAR(w.slope.x, x / weight, 6e-4);
                EXPECT_NEAR(w.slope.y, z / weight, 6e-4);
            }
            EXPECT_NEAR(kept.xx, all.xx, 0.04 * all.xx) << width;
            EXPECT_NEAR(kept.xz, all.xz, 0.04 * all.xx) << width;
            EXPECT_NEAR(kept.zz, all.zz, 0.04 * all.zz) << width;
        }
}

struct Lobe {
    Covariance spread;
    Vec2 mean;
    Vec3 eye;
};
std::vector<Lobe> lobes() {
    std::vector<Lobe> out;
    for (const float y : {0.999f, 0.6f, 0.15f, 0.03f})
        for (const Covariance c :
             {Covariance{2e-3f, 3e-4f, 1.5e-3f}, Covariance{2e-3f, 0, 4e-6f}, Covariance{2e-2f, 3e-3f, 1.5e-2f}})
            for (const Vec2 mean : {Vec2{0, 0}, Vec2{0.02f, -0.01f}}) {
                const float s = std::sqrt(1 - y * y);
                const Vec3 eye{s * 0.8f, y, s * -0.6f};
                if (eye.y - eye.x * mean.x - eye.z * mean.y > 1e-3f) out.push_back({c, mean, eye});
            }
    return out;
}
SurfacePoint water_point(const Lobe& l, bool below) {
    SurfacePoint p;
    p.optics = Optics::water;
    p.albedo = {1, 1, 1};
    p.face = {0, below ? -1.0f : 1.0f, 0};
    p.normal = normalized({-l.mean.x, 1, -l.mean.y}) * p.face.y;
    p.waves = l.spread;
    p.roughness = std::sqrt(std::sqrt(l.spread.xx + l.spread.zz));
    p.ior = below ? 1 / 1.333f : 1.333f;
    p.mirrored = below ? 1.0f : 5.0f;
    return p;
}

// Slopes that are drawn lie as those that are seen: against sums over all slopes.
TEST(FarWater, SlopesAreDrawnAsTheyAreSeen) {
    for (const Lobe& l : lobes()) {
        const WaveLobe w = wave_lobe(l.spread, normalized({-l.mean.x, 1, -l.mean.y}), l.eye);
        double whole = 0, first[2] = {}, second[3] = {}, steep = 0;
        const double sx = std::sqrt(double(l.spread.xx)), sz = std::sqrt(double(l.spread.zz));
        constexpr int n = 240;
        for (int i = 0; i < n * n; ++i) {
            const double a = (i % n + 0.5) / n * 12 - 6, b = (i / n + 0.5) / n * 12 - 6;
            const Vec2 s{l.mean.x + float(a * sx), l.mean.y + float(b * sz)};
            const float q = l.eye.y - l.eye.x * s.x - l.eye.z * s.y;
            if (q <= 0) continue;
            const double d = double(density_of_slope(w, s) * q / w.visible) * (12 * sx / n) * (12 * sz / n);
            whole += d, first[0] += d * a, first[1] += d * b;
            second[0] += d * a * a, second[1] += d * a * b, second[2] += d * b * b;
            if (a * double(l.eye.x) + b * double(l.eye.z) < -1) steep += d;
        }
        EXPECT_NEAR(whole, 1, 0.01);
        constexpr u32 count = 8192;
        double got[6] = {};
        for (u32 i = 0; i < count; ++i) {
            Sampler sampler = make_sampler(3, 4, i, 5);
            const Vec2 s = sample_slope(w, next_2d(sampler));
            const double a = double(s.x - l.mean.x) / sx, b = double(s.y - l.mean.y) / sz;
            EXPECT_GT(l.eye.y - l.eye.x * s.x - l.eye.z * s.y, 0);
            const double all[6] = {a,     b,     a * a,
                                   a * b, b * b, a * double(l.eye.x) + b * double(l.eye.z) < -1 ? 1.0 : 0.0};
            for (int k = 0; k < 6; ++k)
                got[k] += all[k] / count;
        }
        const double want[6] = {first[0], first[1], second[0], second[1], second[2], steep};
        for (int k = 0; k < 6; ++k)
            EXPECT_NEAR(got[k], want[k], 0.02) << "moment " << k << ", eye at " << l.eye.y;
    }
}

// From air and from water, nothing is lost or won, and pdf and value are what samples do: sums over directions.
TEST(FarWater, NothingIsLost) {
    for (const Lobe& l : lobes())
        for (const bool below : {false, true}) {
            const SurfacePoint p = water_point(l, below);
            const Vec3 eye = below ? -l.eye : l.eye;
            constexpr u32 count = 4096;
            double sum = 0, mirrored = 0, pdf_mirrored = 0, up = 0;
            for (u32 i = 0; i < count; ++i) {
                Sampler sampler = make_sampler(1, 2, i, 3);
                const float choose = next_1d(sampler);
                const BsdfSample s = sample_bsdf(p, eye, choose, next_2d(sampler));
                ASSERT_NEAR(length(s.dir), 1, 1e-4);
                ASSERT_FALSE(s.delta);
                ASSERT_EQ(s.through, s.dir.y * p.face.y < 0);
                ASSERT_TRUE(s.pdf > 0 && std::isfinite(s.pdf) && std::isfinite(s.weight.x));
                const BsdfValue v = bsdf_at(p, eye, s.dir);
                ASSERT_NEAR(v.pdf, s.pdf, 2e-3f * s.pdf);
                ASSERT_NEAR(v.value.x, s.pdf * s.weight.x, 2e-3f * v.value.x);
                sum += double(s.weight.x) / count;
                if (!s.through) mirrored += double(s.weight.x) / count, pdf_mirrored += 1.0 / count;
                up += double(s.weight.x * s.dir.y) / count;
            }
            EXPECT_NEAR(sum, 1, 0.02) << l.eye.y << below;
            if (l.spread.zz < 1e-2f || l.eye.y > 0.9f) continue; // too narrow for a sum
            double value = 0, value_mirrored = 0, pdf = 0, value_up = 0;
            constexpr int n = 900;
            for (int i = 0; i < n * n; ++i) {
                const float y = (float(i / n) + 0.5f) * (2.0f / n) - 1, r = std::sqrt(1 - y * y);
                const Vec2 turn = on_circle((float(i % n) + 0.5f) / n);
                const Vec3 dir{r * turn.x, y, r * turn.y};
                const BsdfValue v = bsdf_at(p, eye, dir);
                const double area = double(4 * kPi) / (n * n);
                value += double(v.value.x) * area;
                value_up += double(v.value.x * y) * area;
                if (y * p.face.y > 0) value_mirrored += double(v.value.x) * area, pdf += double(v.pdf) * area;
            }
            EXPECT_NEAR(value, 1, 0.02) << l.eye.y << below;
            EXPECT_NEAR(value_mirrored, mirrored, 0.02) << l.eye.y << below;
            EXPECT_NEAR(value_up, up, 0.02) << l.eye.y << below;
            EXPECT_NEAR(pdf, pdf_mirrored, 0.02) << l.eye.y << below;
        }
}

// What far water mirrors and shows is what its waves would, each as sharp as it is and as large as it is seen.
TEST(FarWater, ShowsWhatItsWavesShow) {
    const scene::WavesSeen far = scene::waves_seen({0, 0, 0}, {0.5f, 0.5f}, kSeconds, kHeight, {1e4f, 0, 1e4f});
    EXPECT_NEAR(far.slope.x, 0, 1e-6f);
    const auto shine = [](Vec3 d) { // of a sky and a sea's depth
        return d.y > 0 ? double(2.2f - 2 * d.y + 0.5f * d.x) : double(0.4f + 0.3f * d.y + 0.2f * d.z);
    };
    Rng rng(5);
    const auto unit = [&] { return float(rng.below(1 << 20)) / float(1 << 20); };
    for (const float y : {0.9f, 0.3f, 0.08f, 0.03f}) {
        const float s = std::sqrt(1 - y * y);
        const Vec3 eye{s * 0.6f, y, s * 0.8f};
        Lobe l{far.spread, {0, 0}, eye};
        const SurfacePoint p = water_point(l, false);
        SurfacePoint still = p;
        still.roughness = 0;
        double waves = 0, area = 0, lobe = 0;
        constexpr u32 count = 20'000;
        for (u32 i = 0; i < count; ++i) {
            const Vec2 slope =
                scene::wave_at({i32(rng.below(256)), 0, i32(rng.below(256))}, {unit(), unit()}, kSeconds, kHeight)
                    .slope;
            const double seen = double(eye.y - eye.x * slope.x - eye.z * slope.y);
            if (seen > 0) {
                still.normal = normalized({-slope.x, 1, -slope.y});
                const float f = fresnel_dielectric(dot(eye, still.normal), still.ior);
                waves += seen * (double(f) * shine(sample_clear_border(still, eye, 0).dir) +
                                 double(1 - f) * shine(sample_clear_border(still, eye, 1).dir));
                area += seen;
            }
            Sampler sampler = make_sampler(7, 7, i, 1);
            const float choose = next_1d(sampler);
            const BsdfSample b = sample_bsdf(p, eye, choose, next_2d(sampler));
            lobe += double(b.weight.x) * shine(b.dir) / count;
        }
        EXPECT_NEAR(lobe, waves / area, 0.015 * lobe) << y;
    }
}

// The sun's path on a sea: as bright through a coarse picture's wide pixels as through a fine one's, whose rays see
// each wave; and far less noisy.
TEST(FarWater, GlitterIsAStreak) {
    TestScene s;
    s.fill({-24, -8, -60}, {24, -1, 4}, TestScene::water);
    s.publish();
    s.view.wave_height = kHeight, s.view.seconds = kSeconds;
    s.set_sky(8500, 0.06f);
    s.settings.fog = false;
    const Vec3 sun = s.sky.light_direction;
    // Looks to where level water mirrors the sun.
    const Vec3 down{sun.x, -sun.y, sun.z};
    s.look(Vec3{0.5f, -0.1f, -28.5f} - down * 40, down, 14);
    const auto tally = [&](u32 side, u32 samples) {
        s.set_size(side, side);
        Rng rng(3);
        Tally t;
        u32 rays = 0;
        for (u32 i = 0; i < samples; ++i) {
            const u32 x = u32(rng.below(side)), y = u32(rng.below(side));
            t.add(double(luminance_of(radiance_of(s.sample(x, y, i, rays)))));
        }
        return t;
    };
    const Tally wide = tally(6, 4000), fine = tally(16384, 160'000);
    EXPECT_LT(relative_error(wide, fine), 0.06);
    EXPECT_NEAR(wide.mean(), fine.mean(), 0.12 * fine.mean());
    EXPECT_LT(wide.variance_of_mean() * wide.count, 0.05 * fine.variance_of_mean() * fine.count);
}

// Guides of far water are of its level, however its waves lie, and say how rough they make it.
TEST(FarWater, GuidesAreOfItsLevel) {
    TestScene s;
    s.fill({-24, -8, -60}, {24, -1, 4}, TestScene::water);
    s.publish();
    s.view.wave_height = kHeight, s.view.seconds = kSeconds;
    s.set_sky(8500);
    s.sky.open_air = 0; // nothing fades into the sky
    s.look({0.5f, 12, 2.5f}, {0, -0.5f, -1}, 30);
    s.set_size(8, 8);
    u32 rays = 0;
    for (u32 i = 0; i < 64; ++i) {
        const PixelSample far = s.sample(i % 8, i / 8, 0, rays);
        EXPECT_EQ(far.normal, (Vec3{0, 1, 0}));
        EXPECT_GT(far.distance, 12);
        EXPECT_NEAR(far.roughness, 0.25f, 0.06f);
        EXPECT_EQ(far.base, Vec3{});
        EXPECT_GT(far.light.z, 0);
    }
    s.set_size(8192, 8192); // sees each wave: as a mirror or what lies behind
    for (u32 i = 0; i < 16; ++i)
        EXPECT_NE(s.sample(4096 + i * 50, 4096, 0, rays).normal, (Vec3{0, 1, 0})) << i;
}

} // namespace
} // namespace vitrail::test
