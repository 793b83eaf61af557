#include "render/passes/ssr/reflections_pass.h"

#include "render/passes/screen_pass.h"

#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

std::vector<std::string> march_defines(const Effects& effects) {
    return {fmt::format("MARCH_STEPS {}", effects.reflections.steps)};
}

Result<> ReflectionsPass::build(const BuildContext& context) {
    if (!context.effects.reflections.on) return {};
    VX_TRY_ASSIGN(program_, context.shaders.program("common/screen.vert.glsl", "ssr/reflections.frag.glsl",
                                                    march_defines(context.effects)));
    return {};
}

void ReflectionsPass::declare(DeclareContext& c) {
    if (!c.effects.reflections.on) return;
    c.graph.add_pass({"reflections",
                      {"albedo", "light", "surface", "scene"},
                      {c.color},
                      [this, roughest = c.effects.reflections.roughness,
                       moves = c.effects.antialias == i32(Antialias::taa)](const gfx::PassContext& p) {
                          glTextureBarrier(); // depth is sampled while it is attached
                          glProgramUniform1f(program_->name(), 0, roughest);
                          glProgramUniform1ui(program_->name(), 1, moves ? u32(frame_->number % 64) : 0);
                          draw_screen(*program_, frame_->plain_array, ScreenArea::surfaces,
                                      {p.graph.target("albedo").name(), p.graph.target("light").name(),
                                       p.graph.target("surface").name(), p.graph.target("depth").name(),
                                       p.graph.target("scene").name()},
                                      ScreenBlend::over);
                      },
                      "depth"});
}

} // namespace vitrail::render
