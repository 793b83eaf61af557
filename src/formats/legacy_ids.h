// Blocks before 1.13 as numbers (id 0..255, meta 0..15) and their modern states; old biome numbers and their names.
// Facts after https://minecraft.wiki/w/Java_Edition_data_values/Pre-flattening
#pragma once

#include "formats/nbt.h"
#include "formats/raw_column.h"
#include "world/block_state.h"

#include <string>
#include <string_view>

namespace vitrail {

// What a numeric block does not say itself but its block entity or its neighbors do, packed by kind of block; 0 where
// there is nothing. See legacy_ids.cpp for the meaning by block.
using LegacyBits = u16;

// The state of newest Minecraft that an old block stands for. A number 1.12 does not know becomes legacy:ID[meta=M].
// Properties Minecraft has but neither number nor bits tell are left out (StateTable::intern_with_defaults fills them).
BlockState legacy_state(LegacyCode code, LegacyBits bits = 0);

// `id:ID:META`, as counts write old blocks.
std::string legacy_count_name(LegacyCode code);

// Colors of beds and banners, kinds of heads, plants of pots, pitches of note blocks.
LegacyBits legacy_bits_of_block_entity(const nbt::Tag& block_entity);

// minecraft:NAME of a biome number before 1.18, under its newest name; legacy:biome_N for numbers of mods.
std::string legacy_biome_name(u32 id);

} // namespace vitrail
