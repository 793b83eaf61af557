// Antialiasing in time and of the finished picture, on pictures that are known everywhere, also between pixels.
#include "math/angle.h"
#include "pass_rig.h"
#include "render/passes/fxaa/fxaa_pass.h"
#include "render/passes/taa/taa_pass.h"
#include "render/passes/tonemap/tonemap_pass.h"

namespace vitrail::render {

using AntialiasTest = RenderTest;
using World = Vec3 (*)(Vec3 direction);

constexpr u32 kWidth = 96, kHeight = 64;

static scene::FrameView looking(float yaw_deg, u32 width = kWidth, u32 height = kHeight) {
    return bench::SampleScene::frame(width, height, {}, yaw_deg, 10, 8);
}

// What the world shows through the point (x, y) of the picture, in pixels from its upper left corner.
static Vec3 seen(World world, const FrameUniforms& u, float x, float y) {
    const ViewUniforms& v = u.views[0];
    const float nx = x / u.screen.x * 2 - 1, ny = 1 - y / u.screen.y * 2;
    const auto xyz = [](Vec4 a) { return Vec3{a.x, a.y, a.z}; };
    return world(normalized(xyz(v.ray_forward) + xyz(v.ray_right) * nx + xyz(v.ray_up) * ny));
}

static Picture one_sample(World world, const FrameUniforms& u) {
    Picture out(u32(u.screen.x), u32(u.screen.y));
    for (u32 y = 0; y < out.height; ++y)
        for (u32 x = 0; x < out.width; ++x)
            out.at(x, y) = seen(world, u, float(x) + 0.5f, float(y) + 0.5f);
    return out;
}

static Picture supersampled(World world, const scene::FrameView& frame) {
    const FrameUniforms u = make_frame_uniforms(frame, {}, {}, false, {});
    Picture out(frame.width, frame.height);
    constexpr u32 n = 12;
    for (u32 y = 0; y < out.height; ++y)
        for (u32 x = 0; x < out.width; ++x)
            for (u32 i = 0; i < n * n; ++i)
                out.at(x, y) = out.at(x, y) + seen(world, u, float(x) + (float(i % n) + 0.5f) / n,
                                                   float(y) + (float(i / n) + 0.5f) / n) *
                                                  (1.0f / (n * n));
    return out;
}

static double rms(const Picture& a, const Picture& b) {
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const Vec3 d = a.pixels[i] - b.pixels[i];
        sum += double(dot(d, d));
    }
    return std::sqrt(sum / double(a.pixels.size()) / 3);
}

// Slanted bars, a few of them finer than a pixel, in two colors.
static Vec3 bars(Vec3 d) {
    const float a = d.x * 9.3f + d.y * 4.1f, b = d.y * 31 - d.x * 3.7f;
    return a - std::floor(a) < 0.4f   ? Vec3{0.8f, 0.5f, 0.2f}
           : b - std::floor(b) < 0.3f ? Vec3{0.1f, 0.3f, 0.7f}
                                      : Vec3{0.05f, 0.05f, 0.06f};
}
static Vec3 checks(Vec3 d) {
    const float a = d.x / std::abs(d.z) * 4, b = d.y / std::abs(d.z) * 4;
    return (i32(std::floor(a)) + i32(std::floor(b))) % 2 ? Vec3{0.6f, 0.6f, 0.55f} : Vec3{0.06f, 0.05f, 0.08f};
}

static Effects only(Antialias kind) {
    Effects effects = preset_effects(Preset::off);
    effects.antialias = i32(kind);
    effects.dither = false;
    return effects;
}

TEST_F(AntialiasTest, ARestingPictureBecomesTheSupersampledOne) {
    PassRig rig(only(Antialias::taa), passes_of<TaaPass>());
    const auto frame = looking(0);
    const Picture wanted = supersampled(bars, frame);
    const double plain = rms(one_sample(bars, make_frame_uniforms(frame, {}, {}, false, {})), wanted);
    ASSERT_GT(plain, 0.05);
    double before = 1;
    for (u32 i = 1; i <= 32; ++i) {
        rig.draw([](const FrameUniforms& u) { return one_sample(bars, u); }, frame, 1 / 60.0f);
        if (i != 4 && i != 16 && i != 32) continue;
        const double error = rms(rig.read("taa"), wanted);
        EXPECT_LT(error, before) << i;
        if (i == 16) EXPECT_LT(error, 0.45 * plain);
        before = error * 1.05;
    }
    // The mean of all shifts is no shift: half a pixel off would be seen in every still.
    Vec2 mean;
    for (u32 i = 0; i < TaaPass::kShifts; ++i)
        mean.x += TaaPass::shift(i).x / TaaPass::kShifts, mean.y += TaaPass::shift(i).y / TaaPass::kShifts;
    EXPECT_LT(std::abs(mean.x), 0.05f);
    EXPECT_LT(std::abs(mean.y), 0.05f);
}

