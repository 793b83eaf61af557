#include "render/passes/sky/sky_pass.h"

#include "render/passes/screen_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

Result<> SkyPass::build(const BuildContext& context) {
    VX_TRY_ASSIGN(day_, context.shaders.program("common/screen.vert.glsl", "sky/sky.frag.glsl"));
    VX_TRY_ASSIGN(night_, context.shaders.program("common/screen.vert.glsl", "sky/sky.frag.glsl", {"NIGHT"}));
    return {};
}

void SkyPass::declare(DeclareContext& c) {
    c.graph.add_pass({"sky",
                      {},
                      {"color"},
                      [this](const gfx::PassContext&) {
                          const scene::SkyState& sky = frame_->frame->sky;
                          const bool night = sky.stars > 0 || sky.moon_direction.y > -0.15f;
                          glBindTextureUnit(u32(Unit::noise), frame_->noise);
                          draw_screen(night ? *night_ : *day_, frame_->plain_array, ScreenArea::background, {});
                      },
                      "depth"});
}

} // namespace vitrail::render
