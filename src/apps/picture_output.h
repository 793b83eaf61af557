// Where `vitrail render` puts its pictures: one file, numbered files, or a video; PNG as the eye sees it, EXR as light.
#pragma once

#include "client/still.h"

#include <string>

namespace vitrail::apps {

struct PictureOutput {
    enum class Kind { png, exr, video };
    Kind kind = Kind::png;
    bool numbered = false;
    std::string before, after; // of the number, which has at least `digits`
    u32 digits = 0;

    std::string file(u32 frame) const; // of a numbered output its frame; else the file
};

// By the name: .exr, .mp4, .webm, .mkv, all else PNG. Frames of a path want one number in it, such as %04d, or a video.
// Errors: invalid_argument (no number, several; a video without a path; EXR of the raster renderer).
Result<PictureOutput> plan_output(const std::string& name, bool path, bool traced);

struct ExrFacts {
    u32 spp = 0, seed = 0, bounces = 0;
    bool denoised = false;
    float time = 0; // of day
    client::CameraPose pose;
};
// The tracer's picture so far with all its layers (docs/tracing.md lists them). Errors: io.
Result<> write_traced_exr(const std::string& path, trace::Tracer& tracer, u32 width, u32 height, const ExrFacts& facts);

} // namespace vitrail::apps
