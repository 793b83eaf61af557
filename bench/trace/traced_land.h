// The sample land with the base content's looks, for benches of whole tracers.
#pragma once

#include "trace/tracer.h"
#include "world/state_table.h"

namespace vitrail::bench {

// A tracer that holds the land, with its noon frame. Errors: the tracer's, the content's.
struct TracedLand {
    static Result<std::unique_ptr<TracedLand>> open(const trace::TracerOptions& options);
    // The camera of camera_rays; `step` blocks further to the south.
    scene::FrameView frame(u32 width, u32 height, float step = 0) const;

    std::unique_ptr<StateTable> states;
    scene::BlockModels models;
    std::unique_ptr<trace::Tracer> tracer; // uses the models
};

} // namespace vitrail::bench
