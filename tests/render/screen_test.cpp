// Passes over the screen draw the same whether they run as fragments or as compute shaders.
#include "render_fixture.h"
#include "scene/sky.h"

#include <cmath>

namespace vitrail::render {

class ScreenWays : public RenderTest {
protected:
    // Several frames of a turning eye, the last one as it is shown.
    static Image last_of(ScreenWork way, const Effects& effects, float time, bool views,
                         std::vector<TargetPixels>* surfaces = nullptr) {
        bench::SampleScene scene(2, true);
        scene.registry.content_roots = {test_content()};
        auto made = Renderer::create({.effects = effects, .quad_bytes_start = 16384, .screen = way});
        EXPECT_TRUE(made) << made.error().message;
        if (!made) return {};
        Renderer& renderer = **made;
        scene.give(renderer);
        EXPECT_TRUE(renderer.load_textures(scene.registry));
        Image image;
        for (u32 i = 0; i < 3; ++i) {
            // An odd size: no pass may rely on whole groups of threads.
            auto frame = bench::SampleScene::frame(123, 77, eye_at(30.5, scene.ground(30, -41) + 9.0, -40.5),
                                                   -60 + float(i), 12, 4);
            frame.sky = scene::sky_at(time);
            frame.seconds = 2 + 0.05f * float(i);
            if (views) {
                scene::View second = frame.views[0];
                second.eye.at = eye_at(4.5, scene.ground(4, 4) + 6.0, 4.5);
                frame.views.push_back(second);
            }
            image = draw(renderer, frame);
        }
        EXPECT_TRUE(renderer.read_target("depth"));
        for (const char* name : {"albedo", "light", "surface", "depth"})
            if (surfaces) surfaces->push_back(renderer.read_target(name).value());
        return image;
    }

    static void expect_same(const Effects& effects, float time, bool views = false) {
        const Image a = last_of(ScreenWork::fragments, effects, time, views);
        const Image b = last_of(ScreenWork::compute, effects, time, views);
        ASSERT_EQ(a.pixels.size(), b.pixels.size());
        ASSERT_FALSE(a.pixels.empty());
        u64 sum = 0, far = 0, lit = 0;
        for (std::size_t i = 0; i < a.pixels.size(); ++i) {
            const int off = std::abs(int(a.pixels[i]) - int(b.pixels[i]));
            sum += u64(off), far += off > 4, lit += a.pixels[i] > 8;
        }
        EXPECT_GT(lit, a.pixels.size() / 4);
        // Directions of rays round otherwise, which turns a comparison here and there.
        EXPECT_LT(double(sum) / double(a.pixels.size()), 0.1);
        EXPECT_LT(far, a.pixels.size() / 500);
    }
};

// Surfaces that a compute shader looks up by the number of a pixel's quad are those that fragments would have written.
TEST_F(ScreenWays, SurfacesAreTheSame) {
    Effects effects = preset_effects(Preset::high);
    effects.antialias = i32(Antialias::off);
    std::vector<TargetPixels> drawn, found;
    last_of(ScreenWork::fragments, effects, 4000, true, &drawn);
    last_of(ScreenWork::compute, effects, 4000, true, &found);
    ASSERT_EQ(drawn.size(), 4u);
    ASSERT_EQ(found.size(), 4u);
    const auto& depth = drawn[3].values;
    EXPECT_EQ(depth, found[3].values);
    for (u32 k = 0; k < 3; ++k) {
        const float step = k == 2 ? 1.0f : 1.0f / 255; // of bytes
        u32 shown = 0, differ = 0;
        for (std::size_t i = 0; i < depth.size(); ++i) {
            if (depth[i] <= 0) continue;
            ++shown;
            for (std::size_t c = 0; c < 4; ++c)
                if (std::abs(drawn[k].values[i * 4 + c] - found[k].values[i * 4 + c]) > 2.5f * step) {
                    ++differ;
                    break;
                }
        }
        EXPECT_GT(shown, depth.size() / 3);
        EXPECT_LT(differ, shown / 200) << "target " << k << " of " << shown; // texels' edges, rounded otherwise
    }
}
TEST_F(ScreenWays, DayWithAllEffects) {
    expect_same(preset_effects(Preset::high), 4000);
}
TEST_F(ScreenWays, NightWithStars) {
    expect_same(preset_effects(Preset::medium), 18000);
}
TEST_F(ScreenWays, WithoutEffects) {
    expect_same(preset_effects(Preset::off), 6000);
}
TEST_F(ScreenWays, SeveralViewsAndFxaa) {
    Effects effects = preset_effects(Preset::medium);
    effects.antialias = i32(Antialias::fxaa);
    expect_same(effects, 1000, true);
}

// Drawn smaller and enlarged, the picture shows the same in the same places.
TEST_F(ScreenWays, SmallerPicturesAreEnlarged) {
    bench::SampleScene scene(2, true);
    scene.registry.content_roots = {test_content()};
    for (const ScreenWork way : {ScreenWork::fragments, ScreenWork::compute}) {
        Effects effects = preset_effects(Preset::low);
        effects.antialias = i32(Antialias::fxaa);
        auto made = Renderer::create({.effects = effects, .quad_bytes_start = 16384, .screen = way});
        ASSERT_TRUE(made) << made.error().message;
        Renderer& renderer = **made;
        scene.give(renderer);
        ASSERT_TRUE(renderer.load_textures(scene.registry));
        auto frame = bench::SampleScene::frame(211, 123, eye_at(30.5, scene.ground(30, -41) + 9.0, -40.5), -60, 12, 4);
        const Image whole = draw(renderer, frame);
        EXPECT_EQ(renderer.stats().width, 211u);
        // Mean difference to the whole picture moved by so many pixels to the right.
        const auto off_by = [&](const Image& image, i32 aside) {
            u64 sum = 0, count = 0;
            for (u32 y = 0; y < image.height; ++y)
                for (u32 x = 8; x < image.width - 8; ++x)
                    for (u32 c = 0; c < 3; ++c, ++count)
                        sum += u64(std::abs(int(image.at(x, y)[c]) - int(whole.at(u32(i32(x) - aside), y)[c])));
            return double(sum) / double(count);
        };
        double before = 0;
        for (const float share : {0.9f, 0.6f}) {
            frame.resolution = share;
            const Image image = draw(renderer, frame);
            ASSERT_EQ(image.width, whole.width);
            ASSERT_EQ(image.height, whole.height);
            EXPECT_EQ(renderer.stats().width, u32(std::lround(211 * share)));
            EXPECT_EQ(renderer.stats().height, u32(std::lround(123 * share)));
            const double off = off_by(image, 0);
            EXPECT_GT(off, before); // what is left out is gone
            EXPECT_LT(off, 7);
            for (const i32 aside : {-1, 1}) // no part of a pixel aside
                EXPECT_LT(off, off_by(image, aside));
            before = off;
        }
        // The lower of what the frame and the effects say.
        effects.resolution.scale = 0.5f;
        ASSERT_TRUE(renderer.set_effects(effects));
        draw(renderer, frame);
        EXPECT_EQ(renderer.stats().width, 106u);
        effects.resolution.scale = 1, frame.resolution = 1;
        ASSERT_TRUE(renderer.set_effects(effects));
        EXPECT_LT(off_by(draw(renderer, frame), 0), 0.5);
    }
}

} // namespace vitrail::render
