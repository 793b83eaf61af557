#include "client/local_game.h"

#include "base/clock.h"
#include "base/log.h"
#include "net/loopback.h"

#include <chrono>
#include <fmt/format.h>
#include <thread>

namespace vitrail::client {

Result<std::unique_ptr<LocalGame>> LocalGame::open(const LocalGameOptions& options,
                                                   const Content& content) {
    std::unique_ptr<LocalGame> game(new LocalGame);
    VX_TRY_ASSIGN(game->server_, server::Server::open(options.server, content));
    auto [near, far] = net::make_loopback();
    game->server_->connect(std::move(far));
    game->server_->start();
    replica::ReplicaOptions replica_options = options.replica;
    replica_options.registry = content.registry;
    game->replica_ = std::make_unique<replica::Replica>(std::move(near), replica_options);
    return game;
}

LocalGame::~LocalGame() {
    if (const auto result = stop(); !result) log_error(result.error().message);
}

Result<> LocalGame::wait_joined(double seconds_most) {
    const u64 start = now_ns();
    while (!replica_->joined()) {
        if (!replica_->poll()) return fail(ErrorCode::denied, fmt::format("the server let nobody in: {}", replica_->lost_reason()));
        if (seconds_since(start) > seconds_most) return fail(ErrorCode::limit, "the server did not answer in time");
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    return {};
}

Result<> LocalGame::stop() {
    if (stopped_) return {};
    stopped_ = true;
    if (replica_) replica_->leave();
    return server_ ? server_->stop() : Result<>{};
}

} // namespace vitrail::client
