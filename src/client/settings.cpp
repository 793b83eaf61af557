#include "client/settings.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <toml++/toml.h>
#include <unistd.h>

namespace vitrail::client {

namespace fs = std::filesystem;

Settings sane(Settings s) {
    const Settings defaults;
    auto hold = [](float v, float lo, float hi, float otherwise) { return v == v ? std::clamp(v, lo, hi) : otherwise; };
    s.view_distance = std::clamp(s.view_distance, 2, 32);
    s.fov_deg = hold(s.fov_deg, 40, 110, defaults.fov_deg);
    s.mouse_sensitivity = hold(s.mouse_sensitivity, 0.1f, 4, 1);
    s.gamma = hold(s.gamma, 0.5f, 2, 1);
    s.ui_scale = hold(s.ui_scale, 0.5f, 3, 1);
    s.frame_limit = std::clamp(s.frame_limit, 0, 1000);
    return s;
}

Result<fs::path> settings_path() {
    if (const char* config = std::getenv("XDG_CONFIG_HOME"); config && *config) return fs::path(config) / "vitrail/settings.toml";
    if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".config/vitrail/settings.toml";
    return fail(ErrorCode::not_found, "settings are not kept: neither XDG_CONFIG_HOME nor HOME is set");
}

// One list of keys serves reading and writing.
template <class Visit>
static void each_setting(Settings& s, Visit&& visit) {
    visit("view_distance", s.view_distance);
    visit("fov_deg", s.fov_deg);
    visit("mouse_sensitivity", s.mouse_sensitivity);
    visit("invert_y", s.invert_y);
    visit("vsync", s.vsync);
    visit("fullscreen", s.fullscreen);
    visit("high_quality", s.high_quality);
    visit("gamma", s.gamma);
    visit("ui_scale", s.ui_scale);
    visit("frame_limit", s.frame_limit);
}

Result<Settings> load_settings(const fs::path& path) {
    Settings settings;
    std::error_code ignored;
    if (!fs::exists(path, ignored)) return settings;
    toml::table table;
    try {
        table = toml::parse_file(path.string());
    } catch (const toml::parse_error& error) {
        return fail(ErrorCode::damaged, fmt::format("{}:{}:{}: {}", path.string(), error.source().begin.line,
                                                    error.source().begin.column, error.description()));
    }
    each_setting(settings, [&](const char* key, auto& value) {
        using T = std::remove_reference_t<decltype(value)>;
        if (const auto found = table[key].value<T>()) value = *found;
    });
    return sane(settings);
}

Result<> save_settings(const fs::path& path, const Settings& settings) {
    Settings copy = sane(settings);
    std::string text = "# Vitrail settings, written by the pause menu.\n";
    each_setting(copy, [&](const char* key, auto& value) {
        using T = std::remove_reference_t<decltype(value)>;
        // TOML tells 1.0 (a float) from 1 (an integer).
        if constexpr (std::is_same_v<T, float>) text += fmt::format("{} = {:.4f}\n", key, value);
        else text += fmt::format("{} = {}\n", key, value);
    });
    std::error_code error;
    fs::create_directories(path.parent_path(), error);
    const fs::path draft = fmt::format("{}.{}.part", path.string(), getpid());
    std::ofstream file(draft);
    file << text;
    if (!file.flush()) return fail(ErrorCode::io, fmt::format("settings cannot be written to {}", path.string()));
    file.close();
    fs::rename(draft, path, error);
    if (error) return fail(ErrorCode::io, fmt::format("settings cannot be written to {}: {}", path.string(), error.message()));
    return {};
}

} // namespace vitrail::client
