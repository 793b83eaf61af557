// Benchmarks of terrain.
#include "bench/harness.h"

namespace vitrail {
void register_noise_benches(bench::Suite& suite);
void register_stage_benches(bench::Suite& suite);
void register_cuda_benches(bench::Suite& suite);
} // namespace vitrail

void register_terrain_benches(vitrail::bench::Suite& suite);
void register_terrain_benches(vitrail::bench::Suite& suite) {
    vitrail::register_noise_benches(suite);
    vitrail::register_stage_benches(suite);
    vitrail::register_cuda_benches(suite);
}
