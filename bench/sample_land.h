// A fixed piece of land for benchmarks: hills, cliffs, caves, sand at the shore, ore, trees; the same on every machine.
#pragma once

#include "base/rng.h"
#include "math/vec.h"
#include "voxel/coords.h"

#include <cmath>
#include <vector>

namespace vitrail::bench {

// Sizes in chunks; solid from y = 0 up.
class SampleLand {
public:
    static constexpr i32 kX = 32, kY = 16, kZ = 32;
    enum Block : u8 { air, stone, dirt, grass, sand, ore, log, leaves, kinds };

    SampleLand()
        : cells_(std::size_t(kX * kY * kZ) * kChunkVolume, air) {
        fill_ground();
        plant_trees();
    }
    static std::size_t chunk_index(i32 x, i32 y, i32 z) { return std::size_t((y * kZ + z) * kX + x); }
    // 4096 blocks in LocalPos order.
    const Block* chunk(std::size_t index) const { return &cells_[index * kChunkVolume]; }
    // Of the ground, blocks; of the column 0 <= x, z < 16 kX.
    static i32 height(i32 x, i32 z) {
        float h = 100;
        float size = 160, rise = 38;
        for (u32 octave = 0; octave < 6; ++octave, size /= 2, rise *= 0.48f)
            h += rise * noise(10 + octave, float(x) / size, 0, float(z) / size);
        return i32(h);
    }

private:
    static std::size_t cell_index(i32 x, i32 y, i32 z) {
        return chunk_index(x >> 4, y >> 4, z >> 4) * kChunkVolume + LocalPos(x & 15, y & 15, z & 15).index;
    }
    // Value noise of lattice size `scale` blocks, -1..1.
    static float noise(u32 purpose, float x, float y, float z) {
        const float fx = std::floor(x), fy = std::floor(y), fz = std::floor(z);
        const auto ease = [](float t) { return t * t * (3 - 2 * t); };
        const float tx = ease(x - fx), ty = ease(y - fy), tz = ease(z - fz);
        const i32 ix = i32(fx), iy = i32(fy), iz = i32(fz);
        const RngKey key{7, purpose};
        const auto at = [&](i32 dx, i32 dy, i32 dz) { return random_unit(key, ix + dx, iy + dy, iz + dz) * 2 - 1; };
        const auto row = [&](i32 dy, i32 dz) { return lerp(at(0, dy, dz), at(1, dy, dz), tx); };
        return lerp(lerp(row(0, 0), row(1, 0), ty), lerp(row(0, 1), row(1, 1), ty), tz);
    }
    void fill_ground() {
        for (i32 z = 0; z < kZ * 16; ++z)
            for (i32 x = 0; x < kX * 16; ++x) {
                const i32 top = height(x, z);
                for (i32 y = 0; y <= top && y < kY * 16; ++y) {
                    // Caves: where two fields are both near zero; wider deep down.
                    if (y > 2) {
                        const float a = noise(1, float(x) / 20, float(y) / 13, float(z) / 20);
                        const float b = noise(2, float(x) / 20, float(y) / 13, float(z) / 20);
                        if (a * a + b * b < 0.035f) continue;
                    }
                    Block s = y == top ? grass : y > top - 4 ? dirt : stone;
                    if (top < 72 && y > top - 4) s = sand;
                    if (s == stone && noise(3, float(x) / 5, float(y) / 5, float(z) / 5) > 0.6f) s = ore;
                    cells_[cell_index(x, y, z)] = s;
                }
            }
    }
    void plant_trees() {
        const auto put = [&](i32 x, i32 y, i32 z, Block s) {
            Block& cell = cells_[cell_index(x, y, z)];
            if (cell == air) cell = s;
        };
        for (i32 gz = 1; gz < kZ * 2 - 1; ++gz)
            for (i32 gx = 1; gx < kX * 2 - 1; ++gx) {
                const RngKey key{7, 5};
                if (random_unit(key, gx, 0, gz) > 0.6f) continue;
                const i32 x = gx * 8 + i32(random_unit(key, gx, 1, gz) * 6),
                          z = gz * 8 + i32(random_unit(key, gx, 2, gz) * 6);
                const i32 ground = height(x, z);
                if (ground < 72 || cells_[cell_index(x, ground, z)] != grass) continue;
                const i32 tall = 4 + i32(random_unit(key, gx, 3, gz) * 3);
                for (i32 y = 1; y <= tall; ++y)
                    put(x, ground + y, z, log);
                for (i32 dy = -2; dy <= 1; ++dy) {
                    const i32 r = dy < 0 ? 2 : 1;
                    for (i32 dz = -r; dz <= r; ++dz)
                        for (i32 dx = -r; dx <= r; ++dx)
                            if (dx * dx + dz * dz < 2 * r * r) put(x + dx, ground + tall + dy, z + dz, leaves);
                }
            }
    }

    std::vector<Block> cells_;
};

} // namespace vitrail::bench
