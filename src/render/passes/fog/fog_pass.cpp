#include "render/passes/fog/fog_pass.h"

#include "render/passes/shadow/shadow_pass.h"
#include "scene/mist.h"

#include <algorithm>
#include <cstring>
#include <epoxy/gl.h>

namespace vitrail::render {

namespace {

struct MistUniforms { // std140, as common/mist.glsl has it
    Vec4 air, eye[kViewsMost];
};

// Below this no mist is found denser, and floats stay exact.
constexpr float kDeepest = -128, kHighest = 4096;

} // namespace

Result<> FogPass::build(const BuildContext& context) {
    if (!context.effects.fog.volumetric) return {};
    VX_TRY_ASSIGN(march_, ScreenProgram::build(context, {.path = "fog/march.screen.glsl",
                                                         .defines = shadow_defines(context.effects),
                                                         .formats = {GL_RG16F}}));
    VX_TRY_ASSIGN(shafts_,
                  ScreenProgram::build(
                      context, {.path = "fog/shafts.screen.glsl", .formats = {GL_RGBA16F}, .blend = ScreenBlend::add}));
    return {};
}

void FogPass::prepare(FrameContext& frame) {
    const Effects::Fog& fog = frame.effects->fog;
    const scene::Mist mist = scene::mist_at(frame.frame->sky);
    MistUniforms u{};
    u.air = {mist.haze * fog.density, mist.mist * fog.density, 1 / mist.height, fog.volumetric ? 0.0f : 1.0f};
    const u32 views = std::min<u32>(u32(frame.frame->views.size()), kViewsMost);
    for (u32 i = 0; i < views; ++i) {
        const scene::View& view = frame.frame->views[i];
        const i32 base = view.sea_level;
        const float above = std::clamp(float(i64(block_of(view.eye.at).y) - base) + frame.uniforms.views[i].fraction.y,
                                       kDeepest, kHighest);
        const bool on = view.misty && (fog.height || fog.volumetric) && !view.underwater && !frame.exact;
        u.eye[i] = {above, scene::mist_column(mist, above), on ? 1.0f : 0.0f, 0};
    }
    const auto slice = frame.ring->allocate(sizeof u, 256);
    std::memcpy(slice.data, &u, sizeof u);
    glBindBufferRange(GL_UNIFORM_BUFFER, 2, slice.buffer, GLintptr(slice.offset), sizeof u);
}

void FogPass::declare(DeclareContext& c) {
    if (!c.effects.fog.volumetric) return;
    c.graph.add_target({.name = "shafts", .format = GL_RG16F, .divisor = 2});
    c.graph.add_pass({"shafts march",
                      {"depth", "light", "surface", "shadow_depth"},
                      {"shafts"},
                      [this](const gfx::PassContext& p) {
                          const bool moves = Antialias(frame_->effects->antialias) == Antialias::taa;
                          glProgramUniform2f(march_.name(), 0, float(frame_->effects->fog.steps),
                                             moves ? 5.588238f * float(frame_->number % 64) : 0.0f);
                          march_.run(p, frame_->plain_array, {"shafts"}, {"depth", "light", "surface"});
                      },
                      ""});
    c.graph.add_pass({"shafts",
                      {"depth", "surface", "shafts"},
                      {c.color},
                      [this, color = c.color](const gfx::PassContext& p) {
                          if (frame_->exact) return;
                          shafts_.run(p, frame_->plain_array, {color}, {"depth", "shafts", "surface"});
                      },
                      ""});
}

} // namespace vitrail::render
