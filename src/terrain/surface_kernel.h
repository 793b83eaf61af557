// Shape of the land: height, climate and biome of a block column; kernel-safe. Heights follow from continuous fields
// alone (continents, mountains, hills, rivers, dryness), never from the biome, so that they blend across biome borders
// by nature.
#pragma once

#include "terrain/noise_kernel.h"

#include "math/vec.h"

namespace vitrail {

// One constant for each use of randomness in terrain; never renumber.
enum class TerrainNoise : u32 {
    warp_x = 1,
    warp_z,
    continent,
    mountain,
    ridge,
    hills,
    river,
    temperature,
    moisture,
    birch,
    dune,
    jitter,
    cave_room,
    cave_tunnel_a,
    cave_tunnel_b,
    cave_gate,
    rock_kind,
    soil,
    plants,
    count
};

struct TerrainKeys {
    NoiseKey warp_x, warp_z, continent, mountain, ridge, hills, river, temperature, moisture, birch, dune, jitter;
    NoiseKey cave_room, cave_tunnel_a, cave_tunnel_b, cave_gate, rock_kind, soil, plants;
    u64 seed = 0;
};

VX_HD constexpr NoiseKey terrain_key(u64 seed, TerrainNoise n) {
    return noise_key(seed, 0x7e220000u + u32(n));
}
VX_HD constexpr TerrainKeys terrain_keys(u64 seed) {
    using enum TerrainNoise;
    TerrainKeys k;
    k.warp_x = terrain_key(seed, warp_x);
    k.warp_z = terrain_key(seed, warp_z);
    k.continent = terrain_key(seed, continent);
    k.mountain = terrain_key(seed, mountain);
    k.ridge = terrain_key(seed, ridge);
    k.hills = terrain_key(seed, hills);
    k.river = terrain_key(seed, river);
    k.temperature = terrain_key(seed, temperature);
    k.moisture = terrain_key(seed, moisture);
    k.birch = terrain_key(seed, birch);
    k.dune = terrain_key(seed, dune);
    k.jitter = terrain_key(seed, jitter);
    k.cave_room = terrain_key(seed, cave_room);
    k.cave_tunnel_a = terrain_key(seed, cave_tunnel_a);
    k.cave_tunnel_b = terrain_key(seed, cave_tunnel_b);
    k.cave_gate = terrain_key(seed, cave_gate);
    k.rock_kind = terrain_key(seed, rock_kind);
    k.soil = terrain_key(seed, soil);
    k.plants = terrain_key(seed, plants);
    k.seed = seed;
    return k;
}

// Fields of a block column. Heights in blocks; the fields about -1..1; masks 0..1.
struct LandPoint {
    float height = 0;    // of the ground's surface: blocks with y < height are ground
    float continent = 0; // below about -0.05: sea
    float mountain = 0;  // mask
    float river = 0;     // mask of the channel
    float temperature = 0, moisture = 0;
    float dry = 0; // mask of desert
};

VX_HD constexpr i64 fixed_block(i32 v) {
    return i64(v) * (i64(1) << kNoiseFraction);
}
VX_HD constexpr i64 fixed_offset(float blocks) {
    return i64(clamp(blocks, -4096.0f, 4096.0f) * float(1 << kNoiseFraction));
}

// Height of the land by nearness to the sea alone.
VX_HD constexpr float continent_height(float c) {
    constexpr float at[] = {-1.3f, -0.75f, -0.42f, -0.2f, -0.1f, 0.0f, 0.35f, 1.3f};
    constexpr float height[] = {24.0f, 34.0f, 47.0f, 58.0f, 62.8f, 67.0f, 72.0f, 86.0f};
    if (c <= at[0]) return height[0];
    for (i32 i = 1; i < 8; ++i)
        if (c < at[i]) return lerp(height[i - 1], height[i], (c - at[i - 1]) / (at[i] - at[i - 1]));
    return height[7];
}

VX_HD constexpr float magnitude(float v) {
    return v < 0 ? -v : v;
}

VX_HD constexpr LandPoint land_at(const TerrainKeys& k, i32 block_x, i32 block_z) {
    const i64 x = fixed_block(block_x), z = fixed_block(block_z);
    const i64 wx = x + fixed_offset(fractal2(k.warp_x, x, z, 8, 3) * 44.0f);
    const i64 wz = z + fixed_offset(fractal2(k.warp_z, x, z, 8, 3) * 44.0f);
    LandPoint p;
    p.continent = fractal2(k.continent, wx, wz, 10, 4) + 0.22f;
    p.temperature = fractal2(k.temperature, wx, wz, 10, 2);
    p.moisture = fractal2(k.moisture, wx, wz, 9, 2);
    const float rough = fractal2(k.mountain, wx, wz, 9, 2);
    const float inland = smoothstep(0.02f, 0.45f, p.continent);
    const float land = smoothstep(-0.16f, 0.08f, p.continent);
    p.mountain = smoothstep(0.0f, 0.66f, rough) * inland;

    const float hills = fractal2(k.hills, x, z, 7, 4);
    float height = continent_height(p.continent);
    height += hills * lerp(3.5f, lerp(3.0f, 14.0f, smoothstep(-0.55f, 0.3f, rough)), land);
    // Ridges: crests where the noise crosses zero, finer ones hung on the coarse.
    float crest = 0, amplitude = 0.62f, weight = 1;
    for (i32 o = 0; o < 4; ++o) {
        float n = 1.0f - clamp(magnitude(noise2(k.ridge, wx, wz, 8 - o)) * 1.25f, 0.0f, 1.0f);
        n = n * n * weight;
        crest += n * amplitude;
        weight = clamp(n * 1.8f, 0.0f, 1.0f);
        amplitude *= 0.5f;
    }
    height += p.mountain * (14.0f + 128.0f * crest * (0.45f + 0.55f * p.mountain));
    // Crags on the slopes.
    if (p.mountain > 0)
        height += p.mountain * crest * (noise2(k.ridge, x, z, 4) * 7.0f + magnitude(noise2(k.ridge, x, z, 3)) * 3.0f);
    p.dry = smoothstep(0.18f, 0.42f, p.temperature) * smoothstep(0.22f, -0.05f, p.moisture);
    if (p.dry > 0 && land > 0) {
        const float d = 1.0f - clamp(magnitude(noise2(k.dune, wx, wz, 5)) * 1.4f, 0.0f, 1.0f);
        height += p.dry * land * (1.0f - p.mountain) * d * d * 4.0f;
    }
    const float course = magnitude(fractal2(k.river, wx, wz, 9, 3));
    const float flows = land * (1.0f - smoothstep(0.18f, 0.6f, p.mountain));
    const float valley = smoothstep(0.30f, 0.04f, course) * flows;
    if (height > 64.5f) height = lerp(height, 64.5f + (height - 64.5f) * 0.22f, valley);
    p.river = smoothstep(0.058f, 0.026f, course) * flows;
    if (height > 56.5f) height = lerp(height, 56.5f, p.river);
    p.height = clamp(height, 12.0f, 268.0f);
    return p;
}

} // namespace vitrail
