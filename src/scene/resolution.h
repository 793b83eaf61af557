// How many pixels are drawn where frames take too long: a share of the picture's width and height, enlarged afterwards.
// Raster and tracer alike take it as FrameView::resolution; this decides it from the times of frames.
//
//     ResolutionControl control;
//     frame.resolution = control.next(last_frame_ms, {.frame_ms = 1000.0f / 30});
//
// Times are judged a few frames at a time, by their median: one long frame (land that arrives) changes nothing. Too
// long: as many steps less as the pixels' share in it asks for, two at most. Far shorter than wanted: a step more. Just
// kept, which is also what waiting for the screen looks like: a step more is tried now and then, and each try that
// fails doubles the time until the next, so that a picture at its limit does not change its sharpness all the time.
#pragma once

#include "base/types.h"

#include <array>
#include <utility>

namespace vitrail::scene {

struct ResolutionWish {
    float frame_ms = 1000.0f / 30; // above 0: what a frame may take
    float least = 0.6f, most = 1;  // of the share, 0 < least <= most <= 1
    bool operator==(const ResolutionWish&) const = default;
};

class ResolutionControl {
public:
    static constexpr u32 kSteps = 6;       // from most to least, each the same factor
    static constexpr float kJudged = 0.4f; // seconds of frames that are judged at once, at least kFrames
    static constexpr u32 kFrames = 8, kFramesMost = 64;
    static constexpr float kFirstWait = 4, kLongestWait = 64; // seconds until a step more is tried

    // The share for the frame to come. frame_ms: what the last one took, of the wall; not above 0: not known. Where the
    // wish changes, it begins anew from its most.
    float next(float frame_ms, const ResolutionWish& wish);
    float share() const; // as last told

private:
    float at(u32 step) const;
    void judge(float median_ms, float seconds);
    ResolutionWish wish_;
    std::array<float, kFramesMost> times_{};
    u32 count_ = 0;
    float sum_ms_ = 0;
    u32 step_ = 0;    // 0: most
    u32 calm_ = 0;    // judgements with time to spare, one after the other
    float since_ = 0; // seconds since the last change
    float wait_ = kFirstWait;
    bool tried_ = false; // the last change was a step more, and is not yet known to hold
};

// The size that is drawn, at least 1 x 1: both sides times the share, rounded.
std::pair<u32, u32> drawn_size(u32 width, u32 height, float share);

} // namespace vitrail::scene
