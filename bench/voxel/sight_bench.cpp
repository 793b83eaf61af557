// sight.N: the walk of sight lines over all sections of a view of N chunks, in every direction: a maze below, open sky
// above.
#include "bench/harness.h"
#include "bench/voxel/sample_maze.h"
#include "voxel/sight.h"

namespace {

using namespace vitrail;

void sight_bench(bench::Context& c, i32 radius, i32 eye_y) {
    static const u8 flags[] = {0, 1, 1};
    const i32 side = 2 * radius + 1, high = 24, ground = 9;
    SightFlood flood;
    flood.reset({{0, 0, 0}, {side, high, side}});
    Rng rng(3);
    bench::SampleMaze maze({side, ground, side});
    maze.carve_maze(rng, 30);
    for (i32 z = 0; z < side * 16; ++z) // hills over the maze
        for (i32 x = 0; x < side * 16; ++x) {
            const i32 top = ground * 16 - 12 + i32(6 * std::sin(float(x) * 0.05f) + 6 * std::sin(float(z) * 0.07f));
            maze.carve({x, top, z}, {x, ground * 16, z});
        }
    maze.each_section([&](ChunkPos at) { flood.set(at, section_sight(maze.blocks(at), {flags, 1})); });
    WorldPos eye = corner_of({radius * 16 + 7, eye_y, radius * 16 + 7});
    c.measure(1, [&] {
        eye.x ^= kFixedOne >> 2;
        flood.run(eye, 0.125f);
        bench::keep(flood.reached());
    });
    std::fprintf(stderr, "  %zu of %zu sections\n", flood.reached_count(), flood.box().count());
}

} // namespace

void register_sight_benches(bench::Suite& suite) {
    for (const i32 radius : {6, 12, 16})
        suite.add("sight." + std::to_string(radius), "us",
                  "lines of sight over " + std::to_string(radius) + " chunks of hills, in every direction",
                  [radius](bench::Context& c) { sight_bench(c, radius, 150); });
    suite.add("sight.maze.12", "us", "the same under ground, in a maze",
              [](bench::Context& c) { sight_bench(c, 12, 71); });
}
