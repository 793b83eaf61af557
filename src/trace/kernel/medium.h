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

// Share of light left after `length` blocks.
VX_HD Vec3 medium_left(const SceneView& s, Place at, float length, u32 medium) {
    const Vec3 lost = medium_optics(s, at, medium).absorption * length;
    return {exp_of(-lost.x), exp_of(-lost.y), exp_of(-lost.z)};
}

} // namespace vitrail::trace
