// Four channels of light at once: a Light's nibbles spread to the bytes of a u32 (sky, green, red, blue from the
// lowest), so that one subtraction serves all of them. Every byte stays below 0x80.
#pragma once

#include "base/types.h"
#include "voxel/light_volume.h"

namespace vitrail {

constexpr u32 kLaneTops = 0x80808080u;
constexpr u32 kLaneOnes = 0x01010101u;

constexpr u32 spread_light(Light l) {
    return (u32(l.bits) & 0x0f0f) | (u32(l.bits) & 0xf0f0) << 12;
}
constexpr Light pack_light(u32 s) {
    return Light(u16((s & 0x0f0f) | (s >> 12 & 0xf0f0)));
}

// Each lane of a less that of b, not below 0.
constexpr u32 lanes_minus(u32 a, u32 b) {
    const u32 t = (a | kLaneTops) - b;
    const u32 k = t & kLaneTops;
    return t & (k - (k >> 7));
}
constexpr u32 lanes_less(u32 a, u32 cost) {
    return lanes_minus(a, cost * kLaneOnes);
}
constexpr u32 lanes_max(u32 a, u32 b) {
    return b + lanes_minus(a, b);
}
// 0x7f in each lane where a and b agree.
constexpr u32 lanes_equal(u32 a, u32 b) {
    const u32 k = ((a ^ b) | kLaneTops) - kLaneOnes; // top bit stays where they differ
    const u32 e = ~k & kLaneTops;
    return e - (e >> 7);
}
// 0x7f in each lane that is not 0.
constexpr u32 lanes_lit(u32 a) {
    const u32 k = ((a | kLaneTops) - kLaneOnes) & kLaneTops;
    return k - (k >> 7);
}

constexpr u32 kSkyLane = 0x7f;
constexpr u32 kSkyFull = 15;

} // namespace vitrail
