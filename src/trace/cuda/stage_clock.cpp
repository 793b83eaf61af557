#if VITRAIL_CUDA

#include "trace/cuda/stage_clock.h"

namespace vitrail::trace::cuda {

StageClock::~StageClock() {
    for (cudaEvent_t e : events_)
        cudaEventDestroy(e);
}

void StageClock::record(std::size_t event) {
    while (events_.size() <= event) {
        cudaEvent_t made = nullptr;
        cudaEventCreate(&made);
        events_.push_back(made);
    }
    cudaEventRecord(events_[event], gpu_.stream);
}

void StageClock::begin() {
    names_.clear();
    record(0);
}

void StageClock::mark(std::string stage, const u32* items) {
    const std::size_t n = names_.size();
    if (n == kMost || !items_.reach({}, kMost * sizeof(u32))) return;
    record(2 * n + 1);
    u32* to = items_.as<u32>() + n;
    *to = 0;
    cudaMemcpyAsync(to, items, sizeof(u32), cudaMemcpyDeviceToHost, gpu_.stream);
    record(2 * n + 2); // copying is no part of any stage
    names_.push_back(std::move(stage));
}

Result<std::vector<TraceStage>> StageClock::read() {
    VX_TRY(gpu_.wait());
    std::vector<TraceStage> stages;
    for (std::size_t n = 0; n < names_.size(); ++n) {
        float ms = 0;
        VX_TRY(check(cudaEventElapsedTime(&ms, events_[2 * n], events_[2 * n + 1]), "asking for times"));
        stages.push_back({names_[n], double(ms), items_.as<u32>()[n]});
    }
    return stages;
}

} // namespace vitrail::trace::cuda

#endif
