// Where the shadow maps lie: geometry without OpenGL. Each cascade is one square map looking along the light, laid over
// a ball around the eye. A ball, since turning then changes nothing; and no larger than the sphere around a slice of
// the view, whose corners lie farther from the eye than its axis (with the usual 70 x 102 degrees by 1.4).
//
// A map stays as it was drawn until the eye leaves its middle. Its texels lie on a grid fixed to the world: the center
// is a whole number of texels from an anchor block, counted exactly, so that a new center shows the same texels
// elsewhere.
#pragma once

#include "math/vec.h"
#include "voxel/coords.h"

#include <array>

namespace vitrail::render {

inline constexpr u32 kCascadesMost = 4;
// Blocks beyond a map, towards the light, at which a caster's distance is still told; farther ones cast from there.
inline constexpr double kCasterReach = 128;
// Widest edge on each side of a shadow's outline, in blocks (penumbrae of casters some 50 blocks away).
inline constexpr float kPenumbraMost = 0.5f;

struct D3 {
    double x = 0, y = 0, z = 0;
};
inline double dot(D3 a, D3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The texel grid and the part of it that a map shows.
struct ShadowMapPlace {
    DimensionId dimension{};
    BlockPos anchor;
    D3 right, up, toward;    // unit; toward the light
    double texel = 0;        // blocks a texel
    i64 u = 0, v = 0, w = 0; // center, texels from the anchor along right, up, toward
    double half = 0;         // blocks from the center to the map's edge, and to where depth ends
    double depth_range() const { return 2 * half + kCasterReach; }
};

// Where each cascade ends, blocks from the eye: between equal ratios and equal steps (the practical split of Zhang,
// Sun, Xu and Lun 2006).
std::array<float, kCascadesMost> cascade_ends(u32 count, float distance);

// The map for a ball of this radius around the eye. `before` gives its anchor on where direction, size and radius are
// the same and the eye is near. toward: unit, to the light.
ShadowMapPlace place_shadow_map(const ShadowMapPlace& before, Located<WorldPos> eye, Vec3 toward, float radius,
                                u32 size);

// The ball around the eye, and what filters read beside it, still lies inside.
bool covers(const ShadowMapPlace& place, Located<WorldPos> eye, float radius);

// Something within the section (and half a block around it) may cast a shadow onto what the map covers.
bool may_cast(const ShadowMapPlace& place, ChunkPos at);

// Dot products with (place from the eye, 1) give texture coordinates 0..1 and depth 0 (nearest to the light) .. 1.
struct ShadowRows {
    Vec4 u, v, z;
};
ShadowRows rows_from_eye(const ShadowMapPlace& place, WorldPos eye);

// For drawing, as terrain.vert.glsl reads it (u_map): texels along right and up, depth, each of a place from the anchor
// block; then the center in texels and 2 / texels a side.
std::array<Vec4, 4> rows_from_anchor(const ShadowMapPlace& place, u32 size);

} // namespace vitrail::render
