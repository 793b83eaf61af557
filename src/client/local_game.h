// LocalGame: single player, which is a server and a replica in one process, joined by the loopback transport with the same
// messages a socket carries.
#pragma once

#include "replica/replica.h"
#include "server/server.h"

#include <functional>
#include <memory>

namespace vitrail::client {

struct LocalGameOptions {
    server::ServerOptions server;
    replica::ReplicaOptions replica;
};

class LocalGame {
public:
    // Opens the world, starts the server's thread and says hello. Errors: the server's.
    static Result<std::unique_ptr<LocalGame>> open(const LocalGameOptions& options, const Content& content);
    ~LocalGame();
    replica::Replica& replica() { return *replica_; }
    server::Server& server() { return *server_; }
    // Polls until the replica has joined. Errors: what the server said; limit after `seconds_most`.
    Result<> wait_joined(double seconds_most);
    // Leaves and saves everything. Errors: io.
    Result<> stop();

private:
    LocalGame() = default;
    std::unique_ptr<server::Server> server_;
    std::unique_ptr<replica::Replica> replica_;
    bool stopped_ = false;
};

} // namespace vitrail::client
