// Parts of the CUDA tracer by themselves, on the first device, for tests and benches: rays through a mirrored scene,
// and the film fed with samples from the host.
#pragma once

#include "base/result.h"
#include "trace/cuda/mirror_source.h"
#include "trace/film/layout.h"
#include "trace/kernel/film.h"

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace vitrail::trace::cuda {

class RayProbe {
public:
    // Errors: unsupported (no device, built without CUDA), limit (memory).
    static Result<std::unique_ptr<RayProbe>> open();
    virtual ~RayProbe() = default;

    virtual Result<> update(const MirrorSource& source) = 0;
    // alike: neighbors go similar ways, as from a camera.
    virtual Result<> set_rays(std::span<const Ray> rays, bool alike = false) = 0;
    // All rays at once, in a medium. Returns the launch's milliseconds, of the device's clock.
    virtual Result<double> closest(u32 medium) = 0;
    virtual Result<double> shadows(u32 medium) = 0;
    // Of the last closest, shadows.
    virtual Result<std::vector<Hit>> hits() = 0;
    virtual Result<std::vector<u8>> lit() = 0;
    virtual u64 sent_bytes() const = 0; // of the scene, since open
};

class FilmProbe {
public:
    static Result<std::unique_ptr<FilmProbe>> open();
    virtual ~FilmProbe() = default;

    // As Film: the camera to trace with; then all pixels' samples, row by row; then the picture.
    virtual Result<Camera> begin(const Camera& now, const FilmSettings& settings, bool changed) = 0;
    virtual Result<> put(std::span<const SampleMean> means) = 0;
    virtual Result<double> finish() = 0;              // milliseconds
    virtual Result<std::vector<float>> color() = 0;   // 3 floats a pixel
    virtual Result<std::vector<float>> samples() = 0; // 1
};

} // namespace vitrail::trace::cuda
