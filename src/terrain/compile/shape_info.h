// What a shape's builder wants from its row: names of its numbers and blocks, their defaults, and how far it can reach.
// The one table that compile_terrain, the list command and the documentation read; builders lie in kernel/shapes/.
#pragma once

#include "terrain/tables.h"

#include <span>

namespace vitrail {

struct ShapeNumber {
    const char* name = nullptr;
    float fallback = 0, least = 0, most = 0;
};
struct ShapeInfo {
    const char* name = nullptr;
    ShapeNumber numbers[kFeatureNumbers]; // in FeatureRow::numbers; unused: name null
    const char* blocks[kFeatureBlocks] = {}; // in FeatureRow::blocks; all wanted
    i16 bound_low = 0, bound_high = 0, reach = 0; // with the greatest numbers allowed
};
std::span<const ShapeInfo> shape_infos(); // by Shape

} // namespace vitrail
