#include "pipeline/generate_area.h"

#include "base/clock.h"
#include "jobs/thread_pool.h"

#include <algorithm>
#include <deque>
#include <mutex>

namespace vitrail {

namespace {

constexpr i32 kBandZones = 4;     // two rows of a band fit into the generator's caches
constexpr u32 kColumnsAStrip = 8; // that one thread takes at a time

u64 filled_chunks(const GeneratedColumn& column) {
    u64 filled = 0;
    for (const Chunk& chunk : column.chunks)
        filled += !(chunk.blocks.uniform() && chunk.blocks.palette()[0] == StateId::air);
    return filled;
}

// Sums of several threads.
struct Totals {
    std::mutex mutex;
    AreaStats stats;
    Result<> trouble;
    std::atomic<bool> failed{false};

    void fail_with(Result<> result) {
        std::lock_guard lock(mutex);
        if (!failed.exchange(true)) trouble = std::move(result);
    }
};

// Runs what the column misses part by part, for the sake of times.
void run_missing(const TerrainGenerator& generator, ColumnPos at, AreaStats& stats) {
    static thread_local std::vector<TerrainTask> missing;
    missing.clear();
    generator.missing(at, missing);
    for (const TerrainTask part : missing) {
        const u64 start = thread_time_ns();
        generator.run(part);
        auto& stage = stats.stages[u32(part.stage)];
        ++stage.count;
        stage.seconds += double(thread_time_ns() - start) * 1e-9;
    }
}

} // namespace

u64 placed_column_hash(ColumnPos at, const GeneratedColumn& column) {
    return hash_combine(hash_combine(u32(at.x), u32(at.z)), column_hash(column));
}

std::vector<ColumnPos> columns_by_zone(ColumnRect area) {
    std::vector<ColumnPos> out;
    out.reserve(area.count());
    const auto down = [](i64 v, i64 step) { return v - ((v % step) + step) % step; };
    const i64 x_end = i64(area.first.x) + area.width, z_end = i64(area.first.z) + area.depth;
    constexpr i64 band = i64(kBandZones) * kZoneColumns;
    for (i64 bx = down(area.first.x, band); bx < x_end; bx += band)
        for (i64 zz = down(area.first.z, kZoneColumns); zz < z_end; zz += kZoneColumns)
            for (i64 zx = bx; zx < bx + band; zx += kZoneColumns)
                for (i64 z = std::max<i64>(zz, area.first.z); z < std::min(zz + kZoneColumns, z_end); ++z)
                    for (i64 x = std::max<i64>(zx, area.first.x); x < std::min(zx + kZoneColumns, x_end); ++x)
                        out.push_back({i32(x), i32(z)});
    return out;
}

Result<AreaStats> generate_area(const TerrainGenerator& generator, const TerrainPalette& palette, ColumnRect area,
                                const AreaOptions& options, const ColumnTaker& take) {
    const std::vector<ColumnPos> columns = columns_by_zone(area);
    Totals totals;
    const u64 start = now_ns();
    ThreadPool pool(std::max(options.threads, 1u) - 1);
    const auto count = u32(columns.size());
    pool.parallel_for((count + kColumnsAStrip - 1) / kColumnsAStrip, [&](u32 strip) {
        AreaStats mine;
        for (u32 i = strip * kColumnsAStrip; i < std::min(count, (strip + 1) * kColumnsAStrip); ++i) {
            if (totals.failed || (options.stop && *options.stop)) break;
            const ColumnPos at = columns[i];
            if (options.stage_times) run_missing(generator, at, mine);
            const u64 begin = options.stage_times ? thread_time_ns() : 0;
            GeneratedColumn column = generator.generate(at, palette);
            if (options.stage_times) {
                auto& stage = mine.stages[u32(TerrainStage::blocks)];
                ++stage.count;
                stage.seconds += double(thread_time_ns() - begin) * 1e-9;
            }
            ++mine.columns;
            mine.chunks += filled_chunks(column);
            if (auto taken = take(at, column); !taken) totals.fail_with(std::move(taken));
        }
        std::lock_guard lock(totals.mutex);
        totals.stats.columns += mine.columns;
        totals.stats.chunks += mine.chunks;
        for (u32 s = 0; s < mine.stages.size(); ++s) {
            totals.stats.stages[s].count += mine.stages[s].count;
            totals.stats.stages[s].seconds += mine.stages[s].seconds;
        }
    });
    VX_TRY(totals.trouble);
    totals.stats.seconds = seconds_since(start);
    return totals.stats;
}

Result<AreaStats> generate_area(ColumnBatchMaker& maker, const TerrainPalette& palette, ColumnRect area,
                                const AreaOptions& options, const ColumnTaker& take) {
    AreaStats stats;
    const u64 start = now_ns();
    const BatchTimes before = maker.times();
    const auto side = i64(maker.max_columns_a_side());
    std::deque<std::pair<u32, ColumnRect>> under_way;
    const auto collect = [&]() -> Result<> {
        const auto [number, rect] = under_way.front();
        under_way.pop_front();
        VX_TRY_ASSIGN(std::vector<GeneratedColumn> columns, maker.collect(number, palette));
        for (u32 i = 0; i < columns.size(); ++i) {
            ++stats.columns;
            stats.chunks += filled_chunks(columns[i]);
            const auto width = u32(rect.width);
            VX_TRY(take({rect.first.x + i32(i % width), rect.first.z + i32(i / width)}, columns[i]));
        }
        return {};
    };
    const i64 x_end = i64(area.first.x) + area.width, z_end = i64(area.first.z) + area.depth;
    for (i64 z = area.first.z; z < z_end; z += side)
        for (i64 x = area.first.x; x < x_end; x += side) {
            if (options.stop && *options.stop) break;
            const ColumnRect rect{{i32(x), i32(z)}, i32(std::min(side, x_end - x)), i32(std::min(side, z_end - z))};
            if (under_way.size() >= maker.max_batches()) VX_TRY(collect());
            VX_TRY_ASSIGN(const u32 number, maker.submit(rect));
            under_way.emplace_back(number, rect);
        }
    while (!under_way.empty())
        VX_TRY(collect());
    stats.seconds = seconds_since(start);
    const BatchTimes after = maker.times();
    for (u32 s = 0; s < stats.stages.size(); ++s)
        stats.stages[s] = {stats.columns, (after.stage_ms[s] - before.stage_ms[s]) * 1e-3};
    stats.copy_seconds = (after.copy_ms - before.copy_ms) * 1e-3;
    stats.pack_seconds = (after.pack_ms - before.pack_ms) * 1e-3;
    return stats;
}

} // namespace vitrail
