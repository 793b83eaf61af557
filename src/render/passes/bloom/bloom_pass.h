// What a lens scatters: the picture at halves of its size, each level blurred and laid over the next larger. Target
// "bloom1" (half size) is the whole light of the picture, spread; the tone mapping mixes Effects::Bloom::strength of it
// with the sharp picture, so that no light is added and no threshold favors a hue.
#pragma once

#include "render/passes/pass.h"
#include "render/passes/screen_pass.h"

namespace vitrail::render {

class BloomPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;

private:
    ScreenProgram first_, down_, up_;
};

} // namespace vitrail::render
