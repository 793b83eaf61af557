// The denoised picture against the one that the samples tend to: noise, edges, energy, flicker, upscaling.
#include "trace/film_scene.h"

#include "trace/film/stages.h"

#include <gtest/gtest.h>

using namespace vitrail;
using namespace vitrail::trace;
using namespace vitrail::trace::film_scene;

namespace {

double psnr(const Picture& a, const Picture& b) {
    return -20 * std::log10(rmse(a, b));
}

TEST(FilmDenoise, NoiseGoesFromTheFirstFrameOn) {
    const Scene s;
    const Camera c = usual_camera();
    const Picture right = truth(s, c);
    const double noise = rmse(noisy(s, c, 1), right);
    Film film;
    const Picture first = frames(film, s, c, {}, 1, 100);
    EXPECT_LT(rmse(first, right), noise / 2.5);
    const Picture later = frames(film, s, c, {}, 31, 101);
    EXPECT_LT(rmse(later, right), noise / 8);
    EXPECT_LT(rmse(later, right), rmse(first, right) / 2);
    // As many samples without the filter are worse.
    Film plain;
    EXPECT_LT(rmse(later, right), 0.7 * rmse(frames(plain, s, c, {.denoise = false}, 32, 100), right));
    show("first", first, kW), show("later", later, kW), show("right", right, kW);
}

TEST(FilmDenoise, EdgesStaySharp) {
    const Camera c = usual_camera();
    const Scene noise;
    Scene clean;
    clean.noise = false;
    const Picture right = truth(clean, c);
    // Pixels beside a strong step of the picture: silhouettes, borders of shadows.
    std::vector<bool> edge(right.size());
    for (u32 y = 0; y < kH; ++y)
        for (u32 x = 1; x < kW; ++x) {
            const float a = luminance_of(right[y * kW + x - 1]), b = luminance_of(right[y * kW + x]);
            if (std::fabs(a - b) > 0.4f * std::max(a, b)) edge[y * kW + x] = edge[y * kW + x - 1] = true;
        }
    const auto at_edge = [&](std::size_t i) { return bool(edge[i]); };
    Picture blurred = right; // over 3x3 pixels
    for (u32 y = 1; y + 1 < kH; ++y)
        for (u32 x = 1; x + 1 < kW; ++x) {
            Vec3 sum;
            for (u32 k = 0; k < 9; ++k)
                sum += right[(y + k / 3 - 1) * kW + x + k % 3 - 1];
            blurred[y * kW + x] = sum * (1.0f / 9);
        }
    const double blur = rmse(blurred, right, at_edge);
    Film a, b;
    const Picture sharp = frames(a, clean, c, {}, 30, 100), filtered = frames(b, noise, c, {}, 60, 100);
    EXPECT_LT(rmse(sharp, right, at_edge), 0.5 * blur);
    EXPECT_LT(rmse(filtered, right, at_edge), 0.75 * blur);
}

TEST(FilmDenoise, EnergyStays) {
    for (const bool half : {false, true}) {
        Scene s;
        s.rare = 0.006f; // spikes carry a third of the light
        double got = 0, right = 0;
        for (u32 part = 0; part < 3; ++part) {
            Film film;
            for (u32 n = 0; n < 14; ++n) {
                const Camera c = usual_camera({0.05f * float(n + 9 * part), 0, 0});
                const Picture p = frame(film, s, c, {.half = half}, false, 1000 * part + n);
                if (n % 3) continue;
                got += mean(p);
                right += mean(truth(s, c, 3));
            }
        }
        EXPECT_NEAR(got / right, 1, half ? 0.015 : 0.01) << half;
    }
}

TEST(FilmDenoise, SpikesAreSpreadNotCut) {
    Film film;
    Scene s;
    const Camera c = usual_camera();
    frame(film, s, c, {.spread_spikes = 4}, false, 5);
    const FilmPlanes& p = film.planes();
    double before = 0, after = 0, most_before = 0, most_after = 0;
    for (u32 y = 0; y < kH; ++y)
        for (u32 x = 0; x < kW; ++x) {
            const i32 j = framed_at(p, i32(x), i32(y));
            before += double(p.light.r[j]), after += double(p.fresh.r[j]);
            most_before = std::max(most_before, double(p.light.r[j]));
            most_after = std::max(most_after, double(p.fresh.r[j]));
        }
    EXPECT_NEAR(after / before, 1, 1e-3);
    EXPECT_LT(most_after, 0.75 * most_before);
}

TEST(FilmDenoise, RestIsCalm) {
    const Scene s;
    const Camera c = usual_camera();
    Film film;
    frames(film, s, c, {}, 30, 1);
    const std::size_t pixels = kW * kH;
    std::vector<double> sum(pixels), squares(pixels);
    constexpr u32 kFrames = 16;
    double all = 0;
    for (u32 n = 0; n < kFrames; ++n) {
        const Picture p = frame(film, s, c, {}, false, n + 500);
        for (std::size_t i = 0; i < pixels; ++i) {
            const double l = double(luminance_of(p[i]));
            sum[i] += l, squares[i] += l * l, all += l;
        }
    }
    double flicker = 0;
    for (std::size_t i = 0; i < pixels; ++i)
        flicker += std::max(0.0, squares[i] / kFrames - (sum[i] / kFrames) * (sum[i] / kFrames));
    EXPECT_LT(std::sqrt(flicker / double(pixels)), 0.02 * all / double(pixels) / kFrames);
}

// Filtered at first, the mean in the end.
void rest_tends_to_the_mean(u32 w, u32 h, bool half) {
    Scene s;
    s.rare = 0.002f;
    const Camera c = camera(w, h, kEye);
    const Picture right = truth(s, c, w < 20 ? 48 : 16);
    Film film;
    const u32 few = half ? 256 : 64, many = half ? 4 * 4'200 : 4'200;
    frames(film, s, c, {.half = half}, few, 1);
    EXPECT_EQ(film.state().to_mean, 0);
    const Picture p = frames(film, s, c, {.half = half}, many - few, 10'000);
    EXPECT_EQ(film.state().to_mean, 1);
    // 1 / sqrt(4,200) of a sample's noise.
    const double expected = rmse(noisy(s, c, 3), right) / std::sqrt(4'200);
    EXPECT_LT(rmse(p, right), 3 * expected + 1e-3);
    EXPECT_NEAR(mean(p) / mean(right), 1, 3e-3);
}
TEST(FilmDenoise, RestTendsToTheMean) {
    rest_tends_to_the_mean(12, 7, false);
}
TEST(FilmDenoise, RestTendsToTheMeanLong) {
    if (!std::getenv("VITRAIL_LONG")) GTEST_SKIP() << "VITRAIL_LONG is not set";
    rest_tends_to_the_mean(32, 18, false);
    rest_tends_to_the_mean(32, 18, true);
}

TEST(FilmDenoise, MistIsSmoothAndKeepsItsEdges) {
    Scene s;
    s.mist = 0.05f;
    const Camera c = usual_camera();
    const Picture right = truth(s, c);
    const double noise = rmse(noisy(s, c, 1), right);
    Film film;
    const Picture p = frames(film, s, c, {}, 16, 3);
    EXPECT_LT(rmse(p, right), noise / 6);
    EXPECT_NEAR(mean(p) / mean(right), 1, 0.01);
    show("mist", p, kW), show("mist_right", right, kW);
}

TEST(FilmDenoise, AQuarterOfTheSamplesGivesTheWholePicture) {
    const Scene s;
    Film whole, half, plain;
    double full_db = 0, half_db = 0, noisy_db = 0;
    Picture p, right;
    for (u32 n = 0; n < 24; ++n) {
        const Camera c = usual_camera({0.04f * float(n), 0, 0});
        const Picture a = frame(whole, s, c, {}, false, n);
        p = frame(half, s, c, {.half = true}, false, n);
        if (n < 16) continue;
        right = truth(s, c, 3);
        full_db += psnr(a, right) / 8, half_db += psnr(p, right) / 8, noisy_db += psnr(noisy(s, c, n), right) / 8;
    }
    EXPECT_GT(half_db, 25);
    EXPECT_GT(half_db, noisy_db + 10);
    EXPECT_GT(half_db, full_db - 2.5);
    show("half", p, kW), show("half_right", right, kW);
    // At rest more.
    Film rest;
    const Camera c = usual_camera();
    EXPECT_GT(psnr(frames(rest, s, c, {.half = true}, 40, 1), truth(s, c)), 27.5);
    // Only a quarter was read.
    EXPECT_EQ(std::count(rest.planes().light.r, rest.planes().light.r + kW, kMissing),
              rest.state().half_y ? kW : kW / 2);
}

TEST(FilmDenoise, AnyVectorsAnyThreads) {
    const Scene s;
    ThreadPool pool(3);
    Film a, b;
    const std::vector<Solid> all = solids(s);
    for (u32 n = 0; n < 6; ++n) {
        const Camera view = camera(101, 57, kEye + Vec3{0.1f * float(n), 0, 0});
        for (Film* film : {&a, &b}) {
            const Camera c = film->begin(view, {.half = n > 3}, false);
            for (u32 y = 0; y < c.height; ++y)
                for (u32 x = 0; x < c.width; ++x)
                    film->put(x, y,
                              look(s, all, eye_of(c),
                                   direction_through(c, float(x) + 0.5f + c.jitter.x, float(y) + 0.5f + c.jitter.y),
                                   u64(n * 57 + y) * 101 + x + 1));
            film->finish(film == &a ? nullptr : &pool);
        }
        for (std::size_t i = 0; i < a.color().size(); ++i)
            ASSERT_EQ(std::memcmp(&a.color()[i], &b.color()[i], sizeof(Vec4)), 0) << n << ' ' << i;
    }
    // The same stage of each vector set, over the same planes.
    const FilmPlanes& p = a.planes();
    std::vector<float> first;
    for (const FilmVectors v : {FilmVectors::portable, FilmVectors::avx2, FilmVectors::avx512}) {
        if (v > best_film_vectors()) continue;
        film_stages(v).stages[u32(FilmStep::respond)](p, a.state(), 0, 0, p.height);
        film_stages(v).stages[u32(FilmStep::filter)](p, a.state(), 0, 0, p.height);
        std::vector<float> row;
        for (u32 y = 0; y < p.height; ++y)
            row.insert(row.end(), p.even.r + framed_at(p, 0, i32(y)), p.even.r + framed_at(p, 101, i32(y)));
        if (first.empty()) first = row;
        for (std::size_t i = 0; i < row.size(); ++i)
            ASSERT_NEAR(row[i], first[i], 1e-3f * (1 + std::fabs(first[i]))) << u32(v);
    }
}

} // namespace
