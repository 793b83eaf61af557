// Purposes of random numbers: hashes of what they are for. A row's numbers follow from its name and the world's seed
// alone, so a row that is added or moved never changes those of another.
#pragma once

#include "base/hash.h"

#include <string_view>

namespace vitrail {

// FNV-1a (Fowler, Noll, Vo) over the bytes, then mixed. Part of the format of worlds: it never changes.
constexpr u64 purpose_of(std::string_view text) {
    u64 h = 0xcbf29ce484222325ull;
    for (const char c : text)
        h = (h ^ u8(c)) * 0x100000001b3ull;
    return mix64(h);
}
// Of the number-th thing of a kind that has no name of its own.
constexpr u64 purpose_of(std::string_view text, u64 number) {
    return hash_combine(purpose_of(text), number);
}

} // namespace vitrail
