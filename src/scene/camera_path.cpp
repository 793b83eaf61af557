#include "scene/camera_path.h"

#include "formats/json_bounds.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vitrail::scene {

namespace {

using Triple = std::array<double, 3>;
constexpr double kPlaceMost = 2147483000; // blocks (voxel/coords.h)

Triple operator-(const Triple& a, const Triple& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
Triple operator+(const Triple& a, const Triple& b) {
    return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
Triple operator*(const Triple& a, double k) {
    return {a[0] * k, a[1] * k, a[2] * k};
}
double length(const Triple& a) {
    return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]);
}

// The angle next to `before` that means the same.
double shortest_way(double before, double angle) {
    return before + std::remainder(angle - before, 360.0);
}

Result<double> number_in(const nlohmann::json& value, double least, double most, const std::string& name) {
    if (!value.is_number()) return fail(ErrorCode::damaged, fmt::format("{} is a number", name));
    const double x = value.get<double>();
    if (!(x >= least && x <= most)) // NaN too
        return fail(ErrorCode::invalid_argument, fmt::format("{} is a number from {} to {}", name, least, most));
    return x;
}

Result<Triple> numbers_in(const nlohmann::json& value, std::size_t count, double most, const std::string& name) {
    if (!value.is_array() || value.size() != count)
        return fail(ErrorCode::damaged, fmt::format("{} is a list of {} numbers", name, count));
    Triple out{};
    for (std::size_t i = 0; i < count; ++i) {
        VX_TRY_ASSIGN(out[i], number_in(value[i], -most, most, name));
    }
    return out;
}

} // namespace

void CameraPath::Track::add(double time, Triple value) {
    times.push_back(time);
    values.push_back(value);
}

void CameraPath::Track::find_slopes(bool in_space) {
    const std::size_t n = times.size();
    slopes.assign(n, {}); // starts and ends at rest
    for (std::size_t i = 1; i + 1 < n; ++i) {
        const double before = times[i] - times[i - 1], after = times[i + 1] - times[i];
        const Triple left = (values[i] - values[i - 1]) * (1 / before),
                     right = (values[i + 1] - values[i]) * (1 / after);
        Triple slope = (left * after + right * before) * (1 / (before + after));
        if (in_space) {
            const double most = 3 * std::min(length(left), length(right)), steep = length(slope);
            if (steep > most) slope = slope * (most / steep);
        } else {
            for (std::size_t c = 0; c < 3; ++c) {
                const double most = left[c] * right[c] > 0 ? 3 * std::min(std::abs(left[c]), std::abs(right[c])) : 0;
                slope[c] = std::clamp(slope[c], -most, most);
            }
        }
        slopes[i] = slope;
    }
}

std::array<double, 3> CameraPath::Track::at(double time, const Triple& otherwise) const {
    if (times.empty()) return otherwise;
    if (time <= times.front()) return values.front();
    if (!(time < times.back())) return values.back();
    const std::size_t k = std::size_t(std::upper_bound(times.begin(), times.end(), time) - times.begin()) - 1;
    const double span = times[k + 1] - times[k], t = (time - times[k]) / span;
    // Cubic Hermite; as steps from the first value, so that far places lose nothing.
    const double along = t * t * (3 - 2 * t), first = t * (1 - t) * (1 - t) * span, last = t * t * (t - 1) * span;
    return values[k] + (values[k + 1] - values[k]) * along + slopes[k] * first + slopes[k + 1] * last;
}

Result<CameraPath> CameraPath::parse(ByteView text, const CameraMoment& otherwise) {
    VX_TRY_ASSIGN(const nlohmann::json file, parse_json(text));
    if (!file.is_object() || !file.contains("keys") || !file["keys"].is_array())
        return fail(ErrorCode::damaged, "a camera path is {\"keys\": [...]}");
    const nlohmann::json& list = file["keys"];
    if (list.empty()) return fail(ErrorCode::damaged, "a camera path without keys");
    if (list.size() > kKeysMost)
        return fail(ErrorCode::limit, fmt::format("a camera path of more than {} keys", kKeysMost));
    CameraPath path;
    path.otherwise_ = otherwise;
    path.keys_ = list.size();
    double before = -1;
    for (std::size_t i = 0; i < list.size(); ++i) {
        const nlohmann::json& key = list[i];
        const auto named = [&](const char* what) { return fmt::format("key {}: {}", i + 1, what); };
        if (!key.is_object()) return fail(ErrorCode::damaged, named("is an object"));
        for (const auto& [word, value] : key.items())
            if (word != "seconds" && word != "at" && word != "look" && word != "fov" && word != "time")
                return fail(ErrorCode::damaged, fmt::format("key {}: knows seconds, at, look, fov and time, not '{}'",
                                                            i + 1, word.substr(0, 40)));
        if (!key.contains("seconds")) return fail(ErrorCode::damaged, named("says no seconds"));
        VX_TRY_ASSIGN(const double seconds, number_in(key["seconds"], 0, kSecondsMost, named("seconds")));
        if (seconds <= before) return fail(ErrorCode::damaged, named("seconds do not grow"));
        before = seconds;
        if (key.contains("at")) {
            VX_TRY_ASSIGN(const Triple at, numbers_in(key["at"], 3, kPlaceMost, named("at")));
            path.place_.add(seconds, at);
        }
        if (key.contains("look")) {
            VX_TRY_ASSIGN(Triple look, numbers_in(key["look"], 2, 36000, named("look")));
            look[1] = std::clamp(look[1], -90.0, 90.0);
            if (!path.look_.values.empty()) look[0] = shortest_way(path.look_.values.back()[0], look[0]);
            path.look_.add(seconds, look);
        }
        if (key.contains("fov")) {
            VX_TRY_ASSIGN(const double fov, number_in(key["fov"], 5, 150, named("fov")));
            path.fov_.add(seconds, {fov, 0, 0});
        }
        if (key.contains("time")) {
            VX_TRY_ASSIGN(const double time, number_in(key["time"], 0, kTimeMost, named("time")));
            path.time_.add(seconds, {time, 0, 0});
        }
    }
    path.seconds_ = before;
    for (Track* track : {&path.place_, &path.look_, &path.fov_, &path.time_})
        track->find_slopes(track == &path.place_);
    return path;
}

CameraMoment CameraPath::at(double seconds) const {
    CameraMoment moment;
    moment.at = place_.at(seconds, otherwise_.at);
    const Triple look = look_.at(seconds, {otherwise_.yaw_deg, otherwise_.pitch_deg, 0});
    moment.yaw_deg = std::remainder(look[0], 360.0);
    moment.pitch_deg = std::clamp(look[1], -90.0, 90.0);
    moment.fov_deg = fov_.at(seconds, {otherwise_.fov_deg, 0, 0})[0];
    const double time = time_.at(seconds, {otherwise_.time, 0, 0})[0];
    moment.time = time - std::floor(time / 24000) * 24000;
    return moment;
}

} // namespace vitrail::scene
