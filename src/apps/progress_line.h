// One line on a terminal's standard error that tells how far long work is and how long it will take; nothing elsewhere.
#pragma once

#include "base/types.h"

#include <string>

namespace vitrail::apps {

class ProgressLine {
public:
    // steps: of the whole work. unit: what a step is, in the plural.
    ProgressLine(u64 steps, std::string unit);
    ~ProgressLine(); // ends the line
    ProgressLine(const ProgressLine&) = delete;
    ProgressLine& operator=(const ProgressLine&) = delete;
    void step(u64 count);
    void note(std::string text) { note_ = std::move(text); } // what is worked on

private:
    u64 steps_, done_ = 0, start_;
    std::string unit_, note_;
    double told_ = 0;
    bool terminal_;
};

std::string duration_text(double seconds); // "12 s", "3:05 min", "1:02 h"

} // namespace vitrail::apps
