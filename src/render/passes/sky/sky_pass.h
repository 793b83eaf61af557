// The sky behind everything: where no surface was drawn. It also brings the dome's table to the GPU, for all who read
// it (common/sky.glsl): fog, mirrors.
#pragma once

#include "render/passes/pass.h"
#include "render/passes/screen_pass.h"

#include <array>

namespace vitrail::render {

class SkyPass : public RenderPass {
public:
    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;
    void prepare(FrameContext& frame) override;
    u64 gpu_bytes() const override;

private:
    void draw(const gfx::PassContext& context) const;
    ScreenProgram day_, night_;
    gfx::Texture clouds_;
    std::array<gfx::Texture, 3> domes_; // in turn: the frames before may still read theirs
    u32 dome_ = 0;
    float dome_time_ = -1; // of what domes_[dome_] holds
    u32 dome_phase_ = 0;
};

} // namespace vitrail::render
