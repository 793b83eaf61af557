#include "terrain/cave_kernel.h"
#include "terrain/column_canvas.h"

#include <algorithm>
#include <vector>

namespace vitrail {

namespace {

constexpr i32 kLavaLevel = -54; // caves are filled with lava up to here
constexpr i32 kSealReach = 4;   // blocks kept between caves and water, sideways and below
constexpr i32 kDeepest = kTerrainMinY + 6;

// corner[x | z << 1 | y << 2], fractions 0..1; one order of operations for every caller.
float cave_between(const float* corner, float fx, float fy, float fz) {
    const float low = noise_mix(noise_mix(corner[0], corner[1], fx), noise_mix(corner[2], corner[3], fx), fz);
    const float high = noise_mix(noise_mix(corner[4], corner[5], fx), noise_mix(corner[6], corner[7], fx), fz);
    return noise_mix(low, high, fy);
}

// Openings to the surface are rarer than caves below it.
float surface_guard(i32 y, i32 ground_y) {
    const i32 depth = ground_y - 1 - y;
    return depth >= 10 ? 0.0f : 0.075f * (1.0f - float(std::max(depth, 0)) * 0.1f);
}

i32 floor_step(i32 v) {
    return v & ~(kCaveStep - 1);
}

} // namespace

bool in_cave(const TerrainKeys& keys, i32 x, i32 y, i32 z, i32 ground_y) {
    if (y < kDeepest || y >= ground_y) return false;
    const i32 lx = floor_step(x), ly = floor_step(y), lz = floor_step(z);
    float corner[8];
    for (i32 i = 0; i < 8; ++i)
        corner[i] =
            cave_value(keys, lx + (i & 1) * kCaveStep, ly + (i >> 2) * kCaveStep, lz + (i >> 1 & 1) * kCaveStep);
    constexpr float part = 1.0f / float(kCaveStep);
    return cave_between(corner, float(x - lx) * part, float(y - ly) * part, float(z - lz) * part) +
               surface_guard(y, ground_y) <
           0;
}

void carve_caves(ColumnCanvas& c) {
    std::array<i32, 256> seal; // caves keep out from here up to the sea level
    for (i32 z = 0; z < 16; ++z)
        for (i32 x = 0; x < 16; ++x) {
            i32 lowest = kTerrainSeaLevel + 1;
            for (i32 dz = -kSealReach; dz <= kSealReach; ++dz)
                for (i32 dx = -kSealReach; dx <= kSealReach; ++dx) {
                    const i32 ground = c.land_at(x + dx, z + dz).ground_y;
                    if (ground < kTerrainSeaLevel) lowest = std::min(lowest, ground);
                }
            seal[std::size_t(x | z << 4)] = lowest <= kTerrainSeaLevel ? lowest - kSealReach : kTerrainMaxY;
        }
    i32 highest = kDeepest;
    for (i32 i = 0; i < 256; ++i)
        highest = std::max(highest, c.land_at(i & 15, i >> 4).ground_y);
    constexpr i32 kAcross = kChunkSize / kCaveStep + 1;
    const i32 low = floor_step(kDeepest), layers = (highest - low + kCaveStep - 1) / kCaveStep + 1;
    static thread_local std::vector<float> lattice;
    lattice.resize(std::size_t(layers * kAcross * kAcross));
    for (i32 j = 0; j < layers; ++j)
        for (i32 k = 0; k < kAcross; ++k)
            for (i32 i = 0; i < kAcross; ++i)
                lattice[std::size_t((j * kAcross + k) * kAcross + i)] =
                    cave_value(c.keys, c.base_x + i * kCaveStep, low + j * kCaveStep, c.base_z + k * kCaveStep);
    constexpr float part = 1.0f / float(kCaveStep);
    for (i32 j = 0; j + 1 < layers; ++j)
        for (i32 k = 0; k + 1 < kAcross; ++k)
            for (i32 i = 0; i + 1 < kAcross; ++i) {
                float corner[8];
                float least = 1;
                for (i32 n = 0; n < 8; ++n) {
                    corner[n] =
                        lattice[std::size_t(((j + (n >> 2)) * kAcross + k + (n >> 1 & 1)) * kAcross + i + (n & 1))];
                    least = std::min(least, corner[n]);
                }
                if (least >= 0) continue; // nothing between is lower than the lowest corner
                for (i32 dy = 0; dy < kCaveStep; ++dy)
                    for (i32 dz = 0; dz < kCaveStep; ++dz)
                        for (i32 dx = 0; dx < kCaveStep; ++dx) {
                            const i32 x = i * kCaveStep + dx, y = low + j * kCaveStep + dy, z = k * kCaveStep + dz;
                            const i32 ground_y = c.land_at(x, z).ground_y;
                            if (y < kDeepest || y >= ground_y) continue;
                            const i32 sealed = seal[std::size_t(x | z << 4)];
                            if (y >= sealed && y <= kTerrainSeaLevel) continue;
                            const float v = cave_between(corner, float(dx) * part, float(dy) * part, float(dz) * part);
                            if (v + surface_guard(y, ground_y) >= 0) continue;
                            c.blocks[ColumnCanvas::index(x, y, z)] =
                                y < kLavaLevel ? TerrainBlock::lava : TerrainBlock::air;
                        }
            }
}

} // namespace vitrail
