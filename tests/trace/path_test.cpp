// Paths against the reference integrator, against analysis, and against themselves.
#include "trace/kernel/texture.h"
#include "trace/statistics.h"

#include <gtest/gtest.h>

namespace vitrail::test {
namespace {

using namespace trace;

bool long_tests() {
    return std::getenv("VITRAIL_LONG") != nullptr;
}

// ---- The mean is that of the reference, all over the picture. The sun is larger here than in life, since the
// reference finds it by chance.

class PathScenes : public testing::TestWithParam<SceneName> {
protected:
    void compare(u32 paths, u32 references, double most_error) {
        auto s = make_scene(GetParam(), 0.3f);
        s->set_size(16, 12);
        const PictureTally a = tally_paths(*s, paths), b = tally_reference(*s, references);
        for (u32 c = 0; c < 3; ++c) {
            EXPECT_LT(apart(a.whole[c], b.whole[c]), 4)
                << "color " << c << ": " << a.whole[c].mean() << " for " << b.whole[c].mean();
            EXPECT_LT(relative_error(a.whole[c], b.whole[c]), most_error) << "too noisy to say anything";
        }
        double worst = 0;
        u32 where = 0;
        for (u32 i = 0; i < PictureTally::kAcross * PictureTally::kDown; ++i)
            if (const double z = apart(a.blocks[i], b.blocks[i]); z > worst) worst = z, where = i;
        EXPECT_LT(worst, 5) << "block " << where << ": " << a.blocks[where].mean() << " for " << b.blocks[where].mean();
    }
};

TEST_P(PathScenes, AsTheReference) {
    const bool dark = GetParam() == SceneName::lamp_room || GetParam() == SceneName::night; // lamps are small
    compare(60, dark ? 1500 : 500, 0.2);
}
TEST_P(PathScenes, AsTheReferenceLong) {
    if (!long_tests()) GTEST_SKIP() << "VITRAIL_LONG is not set";
    // Small lamps make single paths rare and bright: as many more of them, and of the reference, which finds lamps by
    // chance.
    const u32 paths = GetParam() == SceneName::night ? 12'000 : GetParam() == SceneName::lamp_room ? 8'000 : 2'000;
    compare(paths, GetParam() == SceneName::lamp_room ? 120'000 : 40'000, 0.015);
}
INSTANTIATE_TEST_SUITE_P(Six, PathScenes, testing::ValuesIn(kSceneNames),
                         [](const auto& i) { return std::string(name_of(i.param)); });

// ---- Analysis.

double mean_green(const std::vector<Vec3>& p) {
    double sum = 0;
    for (Vec3 v : p)
        sum += double(v.y);
    return sum / double(p.size());
}

// In a closed room whose walls all are the same and shine, radiance is emission / (1 - albedo) everywhere; cut off
// after n scatterings it is emission (1 - albedo^(n + 1)) / (1 - albedo). What the eye sees of it first is held as
// surface.h says: emission 2 of the strongest channel as ln 3.
TEST(Path, ClosedRoomOfShiningWalls) {
    for (const bool direct : {true, false}) {
        TestScene s;
        const float albedo = linear_from_srgb(160.0f / 255), emission = albedo * 2; // emission is of the texel's color
        s.records[TestScene::lamp].emission[0] = s.records[TestScene::lamp].emission[1] =
            s.records[TestScene::lamp].emission[2] = 32;
        // Even walls: no coat to speak of.
        s.publish_states();
        s.fill({-3, -3, -3}, {3, 3, 3}, TestScene::lamp);
        s.fill({-2, -2, -2}, {2, 2, 2}, TestScene::air);
        s.publish();
        s.set_glow({});
        s.look({0.5f, 0.5f, 0.5f}, {0.3f, 0.2f, -1}, 100);
        s.set_size(16, 9);
        s.settings.direct_lamps = direct;
        s.settings.roulette_from = 2;
        for (u32 n : {0u, 1u, 4u}) {
            s.settings.bounces = n;
            Tally t;
            u32 rays = 0;
            for (u32 y = 0; y < 9; ++y)
                for (u32 x = 0; x < 16; ++x)
                    for (u32 i = 0; i < 128; ++i)
                        t.add(double(radiance_of(s.sample(x, y, i, rays)).z));
            const double e = double(emission), a = double(albedo);
            const double want = e * (1 - std::pow(a, n + 1)) / (1 - a) - e + a * std::log(3.0);
            // The coat mirrors a little more than its share of the matte part.
            EXPECT_NEAR(t.mean(), want, 4 * std::sqrt(t.variance_of_mean()) + (n ? 0.06 : 1e-4) * want) << direct << n;
        }
    }
}

// A white thing in an even glow sends that glow everywhere: nothing is lost or won, however often light scatters.
TEST(Path, WhiteFurnace) {
    TestScene s;
    for (i32 x = -3; x <= 3; ++x)
        for (i32 z = -3; z <= 3; ++z)
            for (i32 y = 0; y <= (x * x + 2 * z * z) % 4; ++y)
                s.set(x, y, z, TestScene::white);
    s.fill({-1, 5, -1}, {1, 5, 1}, TestScene::white);
    s.publish();
    s.set_glow({0.7f, 0.7f, 0.7f});
    s.look({0.5f, 6, 9.5f}, {0, -0.4f, -1}, 70);
    s.set_size(32, 18);
    s.settings.bounces = 24, s.settings.events_most = 64, s.settings.roulette_from = 3;
    Tally t;
    u32 rays = 0;
    for (u32 y = 0; y < 18; ++y)
        for (u32 x = 0; x < 32; ++x)
            for (u32 i = 0; i < 32; ++i)
                t.add(double(radiance_of(s.sample(x, y, i, rays)).y));
    EXPECT_NEAR(t.mean(), 0.7, 0.7 * 0.01 + 4 * std::sqrt(t.variance_of_mean()));
}

// Ice full of bubbles that absorbs nothing, in an even glow, cannot be seen: what it scatters on the eye's way it takes
// from what shines through and gives from all around, however deep it is; nothing is lost to light on its way there.
// (At borders that mirror, straight ways lose what they mirror: so there is none.)
TEST(Path, CloudyMediaGainAndLoseNothing) {
    TestScene s;
    s.media[2].absorption = {};
    s.media[2].scattering = {0.6f, 0.4f, 0.2f};
    s.media[2].ior = 1;
    s.publish_states();
    s.fill({-3, 0, -7}, {3, 3, 0}, TestScene::crystal);
    s.publish();
    s.set_glow({0.5f, 0.5f, 0.5f});
    s.settings.fog = true;
    s.look({0.5f, 2, 6.5f}, {0, -0.05f, -1}, 60);
    s.set_size(24, 16);
    double mean = 0;
    for (Vec3 v : s.picture(256)) {
        for (const float c : {v.x, v.y, v.z})
            EXPECT_NEAR(c, 0.5f, 0.09f);
        mean += double(v.x + v.y + v.z) / (3 * 24 * 16);
    }
    EXPECT_NEAR(mean, 0.5, 0.005);
}

// Clear glass and crystal (that absorb nothing) in an even glow cannot be seen.
TEST(Path, ClearBordersInTheFurnace) {
    TestScene s;
    s.media[2].absorption = {};
    s.publish_states();
    s.fill({-2, 0, -2}, {2, 3, 0}, TestScene::crystal);
    s.publish();
    s.set_glow({0.5f, 0.5f, 0.5f});
    s.look({0.5f, 2, 6.5f}, {0, -0.05f, -1}, 60);
    s.set_size(24, 16);
    s.settings.events_most = 200; // light that is mirrored totally goes to and fro for long
    for (Vec3 v : s.picture(64))
        EXPECT_NEAR(v.y, 0.5f, 0.03f);
}

// Light of the sun on a level plane follows the cosine of its height.
TEST(Path, CosineOfTheSun) {
    TestScene s;
    s.fill({-20, 0, -20}, {20, 0, 20}, TestScene::white);
    s.publish();
    s.look({0.5f, 8, 0.5f}, {0, -1, -0.01f}, 20);
    s.set_size(8, 8);
    s.set_glow({});
    s.settings.bounces = 1;
    for (const float degrees : {90.0f, 60.0f, 30.0f, 10.0f}) {
        const float a = degrees * 3.14159265f / 180;
        s.sky.light_direction = {std::cos(a), std::sin(a), 0};
        s.sky.light_radius = 0.01f;
        s.sky.sun_light = {2, 2, 2}; // irradiance over pi of what faces it
        // White with its coat: what the coat mirrors elsewhere is missing, most of it at grazing light.
        const double want = 2 * double(std::sin(a));
        EXPECT_NEAR(mean_green(s.picture(64)), want, want * (degrees < 20 ? 0.35 : 0.10)) << degrees;
    }
}

// ---- Direct sampling finds no other light than chance does.
TEST(Path, DirectLampsChangeNoMean) {
    auto s = make_scene(SceneName::lit_cave);
    s->set_size(16, 12);
    s->settings.bounces = 2;
    const PictureTally a = tally_paths(*s, 60);
    s->settings.direct_lamps = false;
    const PictureTally b = tally_paths(*s, 400);
    for (u32 c = 0; c < 3; ++c)
        EXPECT_LT(apart(a.whole[c], b.whole[c]), 4);
    for (u32 i = 0; i < 12; ++i)
        EXPECT_LT(apart(a.blocks[i], b.blocks[i]), 5);
    EXPECT_LT(a.whole[1].variance_of_mean() * 60, b.whole[1].variance_of_mean() * 400); // and settle sooner
}

// ---- Error falls as 1 / sqrt(samples), or faster: against a picture of many more samples.
void expect_falling_error(u32 last, u32 truth_samples) {
    auto s = make_scene(SceneName::open_noon);
    s->set_size(16, 16);
    s->settings.seed = 7;
    const std::vector<Vec3> truth = s->picture(truth_samples);
    s->settings.seed = 8;
    std::vector<Vec3> sum(truth.size());
    double first = 0;
    u32 done = 0;
    for (u32 samples = 16; samples <= last; samples *= 4) {
        const std::vector<Vec3> more = s->picture(samples - done, done);
        double error = 0;
        for (std::size_t i = 0; i < sum.size(); ++i) {
            sum[i] += more[i] * float(samples - done);
            const Vec3 d = sum[i] * (1 / float(samples)) - truth[i];
            error += double(dot(d, d)) / double(sum.size());
        }
        done = samples;
        error = std::sqrt(error);
        if (samples == 16) first = error;
        // What the truth itself is off by comes on top.
        const double want = first * std::sqrt(16.0 / samples), own = first * std::sqrt(16.0 / truth_samples);
        EXPECT_LT(error, 1.35 * std::sqrt(want * want + own * own)) << samples;
    }
}
TEST(Path, ErrorFalls) {
    expect_falling_error(256, 1024);
}
TEST(Path, ErrorFallsLong) {
    if (!long_tests()) GTEST_SKIP() << "VITRAIL_LONG is not set";
    expect_falling_error(4096, 32768);
}

TEST(Path, SameSeedSamePicture) {
    auto a = make_scene(SceneName::water_and_glass), b = make_scene(SceneName::water_and_glass);
    a->set_size(24, 16), b->set_size(24, 16);
    const auto pa = a->picture(4), pb = b->picture(4);
    for (std::size_t i = 0; i < pa.size(); ++i)
        ASSERT_EQ(pa[i], pb[i]);
    b->settings.seed = 5;
    EXPECT_NE(b->picture(4), pa);
}

// A find that is held makes no other pixel darker than without.
TEST(Path, FirefliesAreHeld) {
    auto s = make_scene(SceneName::lamp_room);
    s->set_size(32, 18);
    const auto free = s->picture(64);
    s->settings.firefly_limit = 2;
    const auto held = s->picture(64);
    for (std::size_t i = 0; i < free.size(); ++i)
        EXPECT_LE(held[i].y, free[i].y + 1e-4f);
    EXPECT_GE(mean_green(held), 0.9 * mean_green(free));
}

// ---- What the film is told.
TEST(Path, GuidesOfTheFirstSurface) {
    TestScene s;
    s.fill({-5, 0, -9}, {5, 5, -9}, TestScene::red);
    s.fill({-5, 0, -6}, {5, 5, -6}, TestScene::glass);
    s.publish();
    s.set_sky(6000);
    s.settings.fog = false;
    s.look({0.5f, 2.5f, 0.5f}, {0, 0, -1}, 20);
    s.set_size(8, 8);
    u32 rays = 0, seen = 0;
    for (u32 i = 0; i < 64; ++i) {
        const PixelSample p = s.sample(i % 8, i / 8, 0, rays);
        EXPECT_GE(p.albedo.x, 0.01f);
        if (p.albedo.x < 2 * p.albedo.y) continue; // mirrored by the glass, or its rim
        if (p.distance > 10.2f) continue;          // to and fro between its faces, a block apart
        ++seen;
        EXPECT_GT(p.normal.z, 0.9f);
        EXPECT_NEAR(p.distance, 8.5f, 0.3f); // behind the glass
        EXPECT_NE(p.surface, 0u);
    }
    EXPECT_GT(seen, 32u);
    s.look({0.5f, 2.5f, 0.5f}, {0, 1, 0.1f}, 20); // the sky
    const PixelSample p = s.sample(4, 4, 0, rays);
    EXPECT_EQ(p.distance, 0);
    EXPECT_EQ(p.normal, Vec3{});
    EXPECT_GT(p.base.z, 0);
}

// Mirrors to infinity end.
TEST(Path, EndsBetweenMirrors) {
    TestScene s;
    s.fill({-3, -3, -3}, {3, 3, 3}, TestScene::mirror);
    s.fill({-2, -2, -2}, {2, 2, 2}, TestScene::air);
    s.publish();
    s.set_glow({});
    s.look({0.5f, 0.5f, 0.5f}, {0, 0, -1}, 90);
    u32 rays = 0;
    s.sample(3, 3, 0, rays);
    EXPECT_LE(rays, s.settings.events_most);
}

} // namespace
} // namespace vitrail::test
