// Occlusion culling on the GPU, within one frame and without waiting: what was seen lately is drawn first; then the
// boxes of all other sections in sight are held against that depth, and those that pass are drawn too, by commands
// whose instance count a compute shader writes. What was seen is tested again every few frames, a part of it in each.
// So nothing is ever missing, however fast the eye turns, and the picture is the one without culling (but for the odd
// pixel where the edges of two faces have the very same depth: the first one drawn has it). (Two-pass occlusion
// culling: U. Haar and S. Aaltonen, GPU-Driven Rendering Pipelines, SIGGRAPH 2015 course; here by rasterized boxes,
// which are exact, instead of a depth pyramid.)
//
// Which section was seen when stays on the GPU, by SectionStore's slots. How many were drawn comes back some frames
// later, for statistics alone.
#pragma once

#include "render/passes/pass.h"

#include <array>

namespace vitrail::render {

class Occlusion {
public:
    Occlusion() = default;
    ~Occlusion();
    Occlusion(const Occlusion&) = delete;
    Occlusion& operator=(const Occlusion&) = delete;

    Result<> build(const BuildContext& context); // nothing where the effect is off
    // Splits the view's commands: draws.first is to be drawn before `test`, draws.late after it; draws.inputs becomes
    // what was drawn of both. Only of a frame's view 0.
    void prepare(FrameContext& frame, ViewDraws& draws);
    // With the framebuffer that holds the depth so far; leaves it as it was.
    void test(const FrameContext& frame, const ViewDraws& draws);
    u64 gpu_bytes() const { return seen_.bytes + commands_.bytes; }

private:
    static constexpr u32 kAnswers = 4;
    struct Counts { // as late.comp.glsl has them
        u32 sections = 0, quads = 0, draws = 0, unused = 0;
    };
    void take_answers(FrameStats& stats);

    ProgramRef first_, boxes_, late_;
    gfx::Buffer seen_;     // by slot: the last frame that saw the section, numbered as now_
    gfx::Buffer commands_; // three lists: first, late, and both
    gfx::Buffer counts_, answers_;
    const Counts* answers_mapped_ = nullptr;
    std::array<void*, kAnswers> fences_{};
    u32 next_answer_ = 0;
    bool answered_ = false;
    Counts last_;

    u32 now_ = 1000; // number of the frame; sections begin as seen in frame 0, long ago
    // Of the frame being drawn.
    u32 records_ = 0, command_count_ = 0, list_words_ = 0;
    u32 source_ = 0, slots_ = 0;
    u64 source_offset_ = 0, slots_offset_ = 0;
};

} // namespace vitrail::render
