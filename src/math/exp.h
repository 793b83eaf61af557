// Exponential and logarithm without calls: loops over them become vectors, and every CPU finds the same bits. By their
// series, after the range is reduced (Cody and Waite, "Software Manual for the Elementary Functions", 1980).
// Kernel-safe; on a GPU its own.
#pragma once

#include "base/hd.h"
#include "base/types.h"

#include <cmath>

namespace vitrail {

// e^x within 3e-7 of itself; x is held within -87..88.
VX_HD float exp_of(float x) {
#ifdef __CUDA_ARCH__
    return expf(x);
#else
    x = x > -87.0f ? x : -87.0f;
    x = x < 88.0f ? x : 88.0f;
    const i32 k = i32(x * 1.44269504f + (x < 0 ? -0.5f : 0.5f));
    const float n = float(k), r = (x - n * 0.693359375f) + n * 2.12194440e-4f; // ln 2 in two parts; |r| < 0.35
    const float e = 1 + r * (1 + r * (0.5f + r * (1.0f / 6 + r * (1.0f / 24 + r * (1.0f / 120 + r * (1.0f / 720))))));
    const u32 bits = u32(k + 127) << 23; // 2^k
    float scale;
    __builtin_memcpy(&scale, &bits, sizeof scale);
    return e * scale;
#endif
}

// The natural logarithm of a normal number above 0, within 2e-7 of itself or 1e-7.
VX_HD float log_of(float x) {
#ifdef __CUDA_ARCH__
    return logf(x);
#else
    u32 bits;
    __builtin_memcpy(&bits, &x, sizeof bits);
    const i32 k = i32(bits - 0x3f3504f3u) >> 23; // x = 2^k m, m from the root of a half to that of two
    const u32 part = bits - (u32(k) << 23);
    float m;
    __builtin_memcpy(&m, &part, sizeof m);
    const float s = (m - 1) / (m + 1), z = s * s, n = float(k);
    const float l = 2 * s * (1 + z * (1.0f / 3 + z * (1.0f / 5 + z * (1.0f / 7 + z * (1.0f / 9)))));
    return n * 0.693359375f + (l - n * 2.12194440e-4f);
#endif
}

} // namespace vitrail
