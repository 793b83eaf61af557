// The wave's kernels between its start and its finish, launched in the order of paths.cu. How many paths a round has is
// known to the device alone; so launches are as large as the device, and warps take what there is.
#pragma once

#include "trace/cuda/wave.h"

namespace vitrail::trace::cuda {

void launch_wave_closest(const WaveJob& j, u32 round, CUstream_st* stream);
void launch_wave_lights(const WaveJob& j, u32 round, CUstream_st* stream);
void launch_surfaces(const WaveJob& j, u32 round, CUstream_st* stream);
void launch_skies(const WaveJob& j, u32 round, CUstream_st* stream);
void launch_rest(const WaveJob& j, CUstream_st* stream);

} // namespace vitrail::trace::cuda
