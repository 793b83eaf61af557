// AVX-512 paths of cell_mask.cpp, called only where the CPU has them; they give the same bits as the portable ones.
// Nothing inline from other headers may be compiled here: the linker could pick that copy for every CPU.
#include "base/types.h"
#include "voxel/cell_mask_wide.h"

#if defined(__AVX512BW__)
#include <immintrin.h>
#endif

namespace vitrail::wide {

#if defined(__AVX512BW__)

bool available() {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") &&
           __builtin_cpu_supports("avx512vl");
}

static __m512i map_64_nibbles(const u64* words, __m512i table) {
    // 32 bytes of nibble pairs, spread to 64 bytes in cell order
    const __m512i pairs = _mm512_cvtepu8_epi16(_mm256_loadu_si256(reinterpret_cast<const __m256i*>(words)));
    const __m512i cells = _mm512_and_si512(_mm512_or_si512(pairs, _mm512_slli_epi16(pairs, 4)), _mm512_set1_epi8(15));
    return _mm512_shuffle_epi8(table, cells);
}

// maskz: g++ 12 warns of its own plain broadcast.
static __m512i load_table(const u8* table16) {
    return _mm512_maskz_broadcast_i32x4(0xffff, _mm_loadu_si128(reinterpret_cast<const __m128i*>(table16)));
}

void map_nibbles(const u64* words, const u8* table16, u8* out) {
    const __m512i table = load_table(table16);
    for (u32 w = 0; w < 64; ++w)
        _mm512_storeu_si512(out + w * 64, map_64_nibbles(words + w * 4, table));
}

void classify_nibbles(const u64* words, const u8* table16, u32 count, u64* out) {
    const __m512i table = load_table(table16);
    for (u32 w = 0; w < 64; ++w) {
        const __m512i classes = map_64_nibbles(words + w * 4, table);
        for (u32 k = 0; k < count; ++k)
            out[k * 64 + w] = _mm512_test_epi8_mask(classes, _mm512_set1_epi8(char(1u << k)));
    }
}

void classify_bytes(const u8* cells, u32 count, u64* out) {
    for (u32 w = 0; w < 64; ++w) {
        const __m512i classes = _mm512_loadu_si512(cells + w * 64);
        for (u32 k = 0; k < count; ++k)
            out[k * 64 + w] = _mm512_test_epi8_mask(classes, _mm512_set1_epi8(char(1u << k)));
    }
}

#else

bool available() {
    return false;
}
void map_nibbles(const u64*, const u8*, u8*) {}
void classify_nibbles(const u64*, const u8*, u32, u64*) {}
void classify_bytes(const u8*, u32, u64*) {}

#endif

} // namespace vitrail::wide
