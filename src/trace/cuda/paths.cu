// Paths on a GPU: a thread a pixel, a warp 8 x 4 of them, so that its rays stay together for a while.
#include "trace/cuda/launch.h"
#include "trace/kernel/path.h"

#include <cuda_runtime.h>

namespace vitrail::trace::cuda {

namespace {

constexpr u32 kBlockWide = 8, kBlockHigh = 16;

// The row of the picture that is the n-th of the bands.
__host__ __device__ u32 row_of(u32 n, u32 band, u32 bands) {
    return (n / kBand * bands + band) * kBand + n % kBand;
}

// All lanes of the warp call it.
__device__ void add_count(unsigned long long* to, u32 value) {
    for (u32 step = 16; step > 0; step /= 2)
        value += __shfl_xor_sync(~0u, value, int(step));
    if (value && threadIdx.x % 32 == 0) atomicAdd(to, value);
}

__global__ void __launch_bounds__(kBlockWide* kBlockHigh) paths_kernel(const __grid_constant__ PathJob j) {
    const u32 lane = threadIdx.x;
    const u32 n = blockIdx.y * kBlockHigh + lane / kBlockWide;
    const u32 x = (blockIdx.x * kBlockWide + lane % kBlockWide) * j.step + j.step_x;
    // Bands keep their rows together, also where only every second one is wanted.
    const u32 row = n * j.step + j.step_y, y = row_of(row, j.band, j.bands);
    // Not in registers, which the paths need.
    __shared__ __align__(16) u8 shared_means[kBlockWide * kBlockHigh * sizeof(SampleMean)];
    SampleMean& mean = reinterpret_cast<SampleMean*>(shared_means)[lane];
    u32 rays = 0, paths = 0, dropped = 0;
    if (x < j.film.width && y < j.film.height) {
        mean = SampleMean{};
        for (u32 s = 0; s < j.samples; ++s)
            add_sample(mean, trace_path(j.scene, j.sky, j.frame.now, j.settings, x, y, s, rays));
        paths = j.samples;
        if (j.means)
            j.means[u64(row) * j.film.width + x] = mean;
        else
            dropped = put_samples(j.film, j.frame, x, y, mean);
    }
    add_count(&j.counts->rays, rays);
    add_count(&j.counts->paths, paths);
    add_count(&j.counts->dropped, dropped);
}

__global__ void put_means_kernel(const __grid_constant__ PathJob j) {
    const u32 x = blockIdx.x * blockDim.x + threadIdx.x, row = blockIdx.y, y = row_of(row, j.band, j.bands);
    u32 dropped = 0;
    if (x < j.film.width && y < j.film.height)
        dropped = put_samples(j.film, j.frame, x, y, j.means[u64(row) * j.film.width + x]);
    add_count(&j.counts->dropped, dropped);
}

} // namespace

u32 rows_of_bands(u32 height, u32 band, u32 bands) {
    const u32 all = (height + kBand - 1) / kBand;
    return (all > band ? (all - band - 1) / bands + 1 : 0) * kBand;
}

void launch_paths(const PathJob& job, cudaStream_t stream) {
    const u32 rows = rows_of_bands(job.film.height, job.band, job.bands) / job.step;
    const u32 wide = (job.film.width + job.step - 1) / job.step;
    const dim3 grid((wide + kBlockWide - 1) / kBlockWide, (rows + kBlockHigh - 1) / kBlockHigh);
    if (rows) paths_kernel<<<grid, kBlockWide * kBlockHigh, 0, stream>>>(job);
}

void launch_put_means(const PathJob& job, cudaStream_t stream) {
    const u32 rows = rows_of_bands(job.film.height, job.band, job.bands);
    const dim3 grid((job.film.width + 127) / 128, rows);
    if (rows) put_means_kernel<<<grid, 128, 0, stream>>>(job);
}

} // namespace vitrail::trace::cuda
