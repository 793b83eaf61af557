#include "apps/trace_pictures.h"

#include "base/clock.h"

#include <algorithm>

namespace vitrail::apps {

Result<> trace_picture(client::Still& still, const client::CameraPose& pose, const TracedPicture& wanted,
                       const std::atomic<bool>& stop, ProgressLine& progress, TracedStats& stats) {
    trace::TraceSettings settings;
    settings.bounces = wanted.bounces;
    settings.denoise = wanted.denoise;
    settings.seed = wanted.seed;
    const u64 start = now_ns();
    if (wanted.forget) still.tracer().forget_frames();
    for (u32 done = 0; done < wanted.spp; done += settings.samples) {
        if (stop) return fail(ErrorCode::denied, "interrupted");
        settings.samples = std::min(wanted.spp - done, wanted.denoise ? 1u : 4u);
        VX_TRY(still.trace(pose, wanted.width, wanted.height, wanted.time, settings));
        const trace::TracerStats& frame = still.tracer().stats();
        stats.rays += frame.rays, stats.paths += frame.paths, stats.dropped += frame.dropped;
        progress.step(settings.samples);
    }
    stats.seconds += seconds_since(start);
    return {};
}

} // namespace vitrail::apps
