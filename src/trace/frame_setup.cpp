#include "trace/frame_setup.h"

#include "trace/boxes.h"

#include <cmath>
#include <fmt/format.h>

namespace vitrail::trace {

Camera camera_of(const scene::FrameView& frame, u32 medium) {
    const scene::View& view = frame.views[0];
    const auto& m = view.rotation.m;
    const float t = std::tan(view.fov_y * 0.5f), aspect = float(frame.width) / float(frame.height);
    Camera c;
    c.eye = place_of(view.eye.at);
    c.right = Vec3{m[0], m[4], m[8]} * (t * aspect);
    c.up = Vec3{m[1], m[5], m[9]} * t;
    c.forward = {-m[2], -m[6], -m[10]};
    c.width = frame.width, c.height = frame.height;
    c.medium = medium;
    return c;
}

PathSettings path_settings_of(const TraceSettings& settings, u32 first_sample) {
    PathSettings p;
    p.bounces = settings.bounces;
    p.firefly_limit = settings.firefly_limit;
    p.fog = settings.fog;
    p.seed = settings.seed;
    p.first_sample = first_sample;
    return p;
}

FilmSettings film_settings_of(const TraceSettings& settings) {
    FilmSettings f;
    f.denoise = settings.denoise;
    f.accumulate = settings.accumulate;
    f.half = settings.half;
    f.samples = settings.samples;
    return f;
}

Result<> check_frame(const scene::FrameView& frame, const TraceSettings& settings) {
    if (frame.views.empty()) return fail(ErrorCode::invalid_argument, "a frame without a view");
    if (frame.width == 0 || frame.height == 0 || frame.width > 16384 || frame.height > 16384)
        return fail(ErrorCode::invalid_argument,
                    fmt::format("a picture of {}x{} cannot be traced", frame.width, frame.height));
    if (settings.samples == 0 || settings.samples > 65536)
        return fail(ErrorCode::invalid_argument,
                    fmt::format("{} samples a pixel: 1 to 65536 are possible", settings.samples));
    return {};
}

bool FrameWatch::changed(const scene::FrameView& frame, const TraceSettings& settings, u64 world) {
    const DimensionId dimension = frame.views[0].eye.dimension;
    const bool same = any_ && frame.sky.time == time_ && world == world_ && dimension == dimension_ &&
                      settings.bounces == settings_.bounces && settings.fog == settings_.fog &&
                      settings.firefly_limit == settings_.firefly_limit &&
                      settings.wave_height == settings_.wave_height && settings.seed == settings_.seed;
    time_ = frame.sky.time, world_ = world, settings_ = settings, dimension_ = dimension;
    any_ = true;
    return !same;
}

} // namespace vitrail::trace
