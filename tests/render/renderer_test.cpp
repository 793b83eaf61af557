#include "math/angle.h"
#include "render_fixture.h"
#include "scene/sky.h"

#include <cmath>

namespace vitrail::render {

using RendererTest = RenderTest;

static bool is_magenta(const u8* p) {
    return p[0] > 200 && p[1] < 60 && p[2] > 200;
}

static u32 count_magenta(const Image& image) {
    u32 n = 0;
    for (u32 y = 0; y < image.height; ++y)
        for (u32 x = 0; x < image.width; ++x)
            n += is_magenta(image.at(x, y));
    return n;
}

// A wall of one face direction at z = `cell` of a section, 16 x 16, one quad.
static Quad wall(i32 z, Face face, TextureId texture) {
    return Quad::cube({0, 0, z}, 16, 16, face, 255, texture, TintKind::none, 0);
}

TEST_F(RendererTest, BuildsEveryPreset) {
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    for (u32 i = 0; i < u32(Preset::count); ++i) {
        const Result<> set = renderer->set_effects(preset_effects(Preset(i)));
        EXPECT_TRUE(set) << preset_name(Preset(i)) << ": " << set.error().message;
        EXPECT_EQ(preset_of(renderer->effects()), Preset(i));
    }
}

// The same scene far away on each axis gives the same picture, byte for byte.
TEST_F(RendererTest, EveryPlaceLooksTheSame) {
    constexpr i32 far = (2147483647 - 1007) / 16;
    static_assert(i64(far) * 16 == (i64(1) << 31) - 1008);
    bench::SampleScene scene(2);
    scene.registry.content_roots = {test_content()};
    const double up = scene.ground(20, 24) + 5;
    for (Preset preset : {Preset::low, Preset::high}) {
        Image first;
        for (ChunkPos base :
             {ChunkPos{0, 0, 0}, ChunkPos{far, 0, 0}, ChunkPos{-far, 0, 0}, ChunkPos{0, far, 0}, ChunkPos{0, -far, 0},
              ChunkPos{0, 0, far}, ChunkPos{0, 0, -far}, ChunkPos{far, -far, far}}) {
            auto renderer = make_renderer(preset);
            ASSERT_TRUE(renderer);
            Effects effects = renderer->effects();
            effects.sky.clouds = i32(Clouds::off);               // they hang in the world: other places have others
            effects.fog.height = effects.fog.volumetric = false; // mist knows how high it lies
            ASSERT_TRUE(renderer->set_effects(effects));
            scene.give(*renderer, base);
            ASSERT_TRUE(renderer->load_textures(scene.registry));
            auto frame = bench::SampleScene::frame(240, 136, eye_at(20.37, up, 24.81, base), 160, 20, 6);
            frame.seconds = 5;
            const Image image = draw(*renderer, frame);
            if (first.width == 0) first = image;
            ASSERT_EQ(image.pixels, first.pixels) << "at chunk " << base.x << " " << base.y << " " << base.z;
        }
        u32 different = 0; // and it shows something
        for (std::size_t i = 0; i < first.pixels.size(); ++i)
            different += first.pixels[i] != first.pixels[i % 3];
        EXPECT_GT(different, first.pixels.size() / 2);
    }
}

// Merged quads meet small ones at T-junctions all over a hilly landscape: no gap may let the background through.
TEST_F(RendererTest, NoCracksAtTJunctions) {
    bench::SampleScene scene(4, false);
    scene.registry.content_roots = {test_content()};
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    scene.give(*renderer);
    ASSERT_TRUE(renderer->load_textures(scene.registry));
    renderer->set_background(true, {1, 0, 1});
    for (int i = 0; i < 24; ++i) {
        Rng rng{u64(i)};
        const double x = rng.unit() * 24 - 12, z = rng.unit() * 24 - 12;
        auto frame = bench::SampleScene::frame(
            427, 240, eye_at(x, scene.ground(i32(std::floor(x)), i32(std::floor(z))) + 3 + 14 * rng.unit(), z),
            360 * rng.unit(), 62 + 20 * rng.unit(), 8);
        frame.views[0].fov_y = 0.8f;
        const Image image = draw(*renderer, frame);
        if (count_magenta(image)) (void)write_png(fmt::format("/tmp/vitrail_cracks_{}.png", i), image);
        EXPECT_EQ(count_magenta(image), 0u) << "view " << i << ", written to /tmp";
    }
    // The same background is there when there is nothing in front of it.
    auto up = bench::SampleScene::frame(64, 64, eye_at(0, 90, 0), 0, -80, 8);
    EXPECT_EQ(count_magenta(draw(*renderer, up)), 64 * 64u);
}

// Whichever side one looks from, the nearer of two panes lies over the farther.
TEST_F(RendererTest, TranslucentQuadsAreSorted) {
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId red = registry.texture_id("red"), green = registry.texture_id("green");
    ASSERT_TRUE(renderer->load_textures(registry));
    renderer->set_background(true, {0, 0, 0});
    // Both sides of each pane, in one section.
    renderer->set_section({0, 0, 0}, {},
                          quads_of(QuadPass::translucent, {{4, wall(4, Face::north, red)},
                                                           {5, wall(3, Face::south, red)},
                                                           {4, wall(12, Face::north, green)},
                                                           {5, wall(11, Face::south, green)}}));
    auto look = [&](double z, float yaw) {
        const Image image = draw(*renderer, bench::SampleScene::frame(33, 33, eye_at(8, 8, z), yaw, 0, 8));
        const u8* p = image.at(16, 16);
        return int(p[0]) - int(p[1]);
    };
    EXPECT_GT(look(-10, 0), 30);   // from the north: red is nearer
    EXPECT_LT(look(30, 180), -30); // from the south: green
    EXPECT_GT(look(-10, 0), 30);   // and back
    // Across sections.
    renderer->clear_sections();
    renderer->set_section(
        {0, 0, 0}, {},
        quads_of(QuadPass::translucent, {{4, wall(4, Face::north, red)}, {5, wall(3, Face::south, red)}}));
    renderer->set_section(
        {0, 0, 1}, {},
        quads_of(QuadPass::translucent, {{4, wall(4, Face::north, green)}, {5, wall(3, Face::south, green)}}));
    EXPECT_GT(look(-10, 0), 30);
    EXPECT_LT(look(40, 180), -30);
    // A small sheet below a large one, its center nearer to the eye: water under ice.
    renderer->clear_sections();
    renderer->set_section(
        {0, 0, 0}, {},
        quads_of(QuadPass::translucent, {{3, Quad::cube({0, 9, 0}, 16, 16, Face::up, 255, green, TintKind::none, 0)},
                                         {3, Quad::cube({0, 8, 0}, 16, 4, Face::up, 255, red, TintKind::none, 0)}}));
    const Image sheets = draw(*renderer, bench::SampleScene::frame(33, 33, eye_at(8, 24, -20), 0, 33, 8));
    EXPECT_LT(int(sheets.at(16, 16)[0]) - int(sheets.at(16, 16)[1]), -30);
    // Two faces in one plane, where glass touches water: that of the nearer block lies over the other's.
    renderer->clear_sections();
    renderer->set_section(
        {0, 0, 0}, {},
        quads_of(QuadPass::translucent, {{5, wall(4, Face::south, red)}, {4, wall(5, Face::north, green)}}));
    EXPECT_GT(look(-10, 0), 30);
    EXPECT_LT(look(30, 180), -30);
}

TEST_F(RendererTest, ResizesAtAnyTime) {
    bench::SampleScene scene(1);
    scene.registry.content_roots = {test_content()};
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    scene.give(*renderer);
    ASSERT_TRUE(renderer->load_textures(scene.registry));
    for (auto [w, h] : {std::pair<u32, u32>{320, 200}, {1, 1}, {2, 301}, {641, 3}, {320, 200}}) {
        const Image image = draw(*renderer, bench::SampleScene::frame(w, h, eye_at(0, 80, 0), 0, 40, 4));
        EXPECT_EQ(image.width, w);
        EXPECT_EQ(image.height, h);
    }
    auto frame = bench::SampleScene::frame(0, 10, {}, 0, 0, 4);
    EXPECT_FALSE(renderer->render(frame));
    frame.width = 20000;
    EXPECT_FALSE(renderer->render(frame));
    frame.width = 20;
    frame.views.clear();
    EXPECT_FALSE(renderer->render(frame));
}

TEST_F(RendererTest, CountsMissingTextures) {
    auto renderer = make_renderer();
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    registry.texture_id("stone");
    registry.texture_id("nowhere");
    registry.texture_id("../../../etc/passwd");
    ASSERT_TRUE(renderer->load_textures(registry));
    EXPECT_EQ(renderer->missing_textures(), 2u);
    EXPECT_EQ(renderer->missing_texture_names().at(0), "nowhere");
}

TEST_F(RendererTest, LightChangesWithoutAMesh) {
    auto renderer = make_renderer();
    Effects effects = renderer->effects();
    effects.exposure.automatic = false; // which would make up for the dark
    ASSERT_TRUE(renderer->set_effects(effects));
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId white = registry.texture_id("white");
    ASSERT_TRUE(renderer->load_textures(registry));
    renderer->set_section({0, 0, 0}, {}, quads_of(QuadPass::opaque, {{4, wall(8, Face::north, white)}}));
    auto look = [&] {
        const Image image = draw(*renderer, bench::SampleScene::frame(33, 33, eye_at(8, 8, 2), 0, 0, 8));
        return std::array<int, 3>{image.at(16, 16)[0], image.at(16, 16)[1], image.at(16, 16)[2]};
    };
    LightBrick brick;
    brick.uniform = true;
    brick.value = Light(0, 0, 0, 0);
    renderer->set_section_light({0, 0, 0}, {}, brick);
    const auto dark = look();
    brick.value = Light(15, 0, 0, 0);
    renderer->set_section_light({0, 0, 0}, {}, brick);
    const auto sky = look();
    brick.uniform = false;
    brick.cells.fill(Light(0, 14, 1, 1).bits);
    renderer->set_section_light({0, 0, 0}, {}, brick);
    const auto lamp = look();
    EXPECT_LT(dark[1], 60);
    EXPECT_GT(sky[1], 110);
    EXPECT_GT(lamp[0], lamp[2] + 80);
    // Uniform bricks of one value share a slot: thousands cost nothing.
    const u64 before = renderer->stats().gpu_bytes;
    brick.uniform = true;
    for (i32 i = 0; i < 3000; ++i)
        renderer->set_section_light({i, 5, 0}, {}, brick);
    (void)look();
    EXPECT_EQ(renderer->stats().gpu_bytes, before);
}

TEST_F(RendererTest, RemovedSectionsAreGone) {
    auto renderer = make_renderer();
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId white = registry.texture_id("white");
    ASSERT_TRUE(renderer->load_textures(registry));
    renderer->set_background(true, {1, 0, 1});
    const auto frame = bench::SampleScene::frame(33, 33, eye_at(8, 8, 2), 0, 0, 8);
    renderer->set_section({0, 0, 0}, {}, quads_of(QuadPass::opaque, {{4, wall(8, Face::north, white)}}));
    EXPECT_EQ(count_magenta(draw(*renderer, frame)), 0u);
    renderer->remove_section({0, 0, 0}, {});
    EXPECT_FALSE(renderer->has_section({0, 0, 0}, {}));
    EXPECT_EQ(count_magenta(draw(*renderer, frame)), 33 * 33u);
    // Another dimension's sections are not drawn.
    renderer->set_section({0, 0, 0}, DimensionId(7), quads_of(QuadPass::opaque, {{4, wall(8, Face::north, white)}}));
    EXPECT_EQ(count_magenta(draw(*renderer, frame)), 33 * 33u);
    EXPECT_EQ(renderer->stats().sections, 1u);
}

TEST_F(RendererTest, ClipPlanesCutAndViewsAreNumbered) {
    auto renderer = make_renderer();
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId white = registry.texture_id("white");
    ASSERT_TRUE(renderer->load_textures(registry));
    renderer->set_background(true, {1, 0, 1});
    renderer->set_section({0, 0, 0}, {}, quads_of(QuadPass::opaque, {{4, wall(8, Face::north, white)}}));
    auto frame = bench::SampleScene::frame(32, 32, eye_at(8, 8, 2), 0, 0, 8);
    frame.views[0].clip_plane = {1, 0, 0, 0}; // the left half: x grows to the left when looking south
    EXPECT_EQ(count_magenta(draw(*renderer, frame)), 16 * 32u);
    // A second view without a portal to be seen through draws nothing yet; all pixels stay view 0.
    frame.views[0].clip_plane = {0, 0, 0, 1};
    frame.views.push_back(frame.views[0]);
    EXPECT_EQ(count_magenta(draw(*renderer, frame)), 0u);
    const auto numbers = renderer->read_view_numbers();
    ASSERT_TRUE(numbers);
    for (u8 n : *numbers)
        ASSERT_EQ(n, 0);
}

TEST_F(RendererTest, OutlinesThePickedBlock) {
    auto renderer = make_renderer();
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId white = registry.texture_id("white");
    ASSERT_TRUE(renderer->load_textures(registry));
    renderer->set_section({0, 0, 0}, {}, quads_of(QuadPass::opaque, {{4, wall(8, Face::north, white)}}));
    auto frame = bench::SampleScene::frame(200, 200, eye_at(8.5, 8.5, 4), 0, 0, 8);
    const Image plain = draw(*renderer, frame);
    frame.outlines.push_back({{DimensionId::overworld, {8, 8, 8}}, {{{0, 0, 0}, {1, 1, 1}}}});
    const Image outlined = draw(*renderer, frame);
    u32 darker = 0;
    for (u32 i = 0; i < plain.pixels.size(); i += 3)
        darker += outlined.pixels[i] + 30 < plain.pixels[i];
    EXPECT_GT(darker, 100u); // four edges of about 36 pixels
    EXPECT_LT(darker, 1500u);
    EXPECT_EQ(outlined.at(100, 100)[0], plain.at(100, 100)[0]); // the inside stays
}

// The shader's dome is scene::sky_color: away from sun, moon and their glare the picture is that table.
TEST_F(RendererTest, SkyIsTheSameInBothLanguages) {
    auto renderer = make_renderer();
    Effects effects = renderer->effects();
    effects.sky.clouds = i32(Clouds::off), effects.sky.stars = false;
    effects.fog.height = effects.fog.volumetric = false;
    ASSERT_TRUE(renderer->set_effects(effects));
    for (float time : {0.0f, 3000.0f, 6000.0f, 11800.0f, 12600.0f, 14000.0f, 18000.0f, 23500.0f})
        for (const auto& [yaw, pitch] :
             {std::pair{180.0f, -25.0f}, {150.0f, -3.0f}, {20.0f, -2.0f}, {215.0f, -60.0f}}) {
            auto frame = bench::SampleScene::frame(17, 17, eye_at(0, 0, 0), yaw, pitch, 8);
            frame.sky = scene::sky_at(time);
            frame.views[0].fov_y = 0.004f;
            (void)draw(*renderer, frame);
            const auto color = renderer->read_target("color");
            ASSERT_TRUE(color);
            const Vec3 d = look_direction(yaw * kRadiansADegree, pitch * kRadiansADegree);
            const Vec3 c = scene::sky_color(frame.sky, d);
            // What the glare of both discs adds here, by the formulas of discs.glsl.
            const auto glare = [&](Vec3 towards, float radius, float reach, float falls) {
                const float angle = length(d - towards), q = angle / radius;
                return std::max(1 - angle * reach, 0.0f) / (1 + q * q * falls);
            };
            const float g = 0.55f * glare(frame.sky.sun_direction, 0.030f, 1.4f, 0.55f);
            const Vec3 sum = c + frame.sky.sun_disc * (g * g * 1.4f) +
                             frame.sky.moon_disc * Vec3{0.55f, 0.75f, 1.1f} *
                                 (0.055f * glare(frame.sky.moon_direction, 0.036f, 2.0f, 0.30f));
            const float in[3] = {sum.x, sum.y, sum.z};
            for (u32 k = 0; k < 3; ++k)
                EXPECT_NEAR(color->at(8, 8)[k], in[k], 0.02f * in[k] + 0.0005f)
                    << "time " << time << " towards " << yaw << ' ' << pitch << " channel " << k;
        }
}

// No frame differs from the one before by a step that an eye would see, whatever the sky's pass switches on and off.
TEST_F(RendererTest, DayAndNightChangeSmoothly) {
    auto renderer = make_renderer();
    Effects effects = renderer->effects();
    effects.exposure.automatic = false; // which would make up for the change
    ASSERT_TRUE(renderer->set_effects(effects));
    std::vector<u8> before;
    for (float yaw : {90.0f, -90.0f})
        for (const auto& [from, to] : {std::pair{11500.0f, 13400.0f}, std::pair{22600.0f, 24500.0f}}) {
            before.clear();
            for (float t = from; t <= to; t += 10) {
                const Image image = draw(*renderer, [&] {
                    auto frame = bench::SampleScene::frame(48, 32, eye_at(0, 80, 0), yaw, -8, 8);
                    frame.sky = scene::sky_at(t, 2);
                    return frame;
                }());
                if (!before.empty()) {
                    double sum = 0;
                    for (std::size_t i = 0; i < before.size(); ++i)
                        sum += std::abs(int(image.pixels[i]) - int(before[i]));
                    ASSERT_LT(sum / double(before.size()), 5) << "at " << t << " towards " << yaw;
                }
                before = image.pixels;
            }
        }
}

TEST_F(RendererTest, IconsShowTheBlock) {
    auto registry = std::make_shared<BlockRegistry>();
    registry->content_roots = {test_content()};
    BlockDef def;
    def.name = "minecraft:stone";
    def.look.textures = {"stone"};
    registry->add_block(def);
    registry->texture_id("stone");
    StateTable states(registry);
    const auto stone = states.intern(*parse_block_state("minecraft:stone"));
    ASSERT_TRUE(stone);
    scene::BlockModels models;
    models.ensure(states);
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer->load_textures(*registry));
    renderer->sync_models(models);
    const auto icon = renderer->render_block_icon(states, models, *stone, 48);
    ASSERT_TRUE(icon) << icon.error().message;
    const Image image = *renderer->read_texture(*icon);
    EXPECT_EQ(image.at(24, 24)[3], 255);
    EXPECT_EQ(image.at(1, 1)[3], 0);
    EXPECT_GT(image.at(24, 10)[0], image.at(36, 34)[0] + 20); // the top is lighter than the side
    const auto air = renderer->render_block_icon(states, models, StateId::air, 48);
    ASSERT_TRUE(air);
    EXPECT_EQ(renderer->read_texture(*air)->at(24, 24)[3], 0);
    EXPECT_FALSE(renderer->render_block_icon(states, models, StateId(9999), 48));
}

} // namespace vitrail::render
