// The sky stands twice in the sources, as shaders and as kernels of the path tracer: both draw one picture.
#include "pass_rig.h"
#include "render/passes/sky/sky_pass.h"
#include "scene/sky.h"
#include "trace/kernel/sky.h"
#include "trace/sky_source.h"

namespace vitrail::render {

using SkyTwinTest = RenderTest;

namespace {

struct Look {
    float time, yaw, pitch, fov;
    u64 day = 0;
};

// The kernels' picture of what the rig last drew.
Picture traced(const scene::FrameView& frame, const FrameUniforms& u, bool clouds) {
    trace::SkyView sky = trace::sky_view_of(frame);
    sky.clouds = clouds;
    sky.cloud_steps = 9; // as many as the shader's
    Picture out(frame.width, frame.height);
    const auto xyz = [](Vec4 v) { return Vec3{v.x, v.y, v.z}; };
    const ViewUniforms& view = u.views[0];
    for (u32 y = 0; y < frame.height; ++y)
        for (u32 x = 0; x < frame.width; ++x) {
            const Vec2 ndc{2 * (float(x) + 0.5f) / float(frame.width) - 1,
                           1 - 2 * (float(y) + 0.5f) / float(frame.height)};
            const Vec3 ray = xyz(view.ray_forward) + xyz(view.ray_right) * ndc.x + xyz(view.ray_up) * ndc.y;
            const float per_length = 1 / length(ray);
            // As the shader hides the steps of its march.
            const float turn = 0.06711056f * float(x) + 0.00583715f * float(frame.height - 1 - y);
            const float noise = 52.9829189f * (turn - std::floor(turn));
            out.at(x, y) =
                trace::sky_seen(sky, ray * per_length, view.ray_right.w * per_length, noise - std::floor(noise));
        }
    return out;
}

} // namespace

TEST_F(SkyTwinTest, ShadersAndKernelsDrawTheSameSky) {
    Effects effects = preset_effects(Preset::ultra);
    effects.sky.clouds = i32(Clouds::lit), effects.sky.stars = true;
    PassRig cloudy(effects, passes_of<SkyPass>());
    effects.sky.clouds = i32(Clouds::off);
    PassRig clear(effects, passes_of<SkyPass>());
    const Look looks[] = {{200, -90, -8, 1.2f},    {6000, 20, -35, 1.2f},   {5000, -32, -60, 0.3f},
                          {11900, 80, -10, 1.2f},  {12700, 90, -4, 0.9f},   {18000, 0, -63, 0.25f},
                          {18000, 200, -40, 1.2f}, {14500, -75, -30, 0.9f}, {21000, 90, -30, 0.8f},
                          {16000, 30, 10, 1.2f}};
    for (const Look& look : looks)
        for (u64 day : {0u, 3u}) {
            PassRig& rig = day == 0 ? cloudy : clear;
            auto frame = bench::SampleScene::frame(96, 64, eye_at(100, 90, -3000), look.yaw, look.pitch, 8);
            frame.sky = scene::sky_at(look.time, day);
            frame.views[0].fov_y = look.fov;
            frame.seconds = 321.5f;
            FrameUniforms uniforms;
            rig.draw(
                [&](const FrameUniforms& u) {
                    uniforms = u;
                    return Picture(frame.width, frame.height);
                },
                frame, 0.016f);
            const Picture drawn = rig.read("color"), ours = traced(frame, uniforms, day == 0);
            if (const char* folder = std::getenv("VITRAIL_KEEP_PICTURES")) {
                Image both{frame.width * 2, frame.height, 4,
                           std::vector<u8>(std::size_t(frame.width) * frame.height * 8)};
                for (u32 y = 0; y < frame.height; ++y)
                    for (u32 x = 0; x < frame.width * 2; ++x) {
                        const Vec3 c = x < frame.width ? drawn.at(x, y) : ours.at(x - frame.width, y);
                        const auto byte = [](float v) { return u8(255 * std::pow(v / (v + 0.5f), 0.4545f)); };
                        u8* p = both.at(x, y);
                        p[0] = byte(c.x), p[1] = byte(c.y), p[2] = byte(c.z), p[3] = 255;
                    }
                (void)write_png(fmt::format("{}/sky_{}_{}_{}.png", folder, look.time, look.yaw, day), both);
            }
            // Software OpenGL filters textures of bytes with bytes, which the clouds' steep edges show as fine grain:
            // small blocks agree, and most pixels.
            u32 off = 0;
            double sum = 0, worst = 0;
            for (u32 by = 0; by < frame.height; by += 8)
                for (u32 bx = 0; bx < frame.width; bx += 8) {
                    Vec3 a, b;
                    for (u32 i = 0; i < 64; ++i) {
                        const Vec3 p = drawn.at(bx + i % 8, by + i / 8), q = ours.at(bx + i % 8, by + i / 8);
                        const auto differs = [](float v, float w) {
                            return std::abs(v - w) > 0.0004f + 0.03f * std::max(v, w);
                        };
                        off += differs(p.x, q.x) || differs(p.y, q.y) || differs(p.z, q.z);
                        a += p * (1.0f / 64), b += q * (1.0f / 64);
                    }
                    const auto apart = [](float v, float w) {
                        return double((std::abs(v - w) - 0.0002f) / std::max(v, w));
                    };
                    worst = std::max({worst, apart(a.x, b.x), apart(a.y, b.y), apart(a.z, b.z)});
                    sum += double(a.x + a.y + a.z);
                }
            EXPECT_LT(off, drawn.pixels.size() / 12) << look.time << ' ' << look.yaw << ' ' << day;
            EXPECT_LT(worst, 0.03) << look.time << ' ' << look.yaw << ' ' << day;
            EXPECT_GT(sum, 0.01) << look.time;
        }
}

} // namespace vitrail::render
