#include "render/passes/tonemap/tonemap_pass.h"

#include <cmath>
#include <epoxy/gl.h>

namespace vitrail::render {

Result<> TonemapPass::build(const BuildContext& context) {
    std::vector<std::string> defines;
    if (context.effects.dither) defines.push_back("DITHER");
    if (context.effects.exposure.automatic) defines.push_back("AUTO");
    if (context.effects.bloom.on) defines.push_back("BLOOM");
    compute_ = context.compute;
    VX_TRY_ASSIGN(program_, ScreenProgram::build(context, {.path = "tonemap/tonemap.screen.glsl",
                                                           .defines = std::move(defines),
                                                           .formats = {GL_RGBA8}}));
    return {};
}

void TonemapPass::declare(DeclareContext& c) {
    if (c.scaled || Antialias(c.effects.antialias) == Antialias::fxaa) {
        c.graph.add_target({.name = "display", .format = GL_RGBA8, .linear = true});
        c.display = "display"; // fxaa or upscale bring it to the screen
    }
    // Threads cannot write into a window: there the picture is carried over. Into a texture they write themselves.
    const bool carried = compute_ && c.display == "screen";
    const std::string into = carried ? "toned" : c.display;
    if (carried) c.graph.add_target({.name = "toned", .format = GL_RGBA8});
    std::vector<std::string> reads{c.color};
    if (c.effects.exposure.automatic) reads.push_back("exposure");
    if (c.effects.bloom.on) reads.push_back("bloom1");
    c.graph.add_pass({"tonemap",
                      reads,
                      {into},
                      [this, color = c.color, into](const gfx::PassContext& p) { draw(p, color, into); },
                      ""});
    if (!carried) return;
    c.graph.add_pass({"tonemap to screen",
                      {"toned"},
                      {"screen"},
                      [this](const gfx::PassContext& p) {
                          const GLint w = GLint(p.width), h = GLint(p.height);
                          if (!frame_->target_texture)
                              glBlitNamedFramebuffer(p.graph.framebuffer("tonemap"), frame_->target_framebuffer, 0, 0,
                                                     w, h, 0, 0, w, h, GL_COLOR_BUFFER_BIT, GL_NEAREST);
                          glBindFramebuffer(GL_FRAMEBUFFER, frame_->target_framebuffer);
                      },
                      ""});
}

void TonemapPass::draw(const gfx::PassContext& p, const std::string& color, const std::string& into) {
    if (p.graph.framebuffer("tonemap") == 0) glBindFramebuffer(GL_FRAMEBUFFER, frame_->target_framebuffer);
    const Effects& effects = *frame_->effects;
    const float exposure = frame_->frame->gamma_exposure * std::exp2(effects.exposure.bias);
    glProgramUniform2f(program_.name(), 0, exposure, effects.bloom.strength);
    if (effects.exposure.automatic) glBindTextureUnit(u32(Unit::exposure), p.graph.target("exposure").name());
    const std::string bloom = effects.bloom.on ? "bloom1" : "";
    if (compute_ && into == "toned" && frame_->target_texture)
        program_.run_into(p, *frame_->target_texture, {color, bloom});
    else
        program_.run(p, frame_->plain_array, {into}, {color, bloom});
}

} // namespace vitrail::render
