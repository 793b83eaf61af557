// Ambient occlusion of the screen against rays over the hemisphere of each pixel's surface.
#include "box_scene.h"

#include <algorithm>

namespace vitrail::render {

class Ssao : public RenderTest {
protected:
    struct Look {
        double x, y, z;
        float yaw, pitch;
        u32 width = 240, height = 160;
    };
    static Effects effects(i32 samples = 16) {
        Effects e = preset_effects(Preset::off);
        e.ssao.on = true, e.ssao.samples = samples;
        return e;
    }
    static scene::FrameView frame_of(const Look& look) {
        return bench::SampleScene::frame(look.width, look.height, eye_at(look.x, look.y, look.z), look.yaw, look.pitch,
                                         8);
    }
    static TargetPixels ao_of(Renderer& renderer, const scene::FrameView& frame) {
        EXPECT_TRUE(renderer.render(frame));
        auto pixels = renderer.read_target("ao");
        EXPECT_TRUE(pixels);
        return pixels ? std::move(*pixels) : TargetPixels{};
    }
    // Share of the cosine-weighted hemisphere without a block nearer than the radius.
    static float open_sky(const BoxScene& scene, Vec3 at, IVec3 normal, float radius) {
        const Vec3 n{float(normal.x), float(normal.y), float(normal.z)};
        const Vec3 u = normal.x ? Vec3{0, 1, 0} : Vec3{1, 0, 0}, v = cross(n, u);
        constexpr u32 kRings = 16, kTurns = 32;
        u32 open = 0;
        for (u32 i = 0; i < kRings; ++i)
            for (u32 k = 0; k < kTurns; ++k) {
                const float s = (float(i) + 0.5f) / kRings, r = std::sqrt(s),
                            a = 6.2831853f * (float(k) + 0.37f) / kTurns;
                const Vec3 d = u * (r * std::cos(a)) + v * (r * std::sin(a)) + n * std::sqrt(1 - s);
                open += !scene.trace(at + n * 1e-3f, d, radius);
            }
        return float(open) / (kRings * kTurns);
    }
    struct Compared {
        u32 pixels = 0, far = 0, shaded = 0;
        double sum = 0, bias = 0;
    };
    // Every fourth pixel against the rays; `far`: off by more than 0.15.
    static Compared compare(const BoxScene& scene, const Look& look, float radius, const TargetPixels& ao) {
        const scene::FrameView frame = frame_of(look);
        const Vec3 eye{float(look.x), float(look.y), float(look.z)};
        Compared c;
        for (u32 y = 1; y < frame.height; y += 4)
            for (u32 x = 1; x < frame.width; x += 4) {
                const Vec3 ray = pixel_ray(frame, x, y);
                const auto hit = scene.trace(eye, ray, 200);
                if (!hit) continue;
                const float truth = open_sky(scene, eye + ray * hit->distance, hit->normal, radius);
                const float difference = ao.at(x, y)[0] - truth;
                ++c.pixels;
                c.shaded += truth < 0.9f;
                c.sum += std::abs(difference), c.bias += difference;
                c.far += std::abs(difference) > 0.15f;
            }
        return c;
    }
    void expect_like_rays(const char* name, BoxScene& scene, const Look& look, double mean, double far) {
        auto renderer = make_renderer(Preset::off);
        ASSERT_TRUE(renderer && renderer->set_effects(effects()));
        scene.give(*renderer);
        const TargetPixels ao = ao_of(*renderer, frame_of(look));
        const Compared c = compare(scene, look, renderer->effects().ssao.radius, ao);
        fmt::print("{}: {} pixels, {} shaded, mean {:.4f} bias {:.4f} far {:.4f}\n", name, c.pixels, c.shaded,
                   c.sum / c.pixels, c.bias / c.pixels, double(c.far) / c.pixels);
        EXPECT_GT(c.shaded, c.pixels / 12) << name;
        EXPECT_LT(c.sum / c.pixels, mean) << name;
        EXPECT_LT(double(c.far) / c.pixels, far) << name;
        if (std::getenv("VITRAIL_SEE")) {
            Image image{ao.width, ao.height, 3, {}};
            for (u32 y = 0; y < ao.height; ++y)
                for (u32 x = 0; x < ao.width; ++x)
                    for (u32 k = 0; k < 3; ++k)
                        image.pixels.push_back(u8(ao.at(x, y)[0] * 255));
            (void)write_png(fmt::format("/tmp/ssao_{}.png", name), image);
        }
    }
};

TEST_F(Ssao, CornerIsAsDarkAsRaysSay) {
    BoxScene scene;
    scene.fill({-8, -1, -4}, {8, -1, 8}, "white");
    scene.fill({-8, 0, 5}, {8, 5, 5}, "white");
    expect_like_rays("corner", scene, {0.5, 2.4, 1.0, 0, 25}, 0.03, 0.02);
}

TEST_F(Ssao, StepsAreAsDarkAsRaysSay) {
    BoxScene scene;
    for (i32 k = 0; k < 5; ++k)
        scene.fill({-6, -1, k + 2}, {6, k, 9}, "white");
    scene.fill({-6, -1, -3}, {6, -1, 2}, "white");
    expect_like_rays("steps", scene, {0.5, 4.2, -1.5, 10, 22}, 0.08, 0.06);
}

TEST_F(Ssao, NicheIsAsDarkAsRaysSay) {
    BoxScene scene;
    scene.fill({-8, -1, -4}, {8, -1, 8}, "white");
    scene.fill({-8, 0, 4}, {8, 5, 7}, "white");
    for (i32 x = -1; x <= 1; ++x)
        for (i32 y = 0; y <= 1; ++y)
            for (i32 z = 4; z <= 5; ++z)
                scene.clear(x, y, z);
    expect_like_rays("niche", scene, {0.9, 1.7, 0.5, 0, 8}, 0.04, 0.04);
}

TEST_F(Ssao, FloatingBlockLetsLightPass) {
    BoxScene scene;
    scene.fill({-8, -1, -4}, {8, -1, 9}, "white");
    scene.set(0, 0, 4, "white");
    scene.fill({2, 1, 4}, {3, 1, 5}, "white");
    scene.set(-3, 1, 5, "white");
    expect_like_rays("floating", scene, {0.5, 3.2, 0.0, 0, 30}, 0.03, 0.02);
}

} // namespace vitrail::render
