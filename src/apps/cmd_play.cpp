#include "apps/commands.h"

#include "client/game.h"
#include "script/content_loader.h"

#include <cstdlib>
#include <filesystem>
#include <fmt/format.h>

namespace vitrail::apps {

namespace fs = std::filesystem;

// Where worlds and screenshots go when nobody says: $XDG_DATA_HOME/vitrail, else ~/.local/share/vitrail.
static fs::path data_folder() {
    if (const char* data = std::getenv("XDG_DATA_HOME"); data && *data) return fs::path(data) / "vitrail";
    if (const char* home = std::getenv("HOME"); home && *home) return fs::path(home) / ".local/share/vitrail";
    return fs::current_path();
}

static Result<client::TraceOptions> trace_options_of(const std::vector<std::string>& changes, const client::TraceOptions& otherwise) {
    client::TraceOptions options = otherwise;
    for (const std::string& change : changes) {
        VX_TRY_ASSIGN(const auto set, parse_change("--trace", change));
        VX_TRY(client::set_trace_option(options, set.first, set.second));
    }
    return options;
}

Result<> run_play(const PlayOptions& options) {
    if (options.renderer != "raster" && options.renderer != "trace")
        return fail(ErrorCode::invalid_argument, fmt::format("--renderer is raster or trace, not '{}'", options.renderer));
    if (!options.connect.empty()) return fail(ErrorCode::unsupported, "play --connect: joining over the network is not built yet");
    client::GameOptions game;
    if (!options.size.empty()) {
        VX_TRY_ASSIGN(const auto size, parse_size(options.size));
        game.width = size.first;
        game.height = size.second;
    }
    fs::path world = options.world.empty() ? data_folder() / "worlds/default" : fs::path(options.world).lexically_normal();
    if (!world.has_filename()) world = world.parent_path(); // "DIR/"
    game.local.server.folder = world.string();
    game.local.server.name = world.filename().string();
    game.local.server.seed = options.seed;
    game.local.server.device = options.device;
    game.local.server.day_minutes = options.day_minutes;
    game.local.server.players_set_time = true; // the world is his
    game.local.replica.name = options.name;
    game.view_distance = options.view_distance;
    game.packs = options.packs;
    game.shader_folder = options.effects.shader_folder;
    VX_TRY(effects_of(options.effects, {})); // wrong words are told before a window opens
    game.change_effects = [arguments = options.effects](const render::Effects& kept) { return *effects_of(arguments, kept); };
    game.trace = options.renderer == "trace";
    VX_TRY_ASSIGN(game.trace_device, client::trace_device_named(options.device));
    game.trace_devices = u32(options.devices);
    if (game.trace) VX_TRY(trace::Tracer::possible_on(game.trace_device)); // F5 says so in the game; here it is told before a window opens
    VX_TRY(trace_options_of(options.trace, {}));
    game.change_trace = [changes = options.trace](const client::TraceOptions& kept) { return *trace_options_of(changes, kept); };
    game.screenshot_folder = data_folder() / "screenshots";
    game.pack_folder = data_folder() / "packs";
    if (const auto path = client::settings_path()) game.settings_file = *path;
    VX_TRY_ASSIGN(const Content content, load_base_content());
    return client::run_game(game, content);
}

} // namespace vitrail::apps
