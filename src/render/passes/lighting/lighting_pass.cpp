#include "render/passes/lighting/lighting_pass.h"

#include "render/passes/screen_pass.h"
#include "render/passes/shadow/shadow_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<> LightingPass::build(const BuildContext& context) {
    std::vector<std::string> defines = shadow_defines(context.effects);
    if (context.effects.ssao.on) defines.push_back("SSAO");
    if (context.effects.shadows.samples > 1 && context.effects.antialias != i32(Antialias::taa))
        defines.push_back("SHADOW_QUADS");
    if (context.effects.water.caustics) defines.push_back("CAUSTICS");
    VX_TRY_ASSIGN(program_, context.shaders.program("common/screen.vert.glsl", "lighting/lighting.frag.glsl", defines));
    return {};
}

void LightingPass::declare(DeclareContext& c) {
    std::vector<std::string> reads{"albedo", "light", "surface"};
    const bool ssao = c.effects.ssao.on;
    if (ssao) reads.push_back("ao");
    c.graph.add_target({.name = "color", .format = GL_RGBA16F, .linear = true});
    c.graph.add_pass({"lighting",
                      reads,
                      {"color"},
                      [this, ssao](const gfx::PassContext& p) {
                          if (ssao) glBindTextureUnit(u32(Unit::ao), p.graph.target("ao").name());
                          // Depth is sampled while it is attached: allowed, since nothing writes it between barriers.
                          glTextureBarrier();
                          draw_screen(*program_, frame_->plain_array, ScreenArea::surfaces,
                                      {p.graph.target("albedo").name(), p.graph.target("light").name(),
                                       p.graph.target("surface").name(), p.graph.target("depth").name()});
                      },
                      "depth"});
}

} // namespace vitrail::render
