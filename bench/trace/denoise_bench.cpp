// The film on the CPU, all cores: a plain with pillars under noise of one path a pixel, the eye walking.
#include "bench/trace/benches.h"
#include "trace/film/film.h"
#include "trace/film/stages.h"

#include "base/hash.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace vitrail {

namespace {

using namespace trace;

float unit(u64 i) {
    return float(mix64(i) >> 40) * 0x1p-24f;
}

Camera camera(u32 w, u32 h, float x) {
    Camera c;
    c.eye.at = {x, 0, 0};
    c.eye.cell = {0, 2, 0};
    c.forward = {0, -0.1f, -0.995f};
    c.right = {0.9f, 0, 0};
    c.up = {0, 0.9f * float(h) / float(w) * 0.995f, -0.09f * float(h) / float(w)};
    c.width = w;
    c.height = h;
    return c;
}

// Pillars every 4 blocks on a plain; light without meaning, noisy.
PixelSample look(Vec3 eye, Vec3 dir, u64 seed) {
    PixelSample s;
    float t = dir.y < 0 ? -eye.y / dir.y : kFar;
    Vec3 n{0, 1, 0};
    for (i32 k = 1; k < 12; ++k) { // planes z = -4 k with pillars a block wide
        const float tz = float(4 * k) / -dir.z, x = eye.x + dir.x * tz, y = eye.y + dir.y * tz;
        if (dir.z < 0 && tz < t && y < 4 && x - 4 * std::floor(x / 4) < 1) {
            t = tz;
            n = {0, 0, 1};
            break;
        }
    }
    if (t > 300) {
        s.base = {0.5f, 0.7f, 1};
        return s;
    }
    s.distance = t;
    s.normal = n;
    s.albedo = {0.5f, 0.6f, 0.3f};
    s.surface = n.y > 0 ? 1 : 2;
    const float u = unit(seed);
    s.light = Vec3{1, 0.9f, 0.7f} * (u < 0.004f ? 30.0f : u < 0.5f ? 1.0f : 0.2f);
    s.air = Vec3{0.1f, 0.1f, 0.12f} * (2 * unit(seed + 1));
    return s;
}

struct Walk {
    ThreadPool pool{default_worker_count()};
    Film film;
    u32 w, h, n = 0;
    FilmSettings settings;
    Walk(u32 width, u32 height, bool half)
        : w(width)
        , h(height) {
        settings.half = half;
        film.resize(w, h);
        for (u32 k = 0; k < 8; ++k)
            put(), film.finish(&pool);
    }
    void put() {
        const Camera c = film.begin(camera(w, h, 0.05f * float(n)), settings, false);
        const Vec3 eye{c.eye.at.x, float(c.eye.cell.y), 0};
        pool.parallel_for(h, [&](u32 y) {
            for (u32 x = 0; x < w; ++x) {
                const Vec3 d = direction_through(c, float(x) + 0.5f + c.jitter.x, float(y) + 0.5f + c.jitter.y);
                film.put(x, y, look(eye, d, (u64(n) * h + y) * w + x));
            }
        });
        ++n;
    }
};

void whole(bench::Context& c, u32 w, u32 h, bool half) {
    Walk walk(w, h, half);
    c.measure(
        1, [&] { walk.put(); }, [&] { walk.film.finish(&walk.pool); });
}

// A stage alone, one core.
void stage(bench::Context& c, FilmStep step, FilmVectors vectors) {
    if (vectors > best_film_vectors()) return c.skip("this CPU has no such vectors");
    Walk walk(854, 480, true);
    const FilmStage run = film_stages(vectors).stages[u32(step)];
    const FilmPlanes p = walk.film.planes();
    const FilmFrame f = walk.film.state();
    const u32 rows = step == FilmStep::watch || step == FilmStep::test ? p.tiles_high : p.height;
    c.measure(1, [&] { run(p, f, 2, 0, rows); });
}

} // namespace

void register_denoise_benches(bench::Suite& suite) {
    suite.add("denoise.cpu", "ms", "a frame at 1920x1080, walking, all cores",
              [](bench::Context& c) { whole(c, 1920, 1080, false); });
    suite.add("denoise.cpu.480", "ms", "854x480", [](bench::Context& c) { whole(c, 854, 480, false); });
    suite.add("denoise.cpu.half", "ms", "854x480, light for a quarter of the pixels",
              [](bench::Context& c) { whole(c, 854, 480, true); });
    const std::pair<const char*, FilmStep> stages[] = {
        {"slope", FilmStep::slope}, {"spikes", FilmStep::spikes},       {"spread", FilmStep::spread},
        {"fill", FilmStep::fill},   {"reproject", FilmStep::reproject}, {"watch", FilmStep::watch},
        {"test", FilmStep::test},   {"respond", FilmStep::respond},     {"filter", FilmStep::filter},
        {"air", FilmStep::air},     {"merge", FilmStep::merge},         {"resolve", FilmStep::resolve},
    };
    for (const auto& [name, step] : stages)
        suite.add(std::string("denoise.stage.") + name, "ms", "854x480, one launch, one core",
                  [s = step](bench::Context& c) { stage(c, s, best_film_vectors()); });
    suite.add("denoise.stage.filter.avx2", "ms", "the same with AVX2",
              [](bench::Context& c) { stage(c, FilmStep::filter, FilmVectors::avx2); });
}

} // namespace vitrail
