// Brings a Minecraft world into Vitrail: reads, decodes and converts its columns on all workers and gives them to a
// sink.
//
//     StoreSink sink(records);                                    // pipeline/store_sink.h
//     ThreadPool pool(default_worker_count());
//     Result<ImportReport> report = import_world(path, sink, pool);
//
// Memory: an open region costs its head; a worker holds the rows of columns that it works on and one batch.
#pragma once

#include "base/result.h"
#include "formats/level_dat.h"
#include "formats/read_report.h"
#include "jobs/thread_pool.h"
#include "voxel/chunk.h"
#include "world/dimension.h"
#include "world/state_table.h"

#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace vitrail {

struct ImportedColumn {
    DimensionId dimension{};
    ColumnPos at;
    struct Part {
        i32 y = 0; // chunk units
        ChunkPtr chunk;
    };
    std::vector<Part> chunks; // bottom first; a y that is absent was never made
    ColumnHeights heights;
};

// Where an import goes. An error from any function ends the import with it.
class ImportSink {
public:
    virtual ~ImportSink() = default;
    virtual StateTable& states() = 0;
    virtual Result<BiomeId> biome(std::string_view name) = 0;                      // thread-safe
    virtual Result<> level(const LevelInfo& level, const std::string& source) = 0; // once, first
    // Before a dimension's columns; again at the end, where its columns reached further than expected.
    virtual Result<> dimension(const DimensionInfo& info) = 0;
    virtual Result<> put_columns(std::vector<ImportedColumn> batch) = 0; // thread-safe
    virtual Result<> finish() = 0;                                       // all was given; returns when all is kept
};

struct ImportProgress {
    u64 rows_done = 0, rows_all = 0; // rows of 32 columns
    u64 columns = 0;
};

struct ImportReport {
    ReadReport read;
    LevelInfo level;
    std::vector<DimensionInfo> dimensions;
    u64 columns = 0, chunks = 0, block_entities = 0, entities = 0, ticks = 0;
    u64 columns_not_made = 0;          // half-made and without a block: left to be made again
    u64 entities_skipped = 0;          // they and block entities whose chunk is not there
    std::map<std::string, u64> counts; // blocks but air by state as imported
    u64 bytes = 0;                     // of region files read
    double seconds = 0;
};

// For a person: a few lines, the last without newline.
std::string import_summary(const ImportReport& report);

// Errors: those of open_world_source and the sink. Damaged regions and chunks are skipped and reported.
Result<ImportReport> import_world(const std::filesystem::path& source, ImportSink& sink, ThreadPool& pool,
                                  const std::function<void(const ImportProgress&)>& progress = {});

} // namespace vitrail
