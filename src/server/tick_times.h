// How long the server's last ticks took: on the wall, and in processor time, which tells what a busy machine hides.
#pragma once

#include "base/types.h"

#include <vector>

namespace vitrail::server {

struct TickDistribution {
    u32 ticks = 0; // that it is of
    float wall_ms_p50 = 0, wall_ms_p99 = 0, wall_ms_longest = 0;
    float cpu_ms_p50 = 0, cpu_ms_p99 = 0, cpu_ms_longest = 0; // of the ticking thread
};

class TickTimes {
public:
    static constexpr std::size_t kKept = 600; // ticks, half a minute

    void add(float wall_ms, float cpu_ms);
    // Of the last kKept ticks; a percentile is the smallest time that at least so many percent of the ticks keep to.
    TickDistribution distribution() const;

private:
    std::vector<float> wall_ms_, cpu_ms_; // rings
    std::size_t next_ = 0;
};

} // namespace vitrail::server
