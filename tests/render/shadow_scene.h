// What tests of shadows share: how much of the sun each pixel gets, by comparing pictures, and the place it shows.
#pragma once

#include "box_scene.h"
#include "render/passes/shadow/shadow_pass.h"

namespace vitrail::render {

class ShadowTest : public RenderTest {
protected:
    struct Sunlight {
        u32 width = 0, height = 0;
        std::vector<Vec3> share;  // of the light, by color; -1 where the sun shines on no surface that faces it
        std::vector<float> depth; // along the view's axis, blocks; 0 for sky
        Vec3 at(u32 x, u32 y) const { return share[std::size_t(y) * width + x]; }
        bool seen(u32 x, u32 y) const { return at(x, y).x >= -0.5f; }
    };

    static Effects effects(i32 samples = 16, float softness = 1) {
        Effects e = preset_effects(Preset::off);
        e.shadows = {.on = true,
                     .cascades = 3,
                     .size = 1024,
                     .distance = 96,
                     .samples = samples,
                     .softness = softness,
                     .colored = true};
        return e;
    }
    static scene::FrameView frame_of(Vec3 eye, float yaw, float pitch, Vec3 sun, u32 width = 160, u32 height = 120) {
        scene::FrameView frame = bench::SampleScene::frame(width, height, eye_at(eye.x, eye.y, eye.z), yaw, pitch, 12);
        sun = normalized(sun);
        frame.sky.sun_direction = sun, frame.sky.moon_direction = -sun;
        frame.sky.sun_light = {1, 1, 1};
        frame.sky.ambient = {};
        for (Vec3& c : frame.sky.irradiance.c)
            c = {};
        return frame;
    }
    static TargetPixels color(Renderer& renderer, const scene::FrameView& frame) {
        EXPECT_TRUE(renderer.render(frame));
        auto pixels = renderer.read_target("color");
        EXPECT_TRUE(pixels);
        return pixels ? std::move(*pixels) : TargetPixels{};
    }
    // The picture between the same without sun and without shadows.
    static Sunlight sunlight(Renderer& renderer, scene::FrameView frame, const Effects& with) {
        renderer.set_background(true);
        EXPECT_TRUE(renderer.set_effects(with));
        const TargetPixels lit = color(renderer, frame);
        Sunlight out{frame.width, frame.height, {}, {}};
        const auto depth = renderer.read_target("depth");
        EXPECT_TRUE(depth);
        Effects without = with;
        without.shadows.on = false;
        EXPECT_TRUE(renderer.set_effects(without));
        const TargetPixels full = color(renderer, frame);
        frame.sky.sun_light = {};
        const TargetPixels none = color(renderer, frame);
        for (u32 y = 0; y < out.height; ++y)
            for (u32 x = 0; x < out.width; ++x) {
                float share[3];
                for (u32 k = 0; k < 3; ++k) {
                    const float range = full.at(x, y)[k] - none.at(x, y)[k];
                    share[k] = range > 2e-3f ? (lit.at(x, y)[k] - none.at(x, y)[k]) / range : -1.0f;
                }
                out.share.push_back({share[0], share[1], share[2]});
                const float d = depth->at(x, y)[0];
                out.depth.push_back(d > 0 ? 0.05f / d : 0);
            }
        return out;
    }
    // Where the pixel's ray meets the plane y = height, from the eye.
    static Vec3 on_plane(const scene::FrameView& frame, u32 x, u32 y, float below_eye) {
        const Vec3 ray = pixel_ray(frame, x, y);
        return ray * (-below_eye / ray.y);
    }
    // One-sided floor of 16 x 16 sections' tops at y = 16 * section + cell + 1, `reach` sections to each side.
    static void give_floor(Renderer& renderer, TextureId texture, i32 section_y, i32 cell, i32 reach) {
        const SectionMesh mesh = quads_of(
            QuadPass::opaque, {{3, Quad::cube({0, cell, 0}, 16, 16, Face::up, 255, texture, TintKind::none, 0)}});
        for (i32 z = -reach; z <= reach; ++z)
            for (i32 x = -reach; x <= reach; ++x)
                renderer.set_section({x, section_y, z}, DimensionId::overworld, mesh);
    }
};

} // namespace vitrail::render
