// Sums at rest against double precision; what is no light is dropped and stays where it was.
#include "base/hash.h"
#include "trace/film/film.h"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

using namespace vitrail;
using namespace vitrail::trace;

namespace {

Camera small_camera(u32 w, u32 h) {
    Camera c;
    c.forward = {0, 0, -1};
    c.right = {1, 0, 0};
    c.up = {0, float(h) / float(w), 0};
    c.width = w;
    c.height = h;
    return c;
}

PixelSample lit(Vec3 light) {
    PixelSample s;
    s.light = light;
    s.albedo = {0.5f, 0.25f, 0.125f};
    s.normal = {0, 1, 0};
    s.distance = 4;
    return s;
}

float unit(u64 i) {
    return float(mix64(i) >> 40) * 0x1p-24f;
}

TEST(FilmSums, SixtyFiveThousandSamplesAreAsExactAsOne) {
    Film film;
    film.resize(2, 1);
    const Camera c = small_camera(2, 1);
    const FilmSettings plain{.denoise = false};
    double right[2][3] = {};
    constexpr u32 kSamples = 65'536;
    for (u32 n = 0; n < kSamples; ++n) {
        film.begin(c, plain, false);
        for (u32 x = 0; x < 2; ++x) {
            // Heavy tails: a plain float sum loses the small ones after the large.
            const float u = unit(n * 2 + x), v = u < 0.001f ? 5'000.0f * unit(n + 77'777'777) : u * 0.01f;
            const PixelSample s = lit({v, v * 0.5f, 0.1f});
            const Vec3 all = radiance_of(s);
            right[x][0] += double(all.x), right[x][1] += double(all.y), right[x][2] += double(all.z);
            film.put(x, 0, s);
        }
        film.finish(nullptr);
    }
    EXPECT_EQ(film.samples(), kSamples);
    for (u32 x = 0; x < 2; ++x) {
        const Vec4 mean = film.color()[x];
        EXPECT_NEAR(double(mean.x) * kSamples / right[x][0], 1, 2e-7);
        EXPECT_NEAR(double(mean.y) * kSamples / right[x][1], 1, 2e-7);
        EXPECT_NEAR(double(mean.z) * kSamples / right[x][2], 1, 2e-7);
        EXPECT_FLOAT_EQ(mean.w, 4);
        EXPECT_EQ(film.counts()[x], float(kSamples));
    }
}

TEST(FilmSums, FaultsAreDroppedCountedAndStay) {
    const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
    for (const bool denoise : {false, true}) {
        Film film;
        film.resize(16, 16);
        const Camera c = small_camera(16, 16);
        for (u32 n = 0; n < 8; ++n) {
            film.begin(c, {.denoise = denoise}, false);
            for (u32 y = 0; y < 16; ++y)
                for (u32 x = 0; x < 16; ++x) {
                    PixelSample s = lit({1, 1, 1});
                    if (n % 2 && x == 8) {
                        if (y == 0) s.light.x = nan;
                        if (y == 1) s.light.y = inf;
                        if (y == 2) s.air.z = -1;
                        if (y == 3) s.base.x = nan;
                        if (y == 4) s.albedo.y = nan;
                        if (y == 5) s.normal.z = nan;
                        if (y == 6) s.distance = inf;
                        if (y == 7) s.roughness = nan;
                        if (y == 8) s.light = {3e38f, 3e38f, 3e38f};
                    }
                    film.put(x, y, s);
                }
            film.finish(nullptr);
        }
        EXPECT_EQ(film.dropped(), 4u * 9) << denoise;
        for (u32 y = 0; y < 16; ++y)
            for (u32 x = 0; x < 16; ++x) {
                const Vec4 p = film.color()[y * 16 + x];
                EXPECT_NEAR(p.x, 0.5f, 1e-5) << x << ' ' << y << ' ' << denoise;
                EXPECT_NEAR(p.y, 0.25f, 1e-5) << x << ' ' << y << ' ' << denoise;
                EXPECT_NEAR(p.z, 0.125f, 1e-5) << x << ' ' << y << ' ' << denoise;
            }
    }
}

TEST(FilmSums, SumsStartAnewWhenSomethingMoves) {
    Film film;
    film.resize(4, 4);
    const Camera still = small_camera(4, 4);
    Camera moved = still;
    moved.eye.at.x = 0.25f;
    const FilmSettings plain{.denoise = false};
    const auto run = [&](const Camera& c, const FilmSettings& settings, bool changed, float light) {
        film.begin(c, settings, changed);
        for (PixelSample& s : film.frame())
            s = lit({light, light, light});
        film.finish(nullptr);
        return film.color()[5].x * 2;
    };
    EXPECT_FLOAT_EQ(run(still, plain, false, 1), 1);
    EXPECT_FLOAT_EQ(run(still, plain, false, 3), 2);
    EXPECT_EQ(film.samples(), 2u);
    EXPECT_FLOAT_EQ(run(still, plain, true, 5), 5); // the world changed
    EXPECT_EQ(film.samples(), 1u);
    EXPECT_FLOAT_EQ(run(still, plain, false, 7), 6);
    EXPECT_FLOAT_EQ(run(moved, plain, false, 1), 1); // the eye moved
    EXPECT_FLOAT_EQ(run(moved, {.denoise = false, .accumulate = false}, false, 9), 9);
    EXPECT_FLOAT_EQ(run(moved, {.denoise = false, .accumulate = false}, false, 4), 4);
    film.forget();
    EXPECT_FLOAT_EQ(run(moved, plain, false, 2), 2);
}

// It is as if it had not been, not as if it had been dark.
TEST(FilmSums, AFaultAmongOthersIsNotBlack) {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const bool denoise : {false, true}) {
        Film film;
        film.resize(1, 1);
        film.begin(small_camera(1, 1), {.denoise = denoise, .samples = 4}, false);
        SampleMean m;
        for (const Vec3 light : {Vec3{1, 2, 4}, {nan, 1, 1}, {3, 4, 0}, {1, 1, -nan}})
            add_sample(m, lit(light));
        EXPECT_EQ(m.samples, 2u);
        EXPECT_EQ(m.dropped, 2u);
        EXPECT_EQ(m.seen, 4u) << "its guides are sound";
        film.put(0, 0, m);
        film.finish(nullptr);
        EXPECT_NEAR(film.color()[0].x, 0.5f * 2, 1e-6);
        EXPECT_NEAR(film.color()[0].y, 0.25f * 3, 1e-6);
        EXPECT_NEAR(film.color()[0].z, 0.125f * 2, 1e-6);
        EXPECT_EQ(film.dropped(), 2u);
        if (!denoise) EXPECT_EQ(film.counts()[0], 2);
    }
}

TEST(FilmSums, SamplesOfAPixelBecomeOne) {
    SampleMean m;
    PixelSample a = lit({1, 2, 4}), b = lit({3, 0, 0});
    b.albedo = {1, 1, 1};
    b.base = {0, 0, 8};
    add_sample(m, a);
    add_sample(m, b);
    EXPECT_EQ(m.samples, 2u);
    EXPECT_FLOAT_EQ(m.radiance.x, 0.5f + 3);
    EXPECT_FLOAT_EQ(m.radiance.z, 0.5f + 8);
    Film film;
    film.resize(1, 1);
    film.begin(small_camera(1, 1), {.denoise = false, .accumulate = false, .samples = 2}, false);
    film.put(0, 0, m);
    film.finish(nullptr);
    EXPECT_FLOAT_EQ(film.color()[0].x, 1.75f);
    EXPECT_FLOAT_EQ(film.color()[0].z, 4.25f);
    EXPECT_FLOAT_EQ(film.albedo()[0], 0.75f);
    EXPECT_EQ(film.counts()[0], 2);
    EXPECT_EQ(film.samples(), 2u);
}

} // namespace
