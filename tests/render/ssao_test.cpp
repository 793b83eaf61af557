// Ambient occlusion of the screen against rays over the hemisphere of each pixel's surface.
#include "box_scene.h"
#include "pass_rig.h"
#include "render/passes/ssao/ssao_pass.h"

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

// Nothing darkens itself, however flat it is looked at, near and far.
TEST_F(Ssao, OpenPlaneIsOpen) {
    BoxScene scene;
    scene.fill({-40, -1, -40}, {40, -1, 40}, "white");
    auto renderer = make_renderer(Preset::off);
    ASSERT_TRUE(renderer && renderer->set_effects(effects()));
    scene.give(*renderer);
    for (float pitch : {0.0f, 5.0f, 15.0f, 45.0f, 89.0f})
        for (float height : {0.2f, 1.7f, 14.0f}) {
            const Look look{0.3, height, -8.4, 31, pitch, 160, 100};
            const TargetPixels ao = ao_of(*renderer, frame_of(look));
            u32 seen = 0;
            float least = 1;
            for (u32 y = 0; y < ao.height; ++y)
                for (u32 x = 0; x < ao.width; ++x) {
                    const Vec3 ray = pixel_ray(frame_of(look), x, y);
                    const auto hit = scene.trace({0.3f, height, -8.4f}, ray, 60);
                    const Vec3 above = pixel_ray(frame_of(look), x, y ? y - 1 : 0); // not the last pixel of the floor
                    if (!hit || hit->normal.y != 1 || !scene.trace({0.3f, height, -8.4f}, above, 60)) continue;
                    ++seen;
                    least = std::min(least, ao.at(x, y)[0]);
                }
            EXPECT_GT(seen, 500u) << pitch << " " << height;
            EXPECT_GT(least, 0.98f) << "pitch " << pitch << " height " << height;
        }
}

// A block far in front of a wall leaves the wall alone, also right beside its outline.
TEST_F(Ssao, NearThingsDoNotDarkenFarWalls) {
    BoxScene scene;
    scene.fill({-30, -20, 12}, {30, 20, 12}, "white");
    scene.fill({-1, -1, 4}, {1, 0, 5}, "white");
    auto renderer = make_renderer(Preset::off);
    ASSERT_TRUE(renderer && renderer->set_effects(effects()));
    scene.give(*renderer);
    const Look look{0.4, 0.6, -1.0, 3, 2};
    const TargetPixels ao = ao_of(*renderer, frame_of(look));
    u32 wall = 0, beside = 0;
    float least = 1;
    for (u32 y = 0; y < ao.height; ++y)
        for (u32 x = 0; x < ao.width; ++x) {
            const auto z_at = [&](i32 px, i32 py) {
                const Vec3 ray = pixel_ray(frame_of(look), u32(px), u32(py));
                const auto hit = scene.trace({0.4f, 0.6f, -1.0f}, ray, 60);
                return hit ? hit->distance * ray.z : 0.0f;
            };
            if (z_at(i32(x), i32(y)) < 12) continue;
            ++wall;
            beside += z_at(i32(x) + 2, i32(y)) < 8 || z_at(i32(x) - 2, i32(y)) < 8;
            least = std::min(least, ao.at(x, y)[0]);
        }
    EXPECT_GT(wall, 10000u);
    EXPECT_GT(beside, 60u);
    EXPECT_GT(least, 0.99f);
}

// The radius is of the world: the same places are as dark from twice as far.
TEST_F(Ssao, SamePlaceIsAsDarkFromFarther) {
    BoxScene scene;
    scene.fill({-12, -1, -12}, {12, -1, 8}, "white");
    scene.fill({-12, 0, 5}, {12, 7, 5}, "white");
    auto renderer = make_renderer(Preset::off);
    ASSERT_TRUE(renderer && renderer->set_effects(effects()));
    scene.give(*renderer);
    const auto profile = [&](float away) { // along the floor towards the wall
        const Look look{0.5, 0.5 * away, 5 - 0.87 * away, 0, 30, 400, 300};
        const scene::FrameView frame = frame_of(look);
        const TargetPixels ao = ao_of(*renderer, frame);
        const Vec3 eye{float(look.x), float(look.y), float(look.z)};
        std::array<float, 10> sums{}, counts{};
        for (u32 y = 0; y < ao.height; ++y)
            for (u32 x = ao.width / 3; x < ao.width * 2 / 3; ++x) {
                const Vec3 ray = pixel_ray(frame, x, y);
                const auto hit = scene.trace(eye, ray, 60);
                if (!hit || hit->normal.y != 1) continue;
                const float from_wall = 5 - (eye.z + ray.z * hit->distance);
                if (from_wall < 0 || from_wall >= 2) continue;
                sums[u32(from_wall * 5)] += ao.at(x, y)[0], counts[u32(from_wall * 5)] += 1;
            }
        for (u32 i = 0; i < sums.size(); ++i) {
            EXPECT_GT(counts[i], 10);
            sums[i] /= std::max(counts[i], 1.0f);
        }
        return sums;
    };
    const auto near = profile(5), far = profile(10);
    EXPECT_LT(near[0], 0.7f);
    EXPECT_GT(near[9], 0.98f);
    for (u32 i = 0; i < near.size(); ++i)
        EXPECT_NEAR(near[i], far[i], 0.06f) << i;
}

// What is seen through a portal lies elsewhere: it darkens nothing here, and the other way round.
TEST_F(Ssao, ViewsDoNotDarkenEachOther) {
    BoxScene scene;
    scene.fill({-8, -1, -4}, {8, -1, 8}, "white");
    scene.fill({-8, 0, 5}, {8, 5, 5}, "white");
    const Look look{0.5, 2.4, 1.0, 0, 25};
    scene::FrameView frame = frame_of(look);
    frame.views.push_back(frame.views[0]);
    const auto least_of = [&](bool apart) {
        PassRig rig(effects(), passes_of<SsaoPass>());
        for (u32 y = 0; y < frame.height; ++y)
            for (u32 x = 0; x < frame.width; ++x) {
                const Vec3 ray = pixel_ray(frame, x, y);
                const auto hit = scene.trace({0.5f, 2.4f, 1.0f}, ray, 60);
                const Vec3 forward = look_direction(0, 25 * 0.017453293f);
                const u8 face = !hit ? 0 : hit->normal.y == 1 ? u8(Face::up) : u8(Face::north);
                rig.depth.push_back(hit ? kNearPlane / (hit->distance * dot(ray, forward)) : 0);
                rig.surfaces.push_back({127, 127, u8(face << 3), 0});
                rig.views.push_back(u8(apart && hit && hit->normal.y == 0));
            }
        rig.draw(Picture(frame.width, frame.height), frame, 0);
        const Picture ao = rig.read("ao");
        float least = 1;
        for (u32 i = 0; i < ao.pixels.size(); ++i)
            if (rig.depth[i] > 0) least = std::min(least, ao.pixels[i].x);
        return least;
    };
    EXPECT_LT(least_of(false), 0.65f);
    EXPECT_GT(least_of(true), 0.99f);
}

} // namespace vitrail::render
