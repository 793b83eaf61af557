// What grows on single blocks: grass, flowers, reeds, water plants; and the snow over all.
#include "terrain/column_canvas.h"

#include "base/rng.h"

#include <algorithm>

namespace vitrail {

namespace {

using enum TerrainBlock;

// Flowers stand in drifts of one kind.
TerrainBlock flower_of(float drift, float roll, TerrainBiome biome) {
    if (biome == TerrainBiome::forest || biome == TerrainBiome::birch_forest) {
        if (drift > 0.35f) return lily_of_the_valley;
        return roll < 0.5f ? dandelion : poppy;
    }
    if (drift > 0.4f) return roll < 0.7f ? red_tulip : poppy;
    if (drift > 0.1f) return roll < 0.6f ? oxeye_daisy : dandelion;
    if (drift > -0.2f) return roll < 0.6f ? cornflower : azure_bluet;
    return biome == TerrainBiome::meadow && roll < 0.5f ? allium : roll < 0.8f ? poppy : dandelion;
}

void tall(ColumnCanvas& c, i32 x, i32 y, i32 z, TerrainBlock lower, TerrainBlock upper) {
    if (y + 1 >= kTerrainMaxY || c.get(x, y + 1, z) != air) return;
    c.put(x, y, z, lower);
    c.put(x, y + 1, z, upper);
}

void grow_on_grass(ColumnCanvas& c, i32 x, i32 y, i32 z, const ColumnCanvas::Land& l, u64 dice) {
    const float roll = float(dice & 0xffff) * (1.0f / 65536.0f), kind = float(dice >> 16 & 0xffff) * (1.0f / 65536.0f);
    const i64 fx = fixed_block(c.base_x + x), fz = fixed_block(c.base_z + z);
    const float lush = noise2(c.keys.plants, fx, fz, 5), drift = noise2(c.keys.plants, fx, fz, 4);
    if (l.cold) {
        if (roll < 0.03f && l.biome == TerrainBiome::snowy_taiga) c.put(x, y, z, fern);
        return;
    }
    float grass = 0, flowers = 0;
    switch (l.biome) {
    case TerrainBiome::plains:
        grass = 0.11f + 0.13f * lush, flowers = drift > 0.3f ? 0.06f : 0.004f;
        break;
    case TerrainBiome::meadow:
        grass = 0.14f + 0.12f * lush, flowers = drift > 0.0f ? 0.1f : 0.015f;
        break;
    case TerrainBiome::forest:
        grass = 0.08f + 0.08f * lush, flowers = drift > 0.3f ? 0.06f : 0.006f;
        break;
    case TerrainBiome::birch_forest:
        grass = 0.1f + 0.08f * lush, flowers = drift > 0.2f ? 0.08f : 0.01f;
        break;
    case TerrainBiome::taiga:
        grass = 0.14f + 0.12f * lush;
        break;
    default:
        grass = 0.05f;
        break;
    }
    if (roll < flowers) {
        c.put(x, y, z, flower_of(lush, kind, l.biome));
    } else if (roll < flowers + grass) {
        if (l.biome == TerrainBiome::taiga) {
            if (kind < 0.12f)
                tall(c, x, y, z, large_fern_lower, large_fern_upper);
            else
                c.put(x, y, z, kind < 0.7f ? fern : short_grass);
        } else if (kind < 0.12f && lush > 0.0f) {
            tall(c, x, y, z, tall_grass_lower, tall_grass_upper);
        } else {
            c.put(x, y, z, short_grass);
        }
    } else if (roll > 0.996f && (l.biome == TerrainBiome::taiga || l.biome == TerrainBiome::forest)) {
        c.put(x, y, z, kind < 0.6f ? brown_mushroom : red_mushroom);
    } else if (drift > 0.85f && roll > 0.97f && (l.biome == TerrainBiome::plains || l.biome == TerrainBiome::forest)) {
        c.put(x, y, z, pumpkin);
    }
}

bool water_beside(const ColumnCanvas& c, i32 x, i32 z) {
    const auto wet = [&](i32 dx, i32 dz) {
        const ColumnCanvas::Land& l = c.land_at(x + dx, z + dz);
        return l.ground_y < kTerrainSeaLevel && !l.cold;
    };
    return wet(-1, 0) || wet(1, 0) || wet(0, -1) || wet(0, 1);
}

} // namespace

void place_plants(ColumnCanvas& c) {
    for (i32 z = 0; z < 16; ++z)
        for (i32 x = 0; x < 16; ++x) {
            const ColumnCanvas::Land& l = c.land_at(x, z);
            const u64 dice = random_u64({c.keys.seed, 0x7e220401u}, c.base_x + x, 0, c.base_z + z);
            const float roll = float(dice & 0xffff) * (1.0f / 65536.0f);
            const i32 y = l.ground_y;
            const TerrainBlock soil = c.get(x, y - 1, z), here = c.get(x, y, z);
            const i64 fx = fixed_block(c.base_x + x), fz = fixed_block(c.base_z + z);
            if (here == water) {
                const float bed = noise2(c.keys.plants, fx, fz, 4);
                const bool soft = soil == sand || soil == dirt || soil == gravel || soil == clay;
                if (soft && !l.cold && l.height < 61.0f && l.height > 44.0f && roll < 0.16f + 0.22f * bed)
                    c.put(x, y, z, seagrass);
                const bool shallow = l.biome == TerrainBiome::river && l.river < 0.85f && !l.cold;
                if (shallow && bed > 0.45f && roll > 0.86f && c.get(x, kTerrainSeaLevel, z) == air)
                    c.put(x, kTerrainSeaLevel, z, lily_pad);
                continue;
            }
            if (here != air) continue;
            if (y == kTerrainSeaLevel && (soil == sand || soil == grass_block || soil == dirt) &&
                water_beside(c, x, z) && noise2(c.keys.plants, fx, fz, 4) > 0.1f && roll < 0.55f) {
                const i32 height = 1 + i32(dice >> 20 & 3) % 3;
                for (i32 i = 0; i < height && c.get(x, y + i, z) == air; ++i)
                    c.put(x, y + i, z, sugar_cane);
            } else if (soil == grass_block || soil == podzol) {
                grow_on_grass(c, x, y, z, l, dice);
            } else if (soil == sand && l.biome == TerrainBiome::desert && roll < 0.008f) {
                c.put(x, y, z, dead_bush);
            }
        }
}

void lay_snow(ColumnCanvas& c) {
    const auto lay_on = [&](i32 x, i32 y, i32 z) { // y: of the block under the snow
        switch (c.get(x, y, z)) {
        case air:
        case water:
        case ice:
        case packed_ice:
        case lava:
        case fern:
        case short_grass:
        case snow_block:
        case spruce_log:
            return;
        case grass_block:
            c.put(x, y, z, snowy_grass_block);
            break;
        default:
            break;
        }
        c.put(x, y + 1, z, snow);
    };
    for (i32 z = 0; z < 16; ++z)
        for (i32 x = 0; x < 16; ++x) {
            const ColumnCanvas::Land& l = c.land_at(x, z);
            if (!l.cold) continue;
            i32 y = std::min(c.top, kTerrainMaxY - 1);
            while (y > kTerrainMinY && c.get(x, y - 1, z) == air)
                --y;
            lay_on(x, y - 1, z);
            // and under trees, whose crowns let much through
            if (y > l.ground_y && c.get(x, l.ground_y, z) == air) lay_on(x, l.ground_y - 1, z);
        }
}

} // namespace vitrail
