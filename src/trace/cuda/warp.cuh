// Warps that share out work and places.
#pragma once

#include "base/types.h"

#include <cuda_runtime.h>

namespace vitrail::trace::cuda {

// A place for each lane that is here: one addition for all of them.
struct Append {
    __device__ u32 operator()(u32& counter) const {
        const u32 here = __activemask(), lane = threadIdx.x % 32;
        const int first = __ffs(int(here)) - 1;
        u32 base = 0;
        if (int(lane) == first) base = atomicAdd(&counter, u32(__popc(here)));
        return __shfl_sync(here, base, first) + u32(__popc(here & ((1u << lane) - 1)));
    }
};

// The next 32 of what a whole warp takes in turns.
__device__ inline u32 take_32(u32& counter) {
    u32 base = 0;
    if (threadIdx.x % 32 == 0) base = atomicAdd(&counter, 32u);
    return __shfl_sync(~0u, base, 0);
}

// All lanes of the warp call it.
__device__ inline void add_count(unsigned long long* to, u32 value) {
    for (u32 step = 16; step > 0; step /= 2)
        value += __shfl_xor_sync(~0u, value, int(step));
    if (value && threadIdx.x % 32 == 0) atomicAdd(to, value);
}

// Blocks that fill the device that is current, of a kernel whose warps take work until there is none.
template <class Kernel>
u32 blocks_at_once(Kernel* kernel, int block) {
    int device = 0, each = 0, cores = 0;
    cudaGetDevice(&device);
    cudaDeviceGetAttribute(&cores, cudaDevAttrMultiProcessorCount, device);
    cudaOccupancyMaxActiveBlocksPerMultiprocessor(&each, kernel, block, 0);
    return u32(each > 0 ? each * cores : 1);
}

} // namespace vitrail::trace::cuda
