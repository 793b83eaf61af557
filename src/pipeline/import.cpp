#include "pipeline/import.h"

#include "base/assert.h"
#include "base/clock.h"
#include "formats/chunk_walk.h"
#include "pipeline/column_converter.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <fmt/format.h>
#include <mutex>

namespace vitrail {

namespace {

constexpr i32 kStripRows = 8; // rows of a region that one worker does in one go; columns with numeric ids read one row
                              // more on each side for what lies across the border
constexpr i32 kVersion1_18 = 2825;

struct DimensionWork {
    DimensionInfo info;          // as announced; workers read it
    i32 least_y = 0, most_y = 0; // what the columns reached; under Import::mutex
    std::map<RegionPos, const SourceRegion*> regions;
};

struct Strip {
    DimensionWork* dimension;
    const SourceRegion* region;
    i32 first_row; // 0, 8, 16, 24
};

struct Import;

// What one worker keeps from strip to strip.
class Worker {
public:
    Worker(Import& import, ImportSink& sink)
        : import_(import)
        , converter(sink) {}
    Result<> run(const Strip& strip);

    ReadReport report;
    u64 columns = 0, chunks = 0, columns_not_made = 0;
    i32 low_y = INT32_MAX, high_y = INT32_MIN; // chunk units, of the strip run last

private:
    // Columns x -1..32 of the strip's region; null: not read yet or none there.
    struct Row {
        i32 z = 0; // chunk coordinate
        std::array<std::unique_ptr<RawColumn>, 34> columns;
        std::array<bool, 34> read{};
    };
    Row& row(i32 z);
    const RawColumn* load(const Strip& strip, Row& row, i32 x);
    void add_entities(const Strip& strip, u32 slot, RawColumn& raw);
    void give_back(std::unique_ptr<RawColumn>& raw);
    Result<> run_row(const Strip& strip, i32 z, std::vector<ImportedColumn>& batch);

    Import& import_;
    ChunkReader reader_, entity_reader_;
    DecodeContext context_;
    ReadReport ignored_;
    std::deque<Row> rows_;
    std::vector<std::unique_ptr<RawColumn>> spare_;

public:
    ColumnConverter converter;
};

struct Import {
    ImportSink& sink;
    RegionCache cache, entity_cache;
    std::mutex mutex;
    std::vector<std::unique_ptr<Worker>> workers;
    std::vector<Worker*> idle;
    std::optional<Error> error;
    std::atomic<bool> stopped{false};

