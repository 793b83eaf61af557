#include "render/passes/ssao/ssao_pass.h"

#include "render/passes/screen_pass.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

Result<> SsaoPass::build(const BuildContext& context) {
    if (!context.effects.ssao.on) return {};
    // Looks of a pixel: slices, two sides each, steps a side.
    const i32 samples = context.effects.ssao.samples, slices = samples < 8 ? 1 : samples < 24 ? 2 : 4;
    const i32 steps = std::max(samples / (2 * slices), 1);
    VX_TRY_ASSIGN(program_,
                  context.shaders.program("common/screen.vert.glsl", "ssao/ssao.frag.glsl",
                                          {fmt::format("SLICES {}", slices), fmt::format("STEPS {}", steps)}));
    VX_TRY_ASSIGN(blur_, context.shaders.program("common/screen.vert.glsl", "ssao/ssao_blur.frag.glsl"));
    return {};
}

void SsaoPass::declare(DeclareContext& c) {
    if (!c.effects.ssao.on) return;
    c.graph.add_target({.name = "ao", .format = GL_R8});
    c.graph.add_target({.name = "ao across", .format = GL_R8});
    const Effects::Ssao settings = c.effects.ssao;
    const bool moves = c.effects.antialias == i32(Antialias::taa);
    c.graph.add_pass({"ssao",
                      {"surface"},
                      {"ao"},
                      [this, settings, moves](const gfx::PassContext& p) {
                          glTextureBarrier(); // depth is sampled while it is attached
                          glProgramUniform2f(program_->name(), 0, settings.radius, settings.strength);
                          glProgramUniform1ui(program_->name(), 1, moves ? u32(frame_->number % 64) : 0);
                          draw_screen(*program_, frame_->plain_array, ScreenArea::surfaces,
                                      {0, 0, p.graph.target("surface").name(), p.graph.target("depth").name()});
                      },
                      "depth"});
    const auto blur = [&](const char* name, const std::string& from, const char* to, i32 x, i32 y) {
        c.graph.add_pass({name,
                          {from, "surface"},
                          {to},
                          [this, settings, from, x, y](const gfx::PassContext& p) {
                              glProgramUniform2f(blur_->name(), 0, settings.radius, 0);
                              glProgramUniform2i(blur_->name(), 1, x, y);
                              draw_screen(*blur_, frame_->plain_array, ScreenArea::surfaces,
                                          {p.graph.target(from).name(), 0, p.graph.target("surface").name(),
                                           p.graph.target("depth").name()});
                          },
                          "depth"});
    };
    blur("ssao blur x", "ao", "ao across", 1, 0);
    blur("ssao blur y", "ao across", "ao", 0, 1);
}

} // namespace vitrail::render
