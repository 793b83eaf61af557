// "scene": the lit picture of solid surfaces and sky, copied so that later passes may look it up while they draw into
// the picture itself: mirrors and refracting water. Red, green and blue are the light, alpha the byte of the G-buffer
// that holds view and face (0 where there is no G-buffer, or sky). With reflections on it has smaller levels for
// blurred mirrors. Full size, filtered; passes bind it at Unit::color.
#pragma once

#include "render/passes/pass.h"
#include "render/passes/screen_pass.h"

namespace vitrail::render {

class SceneCopyPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;
    static bool wanted(const Effects& effects) { return effects.reflections.on || effects.water.refraction; }

private:
    void make_levels(const gfx::Texture& picture) const;
    ScreenProgram program_;
    ProgramRef mips_; // where passes over the screen run as compute
};

} // namespace vitrail::render
