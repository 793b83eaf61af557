// Water, glass and what lets light through. Numbers come from the targets, before the tone curve.
#include "render/frame_uniforms.h"
#include "render/passes/water/water_pass.h"
#include "render_fixture.h"
#include "scene/sky.h"
#include "scene/water.h"

#include <cmath>
#include <epoxy/gl.h>

namespace vitrail::render {

namespace {

Quad sheet(u32 y, TextureId texture, TintKind tint, u64 flags, u32 side = 16) {
    return Quad::cube({0, i32(y), 0}, side, side, Face::up, 255, texture, tint, 0, flags);
}

// A pond: floor at y = 0..1 of `floor` chunks, water filling the cell above `water_y`.
struct Pond {
    BlockRegistry registry;
    TextureId floor, water;
    Pond() {
        registry.content_roots = {test_content()};
        floor = registry.texture_id("flat_white");
        water = registry.texture_id("water_still");
    }
};

scene::FrameView look_down(WorldPos eye, float pitch, u32 size = 33) {
    auto frame = bench::SampleScene::frame(size, size, eye, 0, pitch, 8);
    frame.sky = scene::sky_at(6000);
    return frame;
}

Effects plain_water() {
    Effects e = preset_effects(Preset::low);
    e.water.waves = false;
    e.exposure.automatic = false;
    return e;
}

} // namespace

// The slope is the derivative of the height, everywhere and at any time.
TEST(WaterWaves, SlopesAreDerivatives) {
    Rng rng(3);
    for (int i = 0; i < 400; ++i) {
        const BlockPos at{i32(rng.unit() * 4000) - 2000, 62, i32(rng.unit() * 4000) - 2000};
        const Vec2 p{rng.unit(), rng.unit()};
        const float t = rng.unit() * 65536, h = 1.0f / 128;
        const auto height = [&](float dx, float dz) {
            const auto w = scene::wave_at(at, {p.x + dx, p.y + dz}, t, 0.06f);
            return w.swell + w.ripple;
        };
        const auto w = scene::wave_at(at, p, t, 0.06f);
        EXPECT_NEAR(w.slope.x, (height(h, 0) - height(-h, 0)) / (2 * h), 2e-3f);
        EXPECT_NEAR(w.slope.y, (height(0, h) - height(0, -h)) / (2 * h), 2e-3f);
        EXPECT_LE(std::abs(w.swell), 0.06f);
    }
}

// They meet over section borders, after whole periods in space, at the ends of the world, and where the time wraps.
TEST(WaterWaves, RepeatExactly) {
    constexpr i32 far = 2147483392; // a multiple of 256
    for (int i = 0; i < 64; ++i) {
        const BlockPos at{i * 7, 0, -i * 13};
        const auto here = scene::wave_at(at, {0.25f, 0.5f}, 12.5f, 0.06f);
        for (const i32 step : {256, -256, far, -far}) { // coordinates wrap as the waves do
            const auto there = scene::wave_at({i32(u32(at.x) + u32(step)), 0, i32(u32(at.z) - u32(step))}, {0.25f, 0.5f}, 12.5f, 0.06f);
            EXPECT_EQ(there.swell, here.swell);
            EXPECT_EQ(there.slope.x, here.slope.x);
        }
        const auto beside = scene::wave_at({at.x + 1, 0, at.z}, {-0.75f, 0.5f}, 12.5f, 0.06f);
        EXPECT_NEAR(beside.swell, here.swell, 1e-5f);
        EXPECT_NEAR(beside.slope.x, here.slope.x, 2e-4f);
        const auto later = scene::wave_at(at, {0.25f, 0.5f}, 65536 + 12.5f, 0.06f);
        EXPECT_NEAR(later.swell, here.swell, 1e-4f);
    }
}

using WaterTest = RenderTest;

// What shaders compute is what C++ computes.
TEST_F(WaterTest, ShadersKnowTheSameWaves) {
    ShaderLibrary shaders;
    const auto waves = shaders.text("water/waves.glsl"), medium = shaders.text("water/medium.glsl");
    const auto frame = shaders.text("common/frame.glsl");
    ASSERT_TRUE(waves && medium && frame);
    gfx::ProgramSource source;
    source.name = "waves test";
    source.defines = {"WAVE_HEIGHT 0.06"};
    source.compute = *frame + *waves + *medium + R"(
layout(local_size_x = 64) in;
layout(std430, binding = 4) buffer Places { vec4 places[]; }; // x, z, seconds, footprint
layout(std430, binding = 5) buffer Answers { vec4 answers[]; };
void main() {
    uint i = gl_GlobalInvocationID.x;
    vec4 p = places[i];
    WaveSlope s = wave_slope(p.xy, p.z, p.w);
    answers[2u * i] = vec4(s.slope, wave_swell(p.xy, p.z), s.variance);
    answers[2u * i + 1u] = vec4(water_optics(fract(p.xyz * 0.37)).absorption, 0.0);
}
)";
    const auto program = gfx::build_program(source);
    ASSERT_TRUE(program) << program.error().message;
    constexpr u32 kPlaces = 256;
    Rng rng(5);
    std::vector<float> places;
    std::vector<BlockPos> blocks;
    for (u32 i = 0; i < kPlaces; ++i) {
        const BlockPos at{i32(rng.unit() * 1e6f) - 500000, 0, i32(rng.unit() * 1e6f) - 500000};
        blocks.push_back(at);
        places.insert(places.end(),
                      {float(at.x & 255) + 0.375f, float(at.z & 255) + 0.625f, rng.unit() * 3000, i % 2 ? 0 : 0.4f});
    }
    const auto in = gfx::make_buffer(places.size() * 4, 0, places.data());
    const auto out = gfx::make_buffer(kPlaces * 32, GL_DYNAMIC_STORAGE_BIT, nullptr);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 4, in.name());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, 5, out.name());
    glUseProgram(program->name());
    glDispatchCompute(kPlaces / 64, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    std::vector<float> answers(kPlaces * 8);
    glGetNamedBufferSubData(out.name(), 0, GLsizeiptr(answers.size() * 4), answers.data());
    for (u32 i = 0; i < kPlaces; ++i) {
        const float *p = &places[i * 4], *a = &answers[i * 8];
        const auto expected = scene::wave_at(blocks[i], {0.375f, 0.625f}, p[2], 0.06f);
        EXPECT_NEAR(a[2], expected.swell, 2e-4f);
        if (i % 2) {
            EXPECT_NEAR(a[0], expected.slope.x, 3e-3f);
            EXPECT_NEAR(a[1], expected.slope.y, 3e-3f);
            EXPECT_NEAR(a[3], 0, 1e-7f);
        } else {
            // From far off the short waves are left out, and counted as roughness.
            EXPECT_LT(std::hypot(a[0], a[1]), 0.15f);
            EXPECT_GT(a[3], 5e-4f);
        }
        const auto part = [&](int k) { return p[k] * 0.37f - std::floor(p[k] * 0.37f); };
        const auto optics = scene::water_optics({part(0), part(1), part(2)});
        EXPECT_NEAR(a[4], optics.absorption.x, 2e-3f + 0.03f * optics.absorption.x);
        EXPECT_NEAR(a[6], optics.absorption.z, 2e-3f + 0.03f * optics.absorption.z);
    }
}

