// Film: frames of samples become pictures, on the CPU. The stages are kernels of trace/kernel/ (film.h, upscale.h,
// reproject.h, filter.h, resolve.h), which a CUDA backend runs over the same planes (film/layout.h) in the same order
// (film/stages.h).
//
//     film.resize(1280, 720);
//     const Camera& c = film.begin(camera, settings, something_changed); // trace with c: its jitter is the film's
//     for each pixel, on any thread: film.put(x, y, sample); or fill film.frame()
//     film.finish(&pool);
//     film.color()
//
// With denoise off the picture is the plain mean of all samples since the view rests: unbiased. With it on, the filter
// is driven by the variance of what it filters, so it fades as samples gather, and from 64 samples a pixel on at rest
// the plain mean takes its place step by step; from 4,096 on it is all.
#pragma once

#include "base/types.h"
#include "jobs/thread_pool.h"
#include "trace/film/layout.h"
#include "trace/kernel/film.h"

#include <atomic>
#include <memory>
#include <span>
#include <vector>

namespace vitrail::trace {

// How the stages are run over rows; which depends on the CPU's vectors.
struct FilmStages;

class Film {
public:
    Film();
    ~Film();

    // Forgets all. Sizes 1..16384.
    void resize(u32 width, u32 height);
    // A frame begins. `now` must have the film's size. changed: light or world are not those of the last frame (edits,
    // time, settings of the tracer). The camera to trace with: denoised, one jitter for all pixels; else 0, and the
    // sampler spreads rays over the pixel.
    const Camera& begin(const Camera& now, const FilmSettings& settings, bool changed);
    // Is light wanted for the pixel? Half mode: else bounces and air can be left out.
    bool wants_light(u32 x, u32 y) const { return light_wanted(frame_, x, y); }
    // All samples of a pixel in this frame. Threads may put different pixels.
    void put(u32 x, u32 y, const SampleMean& mean);
    void put(u32 x, u32 y, const PixelSample& sample);
    // One record a pixel, to be filled between begin and finish, instead of put.
    std::span<PixelSample> frame();
    // Makes the picture. pool null: in this thread.
    void finish(ThreadPool* pool);

    u32 width() const { return planes_.width; }
    u32 height() const { return planes_.height; }
    std::span<const Vec4> color() const; // linear radiance; distance in blocks, 0 sky
    // Of first surfaces: means over the samples at rest, else this frame's. Rows from the top.
    std::vector<float> albedo() const;   // 3 floats a pixel
    std::vector<float> normal() const;   // 3, unit or 0
    std::vector<float> distance() const; // 1, blocks
    std::vector<float> counts() const;   // 1, sound samples since the view rests
    // Samples a pixel since the view rests (denoised: since the frame after, which is when it shows).
    u32 samples() const { return samples_; }
    u64 dropped() const { return dropped_; } // samples that were no light, since resize
    u64 bytes() const { return memory_.size() * sizeof(float) + records_.size() * sizeof(PixelSample); }
    // The next frame stands for itself.
    void forget();

    const FilmPlanes& planes() const { return planes_; } // tests
    const FilmFrame& state() const { return frame_; }

private:
    FilmPlanes planes_;
    FilmFrame frame_;
    FilmSettings settings_;
    std::vector<float> memory_;
    std::vector<PixelSample> records_;
    bool use_records_ = false;
    u32 frames_ = 0; // since forget
    u32 samples_ = 0;
    std::atomic<u64> dropped_{0};
    const FilmStages* stages_;
};

} // namespace vitrail::trace
