#include "render/passes/lighting/lighting_pass.h"

#include "render/passes/shadow/shadow_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<> LightingPass::build(const BuildContext& context) {
    std::vector<std::string> defines = shadow_defines(context.effects);
    if (context.effects.ssao.on) defines.push_back("SSAO");
    if (context.effects.water.caustics) defines.push_back("CAUSTICS");
    const bool quads = context.effects.shadows.samples > 1 && context.effects.antialias != i32(Antialias::taa);
    if (quads) defines.push_back("SHADOW_QUADS");
    ScreenShader shader{.path = "lighting/lighting.screen.glsl",
                        .defines = std::move(defines),
                        .formats = {GL_RGBA16F},
                        .area = ScreenArea::surfaces,
                        .derivatives = quads};
    VX_TRY_ASSIGN(any_, ScreenProgram::build(context, shader));
    shader.defines.insert(shader.defines.end(), {"ONE_VIEW", "DRY"});
    VX_TRY_ASSIGN(plain_, ScreenProgram::build(context, std::move(shader)));
    return {};
}

void LightingPass::declare(DeclareContext& c) {
    std::vector<std::string> reads{"albedo", "light", "surface"};
    const bool ssao = c.effects.ssao.on;
    if (ssao) reads.push_back("ao");
    c.graph.add_target({.name = "color", .format = GL_RGBA16F, .linear = true});
    c.graph.add_pass(
        {"lighting",
         reads,
         {"color"},
         [this, ssao](const gfx::PassContext& p) {
             if (ssao) glBindTextureUnit(u32(Unit::ao), p.graph.target("ao").name());
             // Depth is sampled while it is attached: allowed, since nothing writes it between barriers.
             glTextureBarrier();
             const auto& views = frame_->frame->views;
             const bool plain = views.size() == 1 && !views[0].underwater;
             (plain ? plain_ : any_).run(p, frame_->plain_array, {"color"}, {"albedo", "light", "surface", "depth"});
         },
         "depth"});
}

} // namespace vitrail::render
