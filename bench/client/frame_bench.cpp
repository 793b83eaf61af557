// Frames of a real world: server, replica, mesher and renderer as `vitrail render` uses them, drawn without a window. With
// --world, --at and --look any world and view; without, the land of seed 7 seen from above their spawn.
#include "base/clock.h"
#include "bench/harness.h"
#include "client/still.h"
#include "script/content_loader.h"
#include "terrain/generator.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fmt/format.h>

using namespace vitrail;

namespace {

client::StillOptions still_options(bench::Context& context, u32 view_distance, BlockPos spawn) {
    client::StillOptions options;
    options.view_distance = view_distance;
    options.effects = render::preset_effects(render::Preset::low);
    options.world = context.options["world"];
    options.seed = 7;
    options.pose.eye.at = world_pos_from_numbers(spawn.x + 0.5, spawn.y + 9.0, spawn.z + 0.5);
    options.pose.yaw_deg = 30;
    options.pose.pitch_deg = 12;
    double x = 0, y = 0, z = 0;
    if (std::sscanf(context.options["at"].c_str(), "%lf,%lf,%lf", &x, &y, &z) == 3)
        options.pose.eye.at = world_pos_from_numbers(x, y, z);
    if (std::sscanf(context.options["look"].c_str(), "%lf,%lf", &x, &y) == 2) {
        options.pose.yaw_deg = float(x);
        options.pose.pitch_deg = float(y);
    }
    return options;
}

void frame(bench::Context& context, u32 view_distance, bool memory) {
    const std::vector<std::filesystem::path> roots{std::filesystem::path(VITRAIL_SOURCE_DIR) / "content/base"};
    const auto content = load_content(roots);
    if (!content) return context.skip(content.error().message);
    if (!content->terrain) return context.skip("the content describes no terrain");
    const auto generator = TerrainGenerator::create(*content->terrain, 7);
    if (!generator) return context.skip(generator.error().message);
    const auto options = still_options(context, view_distance, spawn_point(**generator));
    const auto still = client::Still::open(options, *content);
    if (!still) return context.skip(still.error().message);
    // The eye turns a little each frame, as a player's does: what is culled and sorted must be found anew.
    float turned = 0;
    const auto draw = [&] {
        client::CameraPose pose = options.pose;
        pose.yaw_deg += 3 * std::sin(turned += 0.7f);
        if (const auto drawn = (*still)->draw_only(pose, 854, 480, 6000); !drawn) context.skip(drawn.error().message);
    };
    if (memory) {
        draw();
        return context.report(double(resident_memory_bytes()) / 1e6);
    }
    context.measure(1, draw);
    const auto& stats = (*still)->renderer().stats();
    fmt::print("  {} sections of {}, {} draws, {} quads of {}, {:.1f} MB on the GPU\n", stats.sections_visible, stats.sections,
               stats.draws, stats.quads, stats.quads_held, double(stats.gpu_bytes) / 1e6);
}

} // namespace

void register_fly_benches(bench::Suite& suite); // fly_bench.cpp

void register_client_benches(bench::Suite& suite) {
    suite.add("frame.raster.6", "ms", "854x480, low preset, 6 chunks of a real world",
              [](bench::Context& c) { frame(c, 6, false); });
    suite.add("frame.raster.12", "ms", "854x480, low preset, 12 chunks of a real world",
              [](bench::Context& c) { frame(c, 12, false); });
    suite.add("frame.memory.12", "MB", "the whole process with that view, resident: server, replica, content, meshes, software OpenGL; run it alone",
              [](bench::Context& c) { frame(c, 12, true); });
    register_fly_benches(suite);
}