    explicit Import(ImportSink& s)
        : sink(s) {}
    Worker* take() {
        std::lock_guard lock(mutex);
        if (idle.empty()) {
            workers.push_back(std::make_unique<Worker>(*this, sink));
            idle.push_back(workers.back().get());
        }
        Worker* worker = idle.back();
        idle.pop_back();
        return worker;
    }
    void done(Worker* worker, DimensionWork& dimension, Result<> result) {
        std::lock_guard lock(mutex);
        if (worker->low_y <= worker->high_y) {
            dimension.least_y = std::min(dimension.least_y, worker->low_y * 16);
            dimension.most_y = std::max(dimension.most_y, worker->high_y * 16 + 16);
        }
        if (!result && !error) {
            error = std::move(result).error();
            stopped = true;
        }
        idle.push_back(worker);
    }
};

Worker::Row& Worker::row(i32 z) {
    for (Row& r : rows_)
        if (r.z == z) return r;
    rows_.emplace_back().z = z;
    return rows_.back();
}

void Worker::give_back(std::unique_ptr<RawColumn>& raw) {
    if (raw) spare_.push_back(std::move(raw));
}

const RawColumn* Worker::load(const Strip& strip, Row& row, i32 x) {
    const std::size_t i = std::size_t(x - strip.region->at.x * 32 + 1);
    if (row.read[i]) return row.columns[i].get();
    row.read[i] = true;
    const bool own = i >= 1 && i <= 32 && row.z >> 3 == (strip.region->at.z * 32 + strip.first_row) >> 3;
    const auto found = strip.dimension->regions.find({x >> 5, row.z >> 5});
    if (found == strip.dimension->regions.end()) return nullptr;
    const auto file = import_.cache.open(found->second->file);
    const u32 slot = u32((x & 31) | (row.z & 31) << 5);
    if (!file || !file->has_chunk(slot)) return nullptr;
    if (spare_.empty()) spare_.push_back(std::make_unique<RawColumn>());
    std::unique_ptr<RawColumn> raw = std::move(spare_.back());
    spare_.pop_back();
    context_.blocks_only = !own;
    if (!own) ignored_ = {};
    if (!read_chunk(*file, slot, reader_, context_, *raw, own ? report : ignored_)) {
        spare_.push_back(std::move(raw));
        return nullptr;
    }
    if (own) add_entities(strip, slot, *raw);
    row.columns[i] = std::move(raw);
    return row.columns[i].get();
}

void Worker::add_entities(const Strip& strip, u32 slot, RawColumn& raw) {
    if (strip.region->entities.empty()) return;
    const auto file = import_.entity_cache.open(strip.region->entities);
    if (!file || !file->has_chunk(slot)) return;
    const auto read = entity_reader_.read(*file, slot);
    if (read.usable) decode_entities(entity_reader_.document.root(), raw);
    if (read.error) report.say(fmt::format("entities of chunk {}, {}: {}", raw.at.x, raw.at.z, read.error->message));
}

Result<> Worker::run_row(const Strip& strip, i32 z, std::vector<ImportedColumn>& batch) {
    const i32 x0 = strip.region->at.x * 32;
    for (i32 x = x0; x < x0 + 32; ++x) {
        Row& here = row(z);
        const std::size_t i = std::size_t(x - x0 + 1);
        if (!load(strip, here, x)) continue;
        RawColumn& raw = *here.columns[i];
        const bool legacy =
            std::any_of(raw.sections.begin(), raw.sections.end(), [](const RawSection& s) { return s.legacy; });
        std::optional<LegacyView> view;
        if (legacy) {
            std::array<const RawColumn*, 9> around{};
            for (i32 dz = -1; dz <= 1; ++dz)
                for (i32 dx = -1; dx <= 1; ++dx)
                    around[std::size_t((dz + 1) * 3 + dx + 1)] = load(strip, row(z + dz), x + dx);
            view.emplace(around);
        }
        auto column = converter.convert(raw, context_.names, view ? &*view : nullptr, strip.dimension->info.id,
                                        strip.dimension->info.min_y);
        for (const std::string& problem : converter.problems)
            report.say(fmt::format("chunk {}, {}: {}", x, z, problem));
        converter.problems.clear();
        if (!column && column.error().code == ErrorCode::limit) {
            report.say(fmt::format("chunk {}, {}: {}", x, z, column.error().message));
            ++report.chunks_unreadable;
            continue;
        }
        if (!column) return tl::unexpected(column.error());
        const bool terrain = ColumnConverter::has_terrain(raw.status);
        if (!legacy) give_back(here.columns[i]);
        const bool only_air = std::all_of(column->chunks.begin(), column->chunks.end(), [](const auto& part) {
            return part.chunk->blocks.uniform() && part.chunk->blocks.get(LocalPos()) == StateId::air;
        });
        if (only_air && (column->chunks.empty() || !terrain)) {
            ++columns_not_made;
            continue;
        }
        ++columns;
        chunks += column->chunks.size();
        low_y = std::min(low_y, column->chunks.front().y);
        high_y = std::max(high_y, column->chunks.back().y);
        batch.push_back(std::move(*column));
    }
    return {};
}

Result<> Worker::run(const Strip& strip) {
    low_y = INT32_MAX, high_y = INT32_MIN;
    for (Row& r : rows_)
        for (auto& raw : r.columns)
            give_back(raw);
    rows_.clear();
    const auto region = import_.cache.open(strip.region->file); // held, so that it stays open for the whole strip
    if (!region) return {};
    const auto entities = strip.region->entities.empty() ? nullptr : import_.entity_cache.open(strip.region->entities);
    const i32 z0 = strip.region->at.z * 32 + strip.first_row;
    for (i32 z = z0; z < z0 + kStripRows && !import_.stopped; ++z) {
        std::vector<ImportedColumn> batch;
        VX_TRY(run_row(strip, z, batch));
        if (!batch.empty()) VX_TRY(import_.sink.put_columns(std::move(batch)));
        while (!rows_.empty() && rows_.front().z < z) {
            for (auto& raw : rows_.front().columns)
                give_back(raw);
            rows_.pop_front();
        }
    }
    return {};
}

// The version that tells how high the world is: level.dat's, else that of the first chunk that can be read.
i32 version_of(const WorldSource& world, const SourceDimension& dimension) {
    if (world.level.data_version > 0) return world.level.data_version;
    ChunkReader reader;
    for (const SourceRegion& region : dimension.regions) {
        const auto file = RegionFile::open(region.file);
        if (!file) continue;
        for (u32 slot = 0; slot < kRegionSlots; ++slot)
            if (file->has_chunk(slot) && reader.read(*file, slot).usable)
                return i32(reader.document.root()["DataVersion"].integer());
    }
    return 0;
}

DimensionInfo dimension_info(const WorldSource& world, const SourceDimension& dimension, u32 next_id) {
    DimensionInfo out;
    out.name = dimension.name;
    const bool nether = out.name == "minecraft:the_nether", end = out.name == "minecraft:the_end";
    out.id = out.name == "minecraft:overworld" ? DimensionId::overworld : DimensionId(nether ? 1 : end ? 2 : next_id);
    const bool tall = out.id == DimensionId::overworld && version_of(world, dimension) >= kVersion1_18;
    out.min_y = tall ? -64 : 0;
    out.max_y = tall ? 320 : 256;
    out.has_sky = !nether && !end;
    return out;
}

} // namespace

Result<ImportReport> import_world(const std::filesystem::path& source, ImportSink& sink, ThreadPool& pool,
                                  const std::function<void(const ImportProgress&)>& progress) {
    const u64 start = now_ns();
    VX_TRY_ASSIGN(const WorldSource world, open_world_source(source));
    ImportReport out;
    out.level = world.level;
    for (const std::string& problem : world.problems)
        out.read.say(problem);
    VX_TRY(sink.level(world.level, source.string()));

    std::deque<DimensionWork> dimensions;
    std::vector<Strip> strips;
    u32 next_id = 3;
    for (const SourceDimension& d : world.dimensions) {
        DimensionWork& work = dimensions.emplace_back();
        work.info = dimension_info(world, d, next_id);
        if (u32(work.info.id) == next_id) ++next_id;
        work.least_y = work.info.min_y, work.most_y = work.info.max_y;
        for (const SourceRegion& region : d.regions) {
            work.regions[region.at] = &region;
            for (i32 row = 0; row < 32; row += kStripRows)
                strips.push_back({&work, &region, row});
            std::error_code ignored;
            const auto size = std::filesystem::file_size(region.file, ignored);
            if (!ignored) out.bytes += size;
        }
        VX_TRY(sink.dimension(work.info));
    }

    Import import(sink);
    std::atomic<u64> strips_done{0}, columns{0};
    pool.parallel_for(u32(strips.size()), [&](u32 i) {
        if (import.stopped) return;
        Worker* worker = import.take();
        const u64 before = worker->columns;
        Result<> result = worker->run(strips[i]);
        const u64 made = worker->columns - before;
        import.done(worker, *strips[i].dimension, std::move(result));
        const u64 all = columns.fetch_add(made) + made;
        const u64 done = strips_done.fetch_add(1) + 1;
        if (progress) progress({done * kStripRows, strips.size() * kStripRows, all});
    });
    if (import.error) return tl::unexpected(std::move(*import.error));

    for (DimensionWork& d : dimensions) {
        const bool further = d.least_y < d.info.min_y || d.most_y > d.info.max_y;
        d.info.min_y = d.least_y, d.info.max_y = d.most_y;
        if (further) VX_TRY(sink.dimension(d.info));
        out.dimensions.push_back(d.info);
    }
    VX_TRY(sink.finish());

    import.cache.report(out.read);
    ReadReport entity_files;
    import.entity_cache.report(entity_files);
    entity_files.region_files = 0;
    out.read.merge(entity_files);
    for (const auto& worker : import.workers) {
        const ColumnConverter& c = worker->converter;
        out.columns += worker->columns;
        out.chunks += worker->chunks;
        out.columns_not_made += worker->columns_not_made;
        out.block_entities += c.block_entities;
        out.entities += c.entities;
        out.ticks += c.ticks;
        out.entities_skipped += c.skipped;
        out.read.merge(worker->report);
        for (u32 id = 0; id < c.counts.size(); ++id) {
            if (c.counts[id] == 0) continue;
            const BlockState& state = sink.states().info(StateId(id)).state;
            if (state.name != "minecraft:air") out.counts[state.to_string()] += c.counts[id];
        }
    }
    out.seconds = seconds_since(start);
    return out;
}

std::string import_summary(const ImportReport& r) {
    u64 blocks = 0;
    for (const auto& [name, n] : r.counts)
        blocks += n;
    std::string out = fmt::format("{} columns, {} chunks, {} blocks of {} states, {} block entities, {} entities",
                                  r.columns, r.chunks, blocks, r.counts.size(), r.block_entities, r.entities);
    out += fmt::format("\n{} region files, {:.1f} MB in {:.2f} s: {:.0f} columns/s", r.read.region_files,
                       double(r.bytes) / 1e6, r.seconds, double(r.columns) / std::max(r.seconds, 1e-9));
    if (r.columns_not_made > 0)
        out += fmt::format("\n{} columns had no blocks yet and are left to be made", r.columns_not_made);
    if (r.read.chunks_unreadable + r.read.chunks_salvaged + r.read.regions_unreadable + r.read.sections_skipped > 0)
        out += fmt::format(
            "\ndamage: {} region files and {} chunks unreadable, {} chunks saved in part, {} sections left out",
            r.read.regions_unreadable, r.read.chunks_unreadable, r.read.chunks_salvaged, r.read.sections_skipped);
    for (const std::string& line : r.read.lines)
        out += "\n  " + line;
    if (r.read.problems > r.read.lines.size())
        out += fmt::format("\n  and {} more", r.read.problems - r.read.lines.size());
    return out;
}

} // namespace vitrail
