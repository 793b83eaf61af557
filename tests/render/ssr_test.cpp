// Mirrors against the same scene drawn from the mirrored eye, Fresnel's share against its formula.
#include "box_scene.h"
#include "pass_rig.h"
#include "render/passes/scene_copy/scene_copy_pass.h"
#include "render/passes/ssr/reflections_pass.h"
#include "scene/sky.h"

namespace vitrail::render {

class Ssr : public RenderTest {
protected:
    static constexpr float kDegree = 0.017453293f;

    // One color a texture, so that a pixel's neighbor is a fair witness.
    static const std::string& flat_content() {
        static const TestFolder root{[] {
            const std::string folder =
                fmt::format("{}/vitrail_ssr_test_{}", std::filesystem::temp_directory_path().string(), getpid());
            std::filesystem::create_directories(folder + "/textures");
            const auto write = [&](const std::string& name, std::array<u8, 3> color, u8 roughness) {
                Image image{32, 32, 4, {}}, rough{32, 32, 4, {}};
                for (u32 i = 0; i < 32 * 32; ++i) {
                    for (u8 c : color)
                        image.pixels.push_back(c);
                    image.pixels.push_back(255);
                    for (u32 c = 0; c < 4; ++c)
                        rough.pixels.push_back(c < 3 ? roughness : 255);
                }
                (void)write_png(folder + "/textures/" + name + ".png", image);
                (void)write_png(folder + "/textures/" + name + "_r.png", rough);
            };
            write("mirror", {60, 60, 60}, 0);
            write("frosted", {60, 60, 60}, 68); // 4 / 15
            write("red", {220, 60, 50}, 255);
            write("green", {70, 200, 60}, 255);
            write("blue", {60, 90, 220}, 255);
            write("white", {230, 230, 230}, 255);
            return folder;
        }()};
        return root.path;
    }
    static Effects effects(bool on) {
        Effects e = preset_effects(Preset::off);
        e.reflections.on = on, e.reflections.steps = 48, e.reflections.roughness = 0.5f;
        return e;
    }
    // A lake of mirror with things on its far shore and on it.
    static BoxScene shore(const char* floor = "mirror") {
        BoxScene scene;
        scene.registry.content_roots = {flat_content()};
        scene.fill({-24, -1, -4}, {24, -1, 30}, floor);
        scene.fill({-24, 0, 22}, {24, 2, 24}, "green");
        scene.fill({-3, 0, 14}, {-1, 3, 16}, "red");
        scene.fill({3, 0, 10}, {3, 5, 10}, "white");
        scene.fill({6, 0, 17}, {11, 1, 18}, "blue");
        scene.fill({-12, 2, 18}, {-9, 4, 20}, "white"); // floats
        return scene;
    }
    static scene::FrameView look(double x, double y, double z, float yaw, float pitch) {
        return bench::SampleScene::frame(320, 180, eye_at(x, y, z), yaw, pitch, 16);
    }
    // The same seen in the plane y = 0; below it nothing is drawn.
    static scene::FrameView mirrored(scene::FrameView frame, float height) {
        scene::View& view = frame.views[0];
        view.eye.at.y = -view.eye.at.y;
        for (u32 row = 0; row < 3; ++row)
            view.rotation.m[4 + row] = -view.rotation.m[4 + row];
        view.mirrored = true;
        view.clip_plane = {0, 1, 0, -height - 1e-3f};
        return frame;
    }
    static TargetPixels color_of(Renderer& renderer, const scene::FrameView& frame) {
        EXPECT_TRUE(renderer.render(frame));
        auto pixels = renderer.read_target("color");
        EXPECT_TRUE(pixels);
        return pixels ? std::move(*pixels) : TargetPixels{};
    }
    static float share_of(float cosine, float roughness) {
        const float straight = 0.04f;
        return straight + (std::max(1 - roughness, straight) - straight) * std::pow(1 - cosine, 5.0f);
    }
    // Where on the picture a place (relative to the eye) is seen: pixels, or nothing behind the eye.
    static std::optional<Vec2> seen_at(const scene::FrameView& frame, Vec3 place) {
        const scene::View& view = frame.views[0];
        const Vec4 v = view.rotation * Vec4{place.x, place.y, place.z, 1};
        if (v.z > -0.1f) return std::nullopt;
        const float t = std::tan(view.fov_y * 0.5f), w = float(frame.width), h = float(frame.height);
        return Vec2{(v.x / -v.z / (t * w / h) * 0.5f + 0.5f) * w, (0.5f - v.y / -v.z / t * 0.5f) * h};
    }
    static float brightness(const float* p) { return p[0] + p[1] + p[2]; }
};

TEST_F(Ssr, MirrorShowsWhatTheMirroredEyeSees) {
    BoxScene scene = shore();
    auto plain = make_renderer(), mirror = make_renderer();
    ASSERT_TRUE(plain && mirror && plain->set_effects(effects(false)) && mirror->set_effects(effects(true)));
    for (auto* r : {plain.get(), mirror.get()}) {
        scene.give(*r);
        r->set_background(true, {0, 0, 0});
    }
    struct Case {
        double x, y, z;
        float yaw, pitch;
    };
    for (const Case& c : {Case{0.3, 2.4, 1.2, 0, 6}, Case{5.7, 4.1, -1.3, 25, 14}, Case{-6.2, 1.3, 3.2, -20, 3}}) {
        const scene::FrameView frame = look(c.x, c.y, c.z, c.yaw, c.pitch);
        const TargetPixels off = color_of(*plain, frame), on = color_of(*mirror, frame);
        const TargetPixels truth = color_of(*plain, mirrored(frame, float(c.y)));
        const Vec3 eye{float(c.x), float(c.y), float(c.z)};
        u32 expected = 0, found = 0;
        double error = 0, light = 0;
        Image seen{frame.width, frame.height, 3, std::vector<u8>(std::size_t(frame.width) * frame.height * 3)};
        Image real = seen;
        for (u32 y = 0; y < frame.height; ++y)
            for (u32 x = 0; x < frame.width; ++x) {
                const Vec3 ray = pixel_ray(frame, x, y);
                const auto floor = scene.trace(eye, ray, 100);
                if (!floor || floor->normal.y != 1 || std::abs(eye.y + ray.y * floor->distance) > 1e-3f) continue;
                const float share = share_of(-ray.y, 0);
                float mirrored_light[3];
                for (u32 k = 0; k < 3; ++k)
                    mirrored_light[k] = (on.at(x, y)[k] - off.at(x, y)[k] * (1 - share)) / share;
                for (u32 k = 0; k < 3; ++k) {
                    *(seen.at(x, y) + k) = u8(std::clamp(mirrored_light[k] * 200, 0.0f, 255.0f));
                    *(real.at(x, y) + k) = u8(std::clamp(truth.at(x, y)[k] * 200, 0.0f, 255.0f));
                }
                // What it mirrors, and whether the screen shows that, well inside and from the front.
                const Vec3 at = eye + ray * floor->distance + Vec3{0, 1e-3f, 0};
                const auto hit = scene.trace(at, {ray.x, -ray.y, ray.z}, 60);
                if (!hit) continue;
                const Vec3 there = at + Vec3{ray.x, -ray.y, ray.z} * hit->distance;
                const auto on_screen = seen_at(frame, there - eye);
                if (!on_screen || on_screen->x < 24 || on_screen->x > 296 || on_screen->y < 14 || on_screen->y > 166)
                    continue;
                const Vec3 way = there - eye;
                const auto first = scene.trace(eye, normalized(way), length(way) - 0.02f);
                if (first) continue;
                ++expected;
                float worst = 0;
                for (u32 k = 0; k < 3; ++k) {
                    worst = std::max(worst, std::abs(mirrored_light[k] - truth.at(x, y)[k]));
                    error += std::abs(mirrored_light[k] - truth.at(x, y)[k]);
                    light += truth.at(x, y)[k];
                }
                found += worst < 0.1f * brightness(truth.at(x, y));
            }
        fmt::print("mirror: expected {} found {} error {:.4f}\n", expected, double(found) / expected, error / light);
        EXPECT_GT(expected, 2000u);
        EXPECT_GT(double(found) / expected, 0.9);
        EXPECT_LT(error / light, 0.09);
        if (std::getenv("VITRAIL_SEE")) {
            (void)write_png(fmt::format("/tmp/ssr_{}_seen.png", c.yaw), seen);
            (void)write_png(fmt::format("/tmp/ssr_{}_real.png", c.yaw), real);
        }
    }
}

// A floor without anything else, seen through a narrow lens so that no mirror ray ends on the screen.
TEST_F(Ssr, FallsBackToTheSkyByFresnelsShare) {
    for (const auto& [floor, roughness] : {std::pair<const char*, float>{"mirror", 0.0f}, {"frosted", 4.0f / 15}}) {
        BoxScene scene;
        scene.registry.content_roots = {flat_content()};
        scene.fill({-40, -1, -40}, {40, -1, 40}, floor);
        auto plain = make_renderer(), mirror = make_renderer();
        ASSERT_TRUE(plain && mirror && plain->set_effects(effects(false)) && mirror->set_effects(effects(true)));
        scene.give(*plain), scene.give(*mirror);
        for (float pitch : {10.0f, 20.0f, 40.0f, 88.0f}) {
            scene::FrameView frame = look(0.3, 2.5, 0.4, 30, pitch);
            frame.views[0].fov_y = 0.06f;
            frame.view_distance = 4096; // no fog
            const TargetPixels off = color_of(*plain, frame), on = color_of(*mirror, frame);
            const u32 x = 160, y = 90;
            const Vec3 ray = pixel_ray(frame, x, y);
            const Vec3 sky = scene::sky_color(frame.sky, {ray.x, -ray.y, ray.z});
            const float share = share_of(-ray.y, roughness) * (roughness > 0.35f ? 0 : 1);
            const float s[3] = {sky.x, sky.y, sky.z};
            for (u32 k = 0; k < 3; ++k) {
                const float was = off.at(x, y)[k];
                EXPECT_NEAR(on.at(x, y)[k], was + (s[k] - was) * share, 0.004f + 0.02f * share)
                    << floor << " pitch " << pitch << " channel " << k;
            }
        }
    }
}

// A flat mirror under an even sky is even: no ray finds the mirror itself, however flat it leaves.
TEST_F(Ssr, FlatMirrorDoesNotSeeItself) {
    BoxScene scene;
    scene.registry.content_roots = {flat_content()};
    scene.fill({-40, -1, -40}, {40, -1, 40}, "mirror");
    scene.fill({-40, -20, 30}, {40, -2, 30}, "white"); // below: a ray that went through would meet it
    auto mirror = make_renderer(), plain = make_renderer();
    ASSERT_TRUE(mirror && plain && mirror->set_effects(effects(true)) && plain->set_effects(effects(false)));
    for (auto* r : {plain.get(), mirror.get()}) {
        scene.give(*r);
        r->set_background(true, {0, 0, 0}); // black sky: what the mirror shows besides is itself
    }
    for (float pitch : {0.5f, 5.0f, 30.0f, 89.0f})
        for (float height : {0.3f, 1.7f, 9.0f}) {
            const scene::FrameView frame = look(0.3, height, -20.6, 17, pitch);
            const TargetPixels off = color_of(*plain, frame), on = color_of(*mirror, frame);
            u32 floor = 0, wrong = 0;
            for (u32 y = 0; y < frame.height; ++y)
                for (u32 x = 0; x < frame.width; ++x) {
                    const Vec3 ray = pixel_ray(frame, x, y);
                    if (off.at(x, y)[0] == 0 || ray.y > -1e-3f) continue;
                    ++floor;
                    const float was = off.at(x, y)[0] * (1 - share_of(-ray.y, 0));
                    wrong += std::abs(on.at(x, y)[0] - was) > 0.002f + 0.01f * was;
                }
            EXPECT_GT(floor, 3000u);
            EXPECT_EQ(wrong, 0u) << "pitch " << pitch << " height " << height;
        }
}

// What is seen through a portal lies elsewhere: a mirror on this side does not show it.
TEST_F(Ssr, MirrorsShowNothingOfOtherViews) {
    BoxScene scene = shore();
    scene::FrameView frame = look(0.3, 2.4, 1.2, 0, 6);
    frame.views.push_back(frame.views[0]);
    frame.view_distance = 4096;
    const Vec3 eye{0.3f, 2.4f, 1.2f}, forward = look_direction(0, 6 * kDegree);
    // Things shine, the floor is black: how much light the floor has in the end.
    const auto mirrored_light = [&](bool apart) {
        PassRig rig(effects(true), passes_of<SceneCopyPass, ReflectionsPass>());
        Picture color(frame.width, frame.height);
        std::vector<bool> floor;
        for (u32 y = 0; y < frame.height; ++y)
            for (u32 x = 0; x < frame.width; ++x) {
                const Vec3 ray = pixel_ray(frame, x, y);
                const auto hit = scene.trace(eye, ray, 100);
                floor.push_back(hit && std::abs(eye.y + ray.y * hit->distance) < 1e-3f);
                u8 face = 0;
                for (u32 f = 0; f < 6; ++f)
                    if (hit && kFaceNormal[f] == hit->normal) face = u8(f);
                rig.depth.push_back(hit ? kNearPlane / (hit->distance * dot(ray, forward)) : 0);
                rig.surfaces.push_back({127, 127, u8(face << 3), u8(floor.back() ? 0 : 0xf0)});
                if (floor.back()) rig.surfaces.back()[0] = 127, rig.surfaces.back()[1] = 254; // up
                rig.views.push_back(u8(apart && hit && !floor.back()));
                color.at(x, y) = hit && !floor.back() ? Vec3{1, 1, 1} : Vec3{};
            }
        rig.draw(color, frame, 0);
        const Picture after = rig.read("color");
        double light = 0;
        for (std::size_t i = 0; i < floor.size(); ++i)
            if (floor[i]) light += after.pixels[i].x;
        return light;
    };
    EXPECT_GT(mirrored_light(false), 500);
    EXPECT_LT(mirrored_light(true), 1);
}

} // namespace vitrail::render
