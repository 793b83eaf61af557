// Mip levels of block pictures, on the CPU.
#pragma once

#include "formats/image.h"

#include <vector>

namespace vitrail::scene {

// One layer with its mip levels, largest first: RGBA, size x size down to 1x1.
struct MipChain {
    std::vector<std::vector<u8>> levels;
};

// Square frames below each other in a strip; 1 for any other picture.
u32 frames_of(const Image& image);

// `size`: texels of level 0, a power of two; the picture is brought to it by nearest texels. Albedo is averaged in
// linear light, weighted by alpha, and the alpha of each level is set so that as much of it passes the 0.5 test as of
// level 0: leaves keep their density far away. `mask`: alpha is no cover but a share (scene::TextureArt::tint_mask),
// averaged as it is.
MipChain make_albedo_mips(const Image& rgba, u32 frame, u32 size = 32, bool mask = false);
// Normal x and y, roughness, emission; each may be null.
MipChain make_material_mips(const Image* normal, const Image* roughness, const Image* emission, u32 frame,
                            u32 size = 32);

} // namespace vitrail::scene
