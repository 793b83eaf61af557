// Grass, foliage and water colors around a chunk, as raster and tracer sample them.
#pragma once

#include "voxel/chunk.h"

#include <array>
#include <span>

namespace vitrail::scene {

// For bilinear sampling: a point of the chunk (blocks, 0..16) lies at (p.xz / 4 + 1) / 6.
struct TintGrid {
    static constexpr i32 kSize = 6; // four cells of 4 blocks and one border cell on each side
    static constexpr u32 index(i32 cell_x, i32 cell_z) { return u32((cell_x + 1) + kSize * (cell_z + 1)); } // -1..4
    using Texels = std::array<std::array<u8, 4>, kSize * kSize>; // sRGB and 255
    Texels grass{}, foliage{}, water{};
    bool uniform = false; // one color everywhere
    friend bool operator==(const TintGrid&, const TintGrid&) = default;
};

// sRGB colors of a biome.
struct BiomeTint {
    std::array<u8, 3> grass{127, 178, 89}, foliage{104, 158, 70}, water{63, 118, 228};
};

// From a chunk and its 8 neighbors at the same height, by (dx + 1) + 3 * (dz + 1): the chunk itself is the fifth and
// must be there. Colors are blended with a tent over 12 blocks (radius 8), all four layers of biomes together. Ids
// beyond `tints` and absent chunks take the tints of the nearest known (entry 0).
TintGrid build_tint_grid(std::span<const Chunk* const, 9> chunks, std::span<const BiomeTint> tints);

} // namespace vitrail::scene
