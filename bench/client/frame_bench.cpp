// Frames of a real world: server, replica, mesher and renderer as `vitrail render` uses them, drawn without a window.
// With --world, --at and --look any world and view; without, the land of seed 7 seen from above their spawn.
#include "base/clock.h"
#include "bench/harness.h"
#include "client/still.h"
#include "gfx/context.h"
#include "platform/headless.h"
#include "script/content_loader.h"
#include "terrain/generator.h"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <fmt/format.h>

using namespace vitrail;

namespace {

client::StillOptions still_options(bench::Context& context, u32 view_distance, BlockPos spawn) {
    client::StillOptions options;
    options.view_distance = view_distance;
    options.effects = render::preset_effects(render::Preset::low);
    options.world = context.options["world"];
    options.shader_folder = context.options["shaders"];
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
    client::StillOptions options;
    { // of the game there is one generator, the server's
        const auto generator = TerrainGenerator::create(*content->terrain, 7);
        if (!generator) return context.skip(generator.error().message);
        options = still_options(context, view_distance, spawn_point(**generator));
    }
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
    // Processor time of all threads tells what a frame costs where others keep the cores busy.
    constexpr int kTogether = 10;
    u32 drawn = 0;
    const std::clock_t before = std::clock();
    context.measure(kTogether, [&] {
        for (int i = 0; i < kTogether; ++i, ++drawn)
            draw();
    });
    const double processor_ms = double(std::clock() - before) * 1e3 / CLOCKS_PER_SEC / drawn;
    const auto& stats = (*still)->renderer().stats();
    fmt::print(
        "  {:.1f} ms of processor time a frame; {} sections of {}, {} draws, {} quads of {}, {:.1f} MB on the GPU\n",
        processor_ms, stats.sections_visible, stats.sections, stats.draws, stats.quads, stats.quads_held,
        double(stats.gpu_bytes) / 1e6);
}

// What the GPU alone takes, by its own clock, pass by pass: mean over frames of a turning eye. --world, --at and --look
// hold here too.
void frame_gpu(bench::Context& context) {
    const std::vector<std::filesystem::path> roots{std::filesystem::path(VITRAIL_SOURCE_DIR) / "content/base"};
    const auto content = load_content(roots);
    if (!content) return context.skip(content.error().message);
    if (!content->terrain) return context.skip("the content describes no terrain");
    {
        const auto probe = platform::HeadlessContext::create();
        if (!probe) return context.skip(probe.error().message);
        if (const auto info = gfx::context_info(); !info || info->software) return context.skip("no GPU here");
    }
    const auto generator = TerrainGenerator::create(*content->terrain, 7);
    if (!generator) return context.skip(generator.error().message);
    auto options = still_options(context, 16, spawn_point(**generator));
    options.effects = render::preset_effects(render::Preset::ultra);
    const auto still = client::Still::open(options, *content);
    if (!still) return context.skip(still.error().message);
    (*still)->renderer().set_timing(true);
    std::vector<std::pair<std::string, double>> sums;
    constexpr int kWarm = 30, kFrames = 200;
    double walls = 0;
    for (int i = 0; i < kWarm + kFrames; ++i) {
        client::CameraPose pose = options.pose;
        pose.yaw_deg += 40 * std::sin(float(i) * 0.03f);
        const u64 start = now_ns();
        if (const auto drawn = (*still)->draw_only(pose, 1920, 1080, 6000); !drawn)
            return context.skip(drawn.error().message);
        if (i < kWarm) continue;
        walls += double(now_ns() - start) * 1e-6;
        const auto& passes = (*still)->renderer().stats().passes_ms;
        sums.resize(passes.size());
        double all = 0;
        for (std::size_t k = 0; k < passes.size(); ++k) {
            sums[k].first = passes[k].first;
            sums[k].second += passes[k].second / kFrames;
            all += passes[k].second;
        }
        context.seconds_an_item.push_back(all * 1e-3);
    }
    for (const auto& [name, ms] : sums)
        fmt::print("  {:20} {:8.3f} ms\n", name, ms);
    const auto& stats = (*still)->renderer().stats();
    fmt::print("  {:.2f} ms with the CPU's part; {} sections of {}, {} quads, {} of shadows\n", walls / kFrames,
               stats.sections_visible, stats.sections, stats.quads, stats.shadow_quads);
}

} // namespace

void register_fly_benches(bench::Suite& suite); // fly_bench.cpp

void register_client_benches(bench::Suite& suite) {
    suite.add("frame.raster.6", "ms", "854x480, low preset, 6 chunks of a real world",
              [](bench::Context& c) { frame(c, 6, false); });
    suite.add("frame.raster.12", "ms", "854x480, low preset, 12 chunks of a real world",
              [](bench::Context& c) { frame(c, 12, false); });
    suite.add(
        "frame.memory.12", "MB",
        "the whole process with that view, resident: server, replica, content, meshes, software OpenGL; run it alone",
        [](bench::Context& c) { frame(c, 12, true); });
    suite.add("frame.gpu.ultra", "ms", "1920x1080, ultra preset, 16 chunks of a real world: the GPU's time a frame",
              frame_gpu);
    register_fly_benches(suite);
}
