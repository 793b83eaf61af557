// Edges of the picked block's boxes.
#pragma once

#include "render/passes/pass.h"

namespace vitrail::render {

class OutlinePass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    void draw();
    ProgramRef program_;
};

} // namespace vitrail::render
