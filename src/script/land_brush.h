// LandBrush: hills from a coarse grid of heights, covered by the first rule that fits the place. Used by world scripts.
#pragma once

#include "script/block_canvas.h"

#include <limits>
#include <vector>

namespace vitrail {

// What lies on the rock where all conditions hold.
struct LandCover {
    StateId top{}, under{}; // the highest block; those below it
    i32 depth = 1;          // blocks of both together
    float above = -std::numeric_limits<float>::infinity(), below = std::numeric_limits<float>::infinity(); // height
    float steeper = 0, flatter = std::numeric_limits<float>::infinity(); // slope, blocks up a block along
    float wander = 0; // blocks that `above` and `below` go up and down from place to place
};

struct LandBrush {
    i32 x = 0, z = 0;           // of the first height
    i32 step = 8;               // blocks between two heights
    u32 width = 0;              // heights a row; at least 2 rows and columns
    std::vector<float> heights; // row by row along x; y above the highest block of land
    i32 bottom = 0;
    StateId rock{}, water{};
    std::vector<LandCover> covers;
    i32 water_level = std::numeric_limits<i32>::min(); // the highest block of water

    u32 depth() const { return u32(heights.size()) / width; } // heights a column
};

// Between the heights it is a smooth surface through them (cubic splines of Catmull and Rom, 1974).
float land_height(const LandBrush& land, i32 x, i32 z);

// Sets what lies below the surface, and water above it; other blocks stay. Errors: as BlockCanvas::fill.
Result<> paint_land(BlockCanvas& canvas, const LandBrush& land);

// Smooth noise of about -1 to 1: gradient noise (Perlin 1985, smoothed as in 2002), octaves halved in size and
// strength.
double script_noise(double x, double z, u64 seed, u32 octaves);

} // namespace vitrail
