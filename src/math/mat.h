// 4x4 matrices, column-major as OpenGL stores them: element (row r, column c) is m[c * 4 + r].
#pragma once

#include "math/vec.h"

#include <array>

namespace vitrail {

struct Mat4 {
    std::array<float, 16> m{};
};

Mat4 identity();
Mat4 operator*(const Mat4& a, const Mat4& b);
Vec4 operator*(const Mat4& a, Vec4 v);
Mat4 translation(Vec3 t);
// Right-handed reversed-Z projection with an infinite far plane: depth 1 at `near_plane`, 0 at infinity, for clip
// control 0..1. Vertical field of view in radians.
Mat4 perspective_reversed_infinite(float fov_y, float aspect, float near_plane);
// Rotation of the world into view space for angles of the command line: yaw 0 looks at +z and grows clockwise seen
// from above, pitch positive looks down; radians. View space looks along -z, x right, y up.
Mat4 view_rotation(float yaw, float pitch);
// The direction such a camera looks in, unit length.
Vec3 look_direction(float yaw, float pitch);
Mat4 inverse(const Mat4& a); // general inverse; identity for a singular matrix

} // namespace vitrail
