// What media take from light and scatter. Kernel-safe.
#pragma once

#include "math/exp.h"
#include "scene/water.h"
#include "trace/kernel/surface.h"

namespace vitrail::trace {

inline constexpr u32 kTintWater = 3; // TintKind

// Of a stretch in this medium, a block, base e: all that a ray loses, and what of that is scattered. A tinted medium
// has the color of the place where the stretch begins.
VX_HD scene::LiquidOptics medium_optics(const SceneView& s, Place at, u32 medium) {
    const MediumRecord& m = s.media[medium];
    scene::LiquidOptics o{m.absorption, m.scattering};
    if (m.tinted) o = scene::water_optics(biome_tint(s.grid, kTintWater, at));
    o.absorption = o.absorption + o.scattering; // what is scattered is lost to the ray too
    return o;
}

// Share of light left after `length` blocks for what arrives, from wherever: what floats in media scatters forwards, so
// what a ray loses by that others bring, and absorption alone dims. The eye's own way also loses what is scattered, and
// gets as much (scatter.h).
VX_HD Vec3 medium_left(const SceneView& s, Place at, float length, u32 medium) {
    const MediumRecord& m = s.media[medium];
    const Vec3 lost =
        (m.tinted ? scene::water_optics(biome_tint(s.grid, kTintWater, at)).absorption : m.absorption) * length;
    return {exp_of(-lost.x), exp_of(-lost.y), exp_of(-lost.z)};
}

} // namespace vitrail::trace
