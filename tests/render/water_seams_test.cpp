// Water and glass as pictures: layers over each other, seams between quads, sections and levels of detail, refraction
// at the edges of things, far places. Numbers come from the targets, before the tone curve.
#include "render/frame_uniforms.h"
#include "render_fixture.h"
#include "scene/sky.h"
#include "scene/water.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace vitrail::render {

namespace {

Effects clear_water() {
    Effects e = preset_effects(Preset::low);
    e.exposure.automatic = false;
    e.fog.density = 0;
    e.water.waves = e.water.swell = e.water.refraction = false;
    return e;
}
Effects bent_water() {
    Effects e = clear_water();
    e.water.waves = e.water.swell = e.water.refraction = true;
    e.water.wave_height = 0.1f;
    return e;
}

class WaterSeams : public RenderTest {
protected:
    BlockRegistry registry;
    TextureId water, white, red, red_glass, blue_glass;
    std::unique_ptr<Renderer> renderer;

    void SetUp() override {
        RenderTest::SetUp();
        if (IsSkipped()) return;
        registry.content_roots = {test_content()};
        water = registry.texture_id("water_still");
        white = registry.texture_id("flat_white");
        red = registry.texture_id("glowstone");
        red_glass = registry.texture_id("flat_red"), blue_glass = registry.texture_id("flat_blue");
        renderer = make_renderer();
        ASSERT_TRUE(renderer);
        ASSERT_TRUE(renderer->load_textures(registry));
    }
    void TearDown() override {
        renderer.reset();
        RenderTest::TearDown();
    }

    static std::pair<u32, Quad> top(i32 x, i32 y, i32 z, u32 w, u32 h, TextureId texture, u64 flags) {
        return {3, Quad::cube({x, y, z}, w, h, Face::up, 255, texture, TintKind::none, 0, flags)};
    }
    static scene::FrameView frame_of(WorldPos eye, float yaw, float pitch, u32 width, u32 height) {
        auto frame = bench::SampleScene::frame(width, height, eye, yaw, pitch, 12);
        frame.sky = scene::sky_at(6000);
        frame.seconds = 5;
        frame.sky.sun_light = {}; // no glitter
        return frame;
    }
    TargetPixels color(const scene::FrameView& frame) {
        EXPECT_TRUE(renderer->render(frame));
        auto pixels = renderer->read_target("color");
        EXPECT_TRUE(pixels);
        return pixels ? std::move(*pixels) : TargetPixels{};
    }
    // Water 16 x 16 sections around, cut into quads as `cells` says: 16 one a section, 1 a quad a block.
    void give_sea(ChunkPos base, const std::function<u32(i32 x, i32 z)>& cells) {
        give_sheets(base, water, kQuadLiquid, cells);
    }
    void give_sheets(ChunkPos base, TextureId texture, u64 flags, const std::function<u32(i32 x, i32 z)>& cells) {
        for (i32 z = -3; z <= 3; ++z)
            for (i32 x = -3; x <= 3; ++x) {
                const u32 side = cells(x, z);
                std::vector<std::pair<u32, Quad>> quads;
                for (u32 j = 0; j < 16; j += side)
                    for (u32 i = 0; i < 16; i += side)
                        quads.push_back(top(i32(i), 4, i32(j), side, side, texture, flags));
                renderer->set_section({base.x + x, base.y, base.z + z}, {}, quads_of(QuadPass::translucent, quads));
            }
    }
};

} // namespace

