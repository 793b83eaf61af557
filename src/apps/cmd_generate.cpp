#include "apps/commands.h"

#include "apps/list_terrain.h"
#include "base/clock.h"
#include "pipeline/column_keeper.h"
#include "pipeline/generate_area.h"
#include "pipeline/new_world.h"
#include "script/content_loader.h"
#include "terrain/cuda/device.h"

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <thread>

namespace vitrail::apps {

namespace {

Result<ColumnRect> parse_area(const std::string& text) {
    VX_TRY_ASSIGN(const auto n, parse_numbers("--columns", text, 4));
    constexpr double edge = kWorldEdge / kChunkSize;
    for (double v : n)
        if (v != std::floor(v) || v < -edge || v >= edge)
            return fail(ErrorCode::invalid_argument,
                        fmt::format("--columns wants whole columns inside the world, not '{}'", text));
    if (n[2] < n[0] || n[3] < n[1]) return fail(ErrorCode::invalid_argument, "--columns wants X0,Z0 at or below X1,Z1");
    if ((n[2] - n[0] + 1) * (n[3] - n[1] + 1) > 1'000'000)
        return fail(ErrorCode::limit, "--columns takes at most 1000000 columns at once");
    return ColumnRect{{i32(n[0]), i32(n[1])}, i32(n[2] - n[0] + 1), i32(n[3] - n[1] + 1)};
}

// A folder made for a world that then could not be opened goes again.
Result<std::unique_ptr<ColumnKeeper>> open_keeper(const std::string& world, const TerrainGenerator& generator,
                                                  std::shared_ptr<const BlockRegistry> registry) {
    std::error_code ignored;
    const bool existed = std::filesystem::exists(world, ignored);
    auto opened = ColumnKeeper::open(world, generator, std::move(registry));
    if (!opened && !existed && opened.error().code != ErrorCode::busy) std::filesystem::remove_all(world, ignored);
    return opened;
}

nlohmann::json stats_json(const AreaStats& stats, const std::string& device, unsigned threads, u64 hash) {
    nlohmann::json stages = nlohmann::json::object();
    for (u32 s = 0; s < stats.stages.size(); ++s)
        stages[kTerrainStageNames[s]] = {
            {"parts", stats.stages[s].count},
            {"seconds", stats.stages[s].seconds},
            {"us_a_column", stats.columns ? stats.stages[s].seconds * 1e6 / double(stats.columns) : 0.0}};
    const double per_second = stats.seconds > 0 ? 1 / stats.seconds : 0;
    return {{"columns", stats.columns},
            {"chunks", stats.chunks},
            {"seconds", stats.seconds},
            {"columns_a_second", double(stats.columns) * per_second},
            {"chunks_a_second", double(stats.chunks) * per_second},
            {"device", device},
            {"threads", threads},
            {"stages", stages},
            {"copy_seconds", stats.copy_seconds},
            {"pack_seconds", stats.pack_seconds},
            {"peak_memory_bytes", peak_memory_bytes()},
            {"hash", fmt::format("{:016x}", hash)}};
}

} // namespace

Result<> run_generate(const GenerateOptions& options) {
    if (!options.script.empty()) return run_world_script(options);
    if (!options.stations_file.empty()) return fail(ErrorCode::invalid_argument, "--stations wants a --script, which names them");
    if (options.device != "cpu" && options.device != "cuda")
        return fail(ErrorCode::invalid_argument, fmt::format("--device is cpu or cuda, not '{}'", options.device));
    if (!options.list && options.columns.empty())
        return fail(ErrorCode::invalid_argument, "generate wants --columns X0,Z0,X1,Z1 (or --list)");
    ColumnRect area;
    if (!options.list) {
        VX_TRY_ASSIGN(area, parse_area(options.columns));
    }
    if (!options.stats_file.empty()) VX_TRY(check_writable(options.stats_file));
    VX_TRY_ASSIGN(const Content content, load_base_content());
    VX_TRY_ASSIGN(const auto generator,
                  open_generator(kGeneratorName, kGeneratorVersion, content.terrain.get(), options.seed));
    if (options.list) return list_terrain(*content.terrain, *generator);
    const unsigned threads =
        options.threads > 0 ? unsigned(options.threads) : std::max(1u, std::thread::hardware_concurrency());
    std::unique_ptr<ColumnBatchMaker> maker;
    if (options.device == "cuda") {
        CudaOptions cuda;
        cuda.pack_threads = threads - 1;
        VX_TRY_ASSIGN(maker, open_cuda_batches(generator, cuda));
    }

    AreaOptions area_options;
    area_options.threads = threads;
    area_options.stage_times = !options.stats_file.empty();
    area_options.stop = &stop_on_signals(); // before the first byte is written
    std::unique_ptr<ColumnKeeper> keeper;
    StateTable own_states(content.registry);
    BiomeTable own_biomes;
    if (!options.world.empty()) {
        VX_TRY_ASSIGN(keeper, open_keeper(options.world, *generator, content.registry));
    }
    VX_TRY_ASSIGN(const TerrainPalette palette,
                  make_terrain_palette(keeper ? keeper->records().states() : own_states,
                                       keeper ? keeper->records().biomes() : own_biomes, *generator));
    std::atomic<u64> hash{0};
    const auto take = [&](ColumnPos at, GeneratedColumn& column) -> Result<> {
        if (options.hash || !options.stats_file.empty()) hash += placed_column_hash(at, column);
        return keeper ? keeper->keep(at, column) : Result<>{};
    };
    VX_TRY_ASSIGN(const AreaStats stats, maker ? generate_area(*maker, palette, area, area_options, take)
                                               : generate_area(*generator, palette, area, area_options, take));
    if (keeper) VX_TRY(keeper->flush());
    if (*area_options.stop)
        return fail(ErrorCode::denied,
                    keeper ? fmt::format("interrupted; {} keeps what was done, the same command goes on", options.world)
                           : "interrupted");
    fmt::print("{} columns, {} chunks with anything in them, {:.3f} s, {:.0f} columns/s, {:.0f} chunks/s\n",
               stats.columns, stats.chunks, stats.seconds, double(stats.columns) / stats.seconds,
               double(stats.chunks) / stats.seconds);
    if (options.hash) fmt::print("hash {:016x}\n", hash.load());
    if (options.stats_file.empty()) return {};
    return write_file(options.stats_file,
                      stats_json(stats, maker ? maker->device_name() : "cpu", threads, hash).dump(1) + "\n");
}

} // namespace vitrail::apps
