#include "terrain/cpu/stages_impl.h"

namespace vitrail {

TerrainStages stages_avx512();
TerrainStages stages_avx512() {
    return make_stages<int(Isa::avx512)>();
}

} // namespace vitrail
