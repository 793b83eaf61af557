// Shapes of states for bodies and picking: sets of boxes. What is drawn follows separately in scene/block_model.h.
#pragma once

#include "base/types.h"
#include "world/block_def.h"
#include "world/block_state.h"

#include <vector>

namespace vitrail {

inline constexpr i32 kShapeUnit = 64; // boxes are in 1/64 block, so that fixed-point positions stay exact

struct ShapeBox {
    i16 min[3] = {0, 0, 0}, max[3] = {kShapeUnit, kShapeUnit, kShapeUnit}; // fences reach above 64
    friend bool operator==(const ShapeBox&, const ShapeBox&) = default;
};

struct BlockShape {
    std::vector<ShapeBox> collision; // empty: bodies pass
    std::vector<ShapeBox> pick;      // empty: rays pass
    bool full_cube = false;          // collision and outline are the unit cube
    friend bool operator==(const BlockShape&, const BlockShape&) = default;
};

// The boxes of a state: kind and properties (Minecraft's names and values) decide; `boxes` serves ShapeKind::boxes.
BlockShape make_shape(const BlockLook& look, const BlockState& state);

// Height of a liquid's surface in 1/64 block for Minecraft's level 0..15 (0 source, 1..7 falling off, 8+ falling: full).
i32 liquid_height(i32 level);

} // namespace vitrail
