// inspect, verify, backup.
#include "apps/commands.h"

#include "store/maintenance.h"

#include <cstdio>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace vitrail::apps {

Result<> run_inspect(const WorldOptions& options) {
    if (!options.blocks_file.empty()) VX_TRY(check_writable(options.blocks_file));
    VX_TRY_ASSIGN(const InspectReport report, inspect_world(options.world));
    if (report.level.unfinished)
        return fail(ErrorCode::denied, fmt::format("world {} is an unfinished import of {}: if it no longer runs, import it again", options.world,
                                                   report.level.source));
    u64 blocks = 0, solid = 0;
    for (const auto& [name, count] : report.blocks) {
        blocks += count;
        if (name != "minecraft:air" && name != "minecraft:cave_air" && name != "minecraft:void_air") solid += count;
    }
    fmt::print("world         {}\nseed          {}\nspawn         {},{},{}\ntime          {} ticks, a day takes {} minutes\n", report.level.name, report.level.seed,
               report.level.spawn.at.x, report.level.spawn.at.y, report.level.spawn.at.z, report.level.time_ticks,
               report.level.day_minutes);
    for (const auto& d : report.dimensions)
        fmt::print("dimension     {}: {} columns, {} chunks, {} bytes\n", d.name, d.columns, d.chunks, d.chunk_bytes);
    fmt::print("blocks        {} ({} not air) of {} states\nbiomes        {}\nplayers       {}\nblock entities {}\nentities      {}\n"
               "damaged       {}\non disk       {} bytes\n",
               blocks, solid, report.states, report.biomes, report.players, report.block_entities, report.entities,
               report.damaged, report.size_bytes);
    if (options.blocks_file.empty()) return {};
    nlohmann::json json = nlohmann::json::object();
    for (const auto& [name, count] : report.blocks) json[name] = count;
    return write_file(options.blocks_file, json.dump(1) + "\n");
}

Result<> run_verify(const WorldOptions& options) {
    VX_TRY_ASSIGN(const VerifyReport report, verify_world(options.world));
    for (const std::string& line : report.findings) fmt::print("{}\n", line);
    fmt::print("{} records looked at, {} of them chunks; {} damaged, {} set aside earlier\n", report.records, report.chunks,
               report.damaged, report.quarantined);
    if (!report.sound()) return fail(ErrorCode::damaged, fmt::format("{} records of {} are damaged", report.damaged, options.world));
    return {};
}

Result<> run_backup(const WorldOptions& options) {
    VX_TRY(backup_world(options.world, options.target));
    fmt::print("copied {} to {}\n", options.world, options.target);
    return {};
}

} // namespace vitrail::apps
