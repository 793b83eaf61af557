// Temporal antialiasing: shifts the view below a pixel (begin) and averages over frames into "taa", which takes the
// place of the HDR picture so far. A resting picture gathers up to 32 frames, so that a still is as good as
// supersampled.
#pragma once

#include "render/passes/pass.h"
#include "render/passes/screen_pass.h"

namespace vitrail::render {

class TaaPass : public RenderPass {
public:
    // Frames after which a resting picture has all shifts.
    static constexpr u32 kShifts = 16;
    // Of frame `step` since the picture began: pixels, -0.5..0.5 (Halton's sequence of bases 2 and 3).
    static Vec2 shift(u32 step);

    Result<> build(const BuildContext& context) override;
    void declare(DeclareContext& context) override;
    void begin(FrameContext& frame) override;

private:
    ScreenProgram program_;
    bool on_ = false;
    u32 step_ = 0;
};

} // namespace vitrail::render
