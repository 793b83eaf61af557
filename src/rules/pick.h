// What a look points at: the first state along it whose pick boxes (world/shape.h) the ray meets.
#pragma once

#include "math/vec.h"
#include "voxel/coords.h"
#include "world/dimension.h"

#include <optional>

namespace vitrail {

inline constexpr float kReach = 5.0f; // blocks from the eye

struct PickHit {
    BlockPos block;
    Face face = Face::up; // of the box that was met
    float t = 0;          // blocks from the eye
    Vec3 point;           // within the block, 0..1
};

// Nothing where no box lies within `reach` blocks; liquids and absent chunks are looked through.
std::optional<PickHit> pick_block(const Dimension& dimension, WorldPos eye, Vec3 direction, float reach);

} // namespace vitrail
