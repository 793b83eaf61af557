// Paths on a GPU: they all begin, go on an event at a time, each kind of work in a kernel of its own whose lanes do the
// same, and end in the film.
#include "trace/cuda/warp.cuh"
#include "trace/cuda/wave_launch.h"
#include "trace/cuda/wave_memory.h"
#include "trace/cuda/wave_steps.h"

namespace vitrail::trace::cuda {

namespace {

constexpr u32 kBlock = 128;

__global__ void __launch_bounds__(kBlock) start_kernel(const __grid_constant__ WaveJob j) {
    const u32 path = blockIdx.x * kBlock + threadIdx.x;
    if (path < j.pixels * j.job.samples) start_step(j, path, Append{});
}

__global__ void __launch_bounds__(kBlock) finish_kernel(const __grid_constant__ WaveJob j) {
    const u32 pixel = blockIdx.x * kBlock + threadIdx.x;
    add_count(&j.job.counts->dropped, pixel < j.pixels ? finish_step(j, pixel) : 0);
    if (pixel > 0) return;
    u64 rays = 0;
    for (u32 round = 0; round < j.rounds; ++round)
        rays += j.wave.rounds[round].rays.n + j.wave.rounds[round].lights.n;
    j.job.counts->rays += rays; // no other kernel is under way
    j.job.counts->paths += j.wave.rounds[0].rays.n;
}

__global__ void put_means_kernel(const __grid_constant__ PathJob j) {
    const u32 x = blockIdx.x * blockDim.x + threadIdx.x, row = blockIdx.y, y = row_of(row, j.band, j.bands);
    u32 dropped = 0;
    if (x < j.film.width && y < j.film.height)
        dropped = put_samples(j.film, j.frame, x, y, j.means[u64(row) * j.film.width + x]);
    add_count(&j.counts->dropped, dropped);
}

} // namespace

void launch_paths(const PathJob& job, const WavePlan& plan, const Wave& wave, const StageMark& mark,
                  const WaveStreams& streams) {
    const cudaStream_t stream = streams.main, lights = streams.lights;
    const auto told = [&](const char* stage, u32 round, const WaveRound::Count& items) {
        if (mark) mark(stage, round, &items.n);
    };
    // What comes in `then` begins after all that `first` has so far.
    const auto order = [](cudaStream_t first, cudaEvent_t by, cudaStream_t then) {
        if (first == then) return;
        cudaEventRecord(by, first);
        cudaStreamWaitEvent(then, by, 0);
    };
    for (u32 k = 0; k < plan.batches(); ++k) {
        const WaveJob j = wave_batch(job, plan, wave, k);
        cudaMemsetAsync(wave.rounds, 0, sizeof(WaveRound) * (plan.rounds + 1), stream);
        start_kernel<<<(j.pixels * job.samples + kBlock - 1) / kBlock, kBlock, 0, stream>>>(j);
        told("start", k, wave.rounds[0].rays);
        for (u32 round = 0; round < plan.rounds; ++round) {
            const WaveRound& now = wave.rounds[round];
            launch_wave_closest(j, round, stream);
            told("closest", round, now.rays);
            // The last round's light is there before this one's events add to it: sums have one order. And only then
            // may its rays be overwritten.
            order(lights, streams.arrived, stream);
            launch_skies(j, round, stream);
            told("sky", round, now.missed);
            launch_surfaces(j, round, stream);
            told("surface", round, now.met);
            order(stream, streams.sent, lights);
            launch_wave_lights(j, round, lights);
            told("light", round, now.lights);
        }
        order(lights, streams.arrived, stream);
        launch_rest(j, stream);
        told("rest", k, wave.rounds[plan.rounds].rays);
        finish_kernel<<<(j.pixels + kBlock - 1) / kBlock, kBlock, 0, stream>>>(j);
        told("finish", k, wave.rounds[0].rays);
    }
}

void launch_put_means(const PathJob& job, cudaStream_t stream) {
    const u32 rows = rows_of_bands(job.film.height, job.band, job.bands);
    const dim3 grid((job.film.width + 127) / 128, rows);
    if (rows) put_means_kernel<<<grid, 128, 0, stream>>>(job);
}

} // namespace vitrail::trace::cuda
