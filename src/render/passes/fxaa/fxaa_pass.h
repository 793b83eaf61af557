// Fast antialiasing of the finished picture, from DeclareContext::display into the screen, or what upscale brings
// there. Cheaper than TAA and without memory; it cannot calm what flickers in motion.
#pragma once

#include "render/passes/pass.h"

namespace vitrail::render {

class FxaaPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    ProgramRef program_;
};

} // namespace vitrail::render
