#include "apps/trace_pictures.h"

#include "base/clock.h"

#include <fmt/format.h>
#include <unistd.h>

namespace vitrail::apps {

constexpr double kProgressSeconds = 0.5;

static std::string time_text(double seconds) {
    const u64 s = u64(seconds + 0.5);
    return s < 60 ? fmt::format("{} s", s) : s < 3600 ? fmt::format("{}:{:02} min", s / 60, s % 60) : fmt::format("{}:{:02} h", s / 3600, s / 60 % 60);
}

Result<TracedStats> trace_picture(client::Still& still, const client::CameraPose& pose, const TracedPicture& wanted,
                                  const std::atomic<bool>& stop) {
    trace::TraceSettings settings;
    settings.bounces = wanted.bounces;
    settings.denoise = wanted.denoise;
    settings.seed = wanted.seed;
    TracedStats stats;
    const u64 start = now_ns();
    double told = 0;
    const bool line = wanted.progress && isatty(2);
    still.tracer().forget_frames();
    for (u32 done = 0; done < wanted.spp;) {
        if (stop) return fail(ErrorCode::denied, "interrupted");
        settings.samples = std::min(wanted.spp - done, wanted.denoise ? 1u : 4u);
        VX_TRY(still.trace(pose, wanted.width, wanted.height, wanted.time, settings));
        done += settings.samples;
        stats.rays += still.tracer().stats().rays, stats.paths += still.tracer().stats().paths;
        const double seconds = seconds_since(start);
        if (line && seconds - told > kProgressSeconds) {
            told = seconds;
            fmt::print(stderr, "\r{} of {} samples a pixel, {} left   ", done, wanted.spp, time_text(seconds * (wanted.spp - done) / done));
        }
    }
    stats.seconds = seconds_since(start);
    if (line && told > 0) fmt::print(stderr, "\r{} samples a pixel in {}                  \n", wanted.spp, time_text(stats.seconds));
    return stats;
}

} // namespace vitrail::apps
