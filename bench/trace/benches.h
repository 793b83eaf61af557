// Benches of this folder, a file each; trace_bench.cpp registers them all.
#pragma once

#include "bench/harness.h"

namespace vitrail {

void register_trace_cuda_benches(bench::Suite& suite);
void register_denoise_benches(bench::Suite& suite);
void register_shade_benches(bench::Suite& suite);
void register_ray_benches(bench::Suite& suite);
void register_path_benches(bench::Suite& suite);
void register_light_benches(bench::Suite& suite);

} // namespace vitrail
