#include "render/passes/taa/taa_pass.h"

#include <epoxy/gl.h>

namespace vitrail::render {

static float halton(u32 index, u32 base) {
    float sum = 0, part = 1;
    for (; index > 0; index /= base) {
        part /= float(base);
        sum += part * float(index % base);
    }
    return sum;
}

Vec2 TaaPass::shift(u32 step) {
    const u32 index = step % kShifts + 1;
    return {halton(index, 2) - 0.5f, halton(index, 3) - 0.5f};
}

Result<> TaaPass::build(const BuildContext& context) {
    on_ = Antialias(context.effects.antialias) == Antialias::taa;
    if (!on_) return {};
    VX_TRY_ASSIGN(program_,
                  ScreenProgram::build(context, {.path = "taa/taa.screen.glsl", .formats = {GL_RGBA16F, GL_RGBA16F}}));
    return {};
}

void TaaPass::begin(FrameContext& frame) {
    RenderPass::begin(frame);
    if (!on_ || frame.exact) return;
    step_ = frame.continues ? step_ + 1 : 0;
    frame.jitter = shift(step_);
}

void TaaPass::declare(DeclareContext& c) {
    if (Antialias(c.effects.antialias) != Antialias::taa) return;
    c.graph.add_target({.name = "taa", .format = GL_RGBA16F, .history = true, .linear = true});
    c.graph.add_target({.name = "taa place", .format = GL_RGBA16F, .history = true});
    const std::string color = std::exchange(c.color, "taa");
    c.graph.add_pass({"taa",
                      {color, "depth", "surface", "taa@before", "taa place@before"},
                      {"taa", "taa place"},
                      [this, color](const gfx::PassContext& p) {
                          const bool known = frame_->continues && p.graph.has_history("taa");
                          glProgramUniform2f(program_.name(), 0, known ? 1.0f : 0.0f,
                                             frame_->frame->views.size() > 1 ? 1.0f : 0.0f);
                          program_.run(p, frame_->plain_array, {"taa", "taa place"},
                                       {color, "taa@before", "taa place@before", "depth", "surface"});
                      },
                      ""});
}

} // namespace vitrail::render
