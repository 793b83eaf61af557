// The sky behind everything: where no surface was drawn.
#pragma once

#include "render/passes/pass.h"

namespace vitrail::render {

class SkyPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    ProgramRef day_, night_;
};

} // namespace vitrail::render
