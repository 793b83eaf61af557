#include "render/passes/tonemap/tonemap_pass.h"

#include "render/passes/screen_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<> TonemapPass::build(const BuildContext& context) {
    std::vector<std::string> defines;
    if (context.effects.dither) defines.push_back("DITHER");
    VX_TRY_ASSIGN(program_, context.shaders.program("common/screen.vert.glsl", "tonemap/tonemap.frag.glsl", defines));
    return {};
}

void TonemapPass::declare(DeclareContext& c) {
    c.graph.add_pass({"tonemap",
                      {c.color},
                      {c.display},
                      [this, color = c.color, screen = c.display == "screen"](const gfx::PassContext& p) {
                          if (screen) glBindFramebuffer(GL_FRAMEBUFFER, frame_->target_framebuffer);
                          draw_screen(*program_, frame_->plain_array, ScreenArea::all, {p.graph.target(color).name()});
                      },
                      ""});
}

} // namespace vitrail::render
