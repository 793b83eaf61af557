#include "render/passes/scene_copy/scene_copy_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<> SceneCopyPass::build(const BuildContext& context) {
    if (!wanted(context.effects)) return {};
    VX_TRY_ASSIGN(program_, ScreenProgram::build(
                                context, {.path = "scene_copy/scene_copy.screen.glsl", .formats = {GL_RGBA16F}}));
    return {};
}

void SceneCopyPass::declare(DeclareContext& c) {
    if (!wanted(c.effects)) return;
    const bool mips = c.effects.reflections.on;
    c.graph.add_target({.name = "scene", .format = GL_RGBA16F, .linear = true, .mips = mips});
    c.graph.add_pass({"scene copy",
                      {c.color, "surface", "depth"},
                      {"scene"},
                      [this, color = c.color, mips](const gfx::PassContext& p) {
                          program_.run(p, frame_->plain_array, {"scene"}, {color, "", "surface", "depth"});
                          if (mips) glGenerateTextureMipmap(p.graph.target("scene").name());
                      },
                      ""});
}

} // namespace vitrail::render
