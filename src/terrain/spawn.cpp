#include "terrain/generator.h"

#include <algorithm>

namespace vitrail {

namespace {

// How good a place the middle of a column is, by its land: dry, not too high, level; 0 is hopeless.
float comfort(const TerrainTables& t, const LandTile& land) {
    float least = land.height[0], most = least;
    for (const float h : land.height)
        least = std::min(least, h), most = std::max(most, h);
    if (least < kTerrainSeaLevel + 3 || most > kTerrainSeaLevel + 40) return 0;
    const float dry = t.ocean < 0 ? 1 : 1 - land.attribute[t.ocean][136];
    return dry / (1 + std::max(0.0f, most - least - 3));
}

} // namespace

BlockPos spawn_point(const TerrainGenerator& generator) {
    const TerrainTables& t = generator.tables();
    // Rings around the origin, the nearer the better: the first comfortable column that proves open. Content may
    // overgrow every block; whole columns take time, so a few dozen are tried.
    constexpr i32 step = 3, rings = 160, tries_most = 48;
    i32 tries = 0;
    BlockPos above_all; // the first one tried, over its treetops
    for (i32 ring = 0; ring < rings && tries < tries_most; ++ring)
        for (i32 side = 0; side < (ring == 0 ? 1 : 8 * ring); ++side) {
            const i32 turn = ring == 0 ? 0 : side / (2 * ring), along = ring == 0 ? 0 : side % (2 * ring) - ring;
            const i32 a[4] = {along, ring, -along, -ring}, b[4] = {-ring, along, ring, -along};
            const ColumnPos at{a[turn] * step, b[turn] * step};
            const auto land = generator.land(at);
            if (comfort(t, *land) < 0.6f) continue;
            if (++tries > tries_most) break;
            const auto tile = generator.blocks(at);
            if (tries == 1) above_all = {at.x * 16 + 8, tile->top, at.z * 16 + 8};
            const auto ground = generator.ground(at);
            for (i32 spiral = 0; spiral < kColumnCells; ++spiral) {
                const i32 x = (spiral * 5 + 8) & 15, z = ((spiral >> 4) * 3 + 8) & 15, index = x | z << 4;
                i32 y = i32(ground->top[index]) + 1;
                while (y > 0 && tile->block[(y - 1) << 8 | index] == kAir)
                    --y;
                const Block below = tile->block[std::max(0, y - 1) << 8 | index];
                if (y < kTerrainSeaLevel || !(t.traits[below] & trait_ground)) continue;
                bool open = true; // nothing overhead, and room beside
                for (i32 k = y; k < std::max(y + 3, tile->top); ++k)
                    open &= tile->block[k << 8 | index] == kAir;
                if (open) return {i32(u32(at.x) * 16) + x, y, i32(u32(at.z) * 16) + z};
            }
        }
    if (tries > 0) return above_all;
    // A world of water: on the sea at the origin.
    return {8, std::max(kTerrainSeaLevel, i32(generator.land({0, 0})->height[136]) + 1), 8};
}

} // namespace vitrail