// Any stack of panes and water, within a section and across two, is each layer over what lies behind it, and not
// another order.
TEST_F(WaterSeams, LayersLieOverEachOther) {
    enum Kind : u32 { none, red_pane, blue_pane, sea };
    const auto look = [&](const std::vector<std::pair<i32, Kind>>& layers, Vec3 background) {
        renderer->clear_sections();
        renderer->set_background(true, background);
        std::vector<std::pair<u32, Quad>> quads[2];
        for (const auto& [y, kind] : layers) {
            auto& to = quads[y >> 4];
            if (kind == sea)
                to.push_back(top(0, y & 15, 0, 16, 16, water, kQuadLiquid));
            else
                to.push_back(top(0, y & 15, 0, 16, 16, kind == red_pane ? red_glass : blue_glass, 0));
        }
        for (i32 s = 0; s < 2; ++s)
            renderer->set_section({0, s, 0}, {}, quads_of(QuadPass::translucent, quads[s]));
        const auto pixels = color(frame_of(eye_at(8, 40, 8), 0, 90, 17, 17));
        const float* p = pixels.at(8, 8);
        return Vec3{p[0], p[1], p[2]};
    };
    for (const bool refraction : {false, true}) {
        Effects effects = clear_water();
        effects.water.refraction = refraction;
        ASSERT_TRUE(renderer->set_effects(effects));
        struct Layer {
            Vec3 own, through;
        };
        std::map<u32, Layer> alone;
        for (const Kind kind : {red_pane, blue_pane, sea}) {
            const Vec3 dark = look({{9, kind}}, {0, 0, 0}), bright = look({{9, kind}}, {2, 2, 2});
            alone[kind] = {dark, (bright - dark) * 0.5f};
        }
        const Vec3 behind{0.3f, 0.2f, 0.6f};
        double wrong_differs = 0;
        Rng rng(4);
        for (int turn = 0; turn < 16; ++turn) {
            std::vector<std::pair<i32, Kind>> stack;
            for (i32 y = 1; y < 32; y += 3 + i32(rng.below(7)))
                stack.push_back({y, Kind(1 + rng.below(3))});
            const auto over = [&](bool backwards) {
                Vec3 sum = behind;
                for (std::size_t i = 0; i < stack.size(); ++i) {
                    const Layer& l = alone[stack[backwards ? stack.size() - 1 - i : i].second];
                    sum = l.own + l.through * sum;
                }
                return sum;
            };
            const Vec3 seen = look(stack, behind), wanted = over(false);
            for (const auto& [s, w] : {std::pair(seen.x, wanted.x), {seen.y, wanted.y}, {seen.z, wanted.z}})
                EXPECT_NEAR(s, w, 0.01f + 0.02f * w) << "turn " << turn << " refraction " << refraction;
            wrong_differs += double(length(over(true) - wanted));
        }
        EXPECT_GT(wrong_differs, 1.0); // else nothing is tested
    }
}

// The sea hides what is bright below it; where a crack opened it would show through. Whole sections, blocks and
// something between lie side by side, some of them in reach of the swell, some beyond.
TEST_F(WaterSeams, SwellTearsNothing) {
    ASSERT_TRUE(renderer->set_effects(bent_water()));
    renderer->set_background(true, {40, 40, 40});
    const u32 sides[] = {16, 1, 4, 16, 2, 8};
    give_sea({}, [&](i32 x, i32 z) { return sides[u32(x * 2 + z * 5 + 60) % 6]; });
    u32 cracks = 0, looked_at = 0;
    for (int turn = 0; turn < 6; ++turn) {
        auto frame = frame_of(eye_at(7.3 + turn, turn % 2 ? 6.3 : 9.1, 8.7 - turn), float(turn) * 67, 55, 213, 120);
        frame.seconds = 3.1f * float(turn);
        const auto pixels = color(frame);
        for (u32 y = 0; y < 120; ++y)
            for (u32 x = 0; x < 213; ++x) {
                ++looked_at;
                cracks += pixels.at(x, y)[0] > 4;
            }
    }
    EXPECT_GT(looked_at, 100000u);
    EXPECT_EQ(cracks, 0u);
}

// From high above, sections that the eye is far beside of are cut like those it is above of; they stay where they are.
TEST_F(WaterSeams, SeaFarBesideAHighEye) {
    ASSERT_TRUE(renderer->set_effects(bent_water()));
    renderer->set_background(true, {40, 40, 40});
    const SectionMesh sea = quads_of(QuadPass::translucent, {top(0, 4, 0, 16, 16, water, kQuadLiquid)});
    renderer->set_section({0, -19, 0}, {}, sea);
    renderer->set_section({10, -10, 0}, {}, sea);
    // East and down, at the middle of the latter: 160 blocks on, 163 down.
    const auto pixels = color(frame_of(eye_at(8, 8.1, 8), -90, 45.5f, 65, 65));
    EXPECT_LT(pixels.at(32, 32)[0], 4);
}

