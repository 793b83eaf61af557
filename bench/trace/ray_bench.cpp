// Rays through land, one core: scalar traversal and streams.
#include "bench/trace/benches.h"
#include "bench/trace/ray_scene.h"
#include "trace/cpu/ray_stream.h"

namespace vitrail {

namespace {

using namespace trace;

bench::RayScene& land() {
    static bench::RayScene scene;
    return scene;
}

struct Sets {
    bench::RaySet primary = bench::camera_rays(land()), bounce1 = bench::bounce_rays(land(), primary),
                  bounce2 = bench::bounce_rays(land(), bounce1), shadow = bench::sun_rays(land(), primary);
};
bench::RaySet& set_of(int which) {
    static Sets sets;
    return which == 0 ? sets.primary : which == 1 ? sets.bounce1 : which == 2 ? sets.bounce2 : sets.shadow;
}

void scalar_closest(bench::Context& c, int which) {
    bench::RaySet& set = set_of(which);
    const SceneView s = land().view();
    c.measure(double(set.rays.size()), [&] {
        for (std::size_t i = 0; i < set.rays.size(); ++i)
            closest_hit(s, set.rays[i], kFar, 0, set.hits[i]);
        bench::keep(set.hits.data());
    });
}

void scalar_shadow(bench::Context& c) {
    bench::RaySet& set = set_of(3);
    const SceneView s = land().view();
    c.measure(double(set.rays.size()), [&] {
        u32 dark = 0;
        for (const Ray& ray : set.rays)
            dark += shadowed(s, ray, kFar, 0, [](const Hit&) { return false; });
        bench::keep(dark);
    });
}

void stream_closest(bench::Context& c, int which) {
    bench::RaySet& set = set_of(which);
    const SceneView s = land().view();
    c.measure(double(set.rays.size()), [&] {
        trace_stream(s, {set.rays, {}, {}}, set.hits);
        bench::keep(set.hits.data());
    });
}

void stream_shadow(bench::Context& c) {
    bench::RaySet& set = set_of(3);
    const SceneView s = land().view();
    std::vector<Lit> lit(set.rays.size());
    c.measure(double(set.rays.size()), [&] {
        shadow_stream(s, {set.rays, {}, {}}, lit);
        bench::keep(lit.data());
    });
}

// A block placed and broken again, with all that follows from it. high: alone in the air, where an empty brick fills.
void edits(bench::Context& c, bool high) {
    bench::RayScene scene;
    scene.grid.refresh();
    Rng rng(5);
    std::vector<BlockPos> places;
    for (u32 i = 0; i < 64; ++i) {
        const i32 x = 100 + i32(rng.below(300)), z = 100 + i32(rng.below(300));
        places.push_back({x, bench::SampleLand::height(x, z) + (high ? 40 : 1), z});
    }
    c.measure(double(places.size() * 2), [&] {
        for (const BlockPos at : places)
            for (const StateId state : {StateId(2), StateId::air}) {
                scene.grid.apply(EditBatch{{{at, state}}});
                scene.grid.refresh();
                scene.grid.clean();
            }
    });
}

void build(bench::Context& c) {
    bench::RayScene scene;
    c.measure(double(bench::SampleLand::kX * bench::SampleLand::kY * bench::SampleLand::kZ), [&] {
        scene.grid.clear();
        scene.fill();
    });
}

} // namespace

void register_ray_benches(bench::Suite& suite) {
    constexpr const char* kUnit = "Mrays/s";
    suite.add("trace.primary", kUnit, "camera rays, 854x480 in pieces of 8x8, over 512x256x512 blocks; one core",
              [](bench::Context& c) { stream_closest(c, 0); });
    suite.add("trace.bounce1", kUnit, "from what those hit, by the cosine; one core",
              [](bench::Context& c) { stream_closest(c, 1); });
    suite.add("trace.bounce2", kUnit, "once more; one core", [](bench::Context& c) { stream_closest(c, 2); });
    suite.add("trace.shadow", kUnit, "from camera rays' hits to the sun; one core",
              [](bench::Context& c) { stream_shadow(c); });
    suite.add("trace.edit", "us", "a block placed or broken on the ground", [](bench::Context& c) { edits(c, false); });
    suite.add("trace.edit_high", "us", "in open air, where a brick was empty",
              [](bench::Context& c) { edits(c, true); });
    suite.add("trace.grid", "us", "a chunk of the land into an empty grid, one core", build);
    suite.add("trace.single.primary", kUnit, "the same rays one by one",
              [](bench::Context& c) { scalar_closest(c, 0); });
    suite.add("trace.single.bounce1", kUnit, "", [](bench::Context& c) { scalar_closest(c, 1); });
    suite.add("trace.single.bounce2", kUnit, "", [](bench::Context& c) { scalar_closest(c, 2); });
    suite.add("trace.single.shadow", kUnit, "", [](bench::Context& c) { scalar_shadow(c); });
}

} // namespace vitrail
