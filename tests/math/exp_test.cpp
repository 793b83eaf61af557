#include "math/exp.h"

#include <gtest/gtest.h>

namespace vitrail {
namespace {

TEST(Exp, AsTheLibrarys) {
    for (double x = -87; x <= 88; x += 0.00173) {
        const double want = std::exp(double(float(x)));
        ASSERT_NEAR(double(exp_of(float(x))) / want, 1, 3e-7) << x;
    }
    EXPECT_EQ(exp_of(0), 1);
    EXPECT_EQ(exp_of(-1000), exp_of(-87));
    EXPECT_LT(exp_of(-1000), 1e-37f);
    EXPECT_EQ(exp_of(1000), exp_of(88));
}

TEST(Exp, LogarithmAsTheLibrarys) {
    EXPECT_EQ(log_of(1), 0);
    for (float x = 1.2e-38f; x < 3e38f; x *= 1.00737f) {
        const double want = std::log(double(x));
        ASSERT_NEAR(double(log_of(x)), want, 1e-7 + 2e-7 * std::abs(want)) << x;
    }
    for (float x = 0.5f; x < 2; x += 0.000137f) { // small results keep their digits
        const double want = std::log(double(x));
        ASSERT_NEAR(double(log_of(x)), want, 3e-7 * std::abs(want) + 1e-12) << x;
    }
}

} // namespace
} // namespace vitrail
