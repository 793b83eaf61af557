// "ao": how much of the sky over each surface is free, 0..1, from depth and the faces of the G-buffer; lighting takes
// it for light that comes from all around.
#pragma once

#include "render/passes/pass.h"

namespace vitrail::render {

class SsaoPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    ProgramRef program_, blur_;
};

} // namespace vitrail::render
