// What a player chooses of the path tracer in the game, described once (trace_options.cpp): key for the settings file
// and the command line, label and help for the menu, range. `vitrail render` has options of its own.
//
//     TraceOptions options;
//     VX_TRY(set_trace_option(options, "bounces", "2"));
#pragma once

#include "base/options.h"
#include "base/result.h"
#include "base/types.h"
#include "trace/tracer.h"

#include <span>
#include <string>
#include <string_view>

namespace vitrail::client {

struct TraceOptions {
    i32 hold = 0;    // frames a second; 0: as many as suit the device
    float scale = 1; // of the window's width and height, at most
    i32 samples = 1; // a pixel and frame
    i32 bounces = 4;
    bool denoise = true;
    bool half = false; // rays for a quarter of the pixels
    bool fog = true;
    float fireflies = 24; // radiance of one indirect contribution, at most; 0: unbiased
    bool operator==(const TraceOptions&) const = default;
};

using TraceOption = OptionOf<TraceOptions>;
std::span<const TraceOption> trace_option_list();

// Errors: invalid_argument, for an unknown key or a value of the wrong kind or outside its range (the line names
// what is allowed). option_text (base/options.h) shows a value as this reads it.
Result<> set_trace_option(TraceOptions& options, std::string_view key, std::string_view value);
std::string trace_options_table();       // Markdown (docs/tracing.md)
TraceOptions sane(TraceOptions options); // every value inside its range

// Frames a second to hold on this device.
float frame_rate_of(const TraceOptions& options, trace::Device device);
// wave_height: blocks, 0 without waves.
trace::TraceSettings tracer_settings(const TraceOptions& options, float wave_height);

} // namespace vitrail::client
