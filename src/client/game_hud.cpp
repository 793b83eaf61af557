#include "base/clock.h"
#include "client/game.h"
#include "client/packs.h"
#include "gfx/context.h"

#include <cmath>
#include <fmt/format.h>

namespace vitrail::client {

void say(GameState& state, std::string text) {
    state.notices.push_back({std::move(text)});
    while (state.notices.size() > 8) state.notices.pop_front();
}

static const char* compass(float yaw_deg) {
    static constexpr const char* names[] = {"south (+z)", "west (-x)", "north (-z)", "east (+x)"};
    const float turned = std::fmod(std::fmod(yaw_deg + 45.0f, 360.0f) + 360.0f, 360.0f);
    return names[int(turned / 90.0f) & 3];
}

std::vector<std::string> debug_lines_left(const GameState& state) {
    auto& replica = state.game->replica();
    const WorldPos at = replica.body().feet.at;
    const BlockPos block = block_of(at);
    const ChunkPos chunk = chunk_of(block);
    auto fraction = [](i64 v) { return double(u32(v)) * 0x1p-32; };
    const auto& frame = state.renderer->stats();
    const FeederStats feeder = state.feeder->stats();
    const Light light = replica.dimension().light_at({block.x, block.y, block.z});
    const ChunkPtr here = replica.dimension().find(chunk);
    std::vector<std::string> lines = {
        fmt::format("Vitrail  {:.0f} frames/s  {:.1f} ms", state.frame_ms > 0 ? 1000.0 / state.frame_ms : 0.0, state.frame_ms),
        fmt::format("at {}.{:03} {}.{:03} {}.{:03}", block.x, int(fraction(at.x) * 1000), block.y, int(fraction(at.y) * 1000), block.z,
                    int(fraction(at.z) * 1000)),
        fmt::format("chunk {} {} {}  in {}", chunk.x, chunk.y, chunk.z, replica.dimension().info().name),
        fmt::format("looks {}  yaw {:.1f} pitch {:.1f}", compass(state.yaw_deg), state.yaw_deg, state.pitch_deg),
        fmt::format("light sky {}  r {} g {} b {}", light.sky(), light.red(), light.green(), light.blue()),
        fmt::format("biome {}", here ? replica.biomes().name(here->biomes.at(local_of(block))) : "?"),
        fmt::format("time {:.0f}{}{}", replica.time_of_day(), state.time_paused ? " stopped" : "", state.free_eye ? "  free camera" : ""),
        "",
        fmt::format("drawn {} x {}", frame.width, frame.height),
    };
    if (shows_traced(state)) {
        for (std::string& line : trace_lines(state)) lines.push_back(std::move(line));
    } else {
        lines.push_back(fmt::format("sections {} of {}  draws {}  quads {}", frame.sections_visible, frame.sections, frame.draws, frame.quads));
        lines.push_back(fmt::format("meshing {} waiting, {} at work, {} done", feeder.waiting, feeder.in_flight, feeder.meshed));
    }
    return lines;
}

std::vector<std::string> debug_lines_right(const GameState& state) {
    auto& replica = state.game->replica();
    const auto server = state.game->server().stats();
    const auto net = replica.stats();
    std::vector<std::string> lines = {
        fmt::format("memory {} MB", resident_memory_bytes() >> 20),
        fmt::format("gpu {} MB", state.renderer->stats().gpu_bytes >> 20),
        fmt::format("server tick {:.1f} ms, most {:.1f}", server.tick_ms, server.tick_ms_max),
        fmt::format("{} columns, {} chunks, {} waiting", server.columns, server.chunks, server.columns_waiting),
        fmt::format("land {:.0f} ms spent, budget {:.0f} %, cache {} MB", double(server.generation.spent_ns) * 1e-6,
                    100 * server.generation.budget_use, server.generator_cache.bytes >> 20),
        fmt::format("{} sections, {} KB received", net.sections, net.bytes >> 10),
        fmt::format("edits waiting {}  corrections {}", net.pending_edits, net.corrections),
    };
    if (const auto info = gfx::context_info()) lines.push_back(info->renderer);
    for (const auto& [pass, ms] : state.renderer->stats().passes_ms) lines.push_back(fmt::format("{} {:.2f} ms", pass, ms));
    if (const std::string& error = state.renderer->shader_error(); !error.empty()) lines.push_back(error);
    if (state.hit) {
        const auto& block = replica.states()->info(replica.dimension().state_at(state.hit->block)).state;
        lines.emplace_back();
        lines.push_back(fmt::format("{} {} {}", state.hit->block.x, state.hit->block.y, state.hit->block.z));
        lines.push_back(block.name);
        for (const auto& [key, value] : block.properties) lines.push_back(fmt::format("{} = {}", key, value));
    }
    return lines;
}

// Icons are drawn once for each block name that stands in the hotbar.
static void update_icons(GameState& state) {
    Hotbar& hotbar = state.hotbar;
    if (hotbar.icon_names == hotbar.names) return;
    hotbar.icons.clear();
    for (const std::string& name : hotbar.names) {
        gfx::Texture icon;
        const auto id = state.game->replica().states()->intern_with_defaults(BlockState{name, {}});
        if (id) {
            state.feeder->models().ensure(*state.game->replica().states());
            state.renderer->sync_models(state.feeder->models());
            auto drawn = state.renderer->render_block_icon(*state.game->replica().states(), state.feeder->models(), *id, 96);
            if (drawn) icon = std::move(*drawn);
        }
        hotbar.icons.push_back(std::move(icon));
    }
    hotbar.icon_names = hotbar.names;
}

void keep_settings(GameState& state) {
    if (state.options.settings_file.empty()) return;
    if (const auto saved = save_settings(state.options.settings_file, state.settings); !saved) say(state, saved.error().message);
}

static void apply_settings(GameState& state, const Settings& before) {
    const Settings& now = state.settings = sane(state.settings);
    if (now.view_distance != before.view_distance) state.game->replica().set_view_distance(u32(now.view_distance));
    if (now.vsync != before.vsync) state.window->set_vsync(now.vsync);
    if (now.fullscreen != before.fullscreen) state.window->set_fullscreen(now.fullscreen);
    if (const auto set = state.renderer->set_effects(now.effects); !set) {
        say(state, set.error().message);
        state.settings.effects = before.effects;
    }
    if (now.ui_scale != before.ui_scale) apply_style(now.ui_scale);
    keep_settings(state);
}

void use_packs(GameState& state, const std::vector<std::string>& paths) {
    auto looks = open_packs(paths, *state.registry);
    if (!looks) return say(state, looks.error().message);
    if (const auto loaded = state.renderer->load_textures(*state.registry, looks->get()); !loaded) {
        (void)state.renderer->load_textures(*state.registry, state.pack_looks.get());
        return say(state, loaded.error().message);
    }
    state.pack_looks = *looks;
    state.feeder->set_packs(*looks);
    if (state.traced) state.traced->set_packs(*looks);
    state.hotbar.icon_names.clear(); // drawn anew
    state.settings.packs = state.packs = paths;
    state.pack_page.changed = false;
    keep_settings(state);
    say(state, paths.empty() ? "no resource packs" : fmt::format("{} resource pack{} in use", paths.size(), paths.size() == 1 ? "" : "s"));
}

void draw_interface(GameState& state) {
    if (!state.hide_ui) {
        update_icons(state);
        draw_crosshair();
        HotbarView view;
        for (const auto& icon : state.hotbar.icons) view.icons.push_back(icon.name());
        view.names = state.hotbar.names;
        view.selected = state.hotbar.selected;
        view.name_seconds = state.hotbar.name_seconds;
        draw_hotbar(view, state.settings.ui_scale);
        std::vector<std::string> lines;
        for (const Notice& notice : state.notices) lines.push_back(notice.text);
        draw_notices(lines);
    }
    state.renderer->set_timing(state.debug_text);
    if (state.debug_text) {
        draw_debug_text(debug_lines_left(state), false);
        draw_debug_text(debug_lines_right(state), true);
    }
    if (state.block_list_open) {
        const int chosen = draw_block_list(state.block_names, state.block_filter, state.block_list_open);
        if (chosen >= 0 && state.hotbar.selected < state.hotbar.names.size()) {
            state.hotbar.names[state.hotbar.selected] = state.block_names[std::size_t(chosen)];
            state.hotbar.name_seconds = 2;
            state.game->replica().set_hotbar(state.hotbar.names, state.hotbar.selected);
            state.block_list_open = false;
        }
        if (!state.block_list_open) {
            state.window->start_text_input(false);
            state.window->capture_mouse(!state.paused);
        }
    }
    if (state.paused) {
        const Settings before = state.settings;
        const MenuAction action = draw_pause_menu(state.settings, state.pack_page);
        if (!(before == state.settings)) apply_settings(state, before);
        if (action == MenuAction::resume) set_paused(state, false);
        if (action == MenuAction::packs_changed) use_packs(state, packs_in_use(state.pack_page.list));
        if (action == MenuAction::quit) state.quit = true;
        bool usual_wanted = false;
        draw_keys(state.settings.controls, state.key_waiting, usual_wanted);
        if (usual_wanted) {
            state.settings.controls = {};
            keep_settings(state);
        }
    }
}

} // namespace vitrail::client
