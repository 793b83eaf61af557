// The finished picture, drawn smaller than the screen (FrameView::resolution, Effects::Resolution), enlarged to it.
#pragma once

#include "render/passes/pass.h"
#include "render/passes/screen_pass.h"

namespace vitrail::render {

class UpscalePass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    ScreenProgram program_;
    bool compute_ = false;
};

} // namespace vitrail::render
