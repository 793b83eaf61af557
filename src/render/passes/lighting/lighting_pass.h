// Light of every pixel of the G-buffer, once a screen, into "color" (linear HDR).
#pragma once

#include "render/passes/pass.h"
#include "render/passes/screen_pass.h"

namespace vitrail::render {

class LightingPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    ScreenProgram any_, plain_; // whatever the views; one view from the air, which most frames are
};

} // namespace vitrail::render
