// What a player chose in the pause menu, kept as TOML in $XDG_CONFIG_HOME/vitrail/settings.toml (else ~/.config).
#pragma once

#include "base/result.h"
#include "base/types.h"
#include "client/controls.h"
#include "client/trace_options.h"
#include "render/effects.h"

#include <filesystem>
#include <string>
#include <vector>

namespace vitrail::client {

struct Settings {
    i32 view_distance = 12;      // chunks, 2..32
    float fov_deg = 75;          // 40..110
    float mouse_sensitivity = 1; // 0.1..4; 1 turns 0.12 degrees a pixel
    bool invert_y = false;
    bool vsync = true;
    bool fullscreen = false;
    render::Effects effects = render::preset_effects(render::Preset::high); // kept as a preset and what differs from it
    TraceOptions trace;  // of the path tracer
    float gamma = 1;     // exposure, 0.5..2
    float ui_scale = 1;  // 0.5..3
    i32 frame_limit = 0; // frames a second, 0 none
    Bindings controls;
    std::vector<std::string> packs; // paths of resource packs, the later over the earlier; at most 64
    bool operator==(const Settings&) const = default;
};

// Values held inside their ranges.
Settings sane(Settings settings);

// Errors: not_found where neither XDG_CONFIG_HOME nor HOME is set.
Result<std::filesystem::path> settings_path();
// Defaults where there is no file; a key that is missing, unknown or of a wrong type keeps its default. Errors: damaged, where
// the file is no TOML (message says line and column).
Result<Settings> load_settings(const std::filesystem::path& path);
// Written beside and renamed. Errors: io.
Result<> save_settings(const std::filesystem::path& path, const Settings& settings);

} // namespace vitrail::client
