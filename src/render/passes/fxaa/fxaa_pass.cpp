#include "render/passes/fxaa/fxaa_pass.h"

#include "render/passes/screen_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<> FxaaPass::build(const BuildContext& context) {
    if (Antialias(context.effects.antialias) != Antialias::fxaa) return {};
    VX_TRY_ASSIGN(program_, context.shaders.program("common/screen.vert.glsl", "fxaa/fxaa.frag.glsl"));
    return {};
}

void FxaaPass::declare(DeclareContext& c) {
    if (Antialias(c.effects.antialias) != Antialias::fxaa) return;
    const std::string picture = std::exchange(c.display, c.scaled ? "smoothed" : "screen");
    if (c.scaled) c.graph.add_target({.name = "smoothed", .format = GL_RGBA8, .linear = true});
    c.graph.add_pass({"fxaa",
                      {picture},
                      {c.display},
                      [this, picture](const gfx::PassContext& p) {
                          if (p.graph.framebuffer("fxaa") == 0)
                              glBindFramebuffer(GL_FRAMEBUFFER, frame_->target_framebuffer);
                          draw_screen(*program_, frame_->plain_array, ScreenArea::all,
                                      {p.graph.target(picture).name()});
                      },
                      ""});
}

} // namespace vitrail::render
