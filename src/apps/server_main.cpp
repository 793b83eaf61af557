// `vitrail-server`: the same as `vitrail serve`, without graphics libraries.
#include "apps/commands.h"

#include <CLI/CLI.hpp>
#include <cstdio>

int main(int argc, char** argv) {
    CLI::App app("Vitrail server");
    vitrail::apps::ServeOptions options;
    app.add_option("--world", options.world, "world folder")->required();
    app.add_option("--port", options.port, "UDP port");
    app.add_option("--device", options.device, "what makes the land: cpu, cuda or auto");
    app.add_option("--day-minutes", options.day_minutes, "how long a day takes, 0 (time stands still) to 1440; kept with the world")
        ->check(CLI::Range(0, 1440));
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::fprintf(stderr, "vitrail-server: %s\n", vitrail::apps::one_line(error.what()).c_str());
        return 2;
    }
    return vitrail::apps::exit_status("vitrail-server", [&] { return vitrail::apps::run_serve(options); });
}
