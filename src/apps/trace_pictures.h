// `vitrail render --renderer trace`: samples until there are enough, with progress.
#pragma once

#include "apps/progress_line.h"
#include "client/still.h"

namespace vitrail::apps {

struct TracedPicture {
    u32 width = 854, height = 480;
    float time = 6000;
    u32 spp = 64;
    u32 bounces = 4;
    bool denoise = true;
    u32 seed = 0;
    bool forget = true; // earlier pictures; else they help, where the filter is on
};

struct TracedStats {
    u64 rays = 0, paths = 0, dropped = 0; // see TracerStats
    double seconds = 0;
};

// Traces and adds to `stats`; afterwards Still::develop gives what the eye sees, Still::tracer().read the layers.
// Progress grows by a step a sample. Errors: the tracer's; denied where `stop` turned true.
Result<> trace_picture(client::Still& still, const client::CameraPose& pose, const TracedPicture& wanted,
                       const std::atomic<bool>& stop, ProgressLine& progress, TracedStats& stats);

} // namespace vitrail::apps
