#include "server/tick_times.h"

#include <algorithm>

namespace vitrail::server {

void TickTimes::add(float wall_ms, float cpu_ms) {
    if (wall_ms_.size() < kKept) {
        wall_ms_.push_back(wall_ms);
        cpu_ms_.push_back(cpu_ms);
        return;
    }
    wall_ms_[next_] = wall_ms;
    cpu_ms_[next_] = cpu_ms;
    next_ = (next_ + 1) % kKept;
}

TickDistribution TickTimes::distribution() const {
    TickDistribution out;
    out.ticks = u32(wall_ms_.size());
    if (out.ticks == 0) return out;
    const auto fill = [](std::vector<float> times, float& p50, float& p99, float& longest) {
        std::sort(times.begin(), times.end());
        const auto part = [&](std::size_t percent) { return times[(times.size() * percent + 99) / 100 - 1]; };
        p50 = part(50), p99 = part(99), longest = times.back();
    };
    fill(wall_ms_, out.wall_ms_p50, out.wall_ms_p99, out.wall_ms_longest);
    fill(cpu_ms_, out.cpu_ms_p50, out.cpu_ms_p99, out.cpu_ms_longest);
    return out;
}

} // namespace vitrail::server
