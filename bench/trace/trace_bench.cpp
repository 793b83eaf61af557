#include "bench/trace/benches.h"

void register_trace_benches(vitrail::bench::Suite& suite);
void register_trace_benches(vitrail::bench::Suite& suite) {
    vitrail::register_ray_benches(suite);
    vitrail::register_path_benches(suite);
    vitrail::register_light_benches(suite);
    vitrail::register_denoise_benches(suite);
    vitrail::register_shade_benches(suite);
    vitrail::register_trace_cuda_benches(suite);
}
