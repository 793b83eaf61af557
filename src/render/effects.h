// Effects: every switch and number of the raster renderer, described once (effects.cpp): its key for settings files and
// the command line, its label and help for the menu, its range, its value in each preset. Passes read the plain struct.
//
//     Effects effects = preset_effects(Preset::high);
//     VX_TRY(set_effect(effects, "shadows.distance", "96"));
//     for (const EffectOption& option : effect_options()) menu(option, effects);
#pragma once

#include "base/options.h"
#include "base/result.h"
#include "base/types.h"

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace vitrail::render {

// off: light levels alone. low: for software OpenGL. ultra: for large GPUs.
enum class Preset : u8 { off, low, medium, high, ultra, count };

enum class Clouds : i32 { off, flat, lit };
enum class Antialias : i32 { off, fxaa, taa };

struct Effects {
    struct Resolution {
        float scale = 1; // of the window's width and height, that the world is drawn at
        i32 hold = 0;    // frames a second for which the game draws it smaller still (scene/resolution.h); 0: never
        bool operator==(const Resolution&) const = default;
    } resolution;
    struct Shadows {
        bool on = false;
        i32 cascades = 3, size = 2048; // texels a side of one cascade
        float distance = 96;           // blocks that shadows reach
        i32 samples = 12;              // of the penumbra's filter; 1: hard edge
        float softness = 1;            // of the sun's disc, 1 as in nature times a taste (shadow_pass.h)
        bool colored = true;           // stained glass and water tint the light
        bool operator==(const Shadows&) const = default;
    } shadows;
    struct Ssao {
        bool on = false;
        i32 samples = 8;
        float radius = 1.2f, strength = 1; // blocks
        bool operator==(const Ssao&) const = default;
    } ssao;
    struct Reflections {
        bool on = false;
        i32 steps = 24;
        float roughness = 0.35f; // rougher surfaces reflect the sky alone
        bool operator==(const Reflections&) const = default;
    } reflections;
    struct Bloom {
        bool on = false;
        i32 levels = 5;
        float strength = 0.06f; // share of the light that the lens scatters
        bool operator==(const Bloom&) const = default;
    } bloom;
    struct Water {
        bool waves = true, swell = false, refraction = false, caustics = false;
        float wave_height = 0.06f; // blocks
        bool operator==(const Water&) const = default;
    } water;
    struct Fog {
        bool height = true;     // mist that lies low
        bool volumetric = false; // shafts of light
        i32 steps = 16;
        float density = 1; // 1: as the sky of the hour says
        bool operator==(const Fog&) const = default;
    } fog;
    struct Exposure {
        bool automatic = true;
        float bias = 0; // stops
        float speed = 1.2f; // shares of the way a second, by which the eye adapts
        bool operator==(const Exposure&) const = default;
    } exposure;
    struct Sky {
        i32 clouds = i32(Clouds::flat); // Clouds
        bool stars = true;
        bool operator==(const Sky&) const = default;
    } sky;
    struct Surface {
        bool normal_maps = false, sway = false, smooth = false; // smooth: filtered minification, blended tints
        bool operator==(const Surface&) const = default;
    } surface;
    struct Culling {
        bool caves = true, occlusion = false;
        bool operator==(const Culling&) const = default;
    } culling;
    i32 antialias = i32(Antialias::off); // Antialias
    bool dither = true;
    bool operator==(const Effects&) const = default;
};

// The part of the key before the dot is the menu's group.
struct EffectOption : OptionOf<Effects> {
    std::array<float, u32(Preset::count)> presets{}; // booleans as 0 and 1, choices by number
};

std::span<const EffectOption> effect_options();
const EffectOption* find_effect(std::string_view key); // null where there is none

Effects preset_effects(Preset preset);
const char* preset_name(Preset preset);
std::optional<Preset> preset_from(std::string_view name);
// The preset whose values these all are; none: the player's own.
std::optional<Preset> preset_of(const Effects& effects);

// Errors: invalid_argument, for an unknown key or a value of the wrong kind or outside its range (the line names what is
// allowed). option_text (base/options.h) shows a value as this reads it.
Result<> set_effect(Effects& effects, std::string_view key, std::string_view value);
// The table of all options as Markdown (docs/effects.md).
std::string effects_table();
// Frames of one moment after which a picture is as good as it gets: 1 where nothing builds up from frame to frame.
u32 settling_frames(const Effects& effects);
// Every value held inside its range; what needs something that is off goes off with it.
Effects sane(Effects effects);

} // namespace vitrail::render
