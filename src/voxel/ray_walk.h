// RayWalk: the cells a ray passes, in order, from a fixed-point origin. Which boundary comes next is decided in
// integers, so no cell is missed or doubled however far from the world's middle; distances come as doubles relative to
// the origin.
//
//     for (RayWalk walk(eye, direction, 5.0f); walk.valid(); walk.step())
//         if (solid(walk.cell())) return walk.entry();
//
// After J. Amanatides and A. Woo, A Fast Voxel Traversal Algorithm for Ray Tracing, 1987. Where a ray goes exactly
// through an edge or corner it passes the cells beside it one by one, x before y before z: successive cells always
// share a face.
#pragma once

#include "base/types.h"
#include "math/vec.h"
#include "voxel/coords.h"

namespace vitrail {

class RayWalk {
public:
    static constexpr float kDistanceMost = 1 << 20; // blocks

    // `direction` need not be of unit length; without one (zero, NaN) only the origin's cell is passed. `distance` in
    // blocks.
    RayWalk(WorldPos origin, Vec3 direction, float distance);

    // False once the next cell lies beyond the distance or outside the world.
    bool valid() const { return valid_; }
    void step();

    BlockPos cell() const { return cell_; }
    // The face of the cell the ray came in by; for the first cell, which it did not enter, the one it would have.
    Face entry() const { return entry_; }
    bool first() const { return first_; }
    // Blocks from the origin to where the ray enters the cell; 0 for the first.
    double t() const { return t_; }

private:
    BlockPos cell_;
    i32 sign_[3];
    u64 next_[3];  // distance along the axis to the next boundary, 2^-32 block
    u64 speed_[3]; // |direction| along the axis, 2^-30
    double distance_ = 0, t_ = 0;
    Face entry_ = Face::up;
    bool valid_ = true, first_ = true;
};

} // namespace vitrail
