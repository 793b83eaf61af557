// Tracer on the CPU: tiles of the picture on the pool's threads.
#pragma once

#include "trace/film/film.h"
#include "trace/frame_setup.h"
#include "trace/scene_host.h"
#include "trace/tracer.h"

namespace vitrail::trace {

class CpuTracer final : public Tracer {
public:
    explicit CpuTracer(const TracerOptions& options);

    Result<> set_content(const scene::BlockModels& models, const StateTable& states,
                         const scene::BlockPictures* pictures) override;
    void set_chunk(ChunkPos at, DimensionId dimension, ChunkPtr chunk, const scene::TintGrid* tints) override;
    void clear() override;
    Result<> render(const scene::FrameView& frame, const TraceSettings& settings) override;
    std::vector<float> read(Layer layer) override;
    Result<> write_texture(u32 texture) override;
    void forget_frames() override;
    const TracerStats& stats() const override { return stats_; }
    Device device() const override { return Device::cpu; }

private:
    ThreadPool* pool_;
    SceneHost scene_;
    Film film_;
    FrameWatch watch_;
    TracerStats stats_;
    u32 frames_ = 0; // since forget_frames: numbers the samples of a pixel's sequence
};

} // namespace vitrail::trace
