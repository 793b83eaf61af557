// Reads one define_block table into a BlockDef.
#pragma once

#include "base/result.h"
#include "lua/value.h"
#include "world/block_def.h"

namespace vitrail {

// Errors: invalid_argument, with the block's name and what was expected; limit.
Result<BlockDef> read_block(const lua::Value& name, const lua::Value& definition);

// `name` with the default namespace added. Errors: invalid_argument.
Result<std::string> read_name(const lua::Value& name, const char* what);
// A texture's name: letters, digits and _ - . / , at most 64, no leading slash or "..".
Result<std::string> read_texture_name(const lua::Value& name);
// {r, g, b} of whole numbers 0..most, or one number for all three where `one_number`.
Result<std::array<u8, 3>> read_triple(const lua::Value& value, int most, bool one_number);

} // namespace vitrail