// Where quads meet, none is blended twice: a pane or a sea of many quads looks as one of few, without dotted lines
// along the borders.
TEST_F(WaterSeams, NothingIsBlendedTwice) {
    for (const bool pane : {true, false}) {
        ASSERT_TRUE(renderer->set_effects(pane ? clear_water() : bent_water()));
        renderer->set_background(true, {1, 1, 1});
        const auto look = [&](int turn, bool many) {
            renderer->clear_sections();
            const u32 sides[] = {16, 1, 4, 16, 2, 8};
            give_sheets({}, pane ? red_glass : water, pane ? 0 : kQuadLiquid,
                        [&](i32 x, i32 z) { return many ? sides[u32(x * 2 + z * 5 + 60) % 6] : 16; });
            return color(frame_of(eye_at(7.31 + turn, 11.2, 8.77 - turn), float(turn) * 67 + 3, 50, 213, 120));
        };
        u32 doubled = 0;
        for (int turn = 0; turn < 3; ++turn) {
            const auto few = look(turn, false), many = look(turn, true);
            for (u32 y = 0; y < 120; ++y)
                for (u32 x = 0; x < 213; ++x) {
                    const float a = few.at(x, y)[1], b = many.at(x, y)[1];
                    doubled += std::abs(a - b) > 0.02f + 0.05f * a;
                }
        }
        // Where a long edge meets short ones rounding leaves a pixel here and there; growing quads made 1300.
        EXPECT_LE(doubled, 20u) << (pane ? "panes" : "swell");
    }
}

// Waves shift what lies behind them; what stands before the water, or in it but above its surface, stays where it is.
TEST_F(WaterSeams, RefractionTakesNothingInFront) {
    ASSERT_TRUE(renderer->set_effects(bent_water()));
    renderer->set_background(true, {0.2f, 0.3f, 0.4f});
    const auto pillar = [](i32 x, i32 z, i32 from, i32 to, TextureId texture, std::vector<std::pair<u32, Quad>>& out) {
        for (const Face face : {Face::west, Face::east, Face::north, Face::south})
            for (i32 y = from; y <= to; ++y)
                out.push_back({u32(face), Quad::cube({x, y, z}, 1, 1, face, 255, texture, TintKind::none, 0)});
    };
    const auto look = [&](TextureId texture, bool wet, int turn) {
        renderer->clear_sections();
        for (i32 z = -2; z <= 2; ++z)
            for (i32 x = -2; x <= 2; ++x) {
                std::vector<std::pair<u32, Quad>> sheets, solid;
                if (wet) sheets.push_back(top(0, 4, 0, 16, 16, water, kQuadLiquid));
                // Half of what stands here differs between the pictures: all of it above the water.
                for (i32 i = 2; i < 16; i += 6) {
                    pillar(i, 15 - i, 0, 4, white, solid);
                    pillar(i, 15 - i, 5, 7, texture, solid);
                    pillar(15 - i, i, 9, 9, texture, solid); // hangs in the air
                }
                renderer->set_section({x, 0, z}, {}, quads_of(QuadPass::translucent, sheets, solid));
                renderer->set_section({x, -1, z}, {}, quads_of(QuadPass::opaque, {top(0, 13, 0, 16, 16, white, 0)}));
            }
        auto frame = frame_of(eye_at(8.3 + turn, 9.7 + turn, 7.2), float(turn) * 50 + 10, 22, 213, 120);
        frame.seconds = float(turn) * 2.3f;
        return color(frame);
    };
    u32 taken = 0, standing = 0;
    for (int turn = 0; turn < 3; ++turn) {
        const auto dry_a = look(white, false, turn), dry_b = look(red, false, turn);
        const auto wet_a = look(white, true, turn), wet_b = look(red, true, turn);
        for (u32 y = 0; y < 120; ++y)
            for (u32 x = 0; x < 213; ++x) {
                const auto differ = [&](const TargetPixels& a, const TargetPixels& b) {
                    return std::abs(a.at(x, y)[2] - b.at(x, y)[2]) > 0.004f;
                };
                const bool stands = differ(dry_a, dry_b);
                standing += stands;
                taken += !stands && differ(wet_a, wet_b);
            }
    }
    EXPECT_GT(standing, 500u);
    EXPECT_EQ(taken, 0u);
}

