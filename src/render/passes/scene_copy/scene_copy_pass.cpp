#include "render/passes/scene_copy/scene_copy_pass.h"

#include "render/passes/screen_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<> SceneCopyPass::build(const BuildContext& context) {
    if (!wanted(context.effects)) return {};
    VX_TRY_ASSIGN(program_, context.shaders.program("common/screen.vert.glsl", "scene_copy/scene_copy.frag.glsl"));
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
                          draw_screen(*program_, frame_->plain_array, ScreenArea::all,
                                      {p.graph.target(color).name(), 0, p.graph.target("surface").name(),
                                       p.graph.target("depth").name()});
                          if (mips) glGenerateTextureMipmap(p.graph.target("scene").name());
                      },
                      ""});
}

} // namespace vitrail::render
