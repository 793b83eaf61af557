#include "script/world_script.h"

#include "apps/commands.h"
#include "base/clock.h"
#include "pipeline/built_world.h"
#include "script/content_loader.h"

#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vitrail::apps {

namespace {

constexpr std::size_t kScriptBytesMost = 4 << 20;

nlohmann::json stations_json(const std::vector<Station>& stations) {
    nlohmann::json out = nlohmann::json::array();
    for (const Station& s : stations)
        out.push_back({{"name", s.name},
                       {"effect", s.effect},
                       {"text", s.text},
                       {"at", s.at},
                       {"look", {s.yaw, s.pitch}},
                       {"fov", s.fov},
                       {"time", s.time},
                       {"without", s.without}});
    return out;
}

// A folder made for a world that then could not be kept goes again.
Result<BuiltWorldFigures> keep(const std::string& folder, const ScriptedWorld& world, const BiomeTable& biomes,
                               const LevelRecord& level) {
    std::error_code ignored;
    const bool existed = std::filesystem::exists(folder, ignored);
    auto kept = keep_built_world(folder, world.dimension, biomes, level);
    if (!kept && !existed && kept.error().code != ErrorCode::busy) std::filesystem::remove_all(folder, ignored);
    return kept;
}

} // namespace

Result<> run_world_script(const GenerateOptions& options) {
    for (const std::string& file : {options.stats_file, options.stations_file})
        if (!file.empty()) VX_TRY(check_writable(file));
    VX_TRY_ASSIGN(const std::string text, read_text_file(options.script, kScriptBytesMost));
    VX_TRY_ASSIGN(const Content content, load_base_content());
    BiomeTable biomes;
    const u64 start = now_ns();
    // Lua cuts long names of chunks, so a script is called by its own name.
    VX_TRY_ASSIGN(const ScriptedWorld world,
                  run_world_script(text, std::filesystem::path(options.script).filename().string(),
                                   std::make_shared<StateTable>(content.registry), biomes));
    const double script_s = seconds_since(start);
    if (!world.output.empty()) fmt::print("{}", world.output);

    LevelRecord level;
    level.name = world.name;
    level.spawn.at = world.spawn;
    level.spawn_yaw = world.spawn_yaw;
    level.time_ticks = world.time;
    level.content_hash = content.registry->content_hash;
    level.source = options.script.substr(0, 1000);
    const u64 keep_start = now_ns();
    BuiltWorldFigures kept;
    if (!options.world.empty()) {
        VX_TRY_ASSIGN(kept, keep(options.world, world, biomes, level));
    }
    const double keep_s = seconds_since(keep_start);
    fmt::print("{} chunks drawn, {} stations, {:.3f} s\n", world.dimension.chunks().size(), world.stations.size(),
               script_s);
    if (!options.stations_file.empty())
        VX_TRY(write_file(options.stations_file, stations_json(world.stations).dump(1) + "\n"));
    if (options.stats_file.empty()) return {};
    const nlohmann::json stats = {{"seconds", {{"script", script_s}, {"keep", keep_s}}},
                                  {"columns", kept.columns},
                                  {"chunks", kept.chunks},
                                  {"instructions", world.instructions},
                                  {"blocks_looked_at", world.cells},
                                  {"stations", world.stations.size()},
                                  {"peak_memory_bytes", peak_memory_bytes()},
                                  {"device", "cpu"}};
    return write_file(options.stats_file, stats.dump(1) + "\n");
}

} // namespace vitrail::apps
