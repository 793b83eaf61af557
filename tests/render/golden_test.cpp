// The sample scene at several hours against golden pictures (tests/golden.h).
#include "golden.h"
#include "render_fixture.h"
#include "scene/sky.h"
#include "scene/water.h"

namespace vitrail::render {

class Golden : public RenderTest {
protected:
    struct Shot {
        const char* name;
        Preset preset;
        float time, yaw, pitch;
        double x, up, z; // up: above the ground there
        bool underwater = false, trees = true;
    };
    static void shoot(const Shot& shot) {
        if (const std::string why = golden::cannot_compare(); !why.empty()) GTEST_SKIP() << why;
        bench::SampleScene scene(4, shot.trees);
        scene.registry.content_roots = {test_content()};
        auto renderer = make_renderer(shot.preset);
        ASSERT_TRUE(renderer);
        scene.give(*renderer);
        ASSERT_TRUE(renderer->load_textures(scene.registry));
        EXPECT_EQ(renderer->missing_textures(), 0u);
        const double ground = scene.ground(i32(std::floor(shot.x)), i32(std::floor(shot.z)));
        auto frame =
            bench::SampleScene::frame(320, 180, eye_at(shot.x, ground + shot.up, shot.z), shot.yaw, shot.pitch, 5);
        frame.sky = scene::sky_at(shot.time);
        frame.seconds = 2;
        frame.views[0].underwater = shot.underwater;
        if (shot.underwater) {
            const auto optics = scene::water_optics({0.25f, 0.46f, 0.89f});
            frame.views[0].medium = {optics.absorption, optics.scattering, {}, 39.9f - float(ground + shot.up), 1};
        }
        frame.outlines.push_back(
            {{DimensionId::overworld, {6, scene.ground(6, 18) + 1, 15}}, {{{0, 0, 0}, {1, 1, 1}}}});
        golden::compare("render", shot.name, draw(*renderer, frame));
    }
};

TEST_F(Golden, LakeByDayLow) {
    shoot({"lake_day_low", Preset::low, 6000, -60, 18, 30.5, 14, -40.5});
}
TEST_F(Golden, LakeByDayHigh) {
    shoot({"lake_day_high", Preset::high, 4000, -60, 18, 30.5, 14, -40.5});
}
TEST_F(Golden, Sunset) {
    shoot({"sunset", Preset::high, 12000, 90, 3, 30.5, 14, -40.5});
}
TEST_F(Golden, NightWithLamps) {
    shoot({"night_lamps", Preset::high, 18500, 10, 14, 4.5, 6, 4.5, false, false});
}
TEST_F(Golden, HutByMorning) {
    shoot({"hut_morning", Preset::low, 1500, 10, 14, 4.5, 6, 4.5, false, false});
}
TEST_F(Golden, UnderWater) {
    shoot({"under_water", Preset::high, 6000, -20, 2, 60.5, -4, -30.5, true});
}

} // namespace vitrail::render
