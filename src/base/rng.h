// Counter-based random numbers: a pure function of (world seed, purpose, x, y, z, counter).
// No state, so the answer does not depend on the order of chunks, threads or devices.
#pragma once

#include "base/hash.h"

namespace vitrail {

struct RngKey {
    u64 seed = 0;    // world seed
    u32 purpose = 0; // one constant for each use, so that two uses never share a stream
};

VX_HD constexpr u64 random_u64(RngKey key, i32 x, i32 y, i32 z, u32 counter = 0) {
    u64 h = mix64(key.seed ^ (u64(key.purpose) * 0xd1342543de82ef95ull));
    h = mix64(h ^ u32(x)) + 0x9e3779b97f4a7c15ull;
    h = mix64(h ^ (u64(u32(z)) << 32 | u32(y)));
    return mix64(h + u64(counter) * 0x9e3779b97f4a7c15ull);
}

// Uniform in [0, 1) with 24 bits, the same on every device.
VX_HD constexpr float random_unit(RngKey key, i32 x, i32 y, i32 z, u32 counter = 0) {
    return float(random_u64(key, x, y, z, counter) >> 40) * (1.0f / 16777216.0f);
}

// Sequential generator for tests, tools and shuffles; never for terrain.
class Rng {
public:
    explicit constexpr Rng(u64 seed)
        : state_(seed) {}
    constexpr u64 next() { return mix64(state_ += 0x9e3779b97f4a7c15ull); }
    // Uniform in [0, bound), bound > 0; bias below 2^-32 for bounds below 2^32.
    constexpr u32 below(u32 bound) { return u32(((next() >> 32) * bound) >> 32); }
    constexpr float unit() { return float(next() >> 40) * (1.0f / 16777216.0f); }

private:
    u64 state_;
};

} // namespace vitrail
