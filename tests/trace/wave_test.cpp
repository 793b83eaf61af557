// Many paths at once, as the CUDA device has them, but run here, a path after the other: queues, packing and sums must
// come to what single paths come to. What warps do is left to cuda_tracer_test.
#include "scenes.h"
#include "trace/cuda/wave_memory.h"
#include "trace/cuda/wave_steps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <random>

namespace vitrail::test {
namespace {

using namespace trace;
using namespace trace::cuda;

struct WaveCount {
    u64 rays = 0, paths = 0;
    u32 left = 0; // paths that went on one by one
    u64 hard = 0; // rays without an easy way
};

// The order of paths.cu. shuffle: queues are read in another order, as a device does.
WaveCount run_wave(const PathJob& job, u32 most, u32 shuffle) {
    const WavePlan plan = plan_wave(job, most);
    struct Free {
        void operator()(void* p) const { std::free(p); }
    };
    const std::unique_ptr<void, Free> memory(std::aligned_alloc(256, wave_bytes(plan)));
    std::memset(memory.get(), 0xcc, wave_bytes(plan));
    const Wave wave = lay_out_wave(plan, memory.get());
    const auto append = [](u32& counter) { return counter++; };
    static const BrickBoxes table = make_brick_boxes();
    const auto boxes = [](u32 i) { return table.of[i]; };
    std::mt19937 random(shuffle);
    const auto mix = [&](u32* from, u32 count) {
        if (shuffle) std::shuffle(from, from + count, random);
    };
    WaveCount count;
    for (u32 k = 0; k < plan.batches(); ++k) {
        const WaveJob j = wave_batch(job, plan, wave, k);
        std::memset(wave.rounds, 0, sizeof(WaveRound) * (plan.rounds + 1));
        for (u32 path = 0; path < j.pixels * job.samples; ++path)
            start_step(j, path, append);
        count.paths += wave.rounds[0].rays.n;
        for (u32 round = 0; round < plan.rounds; ++round) {
            const WaveRound& now = wave.rounds[round];
            EXPECT_LE(now.rays.n, plan.paths);
            mix(wave.going[round & 1], now.rays.n);
            for (u32 i = 0; i < now.rays.n; ++i)
                easy_closest_step(j, round, wave.going[round & 1][i], append, boxes);
            for (u32 i = 0; i < now.hard.n; ++i)
                closest_step(j, round, wave.going[(round + 1) & 1][i], append);
            count.hard += now.hard.n;
            EXPECT_LE(now.met.n + now.missed.n, now.rays.n);
            for (u32 i = 0; i < now.missed.n; ++i)
                event_step<false>(j, round, wave.ends[wave.paths - 1 - i], append);
            mix(wave.ends, now.met.n);
            for (u32 i = 0; i < now.met.n; ++i)
                event_step<true>(j, round, wave.ends[i], append);
            EXPECT_LE(now.lights.n, plan.paths * plan.lights_each);
            for (u32 i = 0; i < now.lights.n; ++i)
                easy_light_step(j, round, shuffle ? now.lights.n - 1 - i : i, append, boxes);
            for (u32 i = 0; i < now.hard_lights.n; ++i)
                light_step(j, wave.hard_lights[i]);
            count.rays += now.rays.n + now.lights.n;
        }
        count.left += wave.rounds[plan.rounds].rays.n;
        for (u32 i = 0; i < wave.rounds[plan.rounds].rays.n; ++i)
            count.rays += rest_step(j, wave.going[plan.rounds & 1][i]);
        for (u32 pixel = 0; pixel < j.pixels; ++pixel)
            finish_step(j, pixel);
    }
    return count;
}

// A job that leaves means.
struct Means {
    PathJob job;
    std::vector<SampleMean> means;
    Means(const TestScene& s, u32 samples, u32 band = 0, u32 bands = 1) {
        job.scene = s.view, job.sky = s.sky, job.settings = s.settings;
        job.film.width = s.camera.width, job.film.height = s.camera.height;
        job.frame.now = s.camera;
        job.samples = samples;
        job.band = band, job.bands = bands;
        means.resize(u64(rows_of_bands(s.camera.height, band, bands)) * s.camera.width);
        job.means = means.data();
    }
};

// Compares words: all of SampleMean are floats or counts.
void expect_near(const SampleMean& a, const SampleMean& b, u32 x, u32 y) {
    const auto near = [&](Vec3 p, Vec3 q, const char* what) {
        const float most = 2e-6f * (1 + greatest(q));
        ASSERT_NEAR(p.x, q.x, most) << what << " of " << x << " " << y;
        ASSERT_NEAR(p.y, q.y, most) << what << " of " << x << " " << y;
        ASSERT_NEAR(p.z, q.z, most) << what << " of " << x << " " << y;
    };
    near(a.radiance, b.radiance, "radiance");
    near(a.base, b.base, "base");
    near(a.lit, b.lit, "light");
    near(a.air, b.air, "air");
    near(a.albedo, b.albedo, "albedo");
    near(a.normal, b.normal, "normal");
    near(a.first_albedo, b.first_albedo, "first albedo");
    near(a.first_normal, b.first_normal, "first normal");
    ASSERT_EQ(a.distance, b.distance);
    ASSERT_EQ(a.first_distance, b.first_distance);
    ASSERT_EQ(a.first_roughness, b.first_roughness);
    ASSERT_EQ(a.first_surface, b.first_surface);
    ASSERT_EQ(a.samples, b.samples);
    ASSERT_EQ(a.seen, b.seen);
    ASSERT_EQ(a.hits, b.hits);
    ASSERT_EQ(a.dropped, b.dropped);
}

// All pixels against trace_path.
void compare(const TestScene& s, const Means& m, const WaveCount& count) {
    u64 rays = 0, paths = 0;
    for (u32 row = 0; row < rows_of_bands(s.camera.height, m.job.band, m.job.bands); ++row) {
        const u32 y = row_of(row, m.job.band, m.job.bands);
        if (y >= s.camera.height) break;
        for (u32 x = 0; x < s.camera.width; ++x) {
            const bool wanted = light_wanted(m.job.frame, x, y);
            PathSettings settings = s.settings;
            if (!wanted) settings.bounces = 0;
            SampleMean mean;
            u32 traced = 0;
            for (u32 i = 0; i < (wanted ? m.job.samples : 1); ++i, ++paths)
                add_sample(mean, trace_path(s.view, s.sky, s.camera, settings, x, y, i, traced));
            rays += traced;
            expect_near(m.means[u64(row) * s.camera.width + x], mean, x, y);
            if (testing::Test::HasFatalFailure()) return;
        }
    }
    EXPECT_EQ(count.rays, rays);
    EXPECT_EQ(count.paths, paths);
    EXPECT_LT(count.hard, count.rays * 3 / 4) << "hardly a ray has an easy way";
}

class WaveScenes : public testing::TestWithParam<SceneName> {};
TEST_P(WaveScenes, AsSinglePaths) {
    const auto s = make_scene(GetParam());
    s->set_size(37, 21); // no whole tiles
    Means m(*s, 1);
    compare(*s, m, run_wave(m.job, kWaveMost, 0));
}
INSTANTIATE_TEST_SUITE_P(Six, WaveScenes, testing::ValuesIn(kSceneNames),
                         [](const auto& i) { return std::string(name_of(i.param)); });

TEST(Wave, BatchesSamplesAndBands) {
    const auto s = make_scene(SceneName::open_noon);
    s->set_size(41, 50);
    s->settings.first_sample = 7;
    for (const u32 most : {96u, 1000u, kWaveMost})
        for (const u32 band : {0u, 1u, 2u}) {
            Means m(*s, 3, band, 3);
            compare(*s, m, run_wave(m.job, most, 0));
        }
    Means none(*s, 1, 5, 6); // more devices than bands
    EXPECT_EQ(run_wave(none.job, kWaveMost, 0).paths, 0u);
}

TEST(Wave, LightForAQuarterOfThePixels) {
    const auto s = make_scene(SceneName::lit_cave);
    s->set_size(40, 24);
    Means m(*s, 2);
    m.job.frame.half = true, m.job.frame.half_x = 1;
    const WaveCount count = run_wave(m.job, kWaveMost, 0);
    EXPECT_EQ(count.paths, 40u * 24 / 4 * 2 + 40 * 24 / 4 * 3);
    compare(*s, m, count);
}

// Bit for bit, in whatever order a device comes upon them.
TEST(Wave, OrderDoesNotMatter) {
    for (const SceneName name : {SceneName::water_and_glass, SceneName::lamp_room}) {
        const auto s = make_scene(name);
        s->set_size(32, 32);
        Means a(*s, 2);
        run_wave(a.job, kWaveMost, 0);
        for (const u32 seed : {1u, 2u}) {
            Means b(*s, 2);
            run_wave(b.job, kWaveMost, seed);
            for (std::size_t i = 0; i < a.means.size(); ++i)
                ASSERT_EQ(std::memcmp(&a.means[i], &b.means[i], sizeof(SampleMean)), 0) << i;
        }
    }
}

// More events than rounds: to and fro between mirrors and through crystal.
TEST(Wave, PathsThatNeedMoreRounds) {
    TestScene s;
    s.fill({-4, -4, -4}, {4, 4, 4}, TestScene::mirror);
    s.fill({-3, -3, -3}, {3, 3, 3}, TestScene::air);
    s.fill({-2, -3, -3}, {1, 0, -2}, TestScene::crystal);
    s.fill({2, -3, -3}, {2, -2, -2}, TestScene::lamp);
    s.publish();
    s.set_glow({});
    s.look({0.5f, 0.5f, 1.5f}, {0.2f, -0.3f, -1}, 80);
    s.set_size(24, 16);
    Means m(s, 1);
    const WaveCount count = run_wave(m.job, kWaveMost, 3);
    EXPECT_GT(count.left, 24u * 16 / 2);
    compare(s, m, count);
    s.settings.events_most = 3; // fewer than rounds
    Means few(s, 1);
    compare(s, few, run_wave(few.job, kWaveMost, 0));
}

TEST(Wave, TilesCoverThePicture) {
    for (const u32 width : {1u, 8u, 61u})
        for (const u32 height : {1u, 16u, 75u})
            for (const u32 bands : {1u, 2u, 4u}) {
                std::vector<u32> seen(width * height);
                for (u32 band = 0; band < bands; ++band) {
                    PathJob job;
                    job.film.width = width, job.film.height = height;
                    job.band = band, job.bands = bands;
                    const u32 all = tile_pixels(width, rows_of_bands(height, band, bands));
                    for (u32 n = 0; n < all; ++n) {
                        const TilePixel p = tile_pixel(job, n);
                        EXPECT_EQ(p.y, row_of(p.row, band, bands));
                        if (samples_at(job, p)) ++seen[p.y * width + p.x];
                    }
                }
                for (u32 n : seen)
                    ASSERT_EQ(n, 1u);
            }
}

// What was stored is what is loaded.
TEST(Wave, PacksWhatAPathCarries) {
    WavePlan plan{.all = 64, .pixels = 64, .paths = 64, .lights_each = 3};
    std::vector<Word4> memory(wave_bytes(plan) / sizeof(Word4) + 16);
    WaveJob j;
    j.wave = lay_out_wave(plan, memory.data());
    j.pixels = 32;
    j.job.settings.seed = 9, j.job.settings.first_sample = 5;
    PathState p;
    p.ray = {{{-5, 1 << 30, 77}, {0.25f, 0.5f, 1}}, {0.6f, -0.8f, 0}};
    p.medium = 255, p.carried = {0.1f, 2, 3}, p.scatter_side = {0, -1, 0}, p.pdf = 3.5f, p.way = 123;
    p.bounces = kEventsMost, p.events = kEventsMost - 1, p.since = Since::mirrors, p.sharp = false, p.bent = true;
    p.sampler = make_sampler(16383, 70, 5 + 1, 9), p.sampler.drawn = 300;
    store_path(j.wave, 33, p, 16383, 70);
    u32 x, y, medium;
    const PathState q = load_path(j, 33, x, y);
    EXPECT_EQ(x, 16383u);
    EXPECT_EQ(y, 70u);
    EXPECT_EQ(q.ray.from.cell, p.ray.from.cell);
    EXPECT_EQ(q.ray.from.at, p.ray.from.at);
    EXPECT_EQ(q.ray.dir, p.ray.dir);
    EXPECT_EQ(q.medium, p.medium);
    EXPECT_EQ(q.carried, p.carried);
    EXPECT_EQ(q.scatter_side, p.scatter_side);
    EXPECT_EQ(q.pdf, p.pdf);
    EXPECT_EQ(q.way, p.way);
    EXPECT_EQ(q.bounces, p.bounces);
    EXPECT_EQ(q.events, p.events);
    EXPECT_EQ(q.since, p.since);
    EXPECT_EQ(q.sharp, p.sharp);
    EXPECT_EQ(q.bent, p.bent);
    EXPECT_EQ(q.sampler.sample, p.sampler.sample);
    EXPECT_EQ(q.sampler.place, p.sampler.place);
    EXPECT_EQ(q.sampler.frame, p.sampler.frame);
    EXPECT_EQ(q.sampler.pixel, p.sampler.pixel);
    EXPECT_EQ(q.sampler.drawn, p.sampler.drawn);
    EXPECT_EQ(load_ray(j.wave, 33, medium).dir, p.ray.dir);
    EXPECT_EQ(medium, 255u);

    Hit h;
    h.t = 12.5f, h.cell = {-1, 2, -3}, h.state = 0x1ffffff, h.kind = HitKind::unknown, h.face = 5, h.leaving = true;
    h.quad = kLiquidSurface, h.u = 0.25f, h.v = 0.75f;
    store_hit(j.wave, 63, h);
    const Hit g = load_hit(j.wave, 63);
    EXPECT_EQ(g.t, h.t);
    EXPECT_EQ(g.cell, h.cell);
    EXPECT_EQ(g.state, h.state);
    EXPECT_EQ(g.kind, h.kind);
    EXPECT_EQ(g.face, h.face);
    EXPECT_EQ(g.leaving, h.leaving);
    EXPECT_EQ(g.quad, h.quad);
    EXPECT_EQ(g.u, h.u);
    EXPECT_EQ(g.v, h.v);

    LightRay l{p.ray, 17, 200, {4, 5, 6}, LightRay::Counts::indirect};
    store_light(j.wave, 64 * 3 - 1, 40, l, Purse::second);
    u32 path;
    Purse purse;
    const LightRay m = load_light(j.wave, 64 * 3 - 1, path, purse);
    EXPECT_EQ(path, 40u);
    EXPECT_EQ(purse, Purse::second);
    EXPECT_EQ(m.ray.from.cell, l.ray.from.cell);
    EXPECT_EQ(m.ray.dir, l.ray.dir);
    EXPECT_EQ(m.distance, l.distance);
    EXPECT_EQ(m.medium, l.medium);
    EXPECT_EQ(m.value, l.value);
    EXPECT_EQ(m.counts, l.counts);
}

// A picture of 1920x1080 is one batch, and its memory is bounded.
TEST(Wave, Memory) {
    PathJob job;
    job.film.width = 1920, job.film.height = 1080;
    job.settings.fog = true, job.sky.sun_light = {1, 1, 1};
    const WavePlan plan = plan_wave(job);
    EXPECT_EQ(plan.batches(), 1u);
    EXPECT_LT(wave_bytes(plan), 740u << 20);
    job.film.width = job.film.height = 16384;
    job.samples = 65536;
    EXPECT_LE(plan_wave(job).paths, kWaveMost);
    EXPECT_GT(plan_wave(job).pixels, 0u);
}

// Where a device has less memory batches are smaller, and remain so.
TEST(Wave, FitsWhatThereIs) {
    PathJob job;
    job.film.width = 1920, job.film.height = 1080;
    u32 most = kWaveMost, asked = 0;
    u64 room = 200u << 20;
    const auto take = [&](u64 bytes) -> Result<> {
        ++asked;
        if (bytes > room) return fail(ErrorCode::limit, "too much");
        return {};
    };
    const auto plan = fit_wave(job, most, take);
    ASSERT_TRUE(plan);
    EXPECT_LE(wave_bytes(*plan), room);
    EXPECT_GT(2 * wave_bytes(*plan), room);
    EXPECT_EQ(plan->batches(), (plan->all + most - 1) / most);
    asked = 0;
    EXPECT_EQ(fit_wave(job, most, take)->paths, plan->paths);
    EXPECT_EQ(asked, 1u);
    // Not even the least; and errors that less memory does not mend.
    room = 0, asked = 0, most = kWaveMost;
    EXPECT_EQ(fit_wave(job, most, take).error().code, ErrorCode::limit);
    EXPECT_EQ(most, kWaveLeast);
    EXPECT_EQ(asked, 6u);
    most = kWaveMost;
    EXPECT_EQ(fit_wave(job, most, [](u64) -> Result<> { return fail(ErrorCode::io, "lost"); }).error().code,
              ErrorCode::io);
    EXPECT_EQ(most, kWaveMost);
}

} // namespace
} // namespace vitrail::test
