// Chunk NBT of every Minecraft version to RawColumn: McRegion, Anvil with numeric ids (1.2 to 1.12), Anvil with
// palettes (1.13 to 1.17: packed across words below DataVersion 2529, padded from there), the layout without Level
// from 1.18 on.
#pragma once

#include "formats/nbt.h"
#include "formats/raw_column.h"

namespace vitrail {

// What a worker keeps while it decodes chunk after chunk.
struct DecodeContext {
    NameTable names;
    std::string text;              // scratch
    std::vector<u16> slot_of_code; // 65536 entries once used, all 0xffff between sections
    bool blocks_only = false;      // leave out biomes, entities and ticks: enough to count blocks
};

// Decodes the chunk in slot `at`. Parts that are wrong are left out and said in out.problems.
// Errors: damaged, where this is no chunk at all; `out` is then empty.
Result<> decode_chunk(const nbt::Tag& root, ColumnPos at, DecodeContext& context, RawColumn& out);

// Adds the entities of a chunk of a separate entities/ region (1.17 on).
void decode_entities(const nbt::Tag& root, RawColumn& out);

// The canonical text of a palette entry {Name, Properties}: name[a=b,c=d], properties sorted; empty where it is none.
void block_state_text(const nbt::Tag& entry, std::string& out);

// Unpacks 4096 indices from big-endian words; `entries` palette entries, DataVersion 0 where unknown. Indices out of
// the palette become 0 and are counted in `bad`. False where the number of words fits no packing.
bool unpack_indices(ByteView words, std::size_t entries, i32 data_version, std::vector<u16>& out, u32& bad);

// Turns 4096 codes into a section's palette and indices.
void set_legacy_blocks(const LegacyCode* codes, DecodeContext& context, RawSection& out);

inline constexpr i32 kPaddedIndicesVersion = 2529; // 20w17a, 1.16

} // namespace vitrail
