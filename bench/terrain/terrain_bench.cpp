#include "bench/harness.h"
#include "terrain/generator.h"

using namespace vitrail;

void register_terrain_benches(bench::Suite& suite) {
    suite.add("terrain.columns", "/s", "whole columns of 16x384x16, all stages, one core", [](bench::Context& c) {
        TerrainPalette palette;
        for (u32 i = 0; i < kTerrainBlockCount; ++i)
            palette.blocks[i] = StateId(i);
        i32 at = 0;
        c.measure(64, [&] {
            for (i32 i = 0; i < 64; ++i, ++at)
                bench::keep(generate_column(1, {(at & 31) - 16, (at >> 5) * 3 - 16}, palette));
        });
    });
    suite.add("terrain.all", "/s", "16^3 chunks with anything in them, all stages, one core", [](bench::Context& c) {
        TerrainPalette palette;
        for (u32 i = 0; i < kTerrainBlockCount; ++i)
            palette.blocks[i] = StateId(i);
        double filled = 0;
        const auto all = [&] {
            filled = 0;
            for (i32 i = 0; i < 64; ++i)
                for (const Chunk& chunk : generate_column(1, {i & 7, i >> 3}, palette).chunks)
                    filled += !chunk.blocks.uniform() || chunk.blocks.get(LocalPos()) != StateId::air;
        };
        all();
        c.measure(filled, all);
    });
}
