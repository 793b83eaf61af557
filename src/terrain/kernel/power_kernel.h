// Powers and sines from + - * / alone, the same on every device.
#pragma once

#include "terrain/kernel/lanes.h"

namespace vitrail {

// Logarithm to base 2 of a normal number above 0; relative error of the power below about 1e-5. The mantissa's part by
// the odd series of atanh: log2 m = 2 / ln 2 * (t + t^3/3 + ...), t = (m - 1) / (m + 1), m in [sqrt 1/2, sqrt 2).
template <class L>
VX_HD_FN typename L::F log2_of(typename L::F v) {
    using F = typename L::F;
    using U = typename L::U;
    const U bits = float_bits(v);
    const U shifted = bits + (0x3f800000u - 0x3f3504f3u);
    const auto exponent = as_int(shifted >> 23) - 127;
    const F m = float_of_bits((shifted & 0x7fffffu) + 0x3f3504f3u);
    const F t = (m - 1.0f) / (m + 1.0f), t2 = t * t;
    const F series = 1.0f + t2 * (1.0f / 3.0f + t2 * (1.0f / 5.0f + t2 * (1.0f / 7.0f + t2 * (1.0f / 9.0f))));
    return to_float(exponent) + t * series * 2.88539008f;
}

// 2 to the v, v clamped to -126..126.
template <class L>
VX_HD_FN typename L::F exp2_of(typename L::F v) {
    using F = typename L::F;
    const F x = greatest(least(v, L::f(126.0f)), L::f(-126.0f));
    const auto whole = floor_int<L>(x + 0.5f);
    const F f = (x - to_float(whole)) * 0.693147181f; // -0.35..0.35
    const F e = 1.0f + f * (1.0f + f * (0.5f + f * (1.0f / 6 + f * (1.0f / 24 + f * (1.0f / 120 + f * (1.0f / 720))))));
    return e * float_of_bits(as_uint(whole + 127) << 23);
}

// base to the exponent; 0 where base <= 0.
template <class L>
VX_HD_FN typename L::F power_of(typename L::F base, typename L::F exponent) {
    const auto p = exp2_of<L>(log2_of<L>(greatest(base, L::f(1e-30f))) * exponent);
    return select(base > L::f(0.0f), p, L::f(0.0f));
}

// Sine of v, |v| < 10^6; error below 1e-4 near 0, growing with |v|.
template <class L>
VX_HD_FN typename L::F sine_of(typename L::F v) {
    using F = typename L::F;
    const F turns = v * 0.159154943f;
    F t = turns - to_float(floor_int<L>(turns + 0.5f)); // -0.5..0.5
    t = select(t > L::f(0.25f), 0.5f - t, select(t < L::f(-0.25f), -0.5f - t, t));
    const F x = t * 6.28318531f, x2 = x * x;
    return x * (1.0f - x2 * (1.0f / 6 - x2 * (1.0f / 120 - x2 * (1.0f / 5040))));
}

} // namespace vitrail
