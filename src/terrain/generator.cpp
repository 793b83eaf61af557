#include "terrain/generator.h"

#include "base/rng.h"
#include "terrain/column_canvas.h"

#include <algorithm>
#include <cstring>

namespace vitrail {

namespace {

BiomeGrid biomes_of(const ColumnCanvas& c, const TerrainPalette& palette) {
    BiomeGrid out;
    for (i32 i = 0; i < 64; ++i) {
        const auto& l = c.land_at((i & 3) * 4 + 2, (i >> 2 & 3) * 4 + 2);
        out.cells[std::size_t(i)] = palette.biomes[std::size_t(l.biome)];
    }
    return out;
}

BlockStorage storage_of(const TerrainBlock* roles, const TerrainPalette& palette) {
    static_assert(kTerrainBlockCount <= 256);
    std::array<u8, kTerrainBlockCount> slot;
    slot.fill(255);
    std::array<StateId, kTerrainBlockCount> used;
    u32 count = 0;
    std::array<u16, kChunkVolume> indices;
    TerrainBlock last = roles[0];
    slot[std::size_t(last)] = 0;
    used[count++] = palette.blocks[std::size_t(last)];
    for (u32 i = 0; i < kChunkVolume; ++i) {
        u8& s = slot[std::size_t(roles[i])];
        if (s == 255) {
            s = u8(count);
            used[count++] = palette.blocks[std::size_t(roles[i])];
        }
        indices[i] = s;
    }
    if (count == 1) return BlockStorage(used[0]);
    return BlockStorage::from_indices(std::span<const StateId>(used.data(), count), indices);
}

} // namespace

GeneratedColumn generate_column(u64 seed, ColumnPos at, const TerrainPalette& palette) {
    static thread_local std::unique_ptr<ColumnCanvas> canvas_of_thread = std::make_unique<ColumnCanvas>();
    ColumnCanvas& c = *canvas_of_thread;
    c.keys = terrain_keys(seed);
    c.base_x = at.x * kChunkSize;
    c.base_z = at.z * kChunkSize;
    survey_land(c);
    fill_ground(c);
    place_veins(c);
    carve_caves(c);
    place_trees(c);
    place_plants(c);
    lay_snow(c);

    GeneratedColumn out;
    out.chunks.resize(kTerrainSections);
    const BiomeGrid biomes = biomes_of(c, palette);
    for (i32 s = 0; s < kTerrainSections; ++s) {
        Chunk& chunk = out.chunks[std::size_t(s)];
        chunk.biomes = biomes;
        if (kTerrainMinY + s * kChunkSize >= c.top)
            chunk.blocks = BlockStorage(palette.blocks[std::size_t(TerrainBlock::air)]);
        else
            chunk.blocks = storage_of(&c.blocks[std::size_t(s) * kChunkVolume], palette);
    }
    for (i32 i = 0; i < 256; ++i) {
        i32 y = std::min(c.top, kTerrainMaxY);
        while (y > kTerrainMinY && !palette.takes_light[std::size_t(c.get(i & 15, y - 1, i >> 4))])
            --y;
        out.heights[std::size_t(i)] = y;
    }
    return out;
}

TerrainSurface terrain_surface(u64 seed, i32 x, i32 z) {
    const TerrainKeys keys = terrain_keys(seed);
    const LandPoint land = land_at(keys, x, z);
    const i32 whole = i32(land.height);
    const i32 ground = whole + (float(whole) < land.height);
    return {ground, biome_of(keys, land, x, z), ground < kTerrainSeaLevel};
}

u64 column_hash(const GeneratedColumn& column) {
    u64 h = 0;
    std::array<StateId, kChunkVolume> states;
    for (const Chunk& chunk : column.chunks) {
        chunk.blocks.unpack(states);
        for (const StateId s : states)
            h = (h ^ u32(s)) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
        for (const BiomeId b : chunk.biomes.cells)
            h = hash_combine(h, u32(b));
    }
    return h;
}

} // namespace vitrail
