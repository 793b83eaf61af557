// SaveQueue: write-behind. The server's tick submits what changed and goes on; a writer thread encodes, groups and
// commits, and tells when it is durable. Later saves of the same chunk replace pending ones, so a busy chunk costs one
// write a group.
#pragma once

#include "store/world_records.h"

#include <condition_variable>
#include <deque>
#include <thread>
#include <unordered_map>

namespace vitrail {

struct SaveQueueOptions {
    u32 group_ms = 100;                  // a commit waits this long for company; kept below the promise of 250 ms
    u64 pending_bytes_most = 128u << 20; // memory of waiting chunks; submit waits beyond it
    u32 retry_ms = 1000;                 // after a failed commit
    // Called on the writer thread when saving begins to fail (once) with the error, and with nothing when it works
    // again.
    std::function<void(const std::optional<Error>&)> on_trouble = {};
};

class SaveQueue {
public:
    using OnKept = std::function<void()>; // runs on the writer thread, in order of submission

    explicit SaveQueue(WorldRecords& records, SaveQueueOptions options = {});
    // Tries once more to save what is pending, then stops; what still fails is logged.
    ~SaveQueue();

    // Batches are kept in order, each whole. Waits while more than pending_bytes_most are pending.
    void submit(SaveBatch batch, OnKept on_kept = {});
    // Waits until everything submitted before is durable. Errors: the last commit's, where saving fails now; the data
    // stays pending.
    Result<> flush();
    u64 pending_bytes() const;

    // Reads that see what is pending: what was submitted last, else the store's.
    Result<ChunkPtr> load_chunk(DimensionId dimension, ChunkPos at);
    Result<std::vector<WorldRecords::ColumnChunk>> load_column_chunks(DimensionId dimension, ColumnPos at);
    Result<std::optional<ColumnRecord>> load_column(DimensionId dimension, ColumnPos at);

private:
    struct State;
    std::unique_ptr<State> state_;
};

} // namespace vitrail
