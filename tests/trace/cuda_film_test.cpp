// The film on a CUDA device makes the CPU's pictures of the same samples. Without a device it is skipped.
#include "film_scene.h"
#include "trace/cuda/probe.h"

#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

using namespace film_scene;

struct Walk {
    FilmSettings settings;
    float step = 0; // blocks a frame
    u32 frames = 6;
    u32 samples = 1;
};

void compare(const Walk& walk) {
    auto opened = cuda::FilmProbe::open();
    if (!opened) GTEST_SKIP() << opened.error().message;
    cuda::FilmProbe& probe = **opened;
    constexpr u32 width = 93, height = 61; // no multiples of anything
    Film film;
    film.resize(width, height);
    Scene scene;
    scene.mist = 0.01f;
    const std::vector<Solid> all = solids(scene);
    FilmSettings settings = walk.settings;
    settings.samples = walk.samples;
    for (u32 n = 0; n < walk.frames; ++n) {
        scene.lamp = n >= 4; // light changes
        const Camera view = camera(width, height, {0.3f + walk.step * float(n), 1.7f, 2.2f});
        const Camera c = film.begin(view, settings, n == 4);
        const auto same = probe.begin(view, settings, n == 4);
        ASSERT_TRUE(same) << same.error().message;
        ASSERT_EQ(c.jitter.x, same->jitter.x);
        std::vector<SampleMean> means(width * height);
        for (u32 y = 0; y < height; ++y)
            for (u32 x = 0; x < width; ++x) {
                SampleMean& mean = means[y * width + x];
                for (u32 s = 0; s < walk.samples; ++s) {
                    const Vec3 dir = direction_through(c, float(x) + 0.5f + c.jitter.x, float(y) + 0.5f + c.jitter.y);
                    add_sample(mean, look(scene, all, eye_of(c), dir, hash_combine(n * 16 + s, y * width + x) | 1));
                }
                film.put(x, y, mean);
            }
        film.finish(nullptr);
        ASSERT_TRUE(probe.put(means));
        ASSERT_TRUE(probe.finish());
        // Rounding may turn a decision (the same surface as before?) in single pixels.
        const std::vector<float> color = probe.color().value(), counts = probe.samples().value();
        const std::vector<float> right = film.counts();
        double off = 0, light = 0;
        u32 other = 0;
        for (u32 i = 0; i < width * height; ++i) {
            const Vec4 a = film.color()[i];
            const Vec3 d = Vec3{color[3 * i], color[3 * i + 1], color[3 * i + 2]} - Vec3{a.x, a.y, a.z};
            const float all_light = a.x + a.y + a.z, unlike = std::fabs(d.x) + std::fabs(d.y) + std::fabs(d.z);
            ASSERT_TRUE(std::isfinite(unlike));
            off += unlike, light += all_light;
            other += unlike > 0.01f * (all_light + 0.01f);
            ASSERT_EQ(counts[i], right[i]) << i;
        }
        EXPECT_LT(off, 1e-3 * light) << "frame " << n;
        EXPECT_LE(other, width * height / 50) << "frame " << n;
    }
}

TEST(CudaFilm, PlainMean) {
    compare({.settings = {.denoise = false}, .samples = 3});
}
TEST(CudaFilm, DenoisedAtRest) {
    compare({.settings = {}, .frames = 10});
}
TEST(CudaFilm, DenoisedWalking) {
    compare({.settings = {}, .step = 0.07f});
}
TEST(CudaFilm, HalfTheRaysWalking) {
    compare({.settings = {.half = true}, .step = 0.07f, .samples = 2});
}
TEST(CudaFilm, WithoutSpreadSpikes) {
    compare({.settings = {.spread_spikes = 0}, .step = 0.02f});
}

} // namespace
} // namespace vitrail::trace
