// Where the time of a frame's launches goes, for who asks (TracerOptions::stages). Host only.
#pragma once

#include "trace/cuda/memory.h"
#include "trace/tracer.h"

#include <vector>

namespace vitrail::trace::cuda {

// Of one stream. Marks follow each other; what lies between two of them is a stage.
class StageClock {
public:
    explicit StageClock(const Gpu& gpu)
        : gpu_(gpu) {}
    StageClock(const StageClock&) = delete;
    StageClock& operator=(const StageClock&) = delete;
    ~StageClock();

    void begin();
    // The launches since the last mark were `stage`. items: of the device, how much they had to do.
    void mark(std::string stage, const u32* items);
    // Waits for the device. Errors: io.
    Result<std::vector<TraceStage>> read();

private:
    void record(std::size_t event);

    static constexpr u32 kMost = 1024; // stages; those beyond go untold
    const Gpu& gpu_;
    std::vector<cudaEvent_t> events_; // a stage's begin and end, 2 n and 2 n + 1
    std::vector<std::string> names_;
    PinnedBytes items_;
};

} // namespace vitrail::trace::cuda
