// A fixed piece of land to mesh: hills, cliffs, caves, sand at the shore, ore, trees; the same on every machine.
#pragma once

#include "base/rng.h"
#include "meshing/mesh_world.h"

#include <cmath>
#include <memory>
#include <vector>

namespace vitrail::bench {

// Sizes in chunks; solid from y = 0 up.
class SampleTerrain {
public:
    static constexpr i32 kX = 32, kY = 16, kZ = 32;

    SampleTerrain()
        : chunks_(std::size_t(kX * kY * kZ)) {
        stone_ = world("stone"), dirt_ = world("dirt"), grass_ = world("grass_block"), sand_ = world("sand");
        ore_ = world("coal_ore"), log_ = world("oak_log[axis=y]"), leaves_ = world("oak_leaves[distance=1]");
        std::vector<StateId> cells(std::size_t(kX * kY * kZ) * kChunkVolume, StateId::air);
        fill_ground(cells);
        plant_trees(cells);
        for (i32 y = 0; y < kY; ++y)
            for (i32 z = 0; z < kZ; ++z)
                for (i32 x = 0; x < kX; ++x) {
                    auto chunk = std::make_unique<Chunk>();
                    const StateId* from = &cells[chunk_index(x, y, z) * kChunkVolume];
                    chunk->blocks =
                        BlockStorage::from_states(std::span<const StateId, kChunkVolume>(from, kChunkVolume));
                    for (i32 i = 0; i < kChunkVolume; ++i)
                        solid_ += from[i] != StateId::air;
                    chunks_[chunk_index(x, y, z)] = std::move(chunk);
                }
    }

    // Chunks with all 27 neighbors' places; null outside.
    render::MeshInput input(i32 x, i32 y, i32 z) const {
        render::MeshInput in;
        for (i32 dy = -1; dy <= 1; ++dy)
            for (i32 dz = -1; dz <= 1; ++dz)
                for (i32 dx = -1; dx <= 1; ++dx) {
                    const i32 cx = x + dx, cy = y + dy, cz = z + dz;
                    const bool inside = cx >= 0 && cx < kX && cy >= 0 && cy < kY && cz >= 0 && cz < kZ;
                    in.chunks[render::MeshInput::index(dx, dy, dz)] =
                        inside ? chunks_[chunk_index(cx, cy, cz)].get() : nullptr;
                }
        in.models = &world.models;
        return in;
    }
    std::size_t size() const { return chunks_.size(); }
    double solid_share() const { return double(solid_) / (double(size()) * kChunkVolume); }

    test::MeshWorld world;

private:
    static std::size_t chunk_index(i32 x, i32 y, i32 z) { return std::size_t((y * kZ + z) * kX + x); }
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
    static i32 height(i32 x, i32 z) {
        float h = 100;
        float size = 160, rise = 38;
        for (u32 octave = 0; octave < 6; ++octave, size /= 2, rise *= 0.48f)
            h += rise * noise(10 + octave, float(x) / size, 0, float(z) / size);
        return i32(h);
    }
    void fill_ground(std::vector<StateId>& cells) const {
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
                    StateId s = y == top ? grass_ : y > top - 4 ? dirt_ : stone_;
                    if (top < 72 && y > top - 4) s = sand_;
                    if (s == stone_ && noise(3, float(x) / 5, float(y) / 5, float(z) / 5) > 0.6f) s = ore_;
                    cells[cell_index(x, y, z)] = s;
                }
            }
    }
    void plant_trees(std::vector<StateId>& cells) const {
        const auto put = [&](i32 x, i32 y, i32 z, StateId s) {
            StateId& cell = cells[cell_index(x, y, z)];
            if (cell == StateId::air) cell = s;
        };
        for (i32 gz = 1; gz < kZ * 2 - 1; ++gz)
            for (i32 gx = 1; gx < kX * 2 - 1; ++gx) {
                const RngKey key{7, 5};
                if (random_unit(key, gx, 0, gz) > 0.6f) continue;
                const i32 x = gx * 8 + i32(random_unit(key, gx, 1, gz) * 6),
                          z = gz * 8 + i32(random_unit(key, gx, 2, gz) * 6);
                const i32 ground = height(x, z);
                if (ground < 72 || cells[cell_index(x, ground, z)] != grass_) continue;
                const i32 tall = 4 + i32(random_unit(key, gx, 3, gz) * 3);
                for (i32 y = 1; y <= tall; ++y)
                    put(x, ground + y, z, log_);
                for (i32 dy = -2; dy <= 1; ++dy) {
                    const i32 r = dy < 0 ? 2 : 1;
                    for (i32 dz = -r; dz <= r; ++dz)
                        for (i32 dx = -r; dx <= r; ++dx)
                            if (dx * dx + dz * dz < 2 * r * r) put(x + dx, ground + tall + dy, z + dz, leaves_);
                }
            }
    }

    StateId stone_, dirt_, grass_, sand_, ore_, log_, leaves_;
    std::vector<std::unique_ptr<Chunk>> chunks_;
    std::size_t solid_ = 0;
};

} // namespace vitrail::bench
