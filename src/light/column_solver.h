// Lights the pending chunks of one column from nothing, by level sets as bit planes: all cells of a level at once, a
// level for all chunks of the column before the next lower one, so that one pass is exact. 4096 cells are 64 words.
#pragma once

#include "light/light_field.h"

#include <span>

namespace vitrail {

// `slots`: pending slots of one column, any order. Light of lit chunks beside them flows in. Gives each its volume
// (LightField::light_up) and adds to field.rising the cells whose light can flow out into lit chunks.
void solve_column(LightField& field, std::span<const i32> slots, const ColumnHeights& heights);

} // namespace vitrail
