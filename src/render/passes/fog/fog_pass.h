// The mist: its numbers for every shader that shows something through air (common/mist.glsl, uniform buffer 2), and,
// where Effects::Fog::volumetric is on, shafts of light: a march through the shadow maps ("shafts", half size) takes
// the place of the sun's part in mist_over() and is added after the translucent surfaces.
#pragma once

#include "render/passes/pass.h"
#include "render/passes/screen_pass.h"

namespace vitrail::render {

class FogPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;
    void prepare(FrameContext& frame) override;

private:
    ScreenProgram march_, shafts_;
};

} // namespace vitrail::render
