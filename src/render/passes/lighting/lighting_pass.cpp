#include "render/passes/lighting/lighting_pass.h"

#include "render/passes/screen_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<> LightingPass::build(const BuildContext& context) {
    VX_TRY_ASSIGN(program_, context.shaders.program("common/screen.vert.glsl", "lighting/lighting.frag.glsl"));
    return {};
}

void LightingPass::declare(DeclareContext& c) {
    std::vector<std::string> reads{"albedo", "light", "surface"};
    c.graph.add_target({.name = "color", .format = GL_RGBA16F, .linear = true});
    c.graph.add_pass({"lighting",
                      reads,
                      {"color"},
                      [this](const gfx::PassContext& p) {
                          // Depth is sampled while it is attached: allowed, since nothing writes it between barriers.
                          glTextureBarrier();
                          draw_screen(*program_, frame_->plain_array, ScreenArea::surfaces,
                                      {p.graph.target("albedo").name(), p.graph.target("light").name(),
                                       p.graph.target("surface").name(), p.graph.target("depth").name()});
                      },
                      "depth"});
}

} // namespace vitrail::render
