// The whole generator on a GPU, packed chunks in hand (on one core: bench/pipeline/land_bench.cpp).
#include "bench/harness.h"
#include "terrain/cuda/device.h"
#include "tests/terrain/base_terrain.h"

#include <algorithm>
#include <thread>

namespace vitrail {

void register_cuda_benches(bench::Suite& suite);

namespace {

u64 filled(const GeneratedColumn& column) {
    u64 n = 0;
    for (const Chunk& chunk : column.chunks)
        n += !chunk.blocks.uniform() || chunk.blocks.get(LocalPos()) != StateId::air;
    return n;
}

void cuda(bench::Context& c, bool chunks) {
    const auto generator = base_generator(7);
    const TerrainPalette palette = plain_palette(*generator);
    auto maker = open_cuda_batches(
        generator,
        {.batches = 3, .columns_most = 4096, .pack_threads = std::max(1u, std::thread::hardware_concurrency()) - 1});
    if (!maker) return c.skip(maker.error().message);
    const i32 side = i32((*maker)->max_columns_a_side());
    constexpr i32 kBatches = 16;
    u64 n = 0;
    const auto turn = [&] {
        n = 0;
        std::vector<u32> under_way;
        for (i32 next = 0, done = 0; done < kBatches; ++done) {
            for (; next < kBatches && under_way.size() < (*maker)->max_batches(); ++next)
                under_way.push_back((*maker)->submit({{next * side, 0}, side, side}).value());
            const auto columns = (*maker)->collect(under_way.front(), palette).value();
            for (const GeneratedColumn& column : columns)
                n += filled(column);
            under_way.erase(under_way.begin());
        }
    };
    turn();
    c.measure(chunks ? double(n) : double(kBatches) * side * side, turn);
}

} // namespace

void register_cuda_benches(bench::Suite& suite) {
    suite.add("terrain.cuda", "/s", "16^3 chunks with anything in them, all stages on a GPU, packed on the host",
              [](bench::Context& c) { cuda(c, true); });
    suite.add("terrain.cuda_columns", "/s", "columns of 16x384x16, likewise",
              [](bench::Context& c) { cuda(c, false); });
}

} // namespace vitrail
