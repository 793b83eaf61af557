// What compile_terrain checks rows with: every error names its row and what was expected.
#pragma once

#include "base/result.h"
#include "base/types.h"

#include <algorithm>
#include <fmt/format.h>
#include <string>
#include <string_view>
#include <vector>

namespace vitrail::compile_detail {

using Names = std::vector<std::string>;

// -1 where there is none.
inline int index_of(const Names& names, std::string_view name) {
    const auto at = std::find(names.begin(), names.end(), name);
    return at == names.end() ? -1 : int(at - names.begin());
}

inline tl::unexpected<Error> wrong(std::string_view row, std::string message) {
    return fail(ErrorCode::invalid_argument, fmt::format("{}: {}", row, message));
}

inline Result<> check_count(std::string_view what, std::size_t count, std::size_t most) {
    if (count <= most) return {};
    return fail(ErrorCode::limit, fmt::format("{} {}; at most {} are allowed", count, what, most));
}

// The comparison also refuses what is no number. Limits count as floats do: what content says in digits became a float.
inline Result<> check_range(std::string_view row, std::string_view what, double v, double least, double most) {
    if (v >= double(float(least)) && v <= double(float(most))) return {};
    return wrong(row, fmt::format("{} is {}; expected {} to {}", what, v, least, most));
}

inline Result<> check_name(std::string_view kind, std::string_view name) {
    const auto fits = [](char c) {
        return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_' || c == ':' || c == '/' || c == '.' ||
               c == ' ' || c == '-';
    };
    if (!name.empty() && name.size() <= 96 && std::all_of(name.begin(), name.end(), fits)) return {};
    return wrong(kind, fmt::format("name '{}'; expected 1 to 96 of a-z 0-9 _ : / . - and blanks", name.substr(0, 96)));
}

// Tangent of an angle in degrees, 0 < angle < 90, from operations that every machine rounds alike.
inline double tangent(double degrees) {
    const double x = degrees * 3.14159265358979323846 / 180.0;
    double sine = 0, cosine = 0, term = 1;
    for (int i = 1; i < 40; i += 2) { // Taylor's series: x < 1.6
        cosine += term;
        term = term * x / double(i);
        sine += term;
        term = -term * x / double(i + 1);
    }
    return sine / cosine;
}

} // namespace vitrail::compile_detail
