#include "render/effects.h"

#include <fmt/format.h>

namespace vitrail::render {

namespace {

constexpr const char* kClouds[] = {"off", "flat", "lit"};
constexpr const char* kAntialias[] = {"off", "fxaa", "taa"};

#define VX_EFFECT(path) [](Effects& e) -> OptionMember { return &e.path; }

// Values in the order off, low, medium, high, ultra.
const EffectOption kOptions[] = {
    {{"resolution.scale", "Resolution", "Share of the window's width and height at which the world is drawn.", VX_EFFECT(resolution.scale), 0.5f, 1}, {1, 1, 1, 1, 1}},
    {{"resolution.hold", "Hold a frame rate", "Draws the world at less (down to 0.6) where frames come slower than this a second; 0: never.", VX_EFFECT(resolution.hold), 0, 240}, {30, 30, 30, 0, 0}},
    {{"shadows.on", "Shadows", "Sun and moon cast shadows.", VX_EFFECT(shadows.on), 0, 1}, {0, 0, 1, 1, 1}},
    {{"shadows.cascades", "Cascades", "Shadow maps, one behind the other.", VX_EFFECT(shadows.cascades), 1, 4}, {2, 2, 3, 4, 4}},
    {{"shadows.size", "Resolution", "Texels a side of a shadow map.", VX_EFFECT(shadows.size), 256, 8192}, {1024, 1024, 1024, 2048, 2048}},
    {{"shadows.distance", "Distance", "How far shadows reach, in blocks.", VX_EFFECT(shadows.distance), 16, 512}, {64, 64, 96, 160, 256}},
    {{"shadows.samples", "Samples", "Of the filter that makes edges soft; 1 leaves them hard.", VX_EFFECT(shadows.samples), 1, 64}, {1, 4, 8, 12, 20}},
    {{"shadows.softness", "Softness", "Width of the edges, 1 for the sun's own.", VX_EFFECT(shadows.softness), 0, 8}, {1, 1, 1, 1, 1}},
    {{"shadows.colored", "Colored light", "Stained glass and water tint the light that they let through.", VX_EFFECT(shadows.colored), 0, 1}, {0, 0, 1, 1, 1}},
    {{"ssao.on", "Ambient occlusion", "Corners that see little of the sky grow dark.", VX_EFFECT(ssao.on), 0, 1}, {0, 0, 0, 1, 1}},
    {{"ssao.samples", "Samples", "Looks around each pixel.", VX_EFFECT(ssao.samples), 4, 64}, {6, 6, 6, 8, 16}},
    {{"ssao.radius", "Radius", "How far it looks, in blocks.", VX_EFFECT(ssao.radius), 0.1f, 8}, {1.2f, 1.2f, 1.2f, 1.2f, 1.2f}},
    {{"ssao.strength", "Strength", "1 as computed.", VX_EFFECT(ssao.strength), 0, 2}, {1, 1, 1, 1, 1}},
    {{"reflections.on", "Reflections", "Water and polished surfaces mirror what is on the screen.", VX_EFFECT(reflections.on), 0, 1}, {0, 0, 0, 1, 1}},
    {{"reflections.steps", "Steps", "Of a reflected ray.", VX_EFFECT(reflections.steps), 8, 128}, {16, 16, 16, 24, 48}},
    {{"reflections.roughness", "Roughest", "Rougher surfaces mirror nothing.", VX_EFFECT(reflections.roughness), 0, 1}, {0.3f, 0.3f, 0.3f, 0.35f, 0.5f}},
    {{"bloom.on", "Bloom", "Bright light spreads a little, as in a lens.", VX_EFFECT(bloom.on), 0, 1}, {0, 0, 1, 1, 1}},
    {{"bloom.levels", "Levels", "Each doubles the reach.", VX_EFFECT(bloom.levels), 2, 8}, {4, 4, 5, 6, 7}},
    {{"bloom.strength", "Strength", "Share of the light that spreads.", VX_EFFECT(bloom.strength), 0, 0.5f}, {0.05f, 0.05f, 0.05f, 0.05f, 0.05f}},
    {{"water.waves", "Waves", "The surface moves.", VX_EFFECT(water.waves), 0, 1}, {0, 1, 1, 1, 1}},
    {{"water.wave_height", "Wave height", "In blocks.", VX_EFFECT(water.wave_height), 0, 0.1f}, {0.06f, 0.06f, 0.06f, 0.06f, 0.06f}},
    {{"water.swell", "Swell", "Waves near the eye bend the surface.", VX_EFFECT(water.swell), 0, 1}, {0, 0, 0, 1, 1}},
    {{"water.refraction", "Refraction", "What lies under water is seen through its waves.", VX_EFFECT(water.refraction), 0, 1}, {0, 0, 1, 1, 1}},
    {{"water.caustics", "Caustics", "Waves gather the sun on the ground below.", VX_EFFECT(water.caustics), 0, 1}, {0, 0, 0, 1, 1}},
    {{"fog.height", "Mist", "Fog that lies in the valleys, most in the morning.", VX_EFFECT(fog.height), 0, 1}, {0, 1, 1, 1, 1}},
    {{"fog.density", "Density", "1 as the hour has it.", VX_EFFECT(fog.density), 0, 8}, {1, 1, 1, 1, 1}},
    {{"fog.volumetric", "Shafts of light", "Sunlight shows in the air between shadows.", VX_EFFECT(fog.volumetric), 0, 1}, {0, 0, 0, 1, 1}},
    {{"fog.steps", "Steps", "Of the light's way through the air.", VX_EFFECT(fog.steps), 4, 64}, {8, 8, 8, 12, 24}},
    {{"exposure.automatic", "Automatic exposure", "The eye grows used to bright and dark.", VX_EFFECT(exposure.automatic), 0, 1}, {0, 1, 1, 1, 1}},
    {{"exposure.bias", "Exposure", "In stops.", VX_EFFECT(exposure.bias), -4, 4}, {0, 0, 0, 0, 0}},
    {{"exposure.speed", "Speed", "Of adapting.", VX_EFFECT(exposure.speed), 0.1f, 10}, {1.2f, 1.2f, 1.2f, 1.2f, 1.2f}},
    {{"sky.clouds", "Clouds", "Flat, or lit by the sun.", VX_EFFECT(sky.clouds), 0, 2, kClouds}, {0, 1, 2, 2, 2}},
    {{"sky.stars", "Stars", "At night.", VX_EFFECT(sky.stars), 0, 1}, {1, 1, 1, 1, 1}},
    {{"surface.normal_maps", "Relief", "Textures catch the light.", VX_EFFECT(surface.normal_maps), 0, 1}, {0, 0, 1, 1, 1}},
    {{"surface.sway", "Wind", "Leaves and grass sway.", VX_EFFECT(surface.sway), 0, 1}, {0, 0, 1, 1, 1}},
    {{"surface.smooth", "Filtered textures", "Far surfaces do not flicker.", VX_EFFECT(surface.smooth), 0, 1}, {0, 0, 1, 1, 1}},
    {{"culling.caves", "Cave culling", "Draws only where lines of sight lead.", VX_EFFECT(culling.caves), 0, 1}, {1, 1, 1, 1, 1}},
    {{"culling.occlusion", "Occlusion culling", "Leaves out what lies behind what is drawn.", VX_EFFECT(culling.occlusion), 0, 1}, {0, 0, 1, 1, 1}},
    {{"antialias", "Antialiasing", "Smooth edges: fxaa cheap, taa best.", VX_EFFECT(antialias), 0, 2, kAntialias}, {0, 0, 1, 2, 2}},
    {{"dither", "Dithering", "No bands in soft gradients.", VX_EFFECT(dither), 0, 1}, {1, 1, 1, 1, 1}},
};

constexpr const char* kPresets[] = {"off", "low", "medium", "high", "ultra"};

void assign(OptionMember member, float value) {
    if (bool** b = std::get_if<bool*>(&member)) **b = value != 0;
    if (i32** i = std::get_if<i32*>(&member)) **i = i32(value);
    if (float** f = std::get_if<float*>(&member)) **f = value;
}

} // namespace

std::span<const EffectOption> effect_options() {
    return kOptions;
}

const EffectOption* find_effect(std::string_view key) {
    return find_option(effect_options(), key);
}

Effects preset_effects(Preset preset) {
    Effects effects;
    for (const EffectOption& option : kOptions)
        assign(option.member(effects), option.presets[u32(preset)]);
    return effects;
}

const char* preset_name(Preset preset) {
    return kPresets[u32(preset)];
}

std::optional<Preset> preset_from(std::string_view name) {
    for (u32 i = 0; i < u32(Preset::count); ++i)
        if (name == kPresets[i]) return Preset(i);
    return std::nullopt;
}

std::optional<Preset> preset_of(const Effects& effects) {
    for (u32 i = 0; i < u32(Preset::count); ++i)
        if (effects == preset_effects(Preset(i))) return Preset(i);
    return std::nullopt;
}

Result<> set_effect(Effects& effects, std::string_view key, std::string_view value) {
    const EffectOption* option = find_effect(key);
    if (!option) return fail(ErrorCode::invalid_argument, fmt::format("there is no effect '{}'", key));
    return set_option(*option, effects, value);
}

std::string effects_table() {
    std::string text = "| effect | what it does | values | off | low | medium | high | ultra |\n|---|---|---|---|---|---|---|---|\n";
    for (const EffectOption& option : kOptions) {
        text += option_row(option);
        for (u32 i = 0; i < u32(Preset::count); ++i)
            text += fmt::format(" {} |", option_text(option, preset_effects(Preset(i))));
        text += "\n";
    }
    return text;
}

Effects sane(Effects effects) {
    hold_options(effect_options(), effects, preset_effects(Preset::high));
    if (!effects.shadows.on) effects.fog.volumetric = false; // shafts are what the shadow maps cut out of the mist
    return effects;
}

u32 settling_frames(const Effects& effects) {
    return Antialias(effects.antialias) == Antialias::taa ? 16 : 1;
}

} // namespace vitrail::render
