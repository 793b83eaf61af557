// The block textures as two arrays of square layers. Layer = TextureId, so that shaders need no table: content's first,
// then pictures that only packs have. Albedo is sRGB-encoded RGBA8 (decoded by the lighting pass); material holds the
// normal map's x and y, roughness and emission, linear. In the opaque pass alpha is the share of its tint that a texel
// takes.
//
// Layers are as large as the largest picture in use. Frames of animations lie in memory and are written into their
// layer as time passes: a few kilobytes each, and the arrays keep their layers for what stands still.
#pragma once

#include "base/result.h"
#include "gfx/handles.h"
#include "render/texture_mips.h"
#include "world/block_registry.h"

#include <string>
#include <vector>

namespace vitrail::scene {
class PackLooks;
}

namespace vitrail::render {

struct TextureLimits {
    u32 size_most = 512;             // texels of a layer's side
    u64 bytes_most = u64(768) << 20; // of both arrays on the GPU
};

class TextureSet {
public:
    static constexpr u32 kSize = 32, kLevels = 6; // without packs
    // packs: of this registry, or null. Errors: limit.
    Result<> load(const BlockRegistry& registry, const scene::PackLooks* packs, const TextureLimits& limits,
                  bool smooth, float anisotropy);
    // Shows the frames that belong to this time; cheap when nothing changes.
    void animate(double seconds);
    const gfx::Texture& albedo() const { return albedo_; }
    const gfx::Texture& material() const { return material_; }
    u32 size() const { return size_; } // texels of a layer's side
    // Content's pictures that are nowhere, then what models of packs name and nobody has.
    const std::vector<std::string>& missing() const { return missing_; }
    void set_smooth(bool smooth, float anisotropy);
    u64 gpu_bytes() const;

    // The side that layers get, a power of two from kSize.
    static u32 choose_size(u32 layers, u32 largest, const TextureLimits& limits);

private:
    struct Animation {
        struct Step {
            u32 frame = 0, end = 0; // ticks
        };
        u32 layer = 0, ticks = 0;
        bool interpolate = false;
        u64 shown = ~u64(0);
        std::vector<Step> steps;
        std::vector<MipChain> albedo, material; // material may be empty: it does not change
    };
    gfx::Texture albedo_, material_;
    std::vector<Animation> animations_;
    MipChain mixed_;
    u32 size_ = kSize;
    bool break_animations_ = false;
    std::vector<std::string> missing_;
};

} // namespace vitrail::render
