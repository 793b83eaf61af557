// The film of a CUDA tracer: planes in the memory of one device, the same stages in the same order as trace/film/.
#pragma once

#include "trace/cuda/launch.h"
#include "trace/cuda/memory.h"
#include "trace/film/layout.h"

#include <vector>

namespace vitrail::trace::cuda {

class DeviceFilm {
public:
    explicit DeviceFilm(const Gpu& gpu)
        : gpu_(gpu) {}

    // See Film::begin. Errors: limit (memory of the device).
    Result<> begin(const Camera& now, const FilmSettings& settings, bool changed);
    // After the samples were put, by kernels on the device's stream.
    Result<> finish();
    void forget() { frames_ = 0, samples_ = 0; }

    const FilmPlanes& planes() const { return planes_; }
    const FilmFrame& frame() const { return frame_; }
    u32 samples() const { return samples_; }
    u64 bytes() const { return memory_.size() + layer_.size(); }

    // Floats, row by row from the top. Waits for the device.
    Result<std::vector<float>> read(FilmLayer layer);

private:
    Result<> resize(u32 width, u32 height);

    const Gpu& gpu_;
    DeviceBytes memory_, layer_;
    FilmPlanes planes_;
    FilmFrame frame_;
    u32 frames_ = 0, samples_ = 0;
};

} // namespace vitrail::trace::cuda
