// The commands of `vitrail`: options as plain structs (filled by main.cpp) and one function each. A function returns the
// exit status's cause: an Error ends the program with one line on standard error and status 2.
#pragma once

#include "apps/effect_arguments.h"
#include "base/result.h"
#include "base/types.h"
#include "voxel/coords.h"

#include <atomic>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vitrail {
struct Content;
}

namespace vitrail::apps {

struct ImportOptions {
    std::string source, world, count_file;
    bool quiet = false;
};
Result<> run_import(const ImportOptions& options);

struct WorldOptions {
    std::string world, blocks_file, target;
};
Result<> run_inspect(const WorldOptions& options);
Result<> run_verify(const WorldOptions& options);
Result<> run_backup(const WorldOptions& options);

struct GenerateOptions {
    u64 seed = 1;
    std::string columns; // X0,Z0,X1,Z1 in chunk columns, inclusive
    std::string device = "cpu", world, stats_file;
    std::string script, stations_file; // a world made by a script instead
    int threads = 0; // 0: as many as the machine has cores
    bool hash = false, list = false;
};
Result<> run_generate(const GenerateOptions& options);
Result<> run_world_script(const GenerateOptions& options); // where there is a script

struct BiomeMapOptions {
    u64 seed = 1;
    std::string center = "0,0";  // X,Z in blocks
    std::string mode = "blocks"; // or "biomes"
    std::string output;
    int size = 4096; // blocks a side
    int scale = 0;   // blocks a pixel; 0: so that the picture has at most 1024 pixels a side
};
Result<> run_biome_map(const BiomeMapOptions& options);

struct RenderOptions {
    std::string world, dimension, at, look, size = "854x480", renderer = "raster", device = "auto", output, stats_file;
    std::optional<u64> seed;
    float fov_deg = 70, time = 6000;
    int view_distance = 12, spp = 64, bounces = 4, trace_seed = 0, devices = 1;
    std::string denoise = "on";
    std::string path_file; // a camera path: many frames
    double fps = 30;
    std::optional<double> seconds; // of the path; none: until its last key
    EffectArguments effects;
    std::vector<std::string> packs;
    bool demo = false;
};
Result<> run_render(const RenderOptions& options);

struct PlayOptions {
    std::string world, connect, renderer = "raster", size, name = "player";
    std::optional<u64> seed;
    int view_distance = 0; // 0: as the settings say
    std::string device = "auto";
    int devices = 1;
    EffectArguments effects; // over the settings
    std::vector<std::string> packs; // instead of the settings'
    std::vector<std::string> trace; // KEY=VALUE, over the settings
    std::optional<u32> day_minutes; // none: as the world has it
};
Result<> run_play(const PlayOptions& options);

struct ServeOptions {
    std::string world, device = "auto";
    int port = 0;
    std::optional<u32> day_minutes; // none: as the world has it
};
Result<> run_serve(const ServeOptions& options);

struct BenchOptions {
    std::string shader_folder; // of the frame benchmarks
    std::vector<std::string> names;
    std::string json_file, world, at, look;
    bool list = false;
};
Result<> run_bench(const BenchOptions& options);

Result<> run_doctor();
Result<> run_effects(); // prints the table of effects

// --- shared by the commands ---

// Turns true at SIGINT or SIGTERM from now on, so that a command can end in order; a second one ends the program at once.
const std::atomic<bool>& stop_on_signals();
// Runs a command and turns what went wrong, exceptions included, into one line on standard error. The exit status: 0 or 2.
int exit_status(const char* program, const std::function<Result<>()>& command);
// The one line that a message is shown as: newlines and other control characters become blanks.
std::string one_line(std::string text);

// What a file of at most `bytes_most` holds. Errors: not_found, io, limit.
Result<std::string> read_text_file(const std::string& path, std::size_t bytes_most);

// The folder content/: $VITRAIL_CONTENT, beside the program, or the source tree it was built from. Errors: not_found.
Result<std::filesystem::path> content_folder();
// content/base, compiled. Errors: those of the scripts.
Result<Content> load_base_content();
// "1,2,3" to numbers; exactly `count` of them. Errors: invalid_argument, naming the option.
Result<std::vector<double>> parse_numbers(const std::string& option, const std::string& text, std::size_t count);
// "854x480"; 16 to 16384 a side, at most 64 million pixels.
Result<std::pair<u32, u32>> parse_size(const std::string& text);
// KEY=VALUE, split at the first =. Errors: invalid_argument, naming the option.
Result<std::pair<std::string, std::string>> parse_change(const std::string& option, const std::string& text);
// Writes a file whole (beside it first, then renamed) or says why not.
Result<> write_file(const std::string& path, const std::string& text);
// An early answer to "can this file be written?", before long work. The folder must exist; nothing is left behind.
Result<> check_writable(const std::string& path);

} // namespace vitrail::apps
