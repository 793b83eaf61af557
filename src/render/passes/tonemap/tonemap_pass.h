// Linear light to what a screen shows: bloom mixed in, exposure, filmic curve (common/tone.glsl), dithering. Into
// DeclareContext::display.
#pragma once

#include "render/passes/pass.h"
#include "render/passes/screen_pass.h"

namespace vitrail::render {

class TonemapPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    void draw(const gfx::PassContext& context, const std::string& color, const std::string& into);
    ScreenProgram program_;
    bool compute_ = false;
};

} // namespace vitrail::render
