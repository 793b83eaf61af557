#include "apps/commands.h"

#include "base/clock.h"
#include "jobs/thread_pool.h"
#include "pipeline/chunk_source.h"
#include "pipeline/column_keeper.h"
#include "pipeline/new_world.h"
#include "script/content_loader.h"
#include "terrain/generator.h"

#include <array>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <mutex>
#include <nlohmann/json.hpp>

namespace vitrail::apps {

namespace {

struct Area {
    i32 x0, z0, x1, z1; // columns, inclusive
    u64 count() const { return (u64(i64(x1) - x0) + 1) * (u64(i64(z1) - z0) + 1); }
};

Result<Area> parse_area(const std::string& text) {
    VX_TRY_ASSIGN(const auto n, parse_numbers("--columns", text, 4));
    constexpr double edge = kWorldEdge / kChunkSize;
    for (double v : n)
        if (v != std::floor(v) || v < -edge || v >= edge)
            return fail(ErrorCode::invalid_argument, fmt::format("--columns wants whole columns inside the world, not '{}'", text));
    const Area area{i32(n[0]), i32(n[1]), i32(n[2]), i32(n[3])};
    if (area.x1 < area.x0 || area.z1 < area.z0)
        return fail(ErrorCode::invalid_argument, "--columns wants X0,Z0 at or below X1,Z1");
    if (area.count() > 1'000'000) return fail(ErrorCode::limit, "--columns takes at most 1000000 columns at once");
    return area;
}

} // namespace

Result<> run_generate(const GenerateOptions& options) {
    if (options.device != "cpu" && options.device != "cuda")
        return fail(ErrorCode::invalid_argument, fmt::format("--device is cpu or cuda, not '{}'", options.device));
    if (options.device == "cuda") return fail(ErrorCode::not_found, "this build generates on the cpu only");
    if (options.list) {
        fmt::print("generator hills, version {}\n", ChunkSource::generator_version("hills"));
        for (const char* name : kTerrainBiomeNames) fmt::print("biome {}\n", name);
        for (const char* name : kTerrainBlockNames) fmt::print("block {}\n", name);
        return {};
    }
    if (options.columns.empty()) return fail(ErrorCode::invalid_argument, "generate wants --columns X0,Z0,X1,Z1 (or --list)");
    VX_TRY_ASSIGN(const Area area, parse_area(options.columns));
    if (!options.stats_file.empty()) VX_TRY(check_writable(options.stats_file));
    VX_TRY_ASSIGN(const Content content, load_base_content());
    const auto& registry = content.registry;

    const std::atomic<bool>& stop = stop_on_signals(); // before the first byte is written
    std::unique_ptr<ColumnKeeper> keeper;
    StateTable own_states(registry);
    BiomeTable own_biomes;
    if (!options.world.empty()) {
        std::error_code ignored;
        const bool existed = std::filesystem::exists(options.world, ignored);
        auto opened = ColumnKeeper::open(options.world, options.seed, registry);
        if (!opened) {
            if (!existed && opened.error().code != ErrorCode::busy) std::filesystem::remove_all(options.world, ignored);
            return tl::unexpected(opened.error());
        }
        keeper = std::move(*opened);
    }
    VX_TRY_ASSIGN(const TerrainPalette palette,
                  make_terrain_palette(keeper ? keeper->records().states() : own_states,
                                       keeper ? keeper->records().biomes() : own_biomes));
    const u64 start = now_ns();
    std::atomic<u64> hash{0}, filled{0};
    std::mutex error_mutex;
    Result<> trouble;
    std::atomic<bool> failed{false};
    ThreadPool pool(default_worker_count());
    const u32 width = u32(area.x1 - area.x0 + 1);
    pool.parallel_for(u32(area.count()), [&](u32 i) {
        if (failed || stop) return;
        const ColumnPos at{area.x0 + i32(i % width), area.z0 + i32(i / width)};
        GeneratedColumn column = generate_column(options.seed, at, palette);
        // A sum, so that the order of columns does not matter; the position is mixed in, so that their places do.
        if (options.hash) hash += hash_combine(hash_combine(u32(at.x), u32(at.z)), column_hash(column));
        for (const Chunk& chunk : column.chunks)
            filled += !(chunk.blocks.uniform() && chunk.blocks.get(LocalPos(0u)) == StateId::air);
        if (!keeper) return;
        if (auto result = keeper->keep(at, column); !result) {
            std::lock_guard lock(error_mutex);
            if (!failed.exchange(true)) trouble = result; // one line: the first
        }
    });
    VX_TRY(trouble);
    if (keeper) VX_TRY(keeper->flush());
    if (stop)
        return fail(ErrorCode::denied, keeper ? fmt::format("interrupted; {} keeps what was done, the same command goes on", options.world)
                                              : "interrupted");
    const double seconds = seconds_since(start);
    fmt::print("{} columns, {} chunks with anything in them, {:.3f} s, {:.0f} columns/s\n", area.count(), filled.load(), seconds,
               double(area.count()) / seconds);
    if (options.hash) fmt::print("hash {:016x}\n", hash.load());
    if (options.stats_file.empty()) return {};
    const nlohmann::json stats = {{"columns", area.count()},          {"chunks", filled.load()},
                                  {"seconds", seconds},               {"device", "cpu"},
                                  {"peak_memory_bytes", peak_memory_bytes()}, {"hash", fmt::format("{:016x}", hash.load())}};
    return write_file(options.stats_file, stats.dump(1) + "\n");
}

} // namespace vitrail::apps
