#include "terrain/cpu/noise_rows_impl.h"

namespace vitrail {

NoiseRows noise_rows_avx2();
NoiseRows noise_rows_avx512();

const NoiseRows& noise_rows(Isa isa) {
#if defined(__x86_64__)
    if (isa == Isa::avx512) {
        static const NoiseRows rows = noise_rows_avx512();
        return rows;
    }
    if (isa == Isa::avx2) {
        static const NoiseRows rows = noise_rows_avx2();
        return rows;
    }
#endif
    (void)isa;
    static const NoiseRows rows = make_noise_rows<int(Isa::portable)>();
    return rows;
}

} // namespace vitrail
