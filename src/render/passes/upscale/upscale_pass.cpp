#include "render/passes/upscale/upscale_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<> UpscalePass::build(const BuildContext& context) {
    compute_ = context.compute;
    std::vector<std::string> defines;
    if (context.context.software) defines.push_back("QUICK");
    VX_TRY_ASSIGN(program_, ScreenProgram::build(context, {.path = "upscale/upscale.screen.glsl",
                                                           .defines = std::move(defines),
                                                           .formats = {GL_RGBA8}}));
    return {};
}

void UpscalePass::declare(DeclareContext& c) {
    if (!c.scaled) return;
    // Threads cannot write into a window.
    const std::string picture = std::exchange(c.display, "screen"), into = compute_ ? "enlarged" : "screen";
    if (compute_) c.graph.add_target({.name = "enlarged", .format = GL_RGBA8, .screen = true});
    c.graph.add_pass({"upscale",
                      {picture},
                      {into},
                      [this, picture, into](const gfx::PassContext& p) {
                          if (!compute_) glBindFramebuffer(GL_FRAMEBUFFER, frame_->target_framebuffer);
                          const float w = float(p.graph.target(picture).width),
                                      h = float(p.graph.target(picture).height);
                          glProgramUniform4f(program_.name(), 0, w, h, 1 / w, 1 / h);
                          program_.run(p, frame_->plain_array, {into}, {picture});
                      },
                      ""});
    if (!compute_) return;
    c.graph.add_pass({"upscale to screen",
                      {into},
                      {"screen"},
                      [this](const gfx::PassContext& p) {
                          const GLint w = GLint(p.width), h = GLint(p.height);
                          glBlitNamedFramebuffer(p.graph.framebuffer("upscale"), frame_->target_framebuffer, 0, 0, w, h,
                                                 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
                          glBindFramebuffer(GL_FRAMEBUFFER, frame_->target_framebuffer);
                      },
                      ""});
}

} // namespace vitrail::render
