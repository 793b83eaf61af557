#include "server/server.h"

#include "base/clock.h"
#include "base/log.h"
#include "server/persistence.h"
#include "server/tick.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>
#include <utility>

namespace vitrail::server {

namespace {

constexpr u64 kTickNs = 1000000000ull / kTicksASecond;
constexpr u64 kBehindNsMost = 10 * kTickNs; // more than this is forgiven, so that a slow moment never spirals

u64 chunk_memory(const ServerWorld& world) {
    u64 bytes = 0;
    for (const auto& [id, dimension] : world.dimensions)
        for (const auto& [at, chunk] : dimension.dimension.chunks()) {
            bytes += sizeof(Chunk) + chunk->blocks.memory_bytes();
            if (chunk->light) bytes += chunk->light->memory_bytes();
        }
    return bytes;
}

bool is_idle(const ServerWorld& world) {
    for (const auto& [id, dimension] : world.dimensions)
        if (dimension.scheduler->pending() > 0 || !dimension.light_changed.empty()) return false;
    for (const auto& session : world.sessions) {
        if (!session->joined || session->gone || session->walk_again || !session->columns_complete) return false;
        if (session->walked_opened != world.dimensions.at(session->dimension()).opened || !session->wanted.empty())
            return false;
        if (session->bytes_acknowledged != session->bytes_sent) return false;
    }
    return !world.sessions.empty();
}

} // namespace

Server::Server() = default;

Result<std::unique_ptr<Server>> Server::open(ServerOptions options, const Content& content) {
    auto server = std::unique_ptr<Server>(new Server);
    VX_TRY_ASSIGN(server->world_, open_world(std::move(options), content));
    return server;
}

Server::~Server() {
    if (auto stopped = stop(); !stopped) log_error(fmt::format("the world was not saved: {}", stopped.error().message));
}

void Server::connect(std::unique_ptr<net::Transport> transport) {
    std::lock_guard lock(arrivals_mutex_);
    arrivals_.push_back(std::move(transport));
}

void Server::put_everybody(const StartPlace& place) {
    std::scoped_lock lock(arrivals_mutex_, stats_mutex_);
    put_ = place;
    stats_.idle = false;
}

void Server::tick_once() {
    const u64 start = now_ns(), start_cpu = thread_time_ns();
    {
        std::lock_guard lock(arrivals_mutex_);
        for (auto& transport : arrivals_) {
            auto session = std::make_unique<Session>();
            session->id = world_->next_session++;
            session->transport = std::move(transport);
            world_->sessions.push_back(std::move(session));
        }
        arrivals_.clear();
        if (put_) {
            world_->options.start = std::exchange(put_, std::nullopt);
            for (auto& session : world_->sessions)
                if (session->joined) put_at_start(*world_, *session);
        }
    }
    run_tick(*world_);

    ServerStats& stats = world_->stats;
    stats.ticks = world_->tick;
    stats.tick_ms = float(seconds_since(start) * 1000);
    stats.tick_ms_max = world_->tick % 100 == 0 ? stats.tick_ms : std::max(stats.tick_ms_max, stats.tick_ms);
    world_->tick_times.add(stats.tick_ms, float(thread_time_ns() - start_cpu) * 1e-6f);
    if (world_->tick % kTicksASecond == 0) stats.tick_times = world_->tick_times.distribution();
    stats.sessions = u32(world_->sessions.size());
    stats.columns = stats.chunks = stats.columns_waiting = 0;
    for (const auto& [id, dimension] : world_->dimensions) {
        stats.columns += u32(dimension.columns.size());
        stats.chunks += u32(dimension.dimension.chunks().size());
        stats.columns_waiting += u32(dimension.scheduler->pending());
        if (id == world_->source->options().generated_dimension) stats.generation = dimension.scheduler->stats();
    }
    if (const auto& generator = world_->source->options().generator) stats.generator_cache = generator->cache_stats();
    stats.idle = is_idle(*world_);
    stats.save_pending_bytes = world_->saves->pending_bytes();
    if (world_->tick % kTicksASecond == 0) stats.chunk_memory_bytes = chunk_memory(*world_);
    std::scoped_lock lock(arrivals_mutex_, stats_mutex_);
    stats_ = stats;
    stats_.idle = stats.idle && !put_;
}

void Server::start() {
    if (thread_.joinable() || stopped_) return;
    stopping_ = false;
    thread_ = std::thread([this] { run(); });
}

void Server::run() {
    u64 due = now_ns();
    while (!stopping_) {
        const u64 now = now_ns();
        if (now < due) {
            std::this_thread::sleep_for(std::chrono::nanoseconds(std::min<u64>(due - now, 5000000)));
            continue;
        }
        if (now - due > kBehindNsMost) due = now - kBehindNsMost;
        tick_once();
        due += kTickNs;
    }
}

Result<> Server::stop() {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
    if (!world_ || stopped_) return {};
    stopped_ = true;
    for (auto& [id, dimension] : world_->dimensions)
        dimension.scheduler->stop();
    world_->pool->wait_idle();
    for (auto& session : world_->sessions)
        if (!session->gone) send(*session, net::Channel::control, net::Goodbye{"the server stops"});
    auto saved = save_all(*world_);
    for (auto& session : world_->sessions)
        session->transport->close();
    world_->sessions.clear();
    return saved;
}

ServerStats Server::stats() const {
    std::lock_guard lock(stats_mutex_);
    return stats_;
}

} // namespace vitrail::server
