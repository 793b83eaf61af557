// The pictures of blocks as square layers with mip levels, found, read and brought to one size on the CPU; the raster
// renderer uploads them, the path tracer reads them as they are. Layer = TextureId: content's first, then pictures that
// only packs have. Albedo is sRGB-encoded RGBA8; material holds the normal map's x (right) and y (down, in the
// picture), roughness and emission, linear. In the opaque pass alpha is the share of its tint that a texel takes.
//
// Layers are as large as the largest picture in use. Frames of animations lie beside them; a layer shows the first
// until somebody writes another.
#pragma once

#include "base/result.h"
#include "scene/texture_mips.h"
#include "world/block_registry.h"

#include <functional>
#include <string>
#include <vector>

namespace vitrail::scene {

class PackLooks;

struct PictureLimits {
    u32 size_most = 512;             // texels of a layer's side
    u64 bytes_most = u64(768) << 20; // of all layers, albedo and material
};

struct PictureFormat {
    static constexpr u32 kContentSize = 32; // without packs
    u32 layers = 1, size = kContentSize, levels = 6;
};
// packs: of this registry, or null.
PictureFormat choose_picture_format(const BlockRegistry& registry, const PackLooks* packs, const PictureLimits& limits);
// The side that layers get, a power of two from kContentSize.
u32 choose_picture_size(u32 layers, u32 largest, const PictureLimits& limits);

struct PictureAnimation {
    struct Step {
        u32 frame = 0, end = 0; // index into albedo and material; ticks of 1/20 s
    };
    u32 layer = 0, ticks = 0; // ticks: of one round
    bool interpolate = false;
    std::vector<Step> steps;
    std::vector<MipChain> albedo, material; // material may be empty: it does not change

    // What is to be seen at a time: `from`, with share / 256 of `to`. Equal keys mean the same picture.
    struct Moment {
        u32 from = 0, to = 0, share = 0;
        u64 key = 0;
    };
    Moment at(double seconds) const;
};
// Into words of a layer, levels one after another.
void copy_levels(const MipChain& chain, u32* to);
void mix_frames(const MipChain& a, const MipChain& b, u32 share_of_256, MipChain& out);

// Receives every layer once, in order; chains are gone after the call.
using PictureSink = std::function<void(u32 layer, const MipChain& albedo, const MipChain& material)>;
struct PictureStock {
    std::vector<PictureAnimation> animations;
    // Content's pictures that are nowhere, then what models of packs name and nobody has.
    std::vector<std::string> missing;
};
// Layers stream through `sink`, so that whoever passes them on holds them once.
PictureStock read_block_pictures(const BlockRegistry& registry, const PackLooks* packs, const PictureFormat& format,
                                 const PictureSink& sink);

// All of them in memory. Texels: red in the lowest byte. A layer's levels follow each other, largest first.
struct BlockPictures {
    PictureFormat format;
    u32 layer_words = 0;
    std::vector<u32> albedo, material;
    std::vector<PictureAnimation> animations;
    std::vector<std::string> missing;

    static BlockPictures load(const BlockRegistry& registry, const PackLooks* packs, const PictureLimits& limits = {});
};

} // namespace vitrail::scene
