// The one source of chance in terrain: counter-based, a pure function of (world seed, purpose, x, y, z, counter). The mixing
// step is the "lowbias32" of Wellons (2018), a bijection with low bias; coordinates enter one after another, so that no sum of
// them repeats.
#pragma once

#include "base/hash.h"
#include "terrain/kernel/lanes.h"

namespace vitrail {

struct RandomKey {
    u32 a = 0, b = 0;
};

// purpose: a hash of what the numbers are for (terrain/compile/names.h), never a running number.
VX_HD constexpr RandomKey random_key(u64 seed, u64 purpose) {
    const u64 h = hash_combine(mix64(seed + 0x9e3779b97f4a7c15ull), purpose);
    return {u32(h), u32(h >> 32)};
}

template <class U>
VX_HD U mix_bits(U x) {
    x = x ^ x >> 16;
    x = x * 0x7feb352du;
    x = x ^ x >> 15;
    x = x * 0x846ca68bu;
    return x ^ x >> 16;
}

// 32 random bits for a place; U is u32 or the lanes' U.
template <class U>
VX_HD U random_bits(RandomKey key, U x, U z) {
    return mix_bits(mix_bits(x * 0x9e3779b1u + key.a) ^ (z * 0x85ebca77u + key.b));
}
// The same in three dimensions, in two steps where many blocks of a block column are asked: random_at(random_bits(key, x, z), y).
template <class U, class Y>
VX_HD U random_at(U bits, Y y) {
    return mix_bits(bits + y * 0xc2b2ae3du);
}
template <class U>
VX_HD U random_bits(RandomKey key, U x, U y, U z) {
    return random_at(random_bits(key, x, z), y);
}
// Bits that most blocks of a clump share: those of a cell of 8 x 8 blocks, looked up at a place up to 3 blocks away. What is
// mixed by them meets in ragged clumps, where bits of each block would make grains of salt and pepper. Uniform for every place,
// whatever its neighbors have.
template <class U>
VX_HD U clump_bits(RandomKey key, U x, U z) {
    const U own = random_bits(key, x, z);
    return random_bits(key, (x + (own & 3u)) >> 3, (z + (own >> 2 & 3u)) >> 3);
}
// The counter-th further number from bits of the place.
template <class U>
VX_HD U random_next(U bits, u32 counter) {
    return mix_bits(bits + (counter + 1) * 0x9e3779b9u);
}

// Uniform in [0, 1), 24 bits.
template <class U>
VX_HD auto unit_of(U bits) {
    return to_float(bits >> 8) * (1.0f / 16777216.0f);
}
// Uniform in [0, bound), bound from 1 to 65536.
VX_HD u32 below_of(u32 bits, u32 bound) { return u32((u64(bits) * bound) >> 32); }

} // namespace vitrail
