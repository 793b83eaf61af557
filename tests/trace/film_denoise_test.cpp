#include "trace/film_scene.h"

#include <gtest/gtest.h>

using namespace vitrail;
using namespace vitrail::trace;
using namespace vitrail::trace::film_scene;

namespace {

constexpr u32 kW = 240, kH = 136;

TEST(FilmDenoise, Probe) {
    Scene s;
    const Vec3 eye{0.3f, 2.2f, 2.7f};
    const Camera c = camera(kW, kH, eye);
    const Picture right = truth(s, c);
    for (const bool half : {false, true}) {
        const std::string tag = half ? "half_" : "full_";
        std::printf("---- %s noisy %.4f\n", tag.c_str(), rmse(noisy(s, c, 1), right));
        const FilmSettings set{.half = half};
        Film film;
        film.resize(kW, kH);
        double e = 0;
        for (u32 n = 0; n < 64; ++n) {
            const Picture p = frame(film, s, c, set, false, n + 100);
            e += mean(p) / mean(right) / 64;
            if ((n & (n + 1)) == 0)
                std::printf("rest %u: %.4f energy %.4f\n", n, rmse(p, right), mean(p) / mean(right)),
                    show(tag + "rest" + std::to_string(n), p, kW);
        }
        std::printf("energy %.4f\n", e);
        // motions
        for (u32 kind = 0; kind < 4; ++kind) {
            const char* names[] = {"walk", "pan", "zoom", "forward"};
            Film f2;
            f2.resize(kW, kH);
            double err = 0, energy = 0, gone = 0, gone_bias = 0, flick = 0;
            Picture last, last_t;
            for (u32 n = 0; n < 30; ++n) {
                const float t = float(n);
                const Camera m = kind == 0   ? camera(kW, kH, {0.3f + 0.12f * t, 2.2f, 2.7f})
                                 : kind == 1 ? camera(kW, kH, eye, 0.02f * t)
                                 : kind == 2 ? camera(kW, kH, eye, 0, -0.12f, 0.7f - 0.012f * t)
                                             : camera(kW, kH, {0.3f, 2.2f, 2.7f - 0.12f * t});
                const Picture p = frame(f2, s, m, set, false, n + 1000);
                const Picture tr = truth(s, m, 3);
                if (n >= 15) {
                    err += rmse(p, tr) / 15, energy += mean(p) / mean(tr) / 15;
                    double b = 0, k = 0;
                    for (std::size_t i = 0; i < p.size(); ++i) {
                        if (f2.planes().past.light == nullptr || f2.planes().next.light[i].w > 1.5f ||
                            f2.planes().albedo[i].w == 0)
                            continue;
                        b += double(luminance(p[i]) - luminance(tr[i])) / double(luminance(tr[i]));
                        k += 1;
                    }
                    if (k > 0) gone_bias += b / k / 15;
                    gone += rmse(p, tr,
                                 [&](std::size_t i) {
                                     return f2.planes().next.light[i].w < 1.5f && f2.planes().albedo[i].w > 0;
                                 }) /
                            15;
                }
                last = p, last_t = tr;
            }
            (void)flick;
            std::printf("%s: %.4f energy %.4f  new: %.4f bias %.4f\n", names[kind], err, energy, gone, gone_bias);
            show(tag + names[kind], last, kW);
            show(tag + names[kind] + "_t", last_t, kW);
        }
        // lamp
        {
            Scene on = s;
            s.sun_strength = on.sun_strength = 0.0f;
            s.sky = on.sky = 0.1f;
            on.lamp = true;
            const Picture dark = truth(s, c), bright = truth(on, c);
            Film f3;
            f3.resize(kW, kH);
            std::printf("lamp on at 20, off at 50\n");
            for (u32 n = 0; n < 80; ++n) {
                const bool lit = n >= 20 && n < 50;
                const Picture p = frame(f3, lit ? on : s, c, set, n == 20 || n == 50, n + 5000);
                double got = 0, all = 0;
                for (std::size_t i = 0; i < p.size(); ++i)
                    got += double(luminance(p[i]) - luminance(dark[i])),
                        all += double(luminance(bright[i]) - luminance(dark[i]));
                if (n == 19 || (n >= 20 && n < 36 && n % 3 == 0) || n == 49 || (n >= 50 && n < 66 && n % 3 == 0) ||
                    n == 79)
                    std::printf("  %u: %.3f rmse %.4f\n", n, got / all, rmse(p, lit ? bright : dark));
                if (n == 19 || n == 26 || n == 49 || n == 56 || n == 62) show(tag + "lamp" + std::to_string(n), p, kW);
            }
            s = Scene{};
        }
        // wall gone, sun turning
        {
            Scene no = s;
            no.wall = false;
            const Picture after = truth(no, c);
            Film f4;
            f4.resize(kW, kH);
            for (u32 n = 0; n < 40; ++n) {
                const Picture p = frame(f4, n < 20 ? s : no, c, set, n == 20, n + 7000);
                if (n >= 20 && n < 36 && n % 3 == 2) std::printf("wall gone %u: %.4f\n", n - 20, rmse(p, after));
                if (n == 30) show(tag + "wall", p, kW);
            }
            Scene day = s;
            Film f5;
            f5.resize(kW, kH);
            Picture p, t;
            for (u32 n = 0; n < 60; ++n) {
                const float a = 0.9f + 0.002f * float(n);
                day.sun = {std::cos(a) * 0.8f, std::sin(a), -0.4f};
                p = frame(f5, day, c, set, true, n + 9000);
            }
            t = truth(day, c);
            std::printf("sun turning %.4f energy %.4f\n", rmse(p, t), mean(p) / mean(t));
            show(tag + "sun", p, kW), show(tag + "sun_t", t, kW);
        }
    }
}

} // namespace