// The floor's share of what the eye sees falls as exp(-k d) along the ray, for straight and slanting looks.
TEST_F(WaterTest, AbsorbsAlongTheTruePath) {
    Pond pond;
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    ASSERT_TRUE(renderer->load_textures(pond.registry));
    const auto optics = scene::water_optics({1, 1, 1}); // no tint
    const Vec3 k = optics.absorption + optics.scattering;
    for (const bool refraction : {false, true}) {
        Effects effects = plain_water();
        effects.water.refraction = refraction;
        ASSERT_TRUE(renderer->set_effects(effects));
        for (const float pitch : {90.0f, 55.0f}) {
            // Of a bright and of a dark floor, at two depths: what the floor adds, and nothing else, differs.
            double floor_share[2];
            for (const u32 deep : {3u, 7u}) {
                float seen[2][3];
                for (int lamp = 0; lamp < 2; ++lamp) {
                    renderer->clear_sections();
                    renderer->set_section({0, 0, 0}, {},
                                          quads_of(QuadPass::translucent,
                                                   {{3, sheet(12, pond.water, TintKind::none, kQuadLiquid)}},
                                                   {{3, sheet(12 - deep, pond.floor, TintKind::none, 0)}}));
                    LightBrick brick;
                    brick.uniform = false;
                    brick.cells.fill(Light(0, 0, 0, 0).bits);
                    // Light on the floor alone: cells of 18 a side, y outermost (light_brick.h), up to below the
                    // surface.
                    for (u32 y = 0; y < 18; ++y)
                        for (u32 i = 0; i < 324; ++i)
                            if (lamp && y < 12) brick.cells[y * 324 + i] = Light(0, 14, 14, 14).bits;
                    renderer->set_section_light({0, 0, 0}, {}, brick);
                    const double back = 10 / std::tan(pitch * 0.017453293);
                    auto frame = look_down(eye_at(8, 22.9, 5 - back), pitch);
                    frame.seconds = 3;
                    ASSERT_TRUE(renderer->render(frame));
                    const auto color = renderer->read_target("color");
                    ASSERT_TRUE(color);
                    for (u32 c = 0; c < 3; ++c)
                        seen[lamp][c] = color->at(16, 16)[c];
                }
                floor_share[deep == 7] = double(seen[1][1]) - double(seen[0][1]);
                ASSERT_GT(floor_share[deep == 7], 1e-3);
            }
            const double more = 4 / std::sin(pitch * 0.017453293);
            // Deeper floors also get less light from above, by the law of medium.glsl; the levels are the same here.
            const auto lit = [&](double d) { return std::exp(-0.7 * double(k.y) * d) / std::sqrt(1 - d / 15); };
            const double expected = std::exp(-double(k.y) * more) * lit(7 - 28.0 / 256) / lit(3 - 28.0 / 256);
            EXPECT_NEAR(floor_share[1] / floor_share[0], expected, 0.03 * expected)
                << pitch << " refraction " << refraction;
        }
    }
}

