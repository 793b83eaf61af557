// StoreSink: an import into a world folder. Columns wait in a short queue; a writer thread encodes them and keeps each
// batch in one transaction.
#pragma once

#include "pipeline/import.h"
#include "store/world_records.h"

#include <atomic>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <thread>

namespace vitrail {

struct StoreSinkOptions {
    u32 columns_a_batch = 256;      // one transaction
    u32 columns_waiting_most = 512; // put_columns waits beyond it
    const std::atomic<bool>* stop = nullptr; // where it turns true, the import ends with an error
};

class StoreSink : public ImportSink {
public:
    // The records must outlive it.
    explicit StoreSink(WorldRecords& records, StoreSinkOptions options = {});
    ~StoreSink() override; // without finish: what still waits is dropped

    StateTable& states() override { return records_.states(); }
    Result<BiomeId> biome(std::string_view name) override { return records_.biomes().intern(name); }
    // Keeps the level as unfinished at once: an import that is killed leaves a world that says so.
    Result<> level(const LevelInfo& level, const std::string& source) override;
    Result<> dimension(const DimensionInfo& info) override;
    // Errors: the store's, from any earlier batch.
    Result<> put_columns(std::vector<ImportedColumn> batch) override;
    // Keeps the rest and the level. Where the source told no spawn, it is on top of the made column nearest to the
    // origin.
    Result<> finish() override;

private:
    void run();
    Result<> save(std::vector<ImportedColumn> columns);

    WorldRecords& records_;
    const StoreSinkOptions options_;
    LevelRecord level_;
    bool spawn_known_ = false;
    i64 nearest_ = INT64_MAX; // writer thread's: distance of the spawn chosen so far, chunk units squared
    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<ImportedColumn> waiting_;
    std::optional<Error> error_;
    bool ending_ = false, dropped_ = false;
    std::thread writer_;
};

} // namespace vitrail
