// Cells of a brick that a ray may still pass: all those ahead of a cell, on each axis, up to the brick's border. Where
// they are empty one step leaves the brick. Kernel-safe.
#pragma once

#include "base/hd.h"
#include "base/types.h"

namespace vitrail::trace {

// octant, bit: as GridView has them (trace/kernel/grid_view.h).
VX_HD constexpr u64 brick_box(u32 octant, u32 bit) {
    const u32 x = bit & 3, z = bit >> 2 & 3, y = bit >> 4;
    const u32 four = octant & 1 ? 15u << x & 15 : 15u >> (3 - x), four_z = octant & 4 ? 15u << z & 15 : 15u >> (3 - z),
              four_y = octant & 2 ? 15u << y & 15 : 15u >> (3 - y);
    u64 out = 0;
    for (u32 k = 0; k < 16; ++k) // rows of x
        if ((four_z >> (k & 3) & 1) && (four_y >> (k >> 2) & 1)) out |= u64(four) << 4 * k;
    return out;
}

inline constexpr u32 kBrickBoxes = 512; // octant * 64 + bit

struct BrickBoxes {
    u64 of[kBrickBoxes];
};
constexpr BrickBoxes make_brick_boxes() {
    BrickBoxes out{};
    for (u32 i = 0; i < kBrickBoxes; ++i)
        out.of[i] = brick_box(i >> 6, i & 63);
    return out;
}

} // namespace vitrail::trace
