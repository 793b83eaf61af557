// The shape of a liquid's surface in a cell, for mesher and tracer alike: a height at each of the cell's four upper
// corners, drawn as two triangles that meet along the diagonal from (x 0, z 1) to (x 1, z 0). Kernel-safe.
#pragma once

#include "base/hd.h"
#include "base/types.h"

namespace vitrail::scene {

inline constexpr i32 kLiquidFull = 256;           // heights are in 1/256 block
inline constexpr i32 kLiquidLevel = 256 - 28;     // of a source: 8/9 (kLiquidDropUnits)
inline constexpr i32 kLiquidNone = -1;            // the cell does not hold the fluid
inline constexpr i32 kLiquidUnderLiquid = 1 << 9; // it does, and so does the cell above it

// Heights at (x, z): 00 least corner, 10 along x.
struct LiquidSlope {
    i32 h00 = kLiquidLevel, h10 = kLiquidLevel, h11 = kLiquidLevel, h01 = kLiquidLevel;
};

// Height where four cells meet: full where one of them has the fluid above it too, else the mean of those that hold it,
// in steps of 4 (few heights make few model quads). of(dx, dz), each -1 or 0: kLiquidNone, kLiquidUnderLiquid or the
// height of the cell's own level.
template <class Of>
VX_HD i32 liquid_corner(Of&& of) {
    i32 sum = 0, count = 0;
    for (i32 dz = -1; dz <= 0; ++dz)
        for (i32 dx = -1; dx <= 0; ++dx) {
            const i32 h = of(dx, dz);
            if (h >= kLiquidUnderLiquid) return kLiquidFull;
            if (h < 0) continue;
            sum += h;
            ++count;
        }
    return count == 0 ? kLiquidLevel : (sum / count + 2) & ~3;
}

// All four corners of a cell; of(dx, dz): as above, each -1..1.
template <class Of>
VX_HD LiquidSlope liquid_slope(Of&& of) {
    LiquidSlope s;
    s.h00 = liquid_corner([&](i32 dx, i32 dz) { return of(dx, dz); });
    s.h10 = liquid_corner([&](i32 dx, i32 dz) { return of(dx + 1, dz); });
    s.h11 = liquid_corner([&](i32 dx, i32 dz) { return of(dx + 1, dz + 1); });
    s.h01 = liquid_corner([&](i32 dx, i32 dz) { return of(dx, dz + 1); });
    return s;
}

} // namespace vitrail::scene
