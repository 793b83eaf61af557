// Whole paths on the CPU: every core, all that a pixel needs but the film.
#include "bench/trace/benches.h"
#include "bench/trace/ray_scene.h"
#include "scene/sky.h"
#include "trace/kernel/path.h"
#include "trace/sky_source.h"

#include <atomic>
#include <fmt/core.h>
#include <thread>

namespace vitrail {

namespace {

using namespace trace;

// The land of the ray benches at noon, each block in one color.
struct PathScene {
    bench::RayScene land;
    std::vector<u32> albedo, material;
    scene::FrameView frame;
    SceneView scene;
    SkyView sky;
    Camera camera;

    PathScene() {
        constexpr u32 kTexels = 64, kColors[] = {0x6E8F5A, 0x7D7F86, 0x51739A, 0x3F7A4C, 0x9AB8C8};
        const u32 layers = u32(land.states.size());
        for (u32 layer = 0; layer < layers; ++layer) {
            albedo.insert(albedo.end(), kTexels, kColors[layer % std::size(kColors)] | 0xFF000000u);
            material.insert(material.end(), kTexels, 0x00E68080u);
            for (u32 f = 0; f < 6; ++f)
                land.states[layer].faces[f] = u64(f) << 20 | u64(layer) << 32;
        }
        scene = land.view();
        scene.textures.albedo = albedo.data(), scene.textures.material = material.data();
        scene.textures.size_bits = 3, scene.textures.levels = 1, scene.textures.layers = layers;
        scene.textures.layer_words = kTexels;
        frame.sky = scene::sky_at(7000);
        frame.views.resize(1);
        frame.view_distance = 512;
        sky = sky_view_of(frame);
        camera = bench::land_camera();
    }
};

void measure_paths(bench::Context& c) {
    PathScene s;
    PathSettings settings;
    settings.bounces = 4;
    const u32 threads = std::max(1u, std::thread::hardware_concurrency());
    ThreadPool pool(threads);
    constexpr u32 kTile = 16;
    const u32 across = (s.camera.width + kTile - 1) / kTile, down = (s.camera.height + kTile - 1) / kTile;
    std::atomic<u64> rays{0}, paths{0};
    u32 sample = 0;
    c.measure(double(s.camera.width) * s.camera.height, [&] {
        pool.parallel_for(across * down, [&](u32 tile) {
            u32 traced = 0, done = 0;
            for (u32 y = tile / across * kTile; y < std::min(tile / across * kTile + kTile, s.camera.height); ++y)
                for (u32 x = tile % across * kTile; x < std::min(tile % across * kTile + kTile, s.camera.width); ++x) {
                    const PixelSample p = trace_path(s.scene, s.sky, s.camera, settings, x, y, sample, traced);
                    bench::keep(p);
                    ++done;
                }
            rays += traced, paths += done;
        });
        ++sample;
    });
    fmt::print("path.cpu: {:.2f} rays a path, {} threads\n", double(rays) / double(paths), threads);
}

} // namespace

void register_path_benches(bench::Suite& suite) {
    suite.add(
        "path.cpu", "Mpaths/s",
        "854x480, 4 bounces, 512x256x512 blocks of land at noon under clouds and haze; all cores; the line before "
        "tells the rays a path, shadow rays among them",
        measure_paths);
}

} // namespace vitrail
