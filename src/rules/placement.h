// Placing a block: which state results where, from the block's own properties, the look, the face clicked and the
// neighbors, as Minecraft players know it. The client predicts with this, the server decides with it.
#pragma once

#include "base/result.h"
#include "rules/body.h"
#include "voxel/edit.h"
#include "world/dimension.h"

#include <span>
#include <string>

namespace vitrail {

struct PlaceRequest {
    std::string block;            // name of the block in hand, e.g. minecraft:torch
    BlockPos against;             // what was clicked
    Face face = Face::up;         // its face
    Vec3 point{0.5f, 0.5f, 0.5f}; // where, within the cell of `against`, 0..1
    float yaw = 0, pitch = 0;     // of the look, radians
    bool sneaking = false;        // chests do not join
};

// The edits, neighbors included; the first is the block itself. Bodies are those that must not be built into.
// Errors: not_found (no such block; chunk absent or outside the dimension), denied (occupied, no support, a body in the
// way), invalid_argument (a point or angle that is not finite).
Result<EditBatch> place_block(const Dimension& dimension, const PlaceRequest& request,
                              std::span<const BodyState> bodies);

} // namespace vitrail
