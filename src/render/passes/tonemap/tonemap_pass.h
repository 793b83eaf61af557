// Linear light to what a screen shows.
#pragma once

#include "render/passes/pass.h"

namespace vitrail::render {

class TonemapPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    ProgramRef program_;
};

} // namespace vitrail::render
