// Where a new player first stands: dry and open, with something to look at around.
#include "terrain/column_canvas.h"

#include <algorithm>

namespace vitrail {

namespace {

bool clear_around(const TerrainKeys& keys, i32 x, i32 z, i32 ground_y) {
    for (i32 dz = -3; dz <= 3; ++dz)
        for (i32 dx = -3; dx <= 3; ++dx) {
            const TerrainSurface s = terrain_surface(keys.seed, x + dx, z + dz);
            if (s.under_water || s.ground_y > ground_y + 1 || s.ground_y < ground_y - 2) return false;
            if (tree_stands_at(keys, x + dx, z + dz)) return false;
            if (in_cave(keys, x + dx, s.ground_y - 1, z + dz, s.ground_y)) return false;
        }
    return true;
}

// The more kinds of land in sight the better: water near, mountains far, woods beside.
float score_of(const TerrainKeys& keys, i32 x, i32 z, const TerrainSurface& here) {
    if (here.under_water || here.ground_y < 65 || here.ground_y > 110) return -1;
    float score = 0;
    switch (here.biome) {
    case TerrainBiome::plains:
        score = 3;
        break;
    case TerrainBiome::meadow:
        score = 3;
        break;
    case TerrainBiome::birch_forest:
    case TerrainBiome::forest:
        score = 1;
        break;
    default:
        return -1;
    }
    constexpr i32 kRays[8][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, 1}, {-1, 1}, {1, -1}, {-1, -1}};
    float water = 0, woods = 0, peak = 0;
    for (const auto& ray : kRays)
        for (const i32 far : {28, 60, 110, 160}) {
            const TerrainSurface s = terrain_surface(keys.seed, x + ray[0] * far, z + ray[1] * far);
            if (s.under_water) water += 1.0f / float(far);
            woods += s.biome == TerrainBiome::forest || s.biome == TerrainBiome::birch_forest ||
                     s.biome == TerrainBiome::taiga;
            peak = std::max(peak, float(s.ground_y - here.ground_y));
        }
    return score + std::min(water * 25.0f, 2.5f) + std::min(woods * 0.2f, 2.0f) + clamp(peak * 0.05f, 0.0f, 4.0f);
}

} // namespace

BlockPos spawn_point(u64 seed) {
    const TerrainKeys keys = terrain_keys(seed);
    float best_score = -1;
    BlockPos best{0, std::max(terrain_surface(seed, 0, 0).ground_y, kTerrainSeaLevel), 0};
    for (i32 ring = 0; ring <= 24; ++ring) {
        for (i32 i = 0; i < std::max(ring * 8, 1); ++i) { // around the edge of a square
            const i32 side = ring ? i / (ring * 2) : 0, along = ring ? i % (ring * 2) - ring : 0;
            const i32 u = side == 0 ? along : side == 1 ? ring : side == 2 ? -along : -ring;
            const i32 v = side == 0 ? -ring : side == 1 ? along : side == 2 ? ring : -along;
            const i32 x = u * 40 + 8, z = v * 40 + 8;
            const TerrainSurface here = terrain_surface(seed, x, z);
            if (here.under_water) continue;
            const float score = score_of(keys, x, z, here) - float(ring) * 0.12f;
            if (score > best_score && clear_around(keys, x, z, here.ground_y)) {
                best_score = score;
                best = {x, here.ground_y, z};
            }
        }
        if (best_score > 7.5f || (ring > 12 && best_score > 4)) break; // good enough; ever farther is not better
    }
    return best;
}

} // namespace vitrail
