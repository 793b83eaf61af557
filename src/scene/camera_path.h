// Camera paths: where a camera is, looks, and at what time of day, as keys in time with smooth motion between them.
// Files are JSON (docs/tracing.md):
//
//     {"keys": [{"seconds": 0, "at": [0, 80, 0], "look": [30, 10], "fov": 70, "time": 6000},
//               {"seconds": 5, "at": [40, 84, 10]}]}
//
// Each of at, look, fov and time goes its own way through the keys that name it. Between keys it is a cubic with the
// slopes of parabolas through three keys each (Catmull and Rom 1974, for times at unequal distances), held so small
// that numbers never leave what lies between two keys, and that what rests between two equal keys stays at rest
// (Fritsch and Carlson 1980).
#pragma once

#include "base/bytes.h"
#include "base/result.h"

#include <array>
#include <optional>
#include <vector>

namespace vitrail::scene {

struct CameraMoment {
    std::array<double, 3> at{}; // blocks
    double yaw_deg = 0, pitch_deg = 0;
    double fov_deg = 70; // vertical
    double time = 6000;  // 0..24000
};

class CameraPath {
public:
    static constexpr std::size_t kKeysMost = 10'000;
    static constexpr double kSecondsMost = 86'400, kTimeMost = 24'000'000;

    // otherwise: what no key says. Errors: damaged (no JSON, a wrong kind of value, times that do not grow), limit,
    // invalid_argument (a value outside its range); the message names the key by its number, from 1.
    static Result<CameraPath> parse(ByteView text, const CameraMoment& otherwise);
    double seconds() const { return seconds_; } // of the last key
    std::size_t keys() const { return keys_; }
    bool has_place() const { return !place_.times.empty(); } // some key says `at`
    // Before the first key and after the last it rests.
    CameraMoment at(double seconds) const;

private:
    struct Track { // one or three numbers in time
        std::vector<double> times;
        std::vector<std::array<double, 3>> values, slopes; // a second
        void add(double time, std::array<double, 3> value);
        void find_slopes(bool in_space); // in space: of a place, not of numbers by themselves
        std::array<double, 3> at(double time, const std::array<double, 3>& otherwise) const;
    };
    Track place_, look_, fov_, time_;
    CameraMoment otherwise_;
    double seconds_ = 0;
    std::size_t keys_ = 0;
};

} // namespace vitrail::scene