// The same scene with waves, seen from eyes that turn and step aside: what moves with the camera is no wave.
TEST_F(WaterTest, WavesStandStillWhileTheCameraTurns) {
    Pond pond;
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    ASSERT_TRUE(renderer->load_textures(pond.registry));
    Effects effects = plain_water();
    effects.water.waves = true;
    effects.fog.density = 0;
    ASSERT_TRUE(renderer->set_effects(effects));
    renderer->set_section({0, 0, 0}, {},
                          quads_of(QuadPass::translucent, {{3, sheet(12, pond.water, TintKind::none, kQuadLiquid)}},
                                   {{3, sheet(2, pond.floor, TintKind::none, 0)}}));
    // Brightness at a place of the world, looked up from eyes that differ by a turn alone: the ray is the same.
    const auto look = [&](float yaw, float pitch, Vec3 to, float seconds) {
        const WorldPos eye = eye_at(8.3, 17.1, 1.2);
        auto frame = bench::SampleScene::frame(201, 201, eye, yaw, pitch, 8);
        frame.sky = scene::sky_at(6000);
        frame.seconds = seconds;
        EXPECT_TRUE(renderer->render(frame));
        const auto color = renderer->read_target("color");
        const Vec3 d{to.x - 8.3f, to.y - 17.1f, to.z - 1.2f};
        const Vec4 v = frame.views[0].rotation * Vec4{d.x, d.y, d.z, 1};
        const float t = std::tan(frame.views[0].fov_y / 2);
        const float x = (v.x / -v.z / t * 0.5f + 0.5f) * 201, y = (0.5f - v.y / -v.z / t * 0.5f) * 201;
        EXPECT_TRUE(x > 0 && y > 0 && x < 201 && y < 201) << x << " " << y;
        return color->at(u32(x), u32(y))[2];
    };
    double moved = 0, stood = 0;
    for (int i = 0; i < 24; ++i) {
        const Vec3 to{5 + float(i % 6), 12.89f, 5.5f + float(i / 6)};
        const float first = look(0, 40, to, 3), turned = look(i % 2 ? 9.0f : -9.0f, 46, to, 3),
                    later = look(0, 40, to, 3.7f);
        stood += std::abs(double(first) - double(turned));
        moved += std::abs(double(first) - double(later));
    }
    EXPECT_LT(stood, 0.5 * moved); // a pixel's size apart at most; time moves them
    EXPECT_GT(moved, 0.01);
}

