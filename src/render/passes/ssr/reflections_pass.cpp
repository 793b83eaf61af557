#include "render/passes/ssr/reflections_pass.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

std::vector<std::string> march_defines(const Effects& effects) {
    return {fmt::format("MARCH_STEPS {}", effects.reflections.steps)};
}

Result<> ReflectionsPass::build(const BuildContext& context) {
    if (!context.effects.reflections.on) return {};
    VX_TRY_ASSIGN(program_,
                  context.shaders.compute_program("ssr/reflections.comp.glsl", march_defines(context.effects)));
    return {};
}

void ReflectionsPass::declare(DeclareContext& c) {
    if (!c.effects.reflections.on) return;
    c.graph.add_pass({"reflections",
                      {"albedo", "light", "surface", "depth", "scene"},
                      {c.color},
                      [this, color = c.color, roughest = c.effects.reflections.roughness,
                       moves = c.effects.antialias == i32(Antialias::taa)](const gfx::PassContext& p) {
                          glProgramUniform1f(program_->name(), 0, roughest);
                          glProgramUniform1ui(program_->name(), 1, moves ? u32(frame_->number % 64) : 0);
                          u32 textures[5] = {};
                          u32 n = 0;
                          for (const char* name : {"albedo", "light", "surface", "depth", "scene"})
                              textures[n++] = p.graph.target(name).name();
                          glBindTextures(0, 5, textures);
                          const gfx::Texture& picture = p.graph.target(color);
                          glMemoryBarrier(GL_SHADER_IMAGE_ACCESS_BARRIER_BIT);
                          glBindImageTexture(0, picture.name(), 0, GL_FALSE, 0, GL_READ_WRITE, picture.format);
                          glUseProgram(program_->name());
                          // Compute, not a triangle over the screen, as ambient occlusion.
                          glDispatchCompute((picture.width + 7) / 8, (picture.height + 7) / 8, 1);
                          glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_FRAMEBUFFER_BARRIER_BIT);
                      },
                      ""});
}

} // namespace vitrail::render
