// The light of a section as the GPU samples it: an 18^3 volume, one border cell around the section, in which opaque
// cells hold light spread from open cells beside them, so that smooth (trilinear) sampling just in front of a face
// neither darkens nor leaks. A light change needs a new brick but no new mesh.
//
// Texels: RGBA4, cells[x + 18 * z + 324 * y] for x, y, z = -1..16 shifted by one: texture axes are (x, z, y). A texel
// is Light::bits unchanged; uploaded as GL_RGBA, GL_UNSIGNED_SHORT_4_4_4_4 (whose first component is the highest
// nibble) it reads as r = blue, g = green, b = red, a = sky: `vec4 sky_rgb = texel.abgr`. A point p of the section
// (blocks, 0..16) is sampled at (p.xzy + 1) / 18.
#pragma once

#include "render/meshing/mesher.h"
#include "scene/tint_grid.h"

#include <array>
#include <span>

namespace vitrail::render {

struct LightBrick {
    static constexpr i32 kSize = 18;
    static constexpr u32 index(i32 x, i32 y, i32 z) { return u32((x + 1) + kSize * (z + 1) + kSize * kSize * (y + 1)); }
    bool uniform = false; // every cell is `value`; cells are not written then
    Light value;
    alignas(64) std::array<u16, kSize * kSize * kSize> cells;
};

// From the same 27 chunks as the mesh. Opaque cells, absent and unlit chunks take the light of open cells beside them:
// on each axis the darker where both sides are open (a thin wall must not let light into a dark room), else the open
// one; averaged over the axes, rounded to the nearest, halves up. Cells with no open side take what sides so filled
// give by the same rule; cells deeper are 0 and never sampled. Neighboring bricks agree in the cells they share.
void build_light_brick(const MeshInput& input, LightBrick& out);

using scene::BiomeTint;
using scene::TintGrid;
// Of the section's height among the 27 chunks.
inline TintGrid build_tint_grid(const MeshInput& input, std::span<const BiomeTint> tints) {
    return scene::build_tint_grid(std::span<const Chunk* const, 9>(&input.chunks[MeshInput::index(-1, 0, -1)], 9),
                                  tints);
}

} // namespace vitrail::render
