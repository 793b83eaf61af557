// The CUDA backend: the same kernels as on the CPU, a thread a block column, many columns a launch. One binary serves
// machines with and without a GPU.
#pragma once

#include "terrain/batch.h"

namespace vitrail {

struct CudaOptions {
    i32 device = 0;
    u32 batches = 2;           // under way at once, each with a stream, device memory and pinned host memory of its own
    u32 columns_most = 1024;   // of one batch; a batch of that size takes about 600 MB of device memory
    unsigned pack_threads = 0; // host threads that make chunks; 0: those of the caller
};

// Errors: not_found (built without CUDA, or no device or driver: says which), io.
Result<std::unique_ptr<ColumnBatchMaker>> open_cuda_batches(std::shared_ptr<const TerrainGenerator> generator,
                                                            CudaOptions options = {});
// One line for `vitrail doctor`: the devices, or why there are none.
std::string cuda_summary();

} // namespace vitrail
