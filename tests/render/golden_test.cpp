// Pictures compared with those a person has looked at. VITRAIL_UPDATE_GOLDEN=1 writes them anew: look at each before it
// is committed (holes, wrong light, seams).
#include "render_fixture.h"
#include "scene/sky.h"

namespace vitrail::render {

class Golden : public RenderTest {
protected:
    static void compare(const std::string& name, const Image& image) {
        const std::string path = std::string(VITRAIL_SOURCE_DIR) + "/tests/render/golden/" + name + ".png";
        if (std::getenv("VITRAIL_UPDATE_GOLDEN")) {
            ASSERT_TRUE(write_png(path, image));
            return;
        }
        const Result<Image> golden = read_png(path);
        ASSERT_TRUE(golden) << golden.error().message;
        ASSERT_EQ(golden->width, image.width);
        ASSERT_EQ(golden->height, image.height);
        u64 sum = 0, far = 0;
        for (u32 y = 0; y < image.height; ++y)
            for (u32 x = 0; x < image.width; ++x) {
                u32 worst = 0;
                for (u32 c = 0; c < 3; ++c) {
                    const u32 d = u32(std::abs(int(image.at(x, y)[c]) - int(golden->at(x, y)[c])));
                    sum += d;
                    worst = std::max(worst, d);
                }
                far += worst > 24;
            }
        const double pixels = double(image.width) * image.height;
        EXPECT_LT(double(sum) / pixels / 3, 1.5) << name;
        EXPECT_LT(double(far) / pixels, 0.01) << name;
        if (testing::Test::HasFailure()) {
            const std::string seen = "/tmp/vitrail_golden_" + name + ".png";
            (void)write_png(seen, image);
            ADD_FAILURE() << "what was drawn: " << seen;
        }
    }

    struct Shot {
        const char* name;
        Preset preset;
        float time, yaw, pitch;
        double x, up, z; // up: above the ground there
        bool underwater = false, trees = true;
    };
    static void shoot(const Shot& shot) {
        if (const auto info = gfx::context_info(); !info || !info->software)
            GTEST_SKIP() << "golden pictures are Mesa's; " << (info ? info->renderer : "")
                         << " filters textures differently";
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
        frame.outlines.push_back(
            {{DimensionId::overworld, {6, scene.ground(6, 18) + 1, 15}}, {{{0, 0, 0}, {1, 1, 1}}}});
        compare(shot.name, draw(*renderer, frame));
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
