#include "terrain/cpu/stages_impl.h"

namespace vitrail {

TerrainStages stages_avx2();
TerrainStages stages_avx2() {
    return make_stages<int(Isa::avx2)>();
}

} // namespace vitrail