// The camera turns by several pixels a frame: the picture stays sharp and nothing trails.
TEST_F(AntialiasTest, TurningLeavesNoGhost) {
    PassRig rig(only(Antialias::taa), passes_of<TaaPass>());
    float yaw = 0;
    for (u32 i = 0; i < 24; ++i, yaw += 2.3f)
        rig.draw([](const FrameUniforms& u) { return one_sample(checks, u); }, looking(yaw), 1 / 60.0f);
    const auto frame = looking(yaw - 2.3f);
    const Picture wanted = supersampled(checks, frame), got = rig.read("taa");
    const double plain = rms(one_sample(checks, make_frame_uniforms(frame, {}, {}, false, {})), wanted);
    EXPECT_LT(rms(got, wanted), plain); // better than without, even now
    // Inside of fields, two pixels from their borders, the color is the field's.
    u32 inside = 0;
    for (u32 y = 2; y + 2 < kHeight; ++y)
        for (u32 x = 2; x + 2 < kWidth; ++x) {
            bool even = true;
            for (u32 j = 0; j < 25; ++j)
                even = even && length(wanted.at(x + j % 5 - 2, y + j / 5 - 2) - wanted.at(x, y)) < 1e-3f;
            if (!even) continue;
            ++inside;
            ASSERT_LT(length(got.at(x, y) - wanted.at(x, y)), 0.01f) << x << " " << y;
        }
    EXPECT_GT(inside, 500u);
}

// Something near passes before something far: what it uncovers is at once what lies there.
TEST_F(AntialiasTest, UncoveredPlacesStartAnew) {
    PassRig rig(only(Antialias::taa), passes_of<TaaPass>());
    const auto frame = looking(0);
    const Vec3 near_color{0.9f, 0.1f, 0.1f}, far_color{0.2f, 0.25f, 0.4f};
    rig.depth.assign(kWidth * kHeight, 0);
    for (u32 step = 0; step < 12; ++step) {
        const u32 left = 8 + step * 4;
        Picture color(kWidth, kHeight, far_color);
        for (u32 y = 0; y < kHeight; ++y)
            for (u32 x = 0; x < kWidth; ++x) {
                const bool near = x >= left && x < left + 16;
                if (near) color.at(x, y) = near_color;
                // Texture on the far wall, so that the clipping box alone would let red through.
                else if ((x * 7 + y * 13) % 5 == 0)
                    color.at(x, y) = {0.8f, 0.3f, 0.2f};
                rig.depth[y * kWidth + x] = kNearPlane / (near ? 2.0f : 40.0f);
            }
        rig.draw(color, frame, 1 / 60.0f);
        const Picture got = rig.read("taa");
        if (step == 0) continue;
        for (u32 y = 0; y < kHeight; ++y)
            for (u32 x = left - 3; x < left - 1; ++x)
                ASSERT_LT(length(got.at(x, y) - color.at(x, y)), 0.02f) << step << " " << x << " " << y;
    }
}

