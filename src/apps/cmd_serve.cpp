#include "apps/commands.h"

#include "script/content_loader.h"
#include "server/server.h"

#include <atomic>
#include <chrono>
#include <cstdio>
#include <fmt/format.h>
#include <thread>

namespace vitrail::apps {

// Runs the world until SIGINT or SIGTERM and saves it. No socket transport exists yet, so nobody can join from outside: an
// honest `--port` says so.
Result<> run_serve(const ServeOptions& options) {
    if (options.port != 0) return fail(ErrorCode::unsupported, "serve --port: joining over the network is not built yet");
    VX_TRY_ASSIGN(const Content content, load_base_content());
    server::ServerOptions server_options;
    server_options.folder = options.world;
    server_options.create = false;
    server_options.device = options.device;
    server_options.day_minutes = options.day_minutes;
    VX_TRY_ASSIGN(const auto server, server::Server::open(server_options, content));
    const std::atomic<bool>& stop = stop_on_signals();
    server->start();
    fmt::print("serving {}; Ctrl-C saves and ends\n", options.world);
    std::fflush(stdout); // who started us through a pipe waits for this line
    while (!stop) std::this_thread::sleep_for(std::chrono::milliseconds(50));
    return server->stop();
}

} // namespace vitrail::apps
