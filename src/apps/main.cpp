// `vitrail`: reads the command line (a contract: README.md) and runs one command. Any error is one line and status 2.
#include "apps/commands.h"

#include "base/log.h"

#include <CLI/CLI.hpp>
#include <charconv>
#include <cstdio>
#include <cstdlib>
#include <functional>

using namespace vitrail;
using namespace vitrail::apps;

namespace {

struct Command {
    CLI::App* app;
    std::function<Result<>()> run;
};

std::string first_line(const std::string& text) { return one_line(text.substr(0, text.find('\n'))); }

// CLI::Range lets NaN pass.
CLI::Validator number_in(double least, double most) {
    return CLI::Validator(
        [=](std::string& text) {
            char* end = nullptr;
            const double value = std::strtod(text.c_str(), &end);
            if (!text.empty() && *end == 0 && value >= least && value <= most) return std::string();
            return "'" + text + "' is no number from " + CLI::detail::to_string(least) + " to " + CLI::detail::to_string(most);
        },
        "NUMBER");
}

// A seed: a whole number of 64 bits, with or without sign.
CLI::Validator seed_number() {
    return CLI::Validator(
        [](std::string& text) {
            const char* end = text.data() + text.size();
            i64 with_sign = 0;
            u64 without = 0;
            const auto a = std::from_chars(text.data(), end, with_sign);
            const auto b = std::from_chars(text.data(), end, without);
            const bool good = (a.ec == std::errc() && a.ptr == end) || (b.ec == std::errc() && b.ptr == end);
            return good ? std::string() : "'" + text + "' is no whole number of 64 bits";
        },
        "SEED");
}

CLI::Validator not_empty() {
    return CLI::Validator([](std::string& text) { return text.empty() ? std::string("is empty") : std::string(); }, "");
}

// No option of ours means anything when its text is empty.
void refuse_empty_texts(CLI::App& command) {
    for (CLI::Option* option : command.get_options())
        if (option->get_type_size() > 0) option->check(not_empty());
}

} // namespace

