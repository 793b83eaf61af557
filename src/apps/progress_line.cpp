#include "apps/progress_line.h"

#include "base/clock.h"

#include <cstdio>
#include <fmt/format.h>
#include <unistd.h>

namespace vitrail::apps {

constexpr double kProgressSeconds = 0.5;

std::string duration_text(double seconds) {
    const u64 s = u64(seconds + 0.5);
    if (s < 60) return fmt::format("{} s", s);
    return s < 3600 ? fmt::format("{}:{:02} min", s / 60, s % 60) : fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
}

ProgressLine::ProgressLine(u64 steps, std::string unit)
    : steps_(steps)
    , start_(now_ns())
    , unit_(std::move(unit))
    , terminal_(isatty(2)) {}

ProgressLine::~ProgressLine() {
    if (told_ > 0)
        fmt::print(stderr, "\r{} of {} {} in {}\033[K\n", done_, steps_, unit_, duration_text(seconds_since(start_)));
}

void ProgressLine::step(u64 count) {
    done_ += count;
    const double seconds = seconds_since(start_);
    if (!terminal_ || seconds - told_ < kProgressSeconds) return;
    told_ = seconds;
    fmt::print(stderr, "\r{}{} of {} {}, {} left\033[K", note_.empty() ? "" : note_ + ": ", done_, steps_, unit_,
               duration_text(seconds * double(steps_ - done_) / double(done_)));
    std::fflush(stderr);
}

} // namespace vitrail::apps
