// Frames of a seeded landscape at the low preset, as the CPU sees them: culling, drawing by the driver (Mesa's software
// renderer draws on these cores), reading back.
#include "bench/harness.h"
#include "bench/render/sample_scene.h"
#include "platform/headless.h"

#include <fmt/format.h>

using namespace vitrail;

static void frame_bench(bench::Context& c, i32 chunks, render::Preset preset) {
    auto context = platform::HeadlessContext::create();
    if (!context) return c.skip(context.error().message);
    auto renderer = render::Renderer::create({.effects = render::preset_effects(preset)});
    if (!renderer) return c.skip(renderer.error().message);
    bench::SampleScene scene(chunks);
    scene.give(**renderer);
    if (auto loaded = (*renderer)->load_textures(scene.registry); !loaded) return c.skip(loaded.error().message);
    auto frame = bench::SampleScene::frame(854, 480, world_pos_from_numbers(30.5, scene.ground(30, -41) + 14, -40.5),
                                           -60, 18, chunks);
    float yaw = -60;
    c.measure(1, [&] {
        yaw += 0.5f;
        frame.seconds += 0.05f;
        frame.views[0].rotation = view_rotation(yaw * 0.017453293f, 18 * 0.017453293f);
        bench::keep((*renderer)->render(frame));
        bench::keep((*renderer)->read_pixels());
    });
    const auto& stats = (*renderer)->stats();
    fmt::print(stderr, "  {} sections, {} draws, {} quads, {:.1f} MB on the GPU\n", stats.sections_visible, stats.draws,
               stats.quads, double(stats.gpu_bytes) / 1e6);
}

void register_render_benches(bench::Suite& suite) {
    suite.add("frame.sample.6", "ms", "854x480, low preset, 6 chunks, seeded landscape",
              [](bench::Context& c) { frame_bench(c, 6, render::Preset::low); });
    suite.add("frame.sample.12", "ms", "854x480, low preset, 12 chunks, seeded landscape",
              [](bench::Context& c) { frame_bench(c, 12, render::Preset::low); });
    suite.add("frame.sample_high.6", "ms", "854x480, high preset, 6 chunks, seeded landscape",
              [](bench::Context& c) { frame_bench(c, 6, render::Preset::high); });
}