int main(int argc, char** argv) {
    CLI::App app("Vitrail: a voxel world to walk in, change and keep");
    app.require_subcommand(1);
    app.set_version_flag("--version", "vitrail 0.1.0");
    bool verbose = false;
    app.add_flag("--verbose", verbose, "more log lines");
    std::vector<Command> commands;

    ImportOptions import_options;
    {
        auto* c = app.add_subcommand("import", "Bring a Minecraft world into a Vitrail world, or count its blocks");
        c->add_option("SOURCE", import_options.source, "Minecraft folder or region file")->required();
        auto* world = c->add_option("--world", import_options.world, "world folder to fill");
        auto* count = c->add_option("--count", import_options.count_file, "write block counts as JSON and import nothing");
        world->excludes(count);
        c->add_flag("--quiet", import_options.quiet, "no progress bar");
        commands.push_back({c, [&] { return run_import(import_options); }});
    }
    WorldOptions world_options;
    auto add_world_command = [&](const char* name, const char* text, Result<> (*run)(const WorldOptions&)) {
        auto* c = app.add_subcommand(name, text);
        c->add_option("--world", world_options.world, "world folder")->required();
        commands.push_back({c, [&world_options, run] { return run(world_options); }});
        return c;
    };
    add_world_command("inspect", "Say what a world holds", run_inspect)
        ->add_option("--blocks", world_options.blocks_file, "write counts by block state as JSON");
    add_world_command("verify", "Check every record of a world", run_verify);
    add_world_command("backup", "Make a consistent copy, also while the world is played", run_backup)
        ->add_option("--target,-o", world_options.target, "folder for the copy")
        ->required();

    GenerateOptions generate;
    {
        auto* c = app.add_subcommand("generate", "Generate land");
        c->add_option("--seed", generate.seed, "world seed")->check(seed_number());
        c->add_option("--columns", generate.columns, "X0,Z0,X1,Z1 in chunk columns, inclusive");
        c->add_option("--device", generate.device, "cpu or cuda");
        c->add_option("--threads", generate.threads, "threads of the CPU; as many as there are cores where not given")->check(CLI::Range(1, 1024));
        c->add_option("--world", generate.world, "keep it in this world folder");
        c->add_option("--stats", generate.stats_file, "write figures as JSON");
        auto* hash = c->add_flag("--hash", generate.hash, "print a hash of all blocks");
        auto* list = c->add_flag("--list", generate.list, "list what the generator knows");
        auto* script = c->add_option("--script", generate.script, "a Lua file that makes a world (docs/world-scripts.md) instead of the generator");
        c->add_option("--stations", generate.stations_file, "write the stations that the script names as JSON")->needs(script);
        for (CLI::Option* other : {c->get_option("--seed"), c->get_option("--columns"), c->get_option("--device"), hash, list}) script->excludes(other);
        commands.push_back({c, [&] { return run_generate(generate); }});
    }
    BiomeMapOptions biome_map;
    {
        auto* c = app.add_subcommand("biome-map", "Draw a map of generated land, seen from above");
        c->add_option("--seed", biome_map.seed, "world seed")->check(seed_number());
        c->add_option("--center", biome_map.center, "X,Z in blocks");
        c->add_option("--size", biome_map.size, "blocks a side")->check(CLI::Range(16, 1 << 20));
        c->add_option("--scale", biome_map.scale, "blocks a pixel; so that at most 1024 pixels a side come out where not given")->check(CLI::Range(1, 4096));
        c->add_option("--mode", biome_map.mode, "blocks or biomes")->check(CLI::IsMember({"blocks", "biomes"}));
        c->add_option("--output,-o", biome_map.output, "PNG file")->required();
        commands.push_back({c, [&] { return run_biome_map(biome_map); }});
    }
    RenderOptions render;
    {
        auto* c = app.add_subcommand("render", "Draw a picture, or the frames of a camera path");
        c->add_option("--world", render.world, "world folder");
        c->add_option("--seed", render.seed, "a new world of this seed, kept nowhere")->check(seed_number());
        c->add_option("--dimension", render.dimension, "dimension name");
        c->add_option("--at", render.at, "X,Y,Z of the eye");
        c->add_option("--look", render.look, "YAW,PITCH in degrees");
        c->add_option("--fov", render.fov_deg, "vertical field of view, degrees")->check(number_in(5, 150));
        c->add_option("--size", render.size, "WxH in pixels");
        c->add_option("--time", render.time, "time of day, 6000 is noon")->check(number_in(0, 24000));
        c->add_option("--renderer", render.renderer, "raster or trace");
        c->add_option("--spp", render.spp, "samples a pixel (trace)")->check(CLI::Range(1, 1'000'000));
        c->add_option("--device", render.device, "cpu, cuda or auto (trace)");
        c->add_option("--devices", render.devices, "CUDA devices that share a picture, at most (trace)")->check(CLI::Range(1, 64));
        c->add_option("--denoise", render.denoise, "on or off (trace)");
        c->add_option("--bounces", render.bounces, "scattering events of a path (trace)")->check(CLI::Range(0, 64));
        c->add_option("--trace-seed", render.trace_seed, "another seed, other noise (trace)")->check(CLI::Range(0, 2'000'000'000));
        add_effect_arguments(*c, render.effects);
        c->add_option("--pack", render.packs, "resource pack, zip or folder; several: the later covers the earlier")->allow_extra_args(false);
        c->add_option("--view-distance", render.view_distance, "chunks")->check(CLI::Range(1, 32));
        auto* path = c->add_option("--path", render.path_file, "a camera path (docs/tracing.md): many frames");
        c->add_option("--fps", render.fps, "frames a second of the path")->check(number_in(0.1, 240))->needs(path);
        c->add_option("--seconds", render.seconds, "how much of the path; all where not given")->check(number_in(0, 86400))->needs(path);
        c->add_option("--output,-o", render.output, "PNG file, or .exr (trace); of a path numbered files as frame-%04d.png, or .mp4, .webm, .mkv")->required();
        c->add_option("--stats", render.stats_file, "write figures as JSON");
        c->add_flag("--demo", render.demo, "the demo picture");
        commands.push_back({c, [&] { return run_render(render); }});
    }
    PlayOptions play;
    {
        auto* c = app.add_subcommand("play", "Walk in a world");
        c->add_option("--world", play.world, "world folder (made where there is none)");
        c->add_option("--seed", play.seed, "seed of a new world")->check(seed_number());
        c->add_option("--connect", play.connect, "HOST:PORT of a server");
        c->add_option("--renderer", play.renderer, "raster or trace; F5 changes it while playing");
        c->add_option("--size", play.size, "WxH of the window");
        c->add_option("--name", play.name, "player name");
        c->add_option("--view-distance", play.view_distance, "chunks")->check(CLI::Range(1, 32));
        c->add_option("--device", play.device, "what makes the land and traces light: cpu, cuda or auto");
        c->add_option("--devices", play.devices, "CUDA devices that share a traced picture, at most")->check(CLI::Range(1, 64));
        add_effect_arguments(*c, play.effects);
        c->add_option("--trace", play.trace, "KEY=VALUE of the path tracer, such as bounces=2; may be repeated")->take_all()->expected(1);
        c->add_option("--pack", play.packs, "resource pack, zip or folder; several: the later covers the earlier")->allow_extra_args(false);
        c->add_option("--day-minutes", play.day_minutes, "how long a day takes, 0 (time stands still) to 1440; kept with the world")
            ->check(CLI::Range(0, 1440));
        commands.push_back({c, [&] { return run_play(play); }});
    }
    ServeOptions serve;
    {
        auto* c = app.add_subcommand("serve", "Run a server without a window");
        c->add_option("--world", serve.world, "world folder")->required();
        c->add_option("--port", serve.port, "UDP port");
        c->add_option("--device", serve.device, "what makes the land: cpu, cuda or auto");
        c->add_option("--day-minutes", serve.day_minutes, "how long a day takes, 0 (time stands still) to 1440; kept with the world")
            ->check(CLI::Range(0, 1440));
        commands.push_back({c, [&] { return run_serve(serve); }});
    }
    BenchOptions bench;
    {
        auto* c = app.add_subcommand("bench", "Measure the hot paths");
        c->add_option("NAME", bench.names, "names or beginnings of names; all where none is given");
        c->add_option("--json", bench.json_file, "write results as JSON");
        c->add_option("--world", bench.world, "world folder for frame benchmarks");
        c->add_option("--at", bench.at, "X,Y,Z of the eye");
        c->add_option("--look", bench.look, "YAW,PITCH in degrees");
        c->add_option("--shaders", bench.shader_folder, "shaders of the frame benchmarks, from this folder");
        c->add_flag("--list", bench.list, "list the names");
        commands.push_back({c, [&] { return run_bench(bench); }});
    }
    commands.push_back({app.add_subcommand("effects", "List the effects, their ranges and presets"), [] { return run_effects(); }});
    commands.push_back({app.add_subcommand("doctor", "Say what this machine offers"), [] { return run_doctor(); }});

    for (const Command& command : commands) refuse_empty_texts(*command.app);
    try {
        app.parse(argc, argv);
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error); // --help, --version
        std::fprintf(stderr, "vitrail: %s\n", first_line(error.what()).c_str());
        return 2;
    }
    // Who draws or imports wants to see what went wrong, who serves also what goes on.
    set_log_level(verbose ? LogLevel::debug : app.got_subcommand("serve") ? LogLevel::info : LogLevel::warning);
    for (const Command& command : commands) {
        if (!command.app->parsed()) continue;
        return exit_status("vitrail", command.run);
    }
    return 2;
}
