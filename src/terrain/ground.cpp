// The ground: land survey, rock, soil and water.
#include "terrain/column_canvas.h"

#include "base/rng.h"

#include <algorithm>
#include <cstring>

namespace vitrail {

static i32 ground_of(float height) {
    const i32 whole = i32(height); // heights are positive and far below 2^31
    return whole + (float(whole) < height);
}

// Colder with height: snow caps.
static float temperature_there(const TerrainKeys& keys, const LandPoint& land, i32 x, i32 z) {
    const float rise = land.height > 92.0f ? (land.height - 92.0f) * 0.0072f : 0.0f;
    return land.temperature - rise + noise2(keys.jitter, fixed_block(x), fixed_block(z), 4) * 0.05f +
           noise2(keys.jitter, fixed_block(x), fixed_block(z), 2) * 0.03f;
}

bool snow_lies(const TerrainKeys& keys, const LandPoint& land, i32 x, i32 z) {
    return temperature_there(keys, land, x, z) < -0.45f;
}

TerrainBiome biome_of(const TerrainKeys& keys, const LandPoint& land, i32 x, i32 z) {
    using enum TerrainBiome;
    const float temperature = temperature_there(keys, land, x, z);
    const bool cold = temperature < -0.45f;
    const float patch = noise2(keys.jitter, fixed_block(x), fixed_block(z), 3) * 0.05f;
    if (ground_of(land.height) < kTerrainSeaLevel) {
        if (land.river > 0.25f || land.continent > 0.03f) return river;
        return land.height < 42.0f ? deep_ocean : ocean;
    }
    if (land.height < 65.3f && land.continent < 0.0f && land.mountain < 0.2f) return cold ? snowy_beach : beach;
    if (land.mountain > 0.25f && land.height > 96.0f) {
        if (cold) return land.height > 158.0f ? jagged_peaks : snowy_slopes;
        return land.height > 132.0f + patch * 60.0f ? stony_peaks : meadow;
    }
    const float moisture = land.moisture + patch;
    if (cold) return moisture > 0.0f ? snowy_taiga : snowy_plains;
    if (temperature < -0.12f && moisture > -0.3f) return taiga;
    if (land.dry + patch > 0.5f) return desert;
    if (moisture > 0.02f)
        return noise2(keys.birch, fixed_block(x), fixed_block(z), 8) + patch > 0.32f ? birch_forest : forest;
    return plains;
}

void survey_land(ColumnCanvas& c) {
    constexpr i32 m = ColumnCanvas::kMargin, end = kChunkSize + m;
    for (i32 z = -m; z < end; ++z)
        for (i32 x = -m; x < end; ++x) {
            const LandPoint p = land_at(c.keys, c.base_x + x, c.base_z + z);
            ColumnCanvas::Land& l = c.land_at(x, z);
            l.height = p.height;
            l.ground_y = ground_of(p.height);
            if (x >= -1 && x <= kChunkSize && z >= -1 && z <= kChunkSize) {
                l.biome = biome_of(c.keys, p, c.base_x + x, c.base_z + z);
                l.cold = snow_lies(c.keys, p, c.base_x + x, c.base_z + z);
            }
            l.mountain = p.mountain;
            l.river = p.river;
            l.continent = p.continent;
        }
    for (i32 z = 1 - m; z < end - 1; ++z)
        for (i32 x = 1 - m; x < end - 1; ++x) {
            const float h = c.land_at(x, z).height;
            float most = 0;
            for (const auto& [dx, dz] : {std::pair{-1, 0}, {1, 0}, {0, -1}, {0, 1}})
                most = std::max(most, magnitude(c.land_at(x + dx, z + dz).height - h));
            c.land_at(x, z).slope = most;
        }
}

namespace {

struct Soil {
    TerrainBlock top, under;
    i32 depth; // blocks of top and under together; 0: bare rock
};

Soil soil_of(const ColumnCanvas& c, const ColumnCanvas::Land& l, i32 x, i32 z) {
    using enum TerrainBlock;
    const i64 fx = fixed_block(c.base_x + x), fz = fixed_block(c.base_z + z);
    const float n = noise2(c.keys.soil, fx, fz, 5), fine = noise2(c.keys.soil, fx, fz, 3);
    const i32 depth = 3 + i32(clamp(n + 1.0f, 0.0f, 2.0f));
    const bool wet = l.ground_y < kTerrainSeaLevel;
    switch (l.biome) {
    case TerrainBiome::ocean:
    case TerrainBiome::deep_ocean:
        if (l.slope > 1.6f) return {stone, stone, 0};
        return n + fine * 0.3f > 0.35f || l.cold ? Soil{gravel, gravel, depth}
                                                 : Soil{sand, l.height < 50.0f ? sand : sandstone, depth};
    case TerrainBiome::river:
        if (n + fine * 0.4f > 0.55f) return {clay, clay, 2};
        return n + fine * 0.4f > -0.15f ? Soil{sand, sand, depth}
               : fine > 0.3f            ? Soil{dirt, dirt, depth}
                                        : Soil{gravel, gravel, depth};
    case TerrainBiome::beach:
    case TerrainBiome::snowy_beach:
        if (l.slope > 1.5f) return {stone, stone, 0};
        return l.cold || n < -0.75f ? Soil{gravel, gravel, depth} : Soil{sand, sandstone, depth + 1};
    case TerrainBiome::desert:
        return l.slope > 2.4f ? Soil{sandstone, sandstone, 6} : Soil{sand, sandstone, depth + 4};
    case TerrainBiome::stony_peaks:
        return l.slope < 0.7f && n > 0.1f ? Soil{grass_block, dirt, 2}
               : fine + n > 0.9f          ? Soil{gravel, gravel, 2}
                                          : Soil{stone, stone, 0};
    case TerrainBiome::snowy_slopes:
    case TerrainBiome::jagged_peaks:
        if (l.slope > 2.1f + fine * 0.5f) return {stone, stone, 0};
        return l.slope < 1.4f && n > 0.5f && l.height > 170.0f ? Soil{packed_ice, packed_ice, 3}
                                                               : Soil{snow_block, snow_block, depth};
    default:
        break;
    }
    if (l.slope > 2.0f + n * 0.5f + fine * 0.25f && l.height > 72.0f) return {stone, stone, 0};
    if (wet || l.height < 63.6f) return n + fine * 0.4f > 0.0f ? Soil{sand, sand, depth} : Soil{gravel, gravel, 2};
    if (l.river > 0.02f && l.height < 65.2f) return fine > 0.1f ? Soil{sand, sand, 3} : Soil{grass_block, dirt, depth};
    if (l.biome == TerrainBiome::taiga && fine + n > 0.55f) return {podzol, dirt, depth};
    if (l.biome == TerrainBiome::taiga && fine - n > 1.0f) return {coarse_dirt, dirt, depth};
    return {grass_block, dirt, depth};
}

} // namespace

void fill_ground(ColumnCanvas& c) {
    using enum TerrainBlock;
    std::array<i16, 256> ground;
    i32 highest = kTerrainSeaLevel;
    for (i32 i = 0; i < 256; ++i) {
        ground[std::size_t(i)] = i16(c.land_at(i & 15, i >> 4).ground_y);
        highest = std::max(highest, i32(ground[std::size_t(i)]));
    }
    c.top = highest;
    const RngKey mix{c.keys.seed, 0x7e220101u};
    for (i32 y = kTerrainMinY; y < kTerrainMaxY; ++y) {
        TerrainBlock* row = &c.blocks[std::size_t(y - kTerrainMinY) * 256];
        if (y >= highest) {
            std::memset(row, int(air), std::size_t(kTerrainMaxY - y) * 256);
            break;
        }
        const TerrainBlock open = y < kTerrainSeaLevel ? water : air, rock = y < 0 ? deepslate : stone;
        for (std::size_t i = 0; i < 256; ++i)
            row[i] = y < ground[i] ? rock : open;
        if (y < kTerrainMinY + 5) // bedrock thins out upwards
            for (i32 i = 0; i < 256; ++i)
                if (random_unit(mix, c.base_x + (i & 15), y, c.base_z + (i >> 4)) * 5.0f >= float(y - kTerrainMinY))
                    row[i] = bedrock;
        if (y >= -4 && y < 4) // deepslate and stone mix
            for (i32 i = 0; i < 256; ++i)
                row[i] = random_unit(mix, c.base_x + (i & 15), y, c.base_z + (i >> 4)) * 8.0f > float(y + 4) ? deepslate
                                                                                                             : stone;
    }
    for (i32 z = 0; z < 16; ++z)
        for (i32 x = 0; x < 16; ++x) {
            const ColumnCanvas::Land& l = c.land_at(x, z);
            Soil soil = soil_of(c, l, x, z);
            if (soil.depth == 0) { // bare rock shows its kinds and loose stone
                const float kind =
                    noise2(c.keys.rock_kind, fixed_block(c.base_x + x), fixed_block(c.base_z + z), 4) +
                    0.4f * noise2(c.keys.rock_kind, fixed_block(c.base_x + x), fixed_block(c.base_z + z), 2);
                const TerrainBlock rock = kind > 0.6f ? andesite : kind < -0.75f ? diorite : stone;
                soil = kind > 0.2f && kind < 0.32f && l.slope < 2.0f ? Soil{gravel, gravel, 1} : Soil{rock, rock, 3};
            }
            for (i32 d = 0; d < soil.depth; ++d)
                c.blocks[ColumnCanvas::index(x, l.ground_y - 1 - d, z)] = d == 0 ? soil.top : soil.under;
            if (l.cold && l.ground_y < kTerrainSeaLevel)
                c.blocks[ColumnCanvas::index(x, kTerrainSeaLevel - 1, z)] = ice;
        }
}

} // namespace vitrail
