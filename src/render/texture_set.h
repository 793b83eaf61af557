// The block textures as two arrays of 32x32 layers. Layer = TextureId, so that shaders need no table; an animation
// copies its current frame into its layer. Albedo is sRGB-encoded RGBA8 (decoded by the lighting pass); material holds
// the normal map's x and y, roughness and emission, linear.
#pragma once

#include "base/result.h"
#include "gfx/handles.h"
#include "render/image.h"
#include "world/block_registry.h"

#include <string>
#include <vector>

namespace vitrail::render {

class TextureSet {
public:
    static constexpr u32 kSize = 32, kLevels = 6;
    // Errors: limit.
    Result<> load(const BlockRegistry& registry, bool smooth, float anisotropy);
    // Shows the frames that belong to this time; cheap when nothing changes.
    void animate(double seconds);
    const gfx::Texture& albedo() const { return albedo_; }
    const gfx::Texture& material() const { return material_; }
    const std::vector<std::string>& missing() const { return missing_; }
    void set_smooth(bool smooth, float anisotropy);
    u64 gpu_bytes() const;

private:
    struct Animation {
        u32 layer = 0, first_frame = 0, frames = 1, frame_time = 1, shown = ~0u;
    };
    gfx::Texture albedo_, material_, frames_albedo_, frames_material_;
    std::vector<Animation> animations_;
    std::vector<std::string> missing_;
};

// One layer with its mip levels, largest first; public for tests. Albedo is averaged in linear light, weighted by
// alpha, and the alpha of each level is scaled so that as much of it passes the 0.5 test as of level 0: leaves keep
// their density far away.
struct MipChain {
    std::vector<std::vector<u8>> levels; // RGBA, 32x32 down to 1x1
};
MipChain make_albedo_mips(const Image& rgba, u32 frame);
MipChain make_material_mips(const Image* normal, const Image* roughness, const Image* emission, u32 frame);

} // namespace vitrail::render
