#include "render/passes/tonemap/tonemap_pass.h"

#include "render/passes/screen_pass.h"

#include <cmath>
#include <epoxy/gl.h>

namespace vitrail::render {

Result<> TonemapPass::build(const BuildContext& context) {
    std::vector<std::string> defines;
    if (context.effects.dither) defines.push_back("DITHER");
    if (context.effects.exposure.automatic) defines.push_back("AUTO");
    if (context.effects.bloom.on) defines.push_back("BLOOM");
    VX_TRY_ASSIGN(program_, context.shaders.program("common/screen.vert.glsl", "tonemap/tonemap.frag.glsl", defines));
    return {};
}

void TonemapPass::declare(DeclareContext& c) {
    if (Antialias(c.effects.antialias) == Antialias::fxaa) {
        c.graph.add_target({.name = "display", .format = GL_RGBA8, .linear = true});
        c.display = "display"; // fxaa brings it to the screen
    }
    std::vector<std::string> reads{c.color};
    if (c.effects.exposure.automatic) reads.push_back("exposure");
    if (c.effects.bloom.on) reads.push_back("bloom1");
    c.graph.add_pass(
        {"tonemap", reads, {c.display}, [this, color = c.color](const gfx::PassContext& p) { draw(p, color); }, ""});
}

void TonemapPass::draw(const gfx::PassContext& p, const std::string& color) {
    if (p.graph.framebuffer("tonemap") == 0) glBindFramebuffer(GL_FRAMEBUFFER, frame_->target_framebuffer);
    const Effects& effects = *frame_->effects;
    const float exposure = frame_->frame->gamma_exposure * std::exp2(effects.exposure.bias);
    glProgramUniform2f(program_->name(), 0, exposure, effects.bloom.strength);
    if (effects.exposure.automatic) glBindTextureUnit(u32(Unit::exposure), p.graph.target("exposure").name());
    if (effects.bloom.on)
        draw_screen(*program_, frame_->plain_array, ScreenArea::all,
                    {p.graph.target(color).name(), p.graph.target("bloom1").name()});
    else
        draw_screen(*program_, frame_->plain_array, ScreenArea::all, {p.graph.target(color).name()});
}

} // namespace vitrail::render
