// Small vectors for kernels and graphics; plain aggregates, no operators that hide cost.
#pragma once

#include "base/hd.h"
#include "base/types.h"

#include <cmath>

namespace vitrail {

struct Vec2 {
    float x = 0, y = 0;
};

struct Vec3 {
    float x = 0, y = 0, z = 0;
};

struct Vec4 {
    float x = 0, y = 0, z = 0, w = 0;
};

VX_HD constexpr Vec3 operator+(Vec3 a, Vec3 b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
VX_HD constexpr Vec3 operator-(Vec3 a, Vec3 b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
VX_HD constexpr Vec3 operator-(Vec3 a) {
    return {-a.x, -a.y, -a.z};
}
VX_HD constexpr Vec3 operator*(Vec3 a, Vec3 b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
VX_HD constexpr Vec3 operator*(Vec3 a, float s) {
    return {a.x * s, a.y * s, a.z * s};
}
VX_HD constexpr Vec3 operator*(float s, Vec3 a) {
    return a * s;
}
VX_HD constexpr Vec3& operator+=(Vec3& a, Vec3 b) {
    return a = a + b;
}
VX_HD constexpr bool operator==(Vec3 a, Vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}
VX_HD constexpr float dot(Vec3 a, Vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
VX_HD constexpr Vec3 cross(Vec3 a, Vec3 b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
VX_HD float length(Vec3 a) {
    return std::sqrt(dot(a, a));
}
VX_HD Vec3 normalized(Vec3 a) {
    const float l = length(a);
    return l > 0 ? a * (1.0f / l) : Vec3{};
}
VX_HD constexpr float lerp(float a, float b, float t) {
    return a + (b - a) * t;
}
VX_HD constexpr Vec3 lerp(Vec3 a, Vec3 b, float t) {
    return a + (b - a) * t;
}
VX_HD constexpr float clamp(float v, float lo, float hi) {
    return v < lo ? lo : (v > hi ? hi : v);
}
// Hermite step of GLSL: 0 below a, 1 above b; a > b descends.
VX_HD constexpr float smoothstep(float a, float b, float x) {
    const float t = clamp((x - a) / (b - a), 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

struct IVec3 {
    i32 x = 0, y = 0, z = 0;
    friend constexpr bool operator==(const IVec3&, const IVec3&) = default;
};

// Axis-aligned box of floats, relative to some stated anchor.
struct Box {
    Vec3 min, max;
};

} // namespace vitrail
