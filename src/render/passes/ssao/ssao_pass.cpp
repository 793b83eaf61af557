#include "render/passes/ssao/ssao_pass.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

// Compute, not a triangle over the screen: large GPUs for data centers have few units that shade fragments.
static void dispatch(const gfx::Program& program, u32 ao, u32 surface, u32 depth, const gfx::Texture& into) {
    glUseProgram(program.name());
    const u32 textures[4] = {ao, 0, surface, depth};
    glBindTextures(0, 4, textures);
    glBindImageTexture(0, into.name(), 0, GL_FALSE, 0, GL_WRITE_ONLY, into.format);
    glDispatchCompute((into.width + 7) / 8, (into.height + 7) / 8, 1);
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT);
}

Result<> SsaoPass::build(const BuildContext& context) {
    if (!context.effects.ssao.on) return {};
    // Looks of a pixel: slices, two sides each, steps a side.
    const i32 samples = context.effects.ssao.samples, slices = samples < 8 ? 1 : samples < 24 ? 2 : 4;
    const i32 steps = std::max(samples / (2 * slices), 1);
    VX_TRY_ASSIGN(program_, context.shaders.compute_program("ssao/ssao.comp.glsl", {fmt::format("SLICES {}", slices),
                                                                                    fmt::format("STEPS {}", steps)}));
    VX_TRY_ASSIGN(blur_, context.shaders.compute_program("ssao/ssao_blur.comp.glsl"));
    return {};
}

void SsaoPass::declare(DeclareContext& c) {
    if (!c.effects.ssao.on) return;
    c.graph.add_target({.name = "ao", .format = GL_R8});
    c.graph.add_target({.name = "ao across", .format = GL_R8});
    const Effects::Ssao settings = c.effects.ssao;
    const bool moves = c.effects.antialias == i32(Antialias::taa);
    c.graph.add_pass({"ssao",
                      {"surface", "depth"},
                      {"ao"},
                      [this, settings, moves](const gfx::PassContext& p) {
                          glProgramUniform2f(program_->name(), 0, settings.radius, settings.strength);
                          glProgramUniform1ui(program_->name(), 1, moves ? u32(frame_->number % 64) : 0);
                          dispatch(*program_, 0, p.graph.target("surface").name(), p.graph.target("depth").name(),
                                   p.graph.target("ao"));
                      },
                      ""});
    const auto blur = [&](const char* name, const std::string& from, const std::string& to, i32 x, i32 y) {
        c.graph.add_pass({name,
                          {from, "surface", "depth"},
                          {to},
                          [this, settings, from, to, x, y](const gfx::PassContext& p) {
                              glProgramUniform2f(blur_->name(), 0, settings.radius, 0);
                              glProgramUniform2i(blur_->name(), 1, x, y);
                              dispatch(*blur_, p.graph.target(from).name(), p.graph.target("surface").name(),
                                       p.graph.target("depth").name(), p.graph.target(to));
                          },
                          ""});
    };
    blur("ssao blur x", "ao", "ao across", 1, 0);
    blur("ssao blur y", "ao across", "ao", 0, 1);
}

} // namespace vitrail::render
