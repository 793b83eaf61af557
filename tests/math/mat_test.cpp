#include "math/mat.h"

#include <gtest/gtest.h>

using namespace vitrail;

static constexpr float kPi = 3.14159265f;

TEST(Mat, LookDirectionsFollowTheCommandLine) {
    const Vec3 south = look_direction(0, 0), west = look_direction(kPi / 2, 0), down = look_direction(0, kPi / 2);
    EXPECT_NEAR(south.z, 1, 1e-6);
    EXPECT_NEAR(west.x, -1, 1e-6); // yaw grows clockwise seen from above: south, west, north, east
    EXPECT_NEAR(down.y, -1, 1e-6);
}

TEST(Mat, ViewRotationPutsTheLookOnMinusZAndKeepsLengths) {
    for (float yaw : {0.0f, 0.7f, 3.0f, -2.0f})
        for (float pitch : {0.0f, 0.5f, -1.5f, kPi / 2}) {
            const Vec3 f = look_direction(yaw, pitch);
            const Vec4 v = view_rotation(yaw, pitch) * Vec4{f.x, f.y, f.z, 0};
            EXPECT_NEAR(v.x, 0, 1e-5);
            EXPECT_NEAR(v.y, 0, 1e-5);
            EXPECT_NEAR(v.z, -1, 1e-5);
            const Vec4 up = view_rotation(yaw, pitch) * Vec4{0, 1, 0, 0};
            EXPECT_GE(up.y, -1e-5); // never upside down
        }
    // Looking south, west lies on the right.
    const Vec4 right = view_rotation(0, 0) * Vec4{-1, 0, 0, 0};
    EXPECT_NEAR(right.x, 1, 1e-6);
}

TEST(Mat, ReversedDepth) {
    const Mat4 p = perspective_reversed_infinite(1.2f, 1.5f, 0.05f);
    const Vec4 near = p * Vec4{0, 0, -0.05f, 1}, far = p * Vec4{0, 0, -1e6f, 1};
    EXPECT_NEAR(near.z / near.w, 1, 1e-5);
    EXPECT_NEAR(far.z / far.w, 0, 1e-5);
}

TEST(Mat, InverseUndoes) {
    const Mat4 a =
        perspective_reversed_infinite(1.2f, 1.5f, 0.05f) * view_rotation(0.4f, -0.3f) * translation({1, 2, 3});
    const Mat4 one = a * inverse(a);
    for (int i = 0; i < 16; ++i)
        EXPECT_NEAR(one.m[i], i % 5 == 0 ? 1 : 0, 1e-4);
}
