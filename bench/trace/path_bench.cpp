// Whole paths on the CPU: every core, all that a pixel needs but the film. path.cpu as the tracer makes them, in
// streams; path.single one by one.
#include "bench/trace/benches.h"
#include "bench/trace/ray_scene.h"
#include "scene/sky.h"
#include "trace/cpu/path_stream.h"
#include "trace/sky_source.h"

#include <algorithm>
#include <atomic>
#include <ctime>
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

// Of all threads, ns. What else runs on the machine takes none of it, but spoils caches.
double cpu_time() {
    timespec t{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return double(t.tv_sec) * 1e9 + double(t.tv_nsec);
}

void measure_paths(bench::Context& c, const char* name, bool streams) {
    PathScene s;
    PathSettings settings;
    settings.bounces = 4;
    const u32 threads = std::max(1u, std::thread::hardware_concurrency());
    ThreadPool pool(threads);
    constexpr u32 kTile = 32;
    const u32 across = (s.camera.width + kTile - 1) / kTile, down = (s.camera.height + kTile - 1) / kTile;
    std::atomic<u64> rays{0}, paths{0};
    u32 sample = 0;
    std::vector<double> busy; // a path
    c.measure(double(s.camera.width) * s.camera.height, [&] {
        const double start = cpu_time();
        pool.parallel_for(across * down, [&](u32 tile) {
            static thread_local PathRoom room;
            static thread_local std::vector<PathStart> starts;
            static thread_local std::vector<PixelSample> sums;
            starts.clear();
            const u32 x0 = tile % across * kTile, y0 = tile / across * kTile;
            for (u32 y = y0; y < std::min(y0 + kTile, s.camera.height); ++y)
                for (u32 x = x0; x < std::min(x0 + kTile, s.camera.width); ++x)
                    starts.push_back({x, y, sample});
            sums.resize(starts.size());
            if (streams) {
                rays += trace_paths(s.scene, s.sky, s.camera, settings, starts, sums, room);
            } else {
                u32 traced = 0;
                for (std::size_t i = 0; i < starts.size(); ++i)
                    sums[i] = trace_path(s.scene, s.sky, s.camera, settings, starts[i].x, starts[i].y, sample, traced);
                rays += traced;
            }
            bench::keep(sums.data());
            paths += starts.size();
        });
        ++sample;
        busy.push_back((cpu_time() - start) / (double(s.camera.width) * s.camera.height));
    });
    std::nth_element(busy.begin(), busy.begin() + std::ptrdiff_t(busy.size() / 2), busy.end());
    fmt::print("{}: {:.2f} rays a path, {} threads, {:.0f} ns of a core a path\n", name, double(rays) / double(paths),
               threads, busy[busy.size() / 2]);
}

} // namespace

void register_path_benches(bench::Suite& suite) {
    suite.add("path.cpu", "Mpaths/s",
              "854x480, 4 bounces, 512x256x512 blocks of land at noon under clouds and haze; all cores; the line "
              "before tells the rays a path, shadow rays among them",
              [](bench::Context& c) { measure_paths(c, "path.cpu", true); });
    suite.add("path.single", "Mpaths/s", "the same, path by path",
              [](bench::Context& c) { measure_paths(c, "path.single", false); });
}

} // namespace vitrail
