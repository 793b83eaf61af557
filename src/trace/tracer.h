// Tracer: pictures by path tracing, on the CPU or a CUDA device, from the same FrameView that the raster renderer
// takes.
//
//     VX_TRY_ASSIGN(auto tracer, Tracer::create({.device = Device::cpu}));
//     VX_TRY(tracer->set_content(models, states, pictures));  // what blocks look like; again after others or new
//     states tracer->set_chunk(at, dimension, chunk, tints);         // as chunks come, change (null: goes)
//     VX_TRY(tracer->render(frame, {.samples = 1}));          // one frame: traced, reprojected, filtered
//     tracer->read(Layer::color)                              // linear HDR, rows from the top
//
// One thread uses it. Memory: see stats().
#pragma once

#include "base/result.h"
#include "jobs/thread_pool.h"
#include "scene/block_model.h"
#include "scene/frame_view.h"
#include "voxel/chunk.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace vitrail::scene {
struct BlockPictures;
struct TintGrid;
} // namespace vitrail::scene

namespace vitrail::trace {

enum class Device : u8 { cpu, cuda, best }; // best: CUDA where it works, else the CPU

struct TracerOptions {
    Device device = Device::cpu;
    u32 devices_most = 1;       // CUDA: picture rows are split over so many
    ThreadPool* pool = nullptr; // CPU work; null: the calling thread alone
    u32 window_chunks = 64;     // side of the window, a power of two, 4..128
    bool stages = false;        // CUDA: tell TracerStats::stages, which costs a little time
};

// One frame.
struct TraceSettings {
    u32 samples = 1; // a pixel of this frame
    u32 bounces = 4;
    bool denoise = true;    // reprojection of earlier frames and spatial filter; false: the plain mean
    bool accumulate = true; // while nothing moves the mean of all frames since is kept
    bool half = false;      // rays for a quarter of the pixels, brought to the full size by the guides
    bool fog = true;
    float firefly_limit = 0; // 0: unbiased; play holds single contributions to a multiple of this
    float wave_height = 0.06f;
    u32 seed = 0;
};

enum class Layer : u8 { color, albedo, normal, distance, samples };

// Part of a frame's tracing on a device.
struct TraceStage {
    std::string name;
    double ms = 0;
    u32 items = 0; // paths or rays that it had
};

struct TracerStats {
    u64 rays = 0, paths = 0;                            // of the last frame: all rays; camera paths
    u64 dropped = 0;                                    // of these: no numbers, or no light; not in the picture
    u32 samples = 0;                                    // a pixel, since the view changed
    double trace_ms = 0, denoise_ms = 0, update_ms = 0; // of the last frame
    u64 host_bytes = 0, device_bytes = 0;
    u32 chunks = 0, emitters = 0;
    std::string device;
    std::vector<TraceStage> stages; // where it was asked for: of trace_ms on the first device, in order
    bool shown_directly = false; // the last write_texture stayed on the device
};

class Tracer {
public:
    // Errors: unsupported (no CUDA device, one too old, or built without), limit (its memory), invalid_argument.
    static Result<std::unique_ptr<Tracer>> create(const TracerOptions& options);
    // Why create could not make one on this device, asked without making any. Errors: unsupported.
    static Result<> possible_on(Device device);
    virtual ~Tracer() = default;

    // States known now, and their pictures (null: those of the last call). Errors: limit (device memory).
    virtual Result<> set_content(const scene::BlockModels& models, const StateTable& states,
                                 const scene::BlockPictures* pictures) = 0;
    // chunk null: not there any more. tints null: plain. Takes effect with the next frame.
    virtual void set_chunk(ChunkPos at, DimensionId dimension, ChunkPtr chunk, const scene::TintGrid* tints) = 0;
    virtual void clear() = 0;
    // Traces view 0 of the frame. Errors: invalid_argument (no view, size 0 or above 16384), limit.
    virtual Result<> render(const scene::FrameView& frame, const TraceSettings& settings) = 0;
    // The mean so far (denoised where it was asked for): 3 floats a pixel, 1 for distance and samples.
    virtual std::vector<float> read(Layer layer) = 0;
    // Into an OpenGL texture (RGBA16F or RGBA32F, of the frame's size), of the current context: color, and the distance
    // in blocks as alpha (0: sky). CUDA writes it on the device where it can.
    virtual Result<> write_texture(u32 texture) = 0;
    virtual void forget_frames() = 0; // next frame stands for itself
    virtual const TracerStats& stats() const = 0;
    virtual Device device() const = 0; // cpu or cuda
};

} // namespace vitrail::trace
