// Generated land from nothing to packed chunks: terrain.all counts 16^3 chunks that hold anything, terrain.columns columns.
#include "bench/harness.h"
#include "pipeline/generate_area.h"
#include "pipeline/new_world.h"
#include "tests/pipeline/base_land.h"

#include <vector>

namespace vitrail {

namespace {

// Squares of 96 x 96 columns in two parts of the world, sea and mountains among them; what neighbors share is made once, as
// in a world that is walked through, but each square begins with empty caches.
constexpr i32 kSide = 96;
constexpr ColumnPos kPlaces[] = {{-48, -48}, {3600, -2400}};
constexpr int kRuns = 3;

struct Run {
    double columns_a_second = 0, chunks_a_second = 0;
};

const std::vector<Run>& runs() {
    static const std::vector<Run> all = [] {
        const auto generator = base_generator(1);
        StateTable states(base_content().registry);
        BiomeTable biomes;
        const auto palette = make_terrain_palette(states, biomes, *generator);
        if (!palette) throw std::runtime_error(palette.error().message);
        std::vector<Run> out;
        for (int run = 0; run < kRuns; ++run) {
            AreaStats sum;
            for (const ColumnPos place : kPlaces) {
                generator->clear_caches();
                const auto stats = generate_area(*generator, *palette, {place, kSide, kSide}, {}, [](ColumnPos, GeneratedColumn& column) {
                    bench::keep(column);
                    return Result<>{};
                });
                if (!stats) throw std::runtime_error(stats.error().message);
                sum.columns += stats->columns, sum.chunks += stats->chunks, sum.seconds += stats->seconds;
            }
            out.push_back({double(sum.columns) / sum.seconds, double(sum.chunks) / sum.seconds});
        }
        return out;
    }();
    return all;
}

} // namespace

void register_land_benches(bench::Suite& suite);
void register_land_benches(bench::Suite& suite) {
    suite.add("terrain.all", "chunks/s", "16^3 chunks that hold anything, all stages and packing, one core", [](bench::Context& c) {
        for (const Run& run : runs()) c.report(run.chunks_a_second);
    });
    suite.add("terrain.columns", "columns/s", "the same, columns of 24 chunks", [](bench::Context& c) {
        for (const Run& run : runs()) c.report(run.columns_a_second);
    });
}

} // namespace vitrail
