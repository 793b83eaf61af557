// What stands for the eye and the lens: exposure, bloom, tone curve, dithering.
#include "pass_rig.h"
#include "render/passes/bloom/bloom_pass.h"
#include "render/passes/exposure/exposure_pass.h"
#include "render/passes/tonemap/tonemap_pass.h"
#include "scene/tone_curve.h"

namespace vitrail::render {

using EyeTest = RenderTest;

static scene::FrameView frame_of(u32 width, u32 height) {
    return bench::SampleScene::frame(width, height, {}, 0, 0, 8);
}

static void set_lamp(Picture& picture, u32 x, u32 y, Vec3 radiance) {
    for (u32 j = 0; j < 4; ++j)
        for (u32 i = 0; i < 4; ++i)
            picture.at(x + i, y + j) = radiance;
}

static Effects bloom_alone(i32 levels) {
    Effects effects = preset_effects(Preset::off);
    effects.bloom.on = true;
    effects.bloom.levels = levels;
    return effects;
}

// Each hue spreads the same light, equally far.
TEST_F(EyeTest, BlueLampBloomsAsMuchAsRed) {
    const auto spread = [](Vec3 radiance) {
        PassRig rig(bloom_alone(6), passes_of<BloomPass>());
        Picture lamp(256, 144);
        set_lamp(lamp, 126, 70, radiance);
        rig.draw(lamp, frame_of(256, 144), 0);
        return rig.read("bloom1");
    };
    const Picture red = spread({12, 0, 0}), green = spread({0, 12, 0}), blue = spread({0, 0, 12});
    EXPECT_GT(red.at(64, 36).x, 0.05f);
    EXPECT_GT(red.at(64 + 30, 36).x, 1e-4f); // 60 pixels away
    for (u32 y = 0; y < red.height; ++y)
        for (u32 x = 0; x < red.width; ++x) {
            ASSERT_EQ(red.at(x, y).x, blue.at(x, y).z);
            ASSERT_EQ(red.at(x, y).x, green.at(x, y).y);
            ASSERT_EQ(red.at(x, y).z, 0.0f);
            ASSERT_EQ(blue.at(x, y).x, 0.0f);
        }
}

TEST_F(EyeTest, BloomKeepsTheLight) {
    for (const auto& [width, height] : {std::pair<u32, u32>{512, 256}, {427, 241}})
        for (i32 levels : {2, 4}) { // as far as no light reaches the border, where the lens has no picture
            PassRig rig(bloom_alone(levels), passes_of<BloomPass>());
            Picture lamps(width, height);
            set_lamp(lamps, width / 2 - 20, height / 2 - 10, {10, 4, 1});
            set_lamp(lamps, width / 2 + 31, height / 2 + 7, {0.5f, 2, 7});
            rig.draw(lamps, frame_of(width, height), 0);
            const Vec3 before = lamps.sum(), after = rig.read("bloom1").sum() * 4;
            EXPECT_NEAR(after.x, before.x, 0.01f * before.x) << width << " " << levels;
            EXPECT_NEAR(after.y, before.y, 0.01f * before.y);
            EXPECT_NEAR(after.z, before.z, 0.01f * before.z);
        }
    // An even picture stays what it is, to its borders.
    PassRig rig(bloom_alone(7), passes_of<BloomPass>());
    rig.draw(Picture(133, 77, {0.3f, 0.5f, 0.7f}), frame_of(133, 77), 0);
    for (const Vec3& p : rig.read("bloom1").pixels) {
        ASSERT_NEAR(p.x, 0.3f, 2e-3f);
        ASSERT_NEAR(p.z, 0.7f, 2e-3f);
    }
}

// A blinding texel, an endless one and one that is no number: the hue stays, nothing spreads that is no light.
TEST_F(EyeTest, FirefliesAreHeldWithTheirHue) {
    PassRig rig(bloom_alone(4), passes_of<BloomPass>());
    Picture glint(64, 64);
    glint.at(32, 32) = {30000, 15000, 7500};
    rig.draw(glint, frame_of(64, 64), 0);
    const Vec3 held = rig.read("bloom1").sum() * 4;
    EXPECT_LT(held.x, 64.0f * 4 * 1.02f); // of 30000: the mean of four texels is held
    EXPECT_GT(held.x, 64.0f);
    EXPECT_NEAR(held.y / held.x, 0.5f, 0.01f);
    EXPECT_NEAR(held.z / held.x, 0.25f, 0.01f);
    glint.at(32, 32) = {std::nanf(""), 1, 1};
    rig.draw(glint, frame_of(64, 64), 0);
    for (const Vec3& p : rig.read("bloom1").pixels)
        ASSERT_TRUE(p.x >= 0 && p.y >= 0 && p.y < 2);
}

static Effects exposure_alone() {
    Effects effects = preset_effects(Preset::off);
    effects.exposure.automatic = true;
    effects.exposure.speed = 1.2f;
    return effects;
}
static float stops(const PassRig& rig) {
    return rig.read("exposure").at(0, 0).y;
}
static float wanted_stops(float luminance) {
    const ExposureCurve& c = kExposureCurve;
    return std::clamp((c.reference_log2 - std::log2(luminance)) * c.slope, c.least, c.most);
}

TEST_F(EyeTest, ExposureBeginsWhereItWouldSettle) {
    for (float luminance : {1e-6f, 0.01f, 0.05f, 0.2f, 0.5f, 2.0f, 1000.0f}) {
        PassRig rig(exposure_alone(), passes_of<ExposurePass>());
        rig.draw(Picture(64, 36, Vec3{1, 1, 1} * luminance), frame_of(64, 36), 0);
        const Vec3 exposure = rig.read("exposure").at(0, 0);
        EXPECT_NEAR(exposure.y, wanted_stops(luminance), 0.01f) << luminance;
        EXPECT_NEAR(exposure.x, std::exp2(exposure.y), 1e-3f);
    }
    // Brighter land looks brighter, though the eye makes up for a part.
    for (float luminance = 1e-3f; luminance < 100; luminance *= 2)
        EXPECT_GT(2 * luminance * std::exp2(wanted_stops(2 * luminance)),
                  1.3f * luminance * std::exp2(wanted_stops(luminance)));
}

// From noon into a cave and back: monotone, to within 2 percent, the same at any frame rate.
TEST_F(EyeTest, ExposureSettles) {
    const Picture bright(64, 36, {0.6f, 0.6f, 0.6f}), dark(64, 36, {0.03f, 0.03f, 0.03f});
    const auto frame = frame_of(64, 36);
    const auto adapt = [&](const Picture& from, const Picture& to, u32 frames, float seconds) {
        PassRig rig(exposure_alone(), passes_of<ExposurePass>());
        rig.draw(from, frame, 0);
        std::vector<float> way{stops(rig)};
        for (u32 i = 0; i < frames; ++i) {
            rig.draw(to, frame, seconds / float(frames));
            way.push_back(stops(rig));
        }
        return way;
    };
    const float day = wanted_stops(0.6f), cave = wanted_stops(0.03f);
    ASSERT_GT(cave - day, 1.5f);
    const std::vector<float> in = adapt(bright, dark, 120, 4), out = adapt(dark, bright, 120, 2);
    for (std::size_t i = 1; i < in.size(); ++i) {
        EXPECT_GE(in[i], in[i - 1]);
        EXPECT_LE(in[i], cave + 1e-3f);
        EXPECT_LE(out[i], out[i - 1]);
        EXPECT_GE(out[i], day - 1e-3f);
    }
    EXPECT_NEAR(std::exp2(in.back() - cave), 1, 0.02f);
    EXPECT_NEAR(std::exp2(out.back() - day), 1, 0.02f);
    EXPECT_LT(in[30], cave - 0.3f); // and it takes its time
    // Half a second into the light is as far as 1.25 seconds into the dark.
    EXPECT_NEAR((out[30] - cave) / (day - cave), 1 - std::exp(-0.5f * 1.2f * kFasterToBright), 0.01f);
    for (u32 frames : {5u, 37u, 240u})
        EXPECT_NEAR(adapt(bright, dark, frames, 1).back(), adapt(bright, dark, 60, 1).back(), 0.01f) << frames;
}

TEST_F(EyeTest, ASmallLampDoesNotBlind) {
    Picture night(160, 90, {0.02f, 0.02f, 0.02f});
    const auto settled = [&](const Picture& picture) {
        PassRig rig(exposure_alone(), passes_of<ExposurePass>());
        rig.draw(picture, frame_of(160, 90), 0);
        return stops(rig);
    };
    const float alone = settled(night);
    for (u32 y = 40; y < 50; ++y)
        for (u32 x = 75; x < 85; ++x)
            night.at(x, y) = {60, 60, 60};
    EXPECT_NEAR(settled(night), alone, 0.12f);
    night.at(3, 3) = {std::nanf(""), 0, 0};
    EXPECT_NEAR(settled(night), alone, 0.12f);
}

// The shader's curve is scene::filmic and sRGB's; the screen rounds to 1/255.
TEST_F(EyeTest, ToneCurveIsTheSameInBothLanguages) {
    Effects effects = preset_effects(Preset::off);
    effects.dither = false;
    PassRig rig(effects, passes_of<TonemapPass>());
    Picture colors(64, 48);
    Rng rng(5);
    for (Vec3& c : colors.pixels)
        c = Vec3{rng.unit(), rng.unit(), rng.unit()} * std::exp2(rng.unit() * 12 - 8);
    rig.draw(colors, frame_of(64, 48), 0);
    const Picture screen = rig.screen();
    for (std::size_t i = 0; i < colors.pixels.size(); ++i) {
        const Vec3 wanted = scene::filmic(colors.pixels[i]);
        ASSERT_NEAR(screen.pixels[i].x, scene::srgb_encode(wanted.x), 0.005f) << colors.pixels[i].x;
        ASSERT_NEAR(screen.pixels[i].y, scene::srgb_encode(wanted.y), 0.005f);
        ASSERT_NEAR(screen.pixels[i].z, scene::srgb_encode(wanted.z), 0.005f);
    }
}

TEST(ToneCurve, RisesAndKeepsGray) {
    float before = -1;
    for (float x = 0; x < 30; x = x * 1.1f + 0.001f) {
        const Vec3 gray = scene::filmic({x, x, x});
        EXPECT_GE(gray.y, before);
        EXPECT_NEAR(gray.x, gray.y, 0.002f);
        EXPECT_NEAR(gray.z, gray.y, 0.002f);
        before = gray.y;
    }
    EXPECT_GT(before, 0.97f);
    EXPECT_NEAR(scene::filmic({0.18f, 0.18f, 0.18f}).y, 0.18f, 0.05f);
}

// Bands: in a soft gradient the local mean of what the screen shows follows the curve far closer than its 8 bits could.
TEST_F(EyeTest, DitheringRemovesBandsAndKeepsTheMean) {
    Effects effects = preset_effects(Preset::off);
    Picture gradient(512, 64);
    for (u32 y = 0; y < 64; ++y)
        for (u32 x = 0; x < 512; ++x)
            gradient.at(x, y) = Vec3{1, 1, 1} * (0.10f + 0.01f * float(x) / 512); // about 5 steps
    const auto error = [&](bool dither) {
        effects.dither = dither;
        PassRig rig(effects, passes_of<TonemapPass>());
        rig.draw(gradient, frame_of(512, 64), 0);
        const Picture screen = rig.screen();
        double worst = 0, bias = 0;
        for (u32 x = 0; x + 16 <= 512; x += 16) {
            double mean = 0, wanted = 0;
            for (u32 y = 0; y < 64; ++y)
                for (u32 i = x; i < x + 16; ++i) {
                    mean += double(screen.at(i, y).y);
                    wanted += double(scene::srgb_encode(scene::filmic(gradient.at(i, y)).y));
                }
            const double off = (mean - wanted) / (16 * 64) * 255;
            worst = std::max(worst, std::abs(off));
            bias += off / 32;
        }
        return std::pair{worst, bias};
    };
    const auto plain = error(false), dithered = error(true);
    // The shader's curve itself is off by up to half a step; it moves both alike.
    EXPECT_NEAR(dithered.second, plain.second, 0.08);
    EXPECT_GT(plain.first - std::abs(plain.second), 0.3);
    EXPECT_LT(dithered.first - std::abs(dithered.second), 0.15);
}

} // namespace vitrail::render
