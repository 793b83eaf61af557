// Server: a world directory, a thread that ticks it at 20 Hz, and the sessions that play in it. How to use it:
//
//     VX_TRY_ASSIGN(auto server, Server::open({.folder = "worlds/mine"}, content));
//     auto [near, far] = net::make_loopback();
//     server->connect(std::move(far));        // the replica takes `near`
//     server->start();                        // or tick_once() by hand, in tests
//     ...
//     VX_TRY(server->stop());                 // saves everything; the destructor does the same and logs a failure
//
// The world itself is plain data (server/world.h) and the systems are free functions over it: sessions (session.h),
// chunks (chunk_loading.h), what each session sees (interest.h), edits (edits.h), saving (persistence.h), the tick
// (tick.h). docs/decisions/0005-threads.md says which thread owns what.
#pragma once

#include "base/result.h"
#include "base/types.h"
#include "net/transport.h"
#include "pipeline/generation_scheduler.h"
#include "script/content_loader.h"
#include "server/tick_times.h"
#include "voxel/coords.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace vitrail::server {

inline constexpr u32 kTicksASecond = 20;

// Where everybody joins instead of where he left, e.g. the camera of a still picture.
struct StartPlace {
    std::string dimension; // name; empty: the spawn's
    WorldPos eye;
};

struct ServerOptions {
    std::string folder;                // the world's directory
    bool create = true;                // make a world where there is none
    std::optional<u64> seed;           // of a new world; none: random
    std::string generator = "endless"; // of a new world; "" makes an empty one
    std::string device = "cpu";      // that makes land: "cpu", "cuda" (or an error), "auto" (a GPU where there is one)
    std::string name = "World";        // of a new world
    // How long a day takes, minutes of real time, 0 (time stands still) to 1440; kept with the world. None: as it is there.
    std::optional<u32> day_minutes;
    bool read_only = false;            // takes no lock on the folder and keeps nothing; the world must exist
    std::optional<StartPlace> start;
    unsigned threads = 1; // workers that load and generate; 0: inside the tick
    // Time that each worker may take for that in a second, microseconds, once somebody has moved; 0: as much as there
    // is. Half a core holds frame and tick on 2 cores and makes land several times faster than anybody flies.
    u32 generation_us_a_second = 500'000;
    bool players_set_time = false;       // any player may move and stop the time of day
    u32 view_distance_most = 24;         // chunks
    u32 save_group_ms = 100;             // how long a commit waits for company
    u32 bytes_a_tick_most = 512u << 10;  // section bytes sent to one session in one tick
    u64 bytes_in_flight_most = 4u << 20; // section bytes sent and not acknowledged
};

struct ServerStats {
    u64 ticks = 0;
    float tick_ms = 0, tick_ms_max = 0; // the last, and the longest of the last 100
    TickDistribution tick_times;        // of the last half minute; found anew every 20 ticks
    u32 sessions = 0, columns = 0, chunks = 0, columns_waiting = 0;
    u64 sections_sent = 0, bytes_sent = 0, save_pending_bytes = 0;
    bool idle = false; // every session has all it can see, and has said so; nothing loads (at least one session)
    u64 chunk_memory_bytes = 0; // blocks and light of loaded chunks; counted once a second
    GenerationStats generation; // of the generated dimension
    TerrainCacheStats generator_cache;
};

struct ServerWorld;

class Server {
public:
    // Errors: the store's (not_found, busy, damaged, unsupported, io); unsupported, where the world's generator is not
    // known here (the world is left as it is); those of the terrain's description; invalid_argument, a day of more
    // than 1440 minutes.
    static Result<std::unique_ptr<Server>> open(ServerOptions options, const Content& content);
    ~Server();

    // A new client's connection; any thread.
    void connect(std::unique_ptr<net::Transport> transport);

    void start();
    // From the next tick on every player hovers here, and who joins too; a dimension that is not there leaves all as it
    // was. Not idle until all of it has arrived. For cameras, any thread.
    void put_everybody(const StartPlace& place);
    // Ends the thread, says goodbye to all sessions and saves everything. Errors: io, where saving failed.
    Result<> stop();
    // One tick in the calling thread; only while not started.
    void tick_once();

    ServerStats stats() const; // any thread
    // The world; only in the thread that ticks it, or while not started.
    ServerWorld& world() { return *world_; }

private:
    Server();
    void run();

    std::unique_ptr<ServerWorld> world_;
    std::thread thread_;
    std::atomic<bool> stopping_{false};
    bool stopped_ = false;
    std::mutex arrivals_mutex_;
    std::vector<std::unique_ptr<net::Transport>> arrivals_;
    std::optional<StartPlace> put_; // under arrivals_mutex_
    mutable std::mutex stats_mutex_;
    ServerStats stats_;
};

} // namespace vitrail::server
