// The frames of a camera path, drawn or traced one after the other, into numbered files or a video.
#pragma once

#include "apps/picture_output.h"
#include "apps/trace_pictures.h"
#include "scene/camera_path.h"

namespace vitrail::apps {

struct PathFrames {
    scene::CameraPath path;
    double fps = 30;
    u32 frames = 1;
    bool traced = false;
    TracedPicture picture; // size, samples, filter; the time of day is the path's
};

// The pose and the time of day at a moment of the path.
client::CameraPose pose_of(const scene::CameraMoment& moment, DimensionId dimension);
// path: the file. seconds: how much of it. Errors: those of the file, which the message names; limit (too many frames).
Result<PathFrames> open_path(const std::string& file, double fps, std::optional<double> seconds,
                             const scene::CameraMoment& otherwise);
// Errors: those of drawing and writing; denied where `stop` turned true, which says what is there by then.
Result<TracedStats> render_path(client::Still& still, const PathFrames& wanted, const PictureOutput& output,
                                const std::atomic<bool>& stop);

} // namespace vitrail::apps
