// RawColumn: what a chunk of any Minecraft version holds, in one form: sections of palette and indices, biomes, block
// entities, entities, ticks. Names are numbers of the worker's NameTable; old numeric ids stay codes until
// formats/legacy_ids.h gives them names.
#pragma once

#include "base/bytes.h"
#include "voxel/coords.h"

#include <array>
#include <deque>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace vitrail {

// Texts to small numbers in order of first sight. One thread.
class NameTable {
public:
    u32 intern(std::string_view text);
    // A second key for the same number: raw bytes whose text is known already, so that it need not be built again.
    u32* find_alias(std::string_view raw);
    void add_alias(std::string_view raw, u32 number);
    std::string_view text(u32 number) const { return texts_[number]; }
    u32 size() const { return u32(texts_.size()); }

private:
    std::deque<std::string> texts_; // addresses stay
    std::unordered_map<std::string_view, u32> index_;
    std::deque<std::string> alias_texts_;
    std::unordered_map<std::string_view, u32> aliases_;
};

// id << 4 | meta of a block before 1.13; id 0..4095, meta 0..15.
using LegacyCode = u16;

struct RawSection {
    i32 y = 0;                // blocks y * 16 .. y * 16 + 15
    bool legacy = false;      // palette entries are LegacyCodes; else NameTable numbers of state texts
    std::vector<u32> palette; // never empty in a decoded section
    std::vector<u16> indices; // 4096 in LocalPos order, each below palette.size(); empty: all palette[0]
    bool has_biomes = false;
    std::array<u32, 64> biomes{}; // NameTable numbers, BiomeGrid order

    u32 entry_at(u32 cell) const { return indices.empty() ? palette[0] : palette[indices[cell]]; }
};

struct RawBlockEntity {
    BlockPos at;
    u16 legacy_bits = 0; // what a pre-1.13 state takes from it (formats/legacy_ids.h)
    Bytes nbt;           // one compound as a document of its own
};
struct RawEntity {
    i32 y = 0; // block it stands in
    Bytes nbt;
};
struct RawTick {
    BlockPos at;
    i32 delay = 0; // ticks from the moment of saving
    i32 priority = 0;
};

struct RawColumn {
    ColumnPos at;                     // by its place in the region file
    i32 data_version = 0;             // 0 before 1.9
    bool position_disagrees = false;  // its own xPos, zPos name another place
    std::string status;               // without namespace; empty before 1.13
    std::vector<RawSection> sections; // only those with blocks, in the file's order, each y once
    // Biomes of a whole column where sections have none: 16 numbers a level of 4 blocks from biome_min_y (in blocks)
    // up. One level alone holds for all heights.
    std::vector<u32> level_biomes;
    i32 biome_min_y = 0;
    std::vector<RawBlockEntity> block_entities;
    std::vector<RawEntity> entities;
    std::vector<RawTick> ticks;
    // Parts left out, one line each; the rest of the column is right.
    std::vector<std::string> problems;
    u32 sections_skipped = 0;

    // Empties it; sections' memory is kept.
    void clear();
    RawSection& add_section();
    const RawSection* section_at(i32 y) const;
    // Biomes of the 16 blocks from section_y * 16 up; false where the file says nothing.
    bool biomes_of(i32 section_y, std::array<u32, 64>& out) const;

private:
    std::vector<RawSection> spare_;
};

} // namespace vitrail
