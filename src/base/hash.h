// Integer hashes: kernel-safe mixing, and XXH3 for bytes.
#pragma once

#include "base/hd.h"
#include "base/types.h"

#include <cstddef>
#include <span>

namespace vitrail {

// Finalizer of SplitMix64 (Steele, Lea, Flood 2014): a bijection whose output bits all depend on all input bits.
VX_HD constexpr u64 mix64(u64 x) {
    x ^= x >> 30;
    x *= 0xbf58476d1ce4e5b9ull;
    x ^= x >> 27;
    x *= 0x94d049bb133111ebull;
    x ^= x >> 31;
    return x;
}

VX_HD constexpr u64 hash_combine(u64 a, u64 b) {
    return mix64(a ^ (b * 0x9e3779b97f4a7c15ull + 0x7f4a7c15u));
}

} // namespace vitrail
