#include "render/passes/exposure/exposure_pass.h"

#include "render/passes/screen_pass.h"

#include <cmath>
#include <epoxy/gl.h>

namespace vitrail::render {

Result<> ExposurePass::build(const BuildContext& context) {
    if (!context.effects.exposure.automatic) return {};
    VX_TRY_ASSIGN(measure_, context.shaders.program("common/screen.vert.glsl", "exposure/measure.frag.glsl"));
    VX_TRY_ASSIGN(adapt_, context.shaders.program("common/screen.vert.glsl", "exposure/adapt.frag.glsl"));
    return {};
}

void ExposurePass::declare(DeclareContext& c) {
    if (!c.effects.exposure.automatic) return;
    c.graph.add_target({.name = "luminance", .format = GL_R16F, .width = 16, .height = 9});
    c.graph.add_target({.name = "exposure", .format = GL_RG32F, .width = 1, .height = 1, .history = true});
    c.graph.add_pass({"exposure measure",
                      {c.color},
                      {"luminance"},
                      [this, color = c.color](const gfx::PassContext& p) {
                          draw_screen(*measure_, frame_->plain_array, ScreenArea::all, {p.graph.target(color).name()});
                      },
                      ""});
    c.graph.add_pass({"exposure",
                      {"luminance", "exposure@before"},
                      {"exposure"},
                      [this](const gfx::PassContext& p) {
                          const float way = -frame_->seconds_since * frame_->effects->exposure.speed;
                          const bool first = !frame_->continues || !p.graph.has_history("exposure");
                          const ExposureCurve& curve = kExposureCurve;
                          glProgramUniform4f(adapt_->name(), 0, 1 - std::exp(way * kFasterToBright), 1 - std::exp(way),
                                             first ? 1.0f : 0.0f, 0);
                          glProgramUniform4f(adapt_->name(), 1, curve.reference_log2, curve.slope, curve.least,
                                             curve.most);
                          draw_screen(*adapt_, frame_->plain_array, ScreenArea::all,
                                      {p.graph.target("luminance").name(), p.graph.target("exposure@before").name()});
                      },
                      ""});
}

} // namespace vitrail::render
