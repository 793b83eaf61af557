#include "math/mat.h"

#include <utility>

namespace vitrail {

Mat4 identity() {
    Mat4 r;
    r.m[0] = r.m[5] = r.m[10] = r.m[15] = 1.0f;
    return r;
}

Mat4 operator*(const Mat4& a, const Mat4& b) {
    Mat4 r;
    for (int c = 0; c < 4; ++c)
        for (int row = 0; row < 4; ++row) {
            float sum = 0;
            for (int k = 0; k < 4; ++k)
                sum += a.m[k * 4 + row] * b.m[c * 4 + k];
            r.m[c * 4 + row] = sum;
        }
    return r;
}

Vec4 operator*(const Mat4& a, Vec4 v) {
    const auto& m = a.m;
    return {m[0] * v.x + m[4] * v.y + m[8] * v.z + m[12] * v.w, m[1] * v.x + m[5] * v.y + m[9] * v.z + m[13] * v.w,
            m[2] * v.x + m[6] * v.y + m[10] * v.z + m[14] * v.w, m[3] * v.x + m[7] * v.y + m[11] * v.z + m[15] * v.w};
}

Mat4 translation(Vec3 t) {
    Mat4 r = identity();
    r.m[12] = t.x;
    r.m[13] = t.y;
    r.m[14] = t.z;
    return r;
}

Mat4 perspective_reversed_infinite(float fov_y, float aspect, float near_plane) {
    const float f = 1.0f / std::tan(fov_y * 0.5f);
    Mat4 r;
    r.m[0] = f / aspect;
    r.m[5] = f;
    r.m[11] = -1.0f;
    r.m[14] = near_plane;
    return r;
}

Vec3 look_direction(float yaw, float pitch) {
    return {-std::sin(yaw) * std::cos(pitch), -std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
}

Mat4 view_rotation(float yaw, float pitch) {
    const Vec3 forward = look_direction(yaw, pitch);
    const Vec3 right = {-std::cos(yaw), 0.0f,
                        -std::sin(yaw)}; // level, so that straight up and down are no special case
    const Vec3 up = cross(right, forward);
    Mat4 r = identity();
    r.m[0] = right.x, r.m[4] = right.y, r.m[8] = right.z;
    r.m[1] = up.x, r.m[5] = up.y, r.m[9] = up.z;
    r.m[2] = -forward.x, r.m[6] = -forward.y, r.m[10] = -forward.z;
    return r;
}

Mat4 inverse(const Mat4& a) {
    // Gauss-Jordan with partial pivoting in double: used a few times a frame, clarity over speed.
    double w[4][8];
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c)
            w[r][c] = a.m[c * 4 + r], w[r][c + 4] = r == c ? 1.0 : 0.0;
    for (int c = 0; c < 4; ++c) {
        int pivot = c;
        for (int r = c + 1; r < 4; ++r)
            if (std::abs(w[r][c]) > std::abs(w[pivot][c])) pivot = r;
        if (w[pivot][c] == 0.0) return identity();
        for (int k = 0; k < 8; ++k)
            std::swap(w[c][k], w[pivot][k]);
        const double scale = 1.0 / w[c][c];
        for (double& v : w[c])
            v *= scale;
        for (int r = 0; r < 4; ++r) {
            if (r == c) continue;
            const double factor = w[r][c];
            for (int k = 0; k < 8; ++k)
                w[r][k] -= factor * w[c][k];
        }
    }
    Mat4 out;
    for (int r = 0; r < 4; ++r)
        for (int c = 0; c < 4; ++c)
            out.m[c * 4 + r] = float(w[r][c + 4]);
    return out;
}

} // namespace vitrail
