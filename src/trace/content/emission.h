// How strongly lamps shine. A texel's radiance is its albedo x its emission channel x the state's emission; this finds
// the last.
//
// Balance: the brightest side of a lamp makes a white wall that faces it return what scene/lamp_light.h says for its
// level, however large the part that shines: scene::lamp_return(level) at scene::lamp_distance(level) from the middle
// of its cell. For level 15 that is 0.99 three blocks away, near 4 one block away. A torch's flame, two texels wide,
// comes so to some 700, glowstone to 20. What fills pools and prisms (liquids, clear bodies) shares that among the
// kAlike blocks that lie side by side. What has an emission picture but gives no light by its level glows faintly
// (kGlow x albedo x channel).
#pragma once

#include "trace/kernel/scene_view.h"

#include <array>
#include <span>

namespace vitrail::trace {

// In the brightest texel, and what a state's record can hold. What would be brighter gives less light than its level:
// of the base content the conduit alone, whose pictures are nearly dark.
inline constexpr float kRadianceMost = 2000, kEmissionMost = 65535 * StateRecord::kEmissionUnit;
inline constexpr float kAlike = 4;
inline constexpr float kGlow = 0.25f;

// What pieces with this emission return from the walls `distance` blocks from the middle of the cell, by Face; the wall
// is white and faces the lamp.
std::array<Vec3, 6> wall_returns(std::span<const TraceQuad> pieces, Vec3 emission, const TextureView& textures,
                                 const u32* fixed_tints, float distance);

// The emission of a state. levels: r, g, b, 0..15, not all 0. alike: it lies beside others of its kind. 0 where no
// texel shines.
Vec3 lamp_emission(const std::array<u8, 3>& levels, std::span<const TraceQuad> pieces, const TextureView& textures,
                   const u32* fixed_tints, bool alike = false);

// Sets where on a piece light leaves it and how much (TraceQuad::shine, shining_part). moves: its picture changes, any
// part may shine later.
void set_shining_part(TraceQuad& piece, const TextureView& textures, const u32* fixed_tints, bool moves);

// The face of a cube as a quad.
TraceQuad quad_of_face(u64 look);

} // namespace vitrail::trace
