// Mist: its integral against numbers, the shader against C++, the sky against the land before it, the march against the
// formula.
#include "gfx/program.h"
#include "pass_rig.h"
#include "render/passes/fog/fog_pass.h"
#include "render/passes/screen_pass.h"
#include "scene/mist.h"
#include "scene/sky.h"

namespace vitrail::render {

using scene::Mist;

// The extinction summed step by step.
static double numeric_depth(const Mist& mist, double above, double rise, double away) {
    constexpr int n = 20000;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double y = above + rise * away * (i + 0.5) / n;
        sum += double(mist.haze) + double(mist.mist) * std::exp(-std::max(y, 0.0) / double(mist.height));
    }
    return sum * away / n;
}

TEST(Mist, DepthIsTheIntegralOfItsDensity) {
    const Mist mist{0.001f, 0.02f, 10};
    for (float above : {-40.0f, -3.0f, 0.0f, 2.0f, 15.0f, 80.0f})
        for (float rise : {-1.0f, -0.4f, -0.02f, -1e-5f, 0.0f, 1e-4f, 0.003f, 0.3f, 1.0f})
            for (float away : {0.5f, 7.0f, 60.0f, 300.0f}) {
                const double wanted = numeric_depth(mist, double(above), double(rise), double(away));
                EXPECT_NEAR(double(scene::mist_depth(mist, above, rise, away)), wanted, 2e-5 + 0.004 * wanted)
                    << above << " " << rise << " " << away;
            }
}

TEST(Mist, MostAtDawnAndSmooth) {
    const auto at = [](float time) { return scene::mist_at(scene::sky_at(time)); };
    EXPECT_GT(at(100).mist, 3 * at(6000).mist);
    EXPECT_GT(at(12300).mist, 2 * at(6000).mist);
    EXPECT_GT(at(100).mist, at(12300).mist);
    for (float t = 0; t < 24000; t += 20) {
        EXPECT_LT(std::abs(at(t).mist - at(t + 20).mist), 0.001f) << t;
        EXPECT_GT(at(t).haze, 0);
    }
}

using FogTest = RenderTest;

// The shader's integral for many rays, written to a picture.
TEST_F(FogTest, ShaderAndTracerHaveTheSameMist) {
    ShaderLibrary shaders;
    const auto frame_text = shaders.text("common/frame.glsl"), mist_text = shaders.text("common/mist.glsl"),
               screen = shaders.text("common/screen.vert.glsl");
    ASSERT_TRUE(frame_text && mist_text && screen);
    const auto program = gfx::build_program(
        {"mist",
         *screen,
         *frame_text + *mist_text +
             "layout(location = 0) out vec4 o;\n"
             "void main() {\n"
             "  float rise = (floor(gl_FragCoord.x) - 16.0) / 16.0, away = exp2(floor(gl_FragCoord.y) * 0.3);\n"
             "  o = vec4(mist_depth(away, rise * abs(rise), 0u));\n"
             "}\n",
         "",
         {}});
    ASSERT_TRUE(program) << program.error().message;
    const gfx::Texture out = gfx::make_texture_2d(GL_R32F, 33, 32);
    const gfx::Texture* attached[] = {&out};
    const auto framebuffer = gfx::make_framebuffer(attached, nullptr);
    const auto array = gfx::make_vertex_array();
    for (float above : {-20.0f, 0.5f, 12.0f, 60.0f}) {
        const Mist mist{0.0011f, 0.017f, 10};
        const Vec4 u[9] = {{mist.haze, mist.mist, 1 / mist.height, 1}, {above, scene::mist_column(mist, above), 1, 0}};
        const auto buffer = gfx::make_buffer(sizeof u, 0, u);
        glBindBufferBase(GL_UNIFORM_BUFFER, 2, buffer.name());
        const auto frame_buffer = gfx::make_buffer(sizeof(FrameUniforms), 0);
        glBindBufferBase(GL_UNIFORM_BUFFER, 0, frame_buffer.name());
        glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
        glViewport(0, 0, 33, 32);
        draw_screen(*program, array.name(), ScreenArea::all, {});
        std::vector<float> values(33 * 32);
        glGetTextureImage(out.name(), 0, GL_RED, GL_FLOAT, GLsizei(values.size() * 4), values.data());
        for (u32 y = 0; y < 32; ++y)
            for (u32 x = 0; x < 33; ++x) {
                const float r = (float(x) - 16) / 16;
                const float wanted = scene::mist_depth(mist, above, r * std::abs(r), std::exp2(float(y) * 0.3f));
                ASSERT_NEAR(values[y * 33 + x], wanted, 1e-5f + 0.003f * wanted) << above << " " << x << " " << y;
            }
    }
}

// Land at the edge of view and the sky beside it have one color, whatever the hour, the height and the direction.
TEST_F(FogTest, NoSeamBetweenLandAndSky) {
    auto renderer = make_renderer();
    ASSERT_TRUE(renderer);
    BlockRegistry registry;
    registry.content_roots = {test_content()};
    const TextureId white = registry.texture_id("white");
    ASSERT_TRUE(renderer->load_textures(registry));
    Effects effects = renderer->effects();
    effects.sky.clouds = i32(Clouds::off);
    effects.sky.stars = false;
    ASSERT_TRUE(renderer->set_effects(effects));
    SectionMesh mesh;
    for (u32 g = 0; g < SectionMesh::kGroups; ++g) {
        mesh.first[g] = u32(mesh.quads.size());
        if (g == SectionMesh::group(QuadPass::opaque, 4))
            mesh.quads.push_back(Quad::cube({0, 0, 8}, 16, 16, Face::north, 255, white, TintKind::none, 0));
    }
    mesh.first[SectionMesh::kGroups] = u32(mesh.quads.size());
    mesh.connections = (u64(1) << 36) - 1;
    for (i32 base : {64, 96}) {
        renderer->clear_sections();
        renderer->set_section({0, base / 16, 7}, {}, mesh); // a wall 120 blocks to the south
        for (float time : {0.0f, 1000.0f, 6000.0f, 12300.0f, 18000.0f}) {
            auto frame = bench::SampleScene::frame(64, 64, eye_at(8, base + 8, 0), 0, 0, 8);
            frame.view_distance = 118;
            frame.sky = scene::sky_at(time);
            frame.views[0].fov_y = 0.3f;
            (void)draw(*renderer, frame);
            const auto color = renderer->read_target("color"), depth = renderer->read_target("depth");
            ASSERT_TRUE(color && depth);
            // Along the row at the height of the eye, the wall's rim: it stands in the middle, sky on both sides.
            u32 rims = 0;
            for (u32 x = 1; x < 64; ++x) {
                const bool a = depth->at(x - 1, 32)[0] > 0, b = depth->at(x, 32)[0] > 0;
                if (a == b) continue;
                ++rims;
                for (u32 k = 0; k < 3; ++k)
                    EXPECT_NEAR(color->at(x - 1, 32)[k], color->at(x, 32)[k], 0.004f + 0.012f * color->at(x, 32)[k])
                        << time << " " << base;
            }
            EXPECT_EQ(rims, 2u);
        }
    }
}

} // namespace vitrail::render
