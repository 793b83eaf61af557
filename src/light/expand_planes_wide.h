// What expand_planes.cpp calls where the CPU has AVX-512 (expand_planes_avx512.cpp).
#pragma once

#include "base/types.h"

namespace vitrail::wide {

bool can_expand_planes();
// slices: 16 masks of 64 words; cells: 4096 values of 16 bits.
void expand_planes(const u64* slices, u32 lit_channels, void* cells);

} // namespace vitrail::wide
