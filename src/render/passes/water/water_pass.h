// Translucent terrain (water, glass, ice, crystals), drawn forward over the lit picture, back to front.
#pragma once

#include "render/passes/pass.h"

namespace vitrail::render {

class WaterPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    ProgramRef program_;
};

} // namespace vitrail::render
