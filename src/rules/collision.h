// Swept boxes against the world, in integers: what a box touches, and how far it may go along an axis. Positions and
// shapes share one fixed-point scale (1/64 block is 2^26 units), so the answer is exact and the same everywhere.
#pragma once

#include "rules/body.h"
#include "world/dimension.h"

#include <vector>

namespace vitrail {

// Half-open in neither direction: boxes that share only a face do not overlap.
struct FixedBox {
    i64 min[3], max[3];
    bool overlaps(const FixedBox& o) const {
        return min[0] < o.max[0] && o.min[0] < max[0] && min[1] < o.max[1] && o.min[1] < max[1] && min[2] < o.max[2] &&
               o.min[2] < max[2];
    }
    FixedBox moved(int axis, i64 by) const {
        FixedBox b = *this;
        b.min[axis] += by;
        b.max[axis] += by;
        return b;
    }
};

FixedBox body_box(WorldPos feet, i64 height);
FixedBox box_of(const ShapeBox& box, BlockPos block);

enum class CellKind { loaded, open, unknown };
// What is known of a cell: in a loaded chunk; open air above a column's heights or outside the dimension's lowest and
// highest y; or unknown (absent chunk), which stops bodies as beyond the edge of the world.
CellKind cell_kind(const Dimension& dimension, BlockPos at);

// All collision boxes that overlap or touch `region`; unknown cells are whole cubes.
void gather_boxes(const Dimension& dimension, const FixedBox& region, std::vector<FixedBox>& out);

// How much of the way `by` along an axis the box may go, stopping at the first box in its way. Boxes it is already
// inside of do not count.
i64 sweep(const FixedBox& body, int axis, i64 by, const std::vector<FixedBox>& boxes);

bool any_overlap(const FixedBox& body, const std::vector<FixedBox>& boxes);

// Whether a box of the world overlaps a body of this height at these feet.
bool body_fits(const Dimension& dimension, WorldPos feet, i64 height);

} // namespace vitrail
