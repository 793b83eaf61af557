// From a tile of raw blocks to chunks with palettes, biomes and heights.
#include "terrain/generator.h"

#include <cstring>

namespace vitrail {

namespace {

// Blocks of one section in rising order, states doubled under two names joined.
BlockStorage pack_section(const Block* blocks, const TerrainPalette& palette) {
    // Sections of one block are frequent: compare with itself shifted by one cell.
    if (std::memcmp(blocks, blocks + 1, kChunkVolume - 1) == 0) return BlockStorage(palette.blocks[blocks[0]]);
    u8 present[kBlocksMost] = {};
    for (i32 i = 0; i < kChunkVolume; ++i)
        present[blocks[i]] = 1;
    u8 slot[kBlocksMost];
    std::vector<StateId> states;
    for (u32 b = 0; b < palette.blocks.size() && b < kBlocksMost; ++b) {
        if (!present[b]) continue;
        u32 s = 0;
        while (s < states.size() && states[s] != palette.blocks[b])
            ++s;
        if (s == states.size()) states.push_back(palette.blocks[b]);
        slot[b] = u8(s);
    }
    const u32 bits = bits_for_palette(states.size());
    if (bits == 0) return BlockStorage(states[0]);
    std::vector<u64> words(std::size_t(bits) * 64);
    const u32 cells = 64 / bits; // a word
    const Block* at = blocks;
    for (u64& word : words) {
        u64 w = 0;
        for (u32 i = 0; i < cells; ++i)
            w |= u64(slot[at[i]]) << (i * bits);
        word = w;
        at += cells;
    }
    return BlockStorage::from_packed(std::move(states), std::move(words));
}

} // namespace

GeneratedColumn pack_column(const BlockTile& tile, const BiomeTile& biomes, const TerrainPalette& palette) {
    GeneratedColumn out;
    out.chunks.resize(kTerrainSections);
    for (i32 s = 0; s < kTerrainSections; ++s) {
        Chunk& chunk = out.chunks[std::size_t(s)];
        chunk.blocks = s * kChunkSize >= tile.top ? BlockStorage(palette.blocks[kAir])
                                                  : pack_section(tile.block + s * kChunkVolume, palette);
        for (i32 cell = 0; cell < 64; ++cell)
            chunk.biomes.cells[std::size_t(cell)] = palette.biomes[biomes.biome[s * 64 + cell]];
    }
    for (i32 i = 0; i < kColumnCells; ++i) {
        i32 y = tile.top;
        while (y > 0 && !palette.takes_light[tile.block[(y - 1) << 8 | i]])
            --y;
        out.heights[std::size_t(i)] = kTerrainMinY + y;
    }
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
