// McRegion chunks (Beta 1.3 to 1.1): 128 blocks high, one byte array in order x, z, y.
#pragma once

#include "formats/anvil.h"

namespace vitrail {

// Whether `level` (the Level compound) is of that form.
bool is_mcregion_level(const nbt::Tag& level);
// Adds the eight sections; says what is wrong in out.problems.
void decode_mcregion_blocks(const nbt::Tag& level, DecodeContext& context, RawColumn& out);

} // namespace vitrail
