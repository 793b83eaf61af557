// AVX-512 path of expand_planes: a mask register spreads 32 bits to 32 cells at once.
#include "base/types.h"
#include "light/expand_planes_wide.h"

#if defined(__AVX512BW__)
#include <immintrin.h>
#endif

namespace vitrail::wide {

#if defined(__AVX512BW__)

bool can_expand_planes() {
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw");
}

void expand_planes(const u64* slices, u32 lit_channels, void* cells) {
    for (u32 w = 0; w < 64; ++w) {
        __m512i low = _mm512_setzero_si512(), high = low;
        for (u32 channel = 0; channel < 4; ++channel) {
            if (!(lit_channels >> channel & 1)) continue;
            for (u32 bit = channel * 4; bit < channel * 4 + 4; ++bit) {
                const u64 word = slices[bit * 64 + w];
                const __m512i value = _mm512_set1_epi16(short(1u << bit));
                low = _mm512_or_si512(low, _mm512_maskz_mov_epi16(u32(word), value));
                high = _mm512_or_si512(high, _mm512_maskz_mov_epi16(u32(word >> 32), value));
            }
        }
        _mm512_storeu_si512(static_cast<char*>(cells) + w * 128, low);
        _mm512_storeu_si512(static_cast<char*>(cells) + w * 128 + 64, high);
    }
}

#else

bool can_expand_planes() {
    return false;
}
void expand_planes(const u64*, u32, void*) {}

#endif

} // namespace vitrail::wide