TEST_F(AntialiasTest, NothingCrossesTheEdgeBetweenViews) {
    PassRig rig(only(Antialias::taa), passes_of<TaaPass>());
    auto frame = looking(0);
    frame.views.push_back(frame.views[0]);
    frame.views[1].parent = 0;
    const auto portal = [](u32 x, u32 y) { return x > 30 && x < 60 && y > 20 && y < 50; };
    Picture color(kWidth, kHeight);
    rig.depth.assign(kWidth * kHeight, kNearPlane / 10);
    rig.views.assign(kWidth * kHeight, 0);
    for (u32 y = 0; y < kHeight; ++y)
        for (u32 x = 0; x < kWidth; ++x) {
            color.at(x, y) = portal(x, y) ? Vec3{0, 0.1f, 6} : Vec3{0.3f, 0, 0};
            rig.views[y * kWidth + x] = portal(x, y);
        }
    for (u32 i = 0; i < 6; ++i) {
        // The second view looks elsewhere every frame, as through a portal from which one steps aside.
        frame.views[1].rotation = view_rotation(float(i) * 0.02f, 0.17f);
        rig.draw(color, frame, 1 / 60.0f);
    }
    const Picture got = rig.read("taa");
    for (u32 y = 0; y < kHeight; ++y)
        for (u32 x = 0; x < kWidth; ++x) {
            const Vec3 own = color.at(x, y), c = got.at(x, y);
            ASSERT_LT(length(c - own), 0.004f * length(own)) << x << " " << y;
        }
}

TEST_F(AntialiasTest, WhatIsNoNumberIsGoneAfterAFrame) {
    PassRig rig(only(Antialias::taa), passes_of<TaaPass>());
    Picture color(kWidth, kHeight, {0.3f, 0.3f, 0.3f});
    color.at(40, 30) = {std::nanf(""), 1, 1};
    rig.draw(color, looking(0), 0.1f);
    color.at(40, 30) = {0.3f, 0.3f, 0.3f};
    for (u32 i = 0; i < 2; ++i)
        rig.draw(color, looking(0), 0.1f);
    for (const Vec3& p : rig.read("taa").pixels)
        ASSERT_NEAR(p.x, 0.3f, 0.01f);
}

TEST_F(AntialiasTest, FxaaSmoothsSlantedEdgesAndLeavesTheRest) {
    const auto half_plane = [](float slope) {
        Picture out(kWidth, kHeight);
        for (u32 y = 0; y < kHeight; ++y)
            for (u32 x = 0; x < kWidth; ++x)
                out.at(x, y) = float(y) + 0.5f > 12 + slope * (float(x) + 0.5f) ? Vec3{0.6f, 0.6f, 0.6f}
                                                                                : Vec3{0.02f, 0.02f, 0.02f};
        return out;
    };
    const auto shown = [](Antialias kind, const Picture& picture) {
        PassRig rig(only(kind), passes_of<TonemapPass, FxaaPass>());
        rig.draw(picture, looking(0), 0);
        return rig.screen();
    };
    for (float slope : {0.13f, 0.37f, 0.61f}) {
        const Picture picture = half_plane(slope), plain = shown(Antialias::off, picture),
                      smooth = shown(Antialias::fxaa, picture);
        const float low = plain.at(95, 0).x, high = plain.at(0, 63).x;
        double error_plain = 0, error_smooth = 0;
        for (u32 x = 4; x + 4 < kWidth; ++x)
            for (u32 y = 2; y + 2 < kHeight; ++y) {
                // Share of the pixel below the line, its middle column standing for it.
                const float edge = 12 + slope * (float(x) + 0.5f);
                const float wanted = low + (high - low) * std::clamp(float(y) + 1 - edge, 0.0f, 1.0f);
                error_plain += double(std::abs(plain.at(x, y).x - wanted));
                error_smooth += double(std::abs(smooth.at(x, y).x - wanted));
                if (std::abs(float(y) + 0.5f - edge) > 2.5f)
                    ASSERT_EQ(smooth.at(x, y).x, plain.at(x, y).x) << x << " " << y;
            }
        EXPECT_LT(error_smooth, 0.65 * error_plain) << slope;
    }
    // Steps along the axes are no stairs, and soft changes no edges.
    for (bool soft : {false, true}) {
        Picture picture(kWidth, kHeight);
        for (u32 y = 0; y < kHeight; ++y)
            for (u32 x = 0; x < kWidth; ++x)
                picture.at(x, y) = Vec3{1, 1, 1} * (soft ? 0.1f + 0.004f * float(x) : x < 48 ? 0.05f : 0.7f);
        const Picture plain = shown(Antialias::off, picture), smooth = shown(Antialias::fxaa, picture);
        for (u32 y = 4; y + 4 < kHeight; ++y)
            for (u32 x = 0; x < kWidth; ++x)
                ASSERT_NEAR(smooth.at(x, y).x, plain.at(x, y).x, soft ? 1e-6f : 0.04f) << soft << " " << x;
    }
}

} // namespace vitrail::render
