// ServerWorld: all that a running world is, as plain data; the systems are free functions over it (tick.h and the
// headers it names). Only the thread that ticks touches it, but for `kept`, which has a lock of its own.
#pragma once

#include "jobs/thread_pool.h"
#include "pipeline/generation_scheduler.h"
#include "server/server.h"
#include "server/session.h"
#include "store/save_queue.h"
#include "store/world_records.h"

#include <map>
#include <mutex>
#include <unordered_map>
#include <unordered_set>

namespace vitrail::server {

// In the dimension and lit.
struct Column {
    bool made = false;   // its absent chunks are air; else it could not be read
    bool stored = false; // all of it is in the store, so that saving its changed chunks is enough
};

struct ServerDimension {
    explicit ServerDimension(Dimension d)
        : dimension(std::move(d)) {}

    Dimension dimension;
    std::unordered_map<ColumnPos, Column> columns;
    // face_connections of sections looked at; goes with the section's blocks.
    std::unordered_map<ChunkPos, u64> connections;
    // To be saved with the next batch.
    std::unordered_set<ChunkPos> dirty_chunks;
    std::unordered_set<ColumnPos> dirty_columns;
    // Light that sessions have not been told of.
    std::unordered_set<ChunkPos> light_changed;
    std::unordered_set<ColumnPos> heights_changed;
    u64 opened = 0; // grows when columns come or connections change, so that interest is walked again
    std::unique_ptr<GenerationScheduler> scheduler; // of columns that are wanted and not here
};

struct Mailbox {
    std::mutex mutex;
    std::vector<std::pair<u32, u32>> kept; // session, last edit sequence that is on disk
};

struct ServerWorld {
    ServerOptions options;
    std::shared_ptr<const BlockRegistry> registry;
    Bytes registry_bytes; // net/registry_codec.h
    u64 content_hash = 0;

    LevelRecord level;
    DayRunner day_runner;
    bool time_paused = false; // by a player; not kept
    bool level_dirty = false;
    std::unique_ptr<WorldRecords> records;
    // The writer thread posts here; it must outlive that.
    std::shared_ptr<Mailbox> mailbox = std::make_shared<Mailbox>();
    std::unique_ptr<SaveQueue> saves;
    std::unique_ptr<ChunkSource> source;
    std::map<DimensionId, ServerDimension> dimensions;
    std::vector<std::unique_ptr<Session>> sessions;
    // Players who left since the start: the store may not have their last state yet.
    std::unordered_map<std::string, PlayerRecord> players_left;
    u32 next_session = 1;
    u64 tick = 0;
    ServerStats stats;
    TickTimes tick_times;
    // Last, so that it ends first: its tasks use what stands above.
    std::unique_ptr<ThreadPool> pool;

    StateTable& states() const { return records->states(); }
    BiomeTable& biomes() const { return records->biomes(); }
};

} // namespace vitrail::server
