#include "client/trace_options.h"

#include <fmt/format.h>

namespace vitrail::client {

namespace {

constexpr float kRateOfGpu = 30, kRateOfCpu = 10;

#define VX_TRACE(name) [](TraceOptions& o) -> OptionMember { return &o.name; }

const TraceOption kOptions[] = {
    {"hold", "Frame rate",
     "The picture is traced smaller where frames come slower than this a second; 0: 30 on a GPU, 10 on the CPU.",
     VX_TRACE(hold), 0, 240},
    {"scale", "Resolution", "Share of the window's width and height that is traced, at most.", VX_TRACE(scale), 0.3f,
     1},
    {"samples", "Samples", "Paths a pixel in each frame.", VX_TRACE(samples), 1, 64},
    {"bounces", "Bounces", "How often light may scatter on its way.", VX_TRACE(bounces), 0, 16},
    {"denoise", "Denoise", "Earlier frames and neighbors smooth the noise; off: the plain mean since the view rests.",
     VX_TRACE(denoise)},
    {"half", "Quarter of the rays", "Light is traced at half the width and height and brought to full size by edges.",
     VX_TRACE(half)},
    {"fog", "Fog", "Light shows in mist and water.", VX_TRACE(fog)},
    {"fireflies", "Hold fireflies",
     "Radiance that a single indirect sample may bring; 0: any (unbiased, but with specks).", VX_TRACE(fireflies), 0,
     1000},
};

} // namespace

std::span<const TraceOption> trace_option_list() {
    return kOptions;
}

Result<> set_trace_option(TraceOptions& options, std::string_view key, std::string_view value) {
    if (const TraceOption* option = find_option(trace_option_list(), key)) return set_option(*option, options, value);
    return fail(ErrorCode::invalid_argument, fmt::format("the path tracer has no option '{}'", key));
}

std::string trace_options_table() {
    std::string text = "| option | what it does | values | at first |\n|---|---|---|---|\n";
    const TraceOptions usual;
    for (const TraceOption& option : kOptions)
        text += fmt::format("{} {} |\n", option_row(option), option_text(option, usual));
    return text;
}

TraceOptions sane(TraceOptions options) {
    hold_options(trace_option_list(), options, TraceOptions());
    return options;
}

float frame_rate_of(const TraceOptions& options, trace::Device device) {
    if (options.hold > 0) return float(options.hold);
    return device == trace::Device::cuda ? kRateOfGpu : kRateOfCpu;
}

trace::TraceSettings tracer_settings(const TraceOptions& options, float wave_height) {
    trace::TraceSettings settings;
    settings.samples = u32(options.samples);
    settings.bounces = u32(options.bounces);
    settings.denoise = options.denoise;
    settings.half = options.half;
    settings.fog = options.fog;
    settings.firefly_limit = options.fireflies;
    settings.wave_height = wave_height;
    return settings;
}

} // namespace vitrail::client
