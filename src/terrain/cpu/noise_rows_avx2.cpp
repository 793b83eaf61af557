#include "terrain/cpu/noise_rows_impl.h"

namespace vitrail {

NoiseRows noise_rows_avx2();
NoiseRows noise_rows_avx2() {
    return make_noise_rows<int(Isa::avx2)>();
}

} // namespace vitrail
