// Passes over the screen draw the same whether they run as fragments or as compute shaders.
#include "render_fixture.h"
#include "scene/sky.h"

#include <cmath>

namespace vitrail::render {

class ScreenWays : public RenderTest {
protected:
    // Several frames of a turning eye, the last one as it is shown.
    static Image last_of(ScreenWork way, const Effects& effects, float time, bool views) {
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

} // namespace vitrail::render
