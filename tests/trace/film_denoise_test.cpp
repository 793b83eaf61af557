#include "trace/film_scene.h"

#include <gtest/gtest.h>

using namespace vitrail;
using namespace vitrail::trace;
using namespace vitrail::trace::film_scene;

namespace {

constexpr u32 kW = 240, kH = 136;

TEST(FilmDenoise, Probe) {
    Scene s;
    const Camera c = camera(kW, kH, {0.3f, 2.2f, 2.7f});
    const Picture right = truth(s, c);
    show("truth", right, kW);
    show("noisy", noisy(s, c, 1), kW);
    std::printf("noisy %.4f mean %.4f of %.4f\n", rmse(noisy(s, c, 1), right), mean(noisy(s, c, 1)), mean(right));
    Film film;
    film.resize(kW, kH);
    for (u32 n = 0; n < 64; ++n) {
        const Picture p = frame(film, s, c, {}, false, n + 100);
        if ((n & (n + 1)) == 0) {
            std::printf("%u %.4f mean %.4f\n", n, rmse(p, right), mean(p));
            show("rest" + std::to_string(n), p, kW);
        }
    }
    for (u32 n = 0; n < 24; ++n) {
        const Camera m = camera(kW, kH, {0.3f + 0.1f * float(n), 2.2f, 2.7f});
        const Picture p = frame(film, s, m, {}, false, n + 1000);
        if (n % 6 == 5) {
            const Picture t = truth(s, m);
            std::printf("move %u %.4f mean %.4f of %.4f\n", n, rmse(p, t), mean(p), mean(t));
            show("move" + std::to_string(n), p, kW);
            show("movetruth" + std::to_string(n), t, kW);
        }
    }
}

} // namespace
