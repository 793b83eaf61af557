// The block pictures of scene/block_pictures.h as two arrays of square layers. Layer = TextureId, so that shaders need
// no table. Albedo is decoded by the lighting pass.
//
// Frames of animations lie in memory and are written into their layer as time passes: a few kilobytes each, and the
// arrays keep their layers for what stands still.
#pragma once

#include "base/result.h"
#include "gfx/handles.h"
#include "scene/block_pictures.h"

#include <string>
#include <vector>

namespace vitrail::render {

using TextureLimits = scene::PictureLimits;

class TextureSet {
public:
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
    // Finer (below 0) or coarser levels than the size on the screen asks for.
    void set_level_bias(float levels);
    void set_smooth(bool smooth, float anisotropy);
    u64 gpu_bytes() const;

private:
    gfx::Texture albedo_, material_;
    std::vector<scene::PictureAnimation> animations_;
    std::vector<u64> shown_; // of each animation: Moment::key
    scene::MipChain mixed_;
    u32 size_ = scene::PictureFormat::kContentSize;
    std::vector<std::string> missing_;
};

} // namespace vitrail::render
