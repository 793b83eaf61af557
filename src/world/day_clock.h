// How time of day runs: a day has 24000 day ticks and takes `day_minutes` of real time, by default 20 (one day tick a
// server tick); 0: it stands still.
#pragma once

#include "base/types.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

inline constexpr u32 kDayTicks = 24000;
inline constexpr u32 kUsualDayMinutes = 20, kMostDayMinutes = 1440;

inline double day_ticks_a_second(u32 day_minutes) {
    return day_minutes == 0 ? 0.0 : double(kDayTicks) / (60.0 * day_minutes);
}

// The server's side: whole day ticks, without drift whatever the length.
class DayRunner {
public:
    // Day ticks that pass in one server tick (of which 20 make a second).
    u64 step(u32 day_minutes) {
        if (day_minutes == 0) return 0;
        rest_ += kUsualDayMinutes;
        const u64 whole = rest_ / day_minutes;
        rest_ %= day_minutes;
        return whole;
    }

private:
    u32 rest_ = 0; // of a day tick, in shares of day_minutes
};

// The client's side: runs on between the server's messages at the rate they tell. A message that came a little early or
// late moves the sun over the next seconds, never at once; one far off (somebody set the time) counts at once.
class DayClock {
public:
    // ticks since the world began, at `now` (seconds of any clock that only grows).
    void hear(u64 ticks, u32 day_minutes, double now) {
        const double off = heard_ ? this->ticks(now) - double(ticks) : 0;
        heard_ticks_ = ticks, heard_at_ = now;
        rate_ = day_ticks_a_second(day_minutes);
        // What may come from a message's way: a second or so, or what is left of a tick.
        off_ = std::abs(off) <= 2 + rate_ * 2 ? off : 0;
        heard_ = true;
    }
    // At most 10 seconds beyond the last message: a server that stands still stops the sun too.
    double ticks(double now) const {
        const double after = std::clamp(now - heard_at_, 0.0, 10.0);
        return std::max(double(heard_ticks_) + after * rate_ + off_ * std::exp(-after / kSettleSeconds), 0.0);
    }

private:
    static constexpr double kSettleSeconds = 2;
    u64 heard_ticks_ = 0;
    double heard_at_ = 0, rate_ = 0, off_ = 0;
    bool heard_ = false;
};

} // namespace vitrail
