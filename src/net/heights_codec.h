// Column heights on the wire: differences along z-rows, zigzag varints, a zero followed by how many more zeros come.
#pragma once

#include "base/bytes.h"
#include "base/result.h"
#include "world/dimension.h"

namespace vitrail::net {

Bytes pack_heights(const ColumnHeights& heights);
// Errors: damaged.
Result<ColumnHeights> unpack_heights(ByteView bytes);

} // namespace vitrail::net
