#include "math/color.h"

#include <gtest/gtest.h>

using namespace vitrail;

TEST(Color, LuminanceIsThatOfRec709) {
    // The second row of the matrix from the primaries' chromaticities and the white D65 to XYZ, solved here.
    const double at[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}}, white[2] = {0.3127, 0.3290};
    double m[3][4]; // columns: XYZ of each primary at Y = 1; the white's
    for (int k = 0; k < 3; ++k) {
        const double x = at[k][0], y = at[k][1];
        m[0][k] = x / y, m[1][k] = 1, m[2][k] = (1 - x - y) / y;
    }
    m[0][3] = white[0] / white[1], m[1][3] = 1, m[2][3] = (1 - white[0] - white[1]) / white[1];
    for (int p = 0; p < 3; ++p) // Gauss and Jordan; no pivot is 0
        for (int r = 0; r < 3; ++r) {
            if (r == p) continue;
            const double f = m[r][p] / m[p][p];
            for (int c = p; c < 4; ++c)
                m[r][c] -= f * m[p][c];
        }
    EXPECT_NEAR(luminance_of(1, 0, 0), m[0][3] / m[0][0], 2e-4);
    EXPECT_NEAR(luminance_of(0, 1, 0), m[1][3] / m[1][1], 2e-4);
    EXPECT_NEAR(luminance_of(0, 0, 1), m[2][3] / m[2][2], 2e-4);
    EXPECT_NEAR(luminance_of(Vec3{0.25f, 0.25f, 0.25f}), 0.25, 1e-6);
}
