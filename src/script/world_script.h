// A world made by a script: one Lua text that draws blocks and names stations, places worth looking from. What it may
// call is described for authors in docs/world-scripts.md. The script runs once, in the restricted state of
// lua/sandbox.h.
#pragma once

#include "base/result.h"
#include "script/block_canvas.h"
#include "world/biome_table.h"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace vitrail {

// A place of the world from where one effect of the renderer is seen well.
struct Station {
    std::string name;                 // a word: a-z 0-9 _ -
    std::string effect;               // what it shows, a word
    std::string text;                 // for people
    std::array<double, 3> at{};       // the eye
    float yaw = 0, pitch = 0;         // degrees, as everywhere
    float fov = 70;                   // vertical, degrees
    float time = 6000;                // of the day, 0 to 24000
    std::vector<std::string> without; // settings as "shadows.on=false" that switch the effect off
};

struct ScriptedWorld {
    std::string name = "World";
    BlockPos spawn{0, 64, 0};
    float spawn_yaw = 0;
    u64 time = 1000;
    Dimension dimension; // overworld, without light
    std::vector<Station> stations;
    std::string output;              // what the script printed
    u64 instructions = 0, cells = 0; // spent
};

struct WorldScriptLimits {
    CanvasLimits canvas;
    u64 instructions_most = 400'000'000;
    std::size_t memory_bytes_most = std::size_t(128) << 20;
    double cpu_seconds_most = 60; // of the script itself and of drawing
};

inline constexpr std::size_t kStationsMost = 256;

// `name` is what messages call the script. Blocks and biomes are numbered in the tables given; blocks must be of the
// content. Errors: invalid_argument with name, line and what was expected; limit.
Result<ScriptedWorld> run_world_script(std::string_view text, const std::string& name,
                                       std::shared_ptr<StateTable> states, BiomeTable& biomes,
                                       const WorldScriptLimits& limits = {});

} // namespace vitrail
