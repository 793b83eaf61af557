#include "apps/commands.h"

#include "server/server.h"
#include "world/block_registry.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <fmt/format.h>
#include <thread>

namespace vitrail::apps {

static std::atomic<bool> g_stop{false};

// Runs the world until SIGINT or SIGTERM and saves it. No socket transport exists yet, so nobody can join from outside: an
// honest `--port` says so.
Result<> run_serve(const ServeOptions& options) {
    if (options.port != 0) return fail(ErrorCode::unsupported, "serve --port: joining over the network is not built yet");
    VX_TRY_ASSIGN(const auto registry, load_base_content());
    server::ServerOptions server_options;
    server_options.folder = options.world;
    server_options.create = false;
    VX_TRY_ASSIGN(const auto server, server::Server::open(server_options, registry));
    std::signal(SIGINT, [](int) { g_stop = true; });
    std::signal(SIGTERM, [](int) { g_stop = true; });
    server->start();
    fmt::print("serving {}; Ctrl-C saves and ends\n", options.world);
    std::fflush(stdout); // who started us through a pipe waits for this line
    while (!g_stop) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return server->stop();
}

} // namespace vitrail::apps
