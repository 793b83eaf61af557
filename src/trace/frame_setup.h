// From a FrameView to what kernels read of a frame, the same for every device.
#pragma once

#include "scene/frame_view.h"
#include "trace/film/layout.h"
#include "trace/kernel/camera.h"
#include "trace/kernel/path_settings.h"
#include "trace/tracer.h"

namespace vitrail::trace {

// View 0. medium: that its eye is in (SceneView::media).
Camera camera_of(const scene::FrameView& frame, u32 medium);

PathSettings path_settings_of(const TraceSettings& settings, u32 first_sample);
FilmSettings film_settings_of(const TraceSettings& settings);

// Errors: invalid_argument (no view, size 0 or above 16384, no samples).
Result<> check_frame(const scene::FrameView& frame, const TraceSettings& settings);

// Tells whether a frame shows another light than the last one: time of day, blocks, pictures, settings. That the camera
// moved is the film's to see.
class FrameWatch {
public:
    // world: a number that grows with every change of blocks or looks.
    bool changed(const scene::FrameView& frame, const TraceSettings& settings, u64 world);
    void forget() { any_ = false; }

private:
    float time_ = 0;
    u64 world_ = 0;
    TraceSettings settings_;
    DimensionId dimension_{};
    bool any_ = false;
};

} // namespace vitrail::trace
