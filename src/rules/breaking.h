// Taking a block away: whether it may be, what goes with it, how long it takes. The server checks every claim with
// these.
#pragma once

#include "base/result.h"
#include "voxel/edit.h"
#include "world/dimension.h"

namespace vitrail {

// Errors: denied (nothing there, a liquid, unbreakable, hidden), not_found (chunk absent or outside the dimension).
Result<> can_break(const Dimension& dimension, BlockPos at);

// The edits: the block, its other part, whatever it held, and the neighbors whose joints change.
// Errors: those of can_break; limit.
Result<EditBatch> break_block(const Dimension& dimension, BlockPos at);

// Seconds of holding the button with bare hands; 0 in creative play. Infinite for what cannot be broken.
float break_seconds(const BlockLook& look, bool creative);

} // namespace vitrail
