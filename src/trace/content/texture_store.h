// The block pictures as kernels read them (TextureView), with what tracing adds: emission of lamps that have no
// emission picture, and the frames of animations.
#pragma once

#include "scene/block_pictures.h"
#include "trace/content/optics.h"
#include "trace/kernel/texture.h"

#include <vector>

namespace vitrail::trace {

class TextureStore {
public:
    void load(const scene::BlockPictures& pictures);

    bool painted_emission(u32 layer) const; // of the picture's own
    bool animated(u32 layer) const;
    // Where there is none, texels that are bright in a lamp's hue are taken to shine. The first hue stays.
    void derive_emission(u32 layer, Vec3 hue);
    PictureMean mean(u32 layer) const; // all clear: white, alpha 0

    // Shows what belongs to a time; appends layers whose texels changed.
    void animate(double seconds, std::vector<u32>& changed);

    // Pointers are valid until the next load.
    TextureView view() const;
    const std::vector<u32>& albedo() const { return albedo_; }
    const std::vector<u32>& material() const { return material_; }

private:
    void brighten(u32 layer);
    scene::PictureFormat format_;
    u32 layer_words_ = 0;
    std::vector<u32> albedo_, material_;
    std::vector<scene::PictureAnimation> animations_;
    std::vector<u64> shown_;  // of each animation: Moment::key
    std::vector<u8> painted_; // by layer: its picture has emission, in some frame
    std::vector<Vec3> hues_;  // of derived ones
    std::vector<u8> derived_; // by layer
    scene::MipChain mixed_;
};

} // namespace vitrail::trace
