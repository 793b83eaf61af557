// What the levels of lamps (0..15, a step less each block) mean as light, for raster and tracer alike. Shaders have the
// same in render/passes/lighting/lamp_light.glsl (a test compares them). In the unit of scene/sky.h: 1 is what a white
// surface returns about at noon. Kernel-safe: values only.
#pragma once

#include "math/vec.h"

namespace vitrail::scene {

inline constexpr float kLevelMost = 15;

// What a white surface returns where the strongest level is `share` of 15: between a linear and a square law.
VX_HD float lamp_law(float share) {
    return share * (0.16f + 1.24f * share);
}

// Flames are warm: factors of red, green and blue.
VX_HD Vec3 lamp_warmth() {
    return {1.10f, 0.97f, 0.84f};
}

// What a white surface returns by color; levels: shares of 15. Each channel loses one level a block, so far from a lamp
// only its strongest color would be left: the weaker a light, the nearer to gray it is taken.
VX_HD Vec3 lamp_light(Vec3 levels) {
    const float some = levels.x > levels.y ? levels.x : levels.y, strongest = some > levels.z ? some : levels.z;
    const float gray = (1.15f - strongest) * strongest, all = strongest + gray;
    const Vec3 hue = (levels + Vec3{gray, gray, gray}) * (1 / (all > 1e-3f ? all : 1e-3f));
    return hue * lamp_warmth() * lamp_law(strongest);
}

// ---- Where rays of light are followed, a lamp is as strong as its level shows at one place, and light does the rest:
// a wall that faces it, a fifth of the level away in blocks from the middle of its cell, but no nearer than the next
// block. Levels fall evenly and light by the square, so nearer to the lamp rays bring more than levels say, farther
// less; in rooms that such a lamp is put into both are alike in sum (docs/tracing.md).

// Blocks from the middle of the lamp's cell. level: 1..15.
VX_HD float lamp_distance(float level) {
    return level > 7.5f ? level * 0.2f : 1.5f;
}
// What the wall returns there, white; 0 for level 0.
VX_HD float lamp_return(float level) {
    if (!(level > 0)) return 0;
    const float there = level - (lamp_distance(level) - 0.5f); // the next block has one level less
    return lamp_law((there > 0.5f ? there : 0.5f) * (1 / kLevelMost));
}

} // namespace vitrail::scene
