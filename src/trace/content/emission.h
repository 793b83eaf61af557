// How strongly lamps shine. A texel's radiance is its albedo x its emission channel x the state's emission; this finds
// the last.
//
// Balance, in the unit of scene/sky.h: the brightest side of a lamp of level 15 makes a white wall one block away (its
// middle, 1.5 blocks from the middle of the lamp's cell) return 1, however large the part that shines; a lamp of a
// lower level what the raster renderer's law of lamps says for light one level lower (shade.glsl: s (0.16 + 1.24 s)),
// in the same proportion. Small flames shine the more, up to kRadianceMost in their brightest texel: beyond that they
// give less light than their level, rather than dazzle. What has an emission picture but gives no light by its level
// glows faintly (kGlow x albedo x channel).
#pragma once

#include "trace/kernel/scene_view.h"

#include <array>
#include <span>

namespace vitrail::trace {

inline constexpr float kRadianceMost = 100;
inline constexpr float kClearMost = 4; // of clear bodies, which should still be seen through
inline constexpr float kGlow = 0.25f;

// What the wall is to return, luminance; 1 for level 15.
float lamp_return(u32 level);

// What pieces with this emission return from the walls one block from the cell, by Face; the wall is white and faces
// the lamp.
std::array<Vec3, 6> wall_returns(std::span<const TraceQuad> pieces, Vec3 emission, const TextureView& textures,
                                 const u32* fixed_tints);

// The emission of a state. levels: r, g, b, 0..15, not all 0. 0 where no texel shines.
Vec3 lamp_emission(const std::array<u8, 3>& levels, std::span<const TraceQuad> pieces, const TextureView& textures,
                   const u32* fixed_tints, float radiance_most = kRadianceMost);

// The face of a cube as a quad.
TraceQuad quad_of_face(u64 look);

} // namespace vitrail::trace