// From below, the world above lies inside Snell's window, 48.6 degrees around straight up.
TEST_F(WaterTest, SnellsWindow) {
    Pond pond;
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    ASSERT_TRUE(renderer->load_textures(pond.registry));
    Effects effects = plain_water();
    ASSERT_TRUE(renderer->set_effects(effects));
    renderer->set_background(true, {4, 0, 0}); // the world above is red
    SectionMesh mesh = quads_of(QuadPass::translucent, {{3, sheet(12, pond.water, TintKind::none, kQuadLiquid)}});
    for (i32 x = -1; x <= 1; ++x)
        for (i32 z = -1; z <= 1; ++z)
            renderer->set_section({x, 0, z}, {}, mesh);
    for (const float from_up : {10.0f, 40.0f, 46.0f, 51.0f, 60.0f}) {
        auto frame = look_down(eye_at(8, 10.5, 8), from_up - 90);
        frame.views[0].underwater = true;
        const auto optics = scene::water_optics({1, 1, 1});
        frame.views[0].medium = {optics.absorption, optics.scattering, {}, 2.39f, 1};
        ASSERT_TRUE(renderer->render(frame));
        const auto color = renderer->read_target("color");
        ASSERT_TRUE(color);
        const float red = color->at(16, 16)[0];
        if (from_up < 47)
            EXPECT_GT(red, 1.0f) << from_up;
        else
            EXPECT_LT(red, 0.5f) << from_up;
    }
}

// Panes multiply the light behind them by their colors, whatever the order of sections and eyes.
TEST_F(WaterTest, NestedPanesMultiply) {
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId red = registry.texture_id("flat_red"), blue = registry.texture_id("flat_blue");
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    ASSERT_TRUE(renderer->load_textures(registry));
    Effects effects = plain_water();
    ASSERT_TRUE(renderer->set_effects(effects));
    // Alpha 128, full red; half-bright blue: glass.glsl's law, and what a pane adds itself.
    const auto see = [&](Vec3 background, std::vector<std::pair<ChunkPos, SectionMesh>> sections, double z, float yaw) {
        renderer->clear_sections();
        renderer->set_background(true, background);
        LightBrick dark;
        dark.uniform = true;
        dark.value = Light(0, 0, 0, 0);
        for (const auto& [at, mesh] : sections) {
            renderer->set_section(at, {}, mesh);
            renderer->set_section_light(at, {}, dark);
        }
        EXPECT_TRUE(renderer->render(bench::SampleScene::frame(33, 33, eye_at(8, 8, z), yaw, 0, 8)));
        const auto color = renderer->read_target("color");
        const float* p = color->at(16, 16);
        return Vec3{p[0], p[1], p[2]};
    };
    const auto pane = [&](u32 z, TextureId t) {
        return std::vector<std::pair<u32, Quad>>{
            {4, Quad::cube({0, 0, i32(z)}, 16, 16, Face::north, 255, t, TintKind::none, 0)},
            {5, Quad::cube({0, 0, i32(z)}, 16, 16, Face::south, 255, t, TintKind::none, 0)}};
    };
    const auto share = [&](std::vector<std::pair<ChunkPos, SectionMesh>> sections, double z, float yaw) {
        const Vec3 bright = see({2, 2, 2}, sections, z, yaw), dark = see({0, 0, 0}, sections, z, yaw);
        return (bright - dark) * 0.5f;
    };
    const SectionMesh a = quads_of(QuadPass::translucent, pane(6, red)),
                      b = quads_of(QuadPass::translucent, pane(9, blue));
    for (const auto& [z, yaw] : {std::pair<double, float>{-20, 0}, {60, 180}}) {
        const Vec3 one = share({{{0, 0, 0}, a}}, z, yaw), other = share({{{0, 0, 1}, b}}, z, yaw);
        const Vec3 both = share({{{0, 0, 0}, a}, {{0, 0, 1}, b}}, z, yaw);
        // Two faces of a pane, each: (1 - opacity squared) and its hue, 1.6 times as strong as it is opaque; Fresnel 4
        // percent * 0.7.
        const float opacity = 128.0f / 255,
                    whole = (1 - opacity * opacity) * (1 - 0.04f * 0.7f * (1 - opacity * opacity));
        const float off = 1 - 1.6f * opacity;
        EXPECT_NEAR(one.x, whole * whole, 0.01f);
        EXPECT_NEAR(one.z, whole * whole * off * off, 0.01f);
        EXPECT_NEAR(other.z, whole * whole, 0.01f);
        EXPECT_NEAR(both.x, one.x * other.x, 0.01f);
        EXPECT_NEAR(both.y, one.y * other.y, 0.01f);
        EXPECT_NEAR(both.z, one.z * other.z, 0.01f);
    }
}

} // namespace vitrail::render