// At the ends of the world waves, colors and light lie as at its origin.
TEST_F(WaterSeams, FarWaterIsTheSame) {
    ASSERT_TRUE(renderer->set_effects(bent_water()));
    renderer->set_background(true, {0.2f, 0.5f, 0.9f});
    std::vector<float> first;
    for (const i32 far : {0, 1874992, -1874992}) { // chunks, a multiple of 16: the waves' period is 256 blocks
        for (const i32 far_z : {0, -far}) {
            renderer->clear_sections();
            const ChunkPos base{far, 0, far_z};
            give_sea(base, [](i32 x, i32) { return x & 1 ? 16u : 2u; });
            for (i32 z = -3; z <= 3; ++z)
                for (i32 x = -3; x <= 3; ++x)
                    renderer->set_section({far + x, -1, far_z + z}, {},
                                          quads_of(QuadPass::opaque, {top(0, 13, 0, 16, 16, red, 0)}));
            const auto pixels = color(frame_of(eye_at(7.31, 8.2, 8.77, base), 30, 25, 107, 60));
            std::vector<float> all;
            for (u32 y = 0; y < 60; ++y)
                for (u32 x = 0; x < 107; ++x)
                    all.insert(all.end(), pixels.at(x, y), pixels.at(x, y) + 3);
            if (first.empty()) first = all;
            float most = 0;
            for (std::size_t i = 0; i < all.size(); ++i)
                most = std::max(most, std::abs(all[i] - first[i]));
            EXPECT_LT(most, 1e-3f) << "at " << far << " " << far_z << " chunks";
        }
    }
}

// An eye in lava sees its glow, the same to all sides however near the surface is, and what stands near through it by
// exp(-k d).
TEST_F(WaterSeams, LavaGlowsAllAround) {
    ASSERT_TRUE(renderer->set_effects(clear_water()));
    const Vec3 glow{0.9f, 0.35f, 0.1f};
    std::vector<std::pair<u32, Quad>> solid{top(0, 1, 0, 16, 16, white, 0)};
    solid.push_back({5, Quad::cube({0, 0, 7}, 16, 16, Face::south, 255, white, TintKind::none, 0)});
    renderer->set_section({0, 0, 0}, {}, quads_of(QuadPass::opaque, solid));
    const auto look = [&](float yaw, float pitch, float dense, float depth, double z = 9) {
        auto frame = frame_of(eye_at(8.1, 9.2, z), yaw, pitch, 17, 17);
        frame.views[0].underwater = true;
        frame.views[0].medium = {{dense, dense, dense}, {}, glow, depth, 1};
        const auto pixels = color(frame);
        const float* p = pixels.at(8, 8);
        return Vec3{p[0], p[1], p[2]};
    };
    for (const float depth : {0.1f, 3.0f}) {
        for (const float pitch : {-90.0f, -40.0f, 0.0f, 40.0f, 90.0f}) { // the sky, and the ground 7 blocks below
            const Vec3 seen = look(0, pitch, 3, depth);
            EXPECT_NEAR(seen.x, glow.x, 0.01f) << pitch << " at depth " << depth;
            EXPECT_NEAR(seen.z, glow.z, 0.01f) << pitch << " at depth " << depth;
        }
        // A wall 1, 2 and 3 blocks north of the eye: what it sends is the same, of which the share falls as it should.
        const auto wall = [&](double away) {
            const float left = std::exp(-0.5f * float(away));
            return (look(180, 0, 0.5f, depth, 8 + away).z - glow.z * (1 - left)) / left;
        };
        const float near = wall(1);
        ASSERT_GT(near, 0.1f);
        EXPECT_NEAR(wall(2), near, 0.01f) << depth;
        EXPECT_NEAR(wall(3), near, 0.01f) << depth;
    }
}

} // namespace vitrail::render
