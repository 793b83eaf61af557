// The tracer on a CUDA device: rays by themselves, paths, the film, whole frames. Launches of one frame each, timed by
// the device's clock; frames by the host's.
#include "bench/trace/benches.h"
#include "bench/trace/ray_scene.h"
#include "bench/trace/traced_land.h"
#include "trace/cuda/probe.h"

#include "base/clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

using namespace trace;

constexpr u32 kWidth = 1920, kHeight = 1080;
constexpr int kLaunches = 15;

// Rays of one frame, and a device that holds the land.
struct DeviceLand {
    bench::RayScene land;
    bench::RaySet sets[4];
    std::unique_ptr<cuda::RayProbe> probe;
    std::string why_not;

    DeviceLand() {
        auto opened = cuda::RayProbe::open();
        if (!opened) {
            why_not = opened.error().message;
            return;
        }
        probe = std::move(*opened);
        sets[0] = bench::camera_rays(land, kWidth, kHeight);
        sets[1] = bench::bounce_rays(land, sets[0]);
        sets[2] = bench::bounce_rays(land, sets[1]);
        sets[3] = bench::sun_rays(land, sets[0]);
        cuda::MirrorSource source;
        source.view = land.view();
        source.grid = &land.grid;
        source.media = land.media.size();
        if (const auto done = probe->update(source); !done) {
            why_not = done.error().message;
            probe.reset();
        }
    }
};
DeviceLand& device_land() {
    static DeviceLand land;
    return land;
}

void rays(bench::Context& c, int which) {
    DeviceLand& d = device_land();
    if (!d.probe) return c.skip(d.why_not);
    const auto& set = d.sets[which].rays;
    if (const auto done = d.probe->set_rays(set, which == 0 || which == 3); !done) return c.skip(done.error().message);
    for (int i = -3; i < kLaunches; ++i) {
        const auto ms = which == 3 ? d.probe->shadows(0) : d.probe->closest(0);
        if (!ms) return c.skip(ms.error().message);
        if (i >= 0) c.report(double(set.size()) / *ms * 1e-6);
    }
}

// Hits of all sets that are not the CPU's.
void wrong_hits(bench::Context& c) {
    DeviceLand& d = device_land();
    if (!d.probe) return c.skip(d.why_not);
    u64 wrong = 0;
    for (const bench::RaySet& set : d.sets) {
        for (const bool alike : {false, true}) {
            if (const auto done = d.probe->set_rays(set.rays, alike); !done) return c.skip(done.error().message);
            const auto traced = d.probe->closest(0), shaded = d.probe->shadows(0);
            if (!traced || !shaded) return c.skip("a launch failed");
            const auto hits = d.probe->hits();
            const auto lit = d.probe->lit();
            if (!hits || !lit) return c.skip("reading failed");
            for (std::size_t i = 0; i < set.hits.size(); ++i) {
                const Hit &a = (*hits)[i], &b = set.hits[i];
                const bool same = a.kind == b.kind && a.cell == b.cell && a.face == b.face && a.state == b.state &&
                                  (b.kind == HitKind::nothing || std::fabs(a.t - b.t) <= 1e-5f * (1 + b.t));
                wrong += !same || ((*lit)[i] != 0) != (b.kind == HitKind::nothing);
            }
        }
    }
    c.report(double(wrong));
}

bench::TracedLand* traced_land(bench::Context& c, bool stages = false) {
    static auto plain = bench::TracedLand::open({.device = Device::cuda});
    static auto told = bench::TracedLand::open({.device = Device::cuda, .stages = true});
    auto& land = stages ? told : plain;
    if (land) return land->get();
    c.skip(land.error().message);
    return nullptr;
}

void paths(bench::Context& c) {
    bench::TracedLand* land = traced_land(c);
    if (!land) return;
    const scene::FrameView frame = land->frame(854, 480);
    for (int i = -3; i < kLaunches; ++i) {
        if (const auto done = land->tracer->render(frame, {.denoise = false}); !done)
            return c.skip(done.error().message);
        const TracerStats& s = land->tracer->stats();
        if (i >= 0) c.report(double(s.paths) / s.trace_ms * 1e-3);
    }
}

enum class Part { whole, trace, film };
void frames(bench::Context& c, Part part, bool half) {
    bench::TracedLand* land = traced_land(c);
    if (!land) return;
    float step = 0;
    for (int i = -5; i < 2 * kLaunches; ++i) {
        const scene::FrameView frame = land->frame(kWidth, kHeight, step += 0.1f);
        const u64 start = now_ns();
        if (const auto done = land->tracer->render(frame, {.half = half}); !done) return c.skip(done.error().message);
        const double ms = seconds_since(start) * 1e3;
        const TracerStats& s = land->tracer->stats();
        if (i >= 0) c.report(part == Part::whole ? ms : part == Part::trace ? s.trace_ms : s.denoise_ms);
    }
}

// Milliseconds of a frame that the launches take whose stage is called so.
void stage(bench::Context& c, std::string_view name) {
    bench::TracedLand* land = traced_land(c, true);
    if (!land) return;
    float step = 0;
    for (int i = -3; i < kLaunches; ++i) {
        const scene::FrameView frame = land->frame(kWidth, kHeight, step += 0.1f);
        if (const auto done = land->tracer->render(frame, {}); !done) return c.skip(done.error().message);
        double ms = 0;
        for (const TraceStage& s : land->tracer->stats().stages)
            if (s.name.starts_with(name)) ms += s.ms;
        if (i >= 0) c.report(ms);
    }
}

} // namespace

void register_trace_cuda_benches(bench::Suite& suite) {
    suite.add("trace.cuda.primary", "Grays/s", "1920x1080, a launch", [](bench::Context& c) { rays(c, 0); });
    suite.add("trace.cuda.bounce1", "Grays/s", "one from each hit", [](bench::Context& c) { rays(c, 1); });
    suite.add("trace.cuda.bounce2", "Grays/s", "and on from there", [](bench::Context& c) { rays(c, 2); });
    suite.add("trace.cuda.shadow", "Grays/s", "to the sun", [](bench::Context& c) { rays(c, 3); });
    suite.add("trace.cuda.wrong", "hits", "that are not the CPU's, of all these rays", wrong_hits);
    suite.add("path.cuda", "Mpaths/s", "854x480, 4 bounces", paths);
    suite.add("denoise.cuda", "ms", "1920x1080, walking", [](bench::Context& c) { frames(c, Part::film, false); });
    suite.add("frame.cuda", "ms", "1920x1080, 1 sample, 4 bounces, denoised, walking",
              [](bench::Context& c) { frames(c, Part::whole, false); });
    suite.add("frame.cuda.trace", "ms", "of that: paths", [](bench::Context& c) { frames(c, Part::trace, false); });
    suite.add("frame.cuda.half", "ms", "light for a quarter of the pixels",
              [](bench::Context& c) { frames(c, Part::whole, true); });
    for (const char* name : {"start", "closest", "sky", "surface", "light", "rest", "finish"})
        suite.add(std::string("frame.cuda.stage.") + name, "ms", "of that paths: all rounds of these kernels",
                  [name](bench::Context& c) { stage(c, name); });
}

} // namespace vitrail
