// Degrees are what people type and read; everything that computes takes radians.
#pragma once

namespace vitrail {

inline constexpr float kPi = 3.14159265358979f;
inline constexpr float kRadiansADegree = kPi / 180.0f;
inline constexpr float kDegreesARadian = 180.0f / kPi;

} // namespace vitrail
