#include "scene/resolution.h"

#include <algorithm>
#include <cmath>

namespace vitrail::scene {

// Frames up to this much longer than wanted are left alone; what would take less than the second leaves time to spare.
constexpr float kTooLong = 1.06f, kSpare = 0.90f;
constexpr u32 kCalm = 3; // judgements in a row with time to spare

float ResolutionControl::at(u32 step) const {
    if (step == 0) return wish_.most;
    if (step >= kSteps) return wish_.least;
    return wish_.most * std::pow(wish_.least / wish_.most, float(step) / float(kSteps));
}

float ResolutionControl::share() const {
    return at(step_);
}

float ResolutionControl::next(float frame_ms, const ResolutionWish& wish) {
    if (!(wish == wish_)) {
        *this = {};
        wish_ = wish;
        return share();
    }
    if (!(frame_ms > 0)) return share();
    times_[count_++] = frame_ms;
    sum_ms_ += frame_ms;
    if (count_ < kFramesMost && (count_ < kFrames || sum_ms_ < kJudged * 1000)) return share();
    const auto middle = times_.begin() + count_ / 2;
    std::nth_element(times_.begin(), middle, times_.begin() + count_);
    judge(*middle, sum_ms_ * 1e-3f);
    count_ = 0, sum_ms_ = 0;
    return share();
}

void ResolutionControl::judge(float median_ms, float seconds) {
    since_ += seconds;
    // As if all of a frame were pixels. Some of it is not: that asks for too little both on the way down and up.
    const auto would_take = [&](u32 step) {
        const float ratio = at(step) / at(step_);
        return median_ms * ratio * ratio;
    };
    if (tried_ && since_ > kFirstWait) tried_ = false, wait_ = kFirstWait; // it holds
    if (median_ms > wish_.frame_ms * kTooLong) {
        calm_ = 0;
        if (step_ == kSteps) return;
        if (tried_) wait_ = std::min(wait_ * 2, kLongestWait);
        tried_ = false;
        const bool by_two = step_ + 1 < kSteps && would_take(step_ + 1) > wish_.frame_ms;
        step_ += by_two ? 2 : 1;
        since_ = 0;
        return;
    }
    if (step_ == 0) return;
    calm_ = would_take(step_ - 1) < wish_.frame_ms * kSpare ? calm_ + 1 : 0;
    if (calm_ < kCalm && since_ < wait_) return;
    --step_;
    calm_ = 0, since_ = 0;
    tried_ = true;
}

std::pair<u32, u32> drawn_size(u32 width, u32 height, float share) {
    const auto side = [&](u32 whole) {
        return std::clamp(u32(std::lround(float(whole) * share)), 1u, std::max(whole, 1u));
    };
    return {side(width), side(height)};
}

} // namespace vitrail::scene
