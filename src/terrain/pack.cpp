// From a tile of raw blocks to chunks with palettes, biomes and heights.
#include "terrain/cpu/pack_stage.h"
#include "terrain/generator.h"

#include <algorithm>
#include <cstring>

namespace vitrail {

namespace {

BlockStorage pack_section(const TerrainStages& stages, const Block* blocks, const TerrainPalette& palette) {
    PackedSection packed;
    stages.pack(blocks, packed);
    if (packed.bits == 0) return BlockStorage(palette.blocks[packed.palette[0]]);
    std::vector<StateId> states(packed.count);
    for (u32 i = 0; i < packed.count; ++i)
        states[i] = palette.blocks[packed.palette[i]];
    // Content may give one state two texts; a palette holds each state once.
    for (auto s = states.begin(); s != states.end(); ++s)
        if (std::find(states.begin(), s, *s) != s) {
            std::array<StateId, kChunkVolume> all;
            for (i32 i = 0; i < kChunkVolume; ++i)
                all[std::size_t(i)] = palette.blocks[blocks[i]];
            return BlockStorage::from_states(all);
        }
    return BlockStorage::from_packed(std::move(states),
                                     std::vector<u64>(packed.words, packed.words + packed.bits * 64));
}

// The y above each block column's highest block that takes light, from the top down, eight columns of air at a time.
void find_heights(const BlockTile& tile, const TerrainPalette& palette, std::array<i32, 256>& heights) {
    heights.fill(kTerrainMinY);
    u8 wanted[32];
    std::memset(wanted, 255, sizeof wanted);
    i32 open = 32;
    for (i32 y = tile.top - 1; y >= 0 && open > 0; --y)
        for (i32 group = 0; group < 32; ++group) {
            if (wanted[group] == 0) continue;
            const Block* blocks = tile.block + (y << 8) + group * 8;
            u64 all;
            std::memcpy(&all, blocks, sizeof all);
            if (all == 0) continue;
            for (i32 i = 0; i < 8; ++i)
                if ((wanted[group] >> i & 1) && palette.takes_light[blocks[i]]) {
                    heights[std::size_t(group * 8 + i)] = kTerrainMinY + y + 1;
                    wanted[group] = u8(wanted[group] & ~(1u << i));
                }
            open -= wanted[group] == 0;
        }
}

} // namespace

GeneratedColumn pack_column(const BlockTile& tile, const BiomeTile& biomes, const TerrainPalette& palette) {
    const TerrainStages& stages = terrain_stages(best_isa());
    GeneratedColumn out;
    out.chunks.resize(kTerrainSections);
    for (i32 s = 0; s < kTerrainSections; ++s) {
        Chunk& chunk = out.chunks[std::size_t(s)];
        chunk.blocks = s * kChunkSize >= tile.top ? BlockStorage(palette.blocks[kAir])
                                                  : pack_section(stages, tile.block + s * kChunkVolume, palette);
        for (i32 cell = 0; cell < 64; ++cell)
            chunk.biomes.cells[std::size_t(cell)] = palette.biomes[biomes.biome[s * 64 + cell]];
    }
    find_heights(tile, palette, out.heights);
    return out;
}

u64 column_hash(const GeneratedColumn& column) {
    u64 h = 0;
    std::array<StateId, kChunkVolume> states;
    for (const Chunk& chunk : column.chunks) {
        if (chunk.blocks.uniform())
            h = hash_combine(h, u64(chunk.blocks.get(LocalPos())) << 32 | 1);
        else {
            chunk.blocks.unpack(states);
            for (const StateId s : states)
                h = (h ^ u32(s)) * 0x9e3779b97f4a7c15ull, h ^= h >> 29;
        }
        for (const BiomeId b : chunk.biomes.cells)
            h = hash_combine(h, u32(b));
    }
    return h;
}

} // namespace vitrail
