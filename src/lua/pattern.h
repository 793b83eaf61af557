// Lua patterns with a budget. Lua's own matcher backtracks without bound inside one C call, where no hook can stop it;
// this one counts its steps. Same language and results: Lua 5.4 reference manual, section 6.4.1.
#pragma once

#include "base/types.h"

#include <cstddef>
#include <string_view>

namespace vitrail::lua {

inline constexpr int kPatternCapturesMost = 32;

struct PatternCapture {
    std::size_t start = 0;
    std::ptrdiff_t size = 0; // kCaptureOpen, kCapturePosition, or bytes
};
inline constexpr std::ptrdiff_t kCaptureOpen = -1, kCapturePosition = -2;

// Plain data: it lives in frames that a Lua error may jump over.
struct PatternMatch {
    bool matched = false;
    std::size_t begin = 0, end = 0; // in the subject
    int captures = 0;
    PatternCapture capture[kPatternCapturesMost];
    const char* error = nullptr; // the pattern is malformed or too deep
    bool out_of_steps = false;
    u64 steps = 0; // spent
};

// Matches at exactly `start` (`anchored`) or at the first place from there on. A leading ^ is the caller's to strip.
// At most `steps_most` single-character comparisons.
PatternMatch match_pattern(std::string_view subject, std::string_view pattern, std::size_t start, bool anchored,
                           u64 steps_most);

} // namespace vitrail::lua
