// Light of every pixel of the G-buffer, once a screen, into "color" (linear HDR).
#pragma once

#include "render/passes/pass.h"

namespace vitrail::render {

class LightingPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    ProgramRef program_;
};

} // namespace vitrail::render
