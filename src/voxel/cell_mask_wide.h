// What cell_mask.cpp calls where the CPU has AVX-512 (cell_mask_avx512.cpp). Masks are 64 words each, one after
// another.
#pragma once

#include "base/types.h"

namespace vitrail::wide {

bool available();
// out[cell] = table16[4-bit index of the cell]; words: 256 of them
void map_nibbles(const u64* words, const u8* table16, u8* out);
void classify_nibbles(const u64* words, const u8* table16, u32 count, u64* out);
void classify_bytes(const u8* cells, u32 count, u64* out);

} // namespace vitrail::wide
