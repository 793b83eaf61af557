#include "render/passes/water/water_pass.h"

#include "render/passes/shadow/shadow_pass.h"
#include "render/passes/terrain/terrain_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<> WaterPass::build(const BuildContext& context) {
    std::vector<std::string> defines = terrain_defines(context.effects);
    defines.insert(defines.end(), {"MODEL 2", "LIQUID"});
    const auto shadows = shadow_defines(context.effects);
    defines.insert(defines.end(), shadows.begin(), shadows.end());
    if (context.effects.water.waves) defines.push_back("WAVES");
    if (context.effects.water.refraction) defines.push_back("SEES_DEPTH");
    VX_TRY_ASSIGN(program_, context.shaders.program("terrain/terrain.vert.glsl", "water/water.frag.glsl", defines));
    return {};
}

void WaterPass::declare(DeclareContext& c) {
    c.graph.add_pass({"translucent",
                      {},
                      {c.color},
                      [this](const gfx::PassContext& p) {
                          glTextureBarrier(); // depth is sampled while it is attached
                          glEnable(GL_BLEND);
                          glBlendFunc(GL_ONE, GL_SRC1_COLOR);
                          glEnable(GL_DEPTH_TEST);
                          glDepthFunc(GL_GREATER);
                          glDepthMask(GL_FALSE);
                          for_each_view(*frame_, [&](u32, const ViewDraws& draws) {
                              bind_terrain(draws.inputs);
                              glBindTextureUnit(u32(Unit::depth), p.graph.target("depth").name());
                              draw_kind(*program_, draws.inputs, DrawKind::translucent, false);
                          });
                          // Mesa refuses several targets while two sources are set, even with blending off.
                          glBlendFunc(GL_ONE, GL_ZERO);
                      },
                      "depth"});
}

} // namespace vitrail::render
