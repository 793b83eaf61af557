#include "client/trace_options.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <optional>

namespace vitrail::client {

namespace {

using Member = TraceOption::Member;
constexpr float kRateOfGpu = 30, kRateOfCpu = 10;

#define VX_TRACE(name) [](TraceOptions& o) -> Member { return &o.name; }

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

std::string allowed(const TraceOption& option) {
    TraceOptions any;
    const Member member = option.member(any);
    if (std::holds_alternative<bool*>(member)) return "true or false";
    return fmt::format("a {}number from {} to {}", std::holds_alternative<i32*>(member) ? "whole " : "", option.least,
                       option.most);
}

template <class T>
std::optional<T> number(std::string_view text) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
}

} // namespace

std::span<const TraceOption> trace_option_list() {
    return kOptions;
}

Result<> set_trace_option(TraceOptions& options, std::string_view key, std::string_view value) {
    for (const TraceOption& option : kOptions) {
        if (key != option.key) continue;
        const auto wrong = [&] {
            return fail(ErrorCode::invalid_argument, fmt::format("{} is {}, not '{}'", key, allowed(option), value));
        };
        const auto fits = [&](auto x) { return float(x) >= option.least && float(x) <= option.most; };
        const Member member = option.member(options);
        if (bool* const* b = std::get_if<bool*>(&member)) {
            const bool yes = value == "true" || value == "on" || value == "1";
            if (!yes && value != "false" && value != "off" && value != "0") return wrong();
            **b = yes;
        } else if (i32* const* i = std::get_if<i32*>(&member)) {
            const auto x = number<i32>(value);
            if (!x || !fits(*x)) return wrong();
            **i = *x;
        } else {
            const auto x = number<float>(value);
            if (!x || !fits(*x)) return wrong();
            *std::get<float*>(member) = *x;
        }
        return {};
    }
    return fail(ErrorCode::invalid_argument, fmt::format("the path tracer has no option '{}'", key));
}

std::string trace_option_text(const TraceOptions& options, const TraceOption& option) {
    TraceOptions copy = options;
    return std::visit([](auto* value) { return fmt::format("{}", *value); }, option.member(copy));
}

std::string trace_options_table() {
    std::string text = "| option | what it does | values | at first |\n|---|---|---|---|\n";
    const TraceOptions usual;
    for (const TraceOption& option : kOptions)
        text += fmt::format("| `{}` | {}: {} | {} | {} |\n", option.key, option.label, option.help, allowed(option),
                            trace_option_text(usual, option));
    return text;
}

TraceOptions sane(TraceOptions options) {
    TraceOptions usual;
    for (const TraceOption& option : kOptions) {
        const Member member = option.member(options);
        if (i32* const* i = std::get_if<i32*>(&member)) **i = std::clamp(**i, i32(option.least), i32(option.most));
        if (float* const* f = std::get_if<float*>(&member))
            **f = **f == **f ? std::clamp(**f, option.least, option.most) : *std::get<float*>(option.member(usual));
    }
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
