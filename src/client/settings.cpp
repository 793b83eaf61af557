#include "client/settings.h"

#include "platform/key_names.h"

#include <algorithm>
#include <cstdlib>
#include <fmt/format.h>
#include <fstream>
#include <sstream>
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
    s.packs.resize(std::min<std::size_t>(s.packs.size(), 64));
    s.effects = render::sane(s.effects);
    s.trace = sane(s.trace);
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
    visit("gamma", s.gamma);
    visit("ui_scale", s.ui_scale);
    visit("frame_limit", s.frame_limit);
}

static void read_packs(const toml::table& table, std::vector<std::string>& packs) {
    const toml::array* list = table["packs"].as_array();
    if (!list) return;
    for (const toml::node& node : *list)
        if (const auto path = node.value_exact<std::string>(); path && !path->empty()) packs.push_back(*path);
}

static std::string packs_text(const std::vector<std::string>& packs) {
    toml::array list;
    for (const std::string& path : packs) list.push_back(path);
    std::ostringstream text; // the library quotes what a path may hold
    text << "packs = " << list << "\n";
    return text.str();
}

// A value as the tables of options read it; empty where it is of no kind they know.
static std::string text_of(const toml::node& node) {
    if (const auto text = node.value_exact<std::string>()) return *text;
    if (const auto yes = node.value_exact<bool>()) return *yes ? "true" : "false";
    if (const auto whole = node.value_exact<i64>()) return fmt::format("{}", *whole);
    if (const auto number = node.value_exact<double>()) return fmt::format("{}", float(*number));
    return {};
}

// quality = "PRESET" and a table [effects] of what the player changed in it.
static void read_effects(const toml::table& table, render::Effects& effects) {
    if (const auto name = table["quality"].value<std::string>())
        if (const auto preset = render::preset_from(*name)) effects = render::preset_effects(*preset);
    const toml::table* changes = table["effects"].as_table();
    if (!changes) return;
    for (const render::EffectOption& option : render::effect_options()) {
        // What does not fit keeps the preset's value.
        if (const toml::node* node = changes->get(option.key)) (void)render::set_effect(effects, option.key, text_of(*node));
    }
}

static std::string effects_text(const render::Effects& effects) {
    // The preset from which fewest values differ.
    u32 nearest = 0, fewest = ~0u;
    for (u32 i = 0; i < u32(render::Preset::count); ++i) {
        const render::Effects preset = render::preset_effects(render::Preset(i));
        u32 differ = 0;
        for (const render::EffectOption& option : render::effect_options())
            differ += option_text(option, preset) != option_text(option, effects);
        if (differ < fewest) fewest = differ, nearest = i;
    }
    const render::Effects preset = render::preset_effects(render::Preset(nearest));
    std::string text = fmt::format("quality = \"{}\"\n", render::preset_name(render::Preset(nearest)));
    if (fewest > 0) text += "[effects]\n";
    for (const render::EffectOption& option : render::effect_options()) {
        const std::string value = option_text(option, effects);
        if (value == option_text(option, preset)) continue;
        text += option.choices.empty() ? fmt::format("\"{}\" = {}\n", option.key, value)
                                       : fmt::format("\"{}\" = \"{}\"\n", option.key, value);
    }
    return text;
}

// A table [trace] of what is not as at first.
static void read_trace(const toml::table& table, TraceOptions& options) {
    const toml::table* changes = table["trace"].as_table();
    if (!changes) return;
    for (const TraceOption& option : trace_option_list())
        if (const toml::node* node = changes->get(option.key)) (void)set_trace_option(options, option.key, text_of(*node));
}

static std::string trace_text(const TraceOptions& options) {
    std::string text;
    for (const TraceOption& option : trace_option_list()) {
        const std::string value = option_text(option, options);
        if (value != option_text(option, TraceOptions())) text += fmt::format("{} = {}\n", option.key, value);
    }
    return text.empty() ? text : "[trace]\n" + text;
}

// A table [keys] of what is not as usual: action = "key", "" for none.
static void read_keys(const toml::table& table, Bindings& controls) {
    const toml::table* changes = table["keys"].as_table();
    if (!changes) return;
    for (const ActionInfo& info : actions()) {
        const auto name = (*changes)[info.key].value_exact<std::string>();
        if (!name) continue;
        if (name->empty()) (void)controls.bind(info.action, platform::Key::none);
        else if (const auto key = platform::key_from(*name)) (void)controls.bind(info.action, *key);
    }
}

static std::string keys_text(const Bindings& controls) {
    std::string text;
    for (const ActionInfo& info : actions())
        if (controls.of(info.action) != info.usual) text += fmt::format("{} = \"{}\"\n", info.key, platform::key_name(controls.of(info.action)));
    return text.empty() ? text : "[keys]\n" + text;
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
    read_packs(table, settings.packs);
    read_effects(table, settings.effects);
    read_trace(table, settings.trace);
    read_keys(table, settings.controls);
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
    text += packs_text(copy.packs); // before the table: keys after it would be its own
    text += effects_text(copy.effects);
    text += trace_text(copy.trace);
    text += keys_text(copy.controls);
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
