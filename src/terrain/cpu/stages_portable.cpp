#include "terrain/cpu/stages_impl.h"

namespace vitrail {

TerrainStages stages_avx2();
TerrainStages stages_avx512();

Isa best_isa() {
#if defined(__x86_64__)
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512vbmi") && __builtin_cpu_supports("avx512vbmi2"))
        return Isa::avx512;
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi2")) return Isa::avx2;
#endif
    return Isa::portable;
}

const TerrainStages& terrain_stages(Isa isa) {
#if defined(__x86_64__)
    if (isa == Isa::avx512) {
        static const TerrainStages stages = stages_avx512();
        return stages;
    }
    if (isa == Isa::avx2) {
        static const TerrainStages stages = stages_avx2();
        return stages;
    }
#endif
    (void)isa;
    static const TerrainStages stages = make_stages<int(Isa::portable)>();
    return stages;
}

} // namespace vitrail
