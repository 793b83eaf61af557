#include "terrain/cpu/noise_rows_impl.h"

namespace vitrail {

NoiseRows noise_rows_avx512();
NoiseRows noise_rows_avx512() {
    return make_noise_rows<int(Isa::avx512)>();
}

} // namespace vitrail
