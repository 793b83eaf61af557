#include "trace/content/texture_store.h"

#include <algorithm>

namespace vitrail::trace {

void TextureStore::load(const scene::BlockPictures& pictures) {
    format_ = pictures.format;
    layer_words_ = pictures.layer_words;
    albedo_ = pictures.albedo;
    material_ = pictures.material;
    animations_ = pictures.animations;
    shown_.assign(animations_.size(), ~u64(0));
    painted_.assign(format_.layers, 0);
    derived_.assign(format_.layers, 0);
    hues_.assign(format_.layers, Vec3{});
    const u32 texels = format_.size * format_.size;
    for (u32 layer = 0; layer < format_.layers; ++layer) {
        const u32* first = material_.data() + std::size_t(layer) * layer_words_;
        painted_[layer] = std::any_of(first, first + texels, [](u32 t) { return t >> 24; });
    }
    for (const scene::PictureAnimation& a : animations_)
        for (const scene::MipChain& frame : a.material)
            for (std::size_t i = 3; i < frame.levels[0].size(); i += 4)
                painted_[a.layer] |= frame.levels[0][i] > 0;
}

bool TextureStore::painted_emission(u32 layer) const {
    return layer < painted_.size() && painted_[layer];
}

bool TextureStore::animated(u32 layer) const {
    return std::any_of(animations_.begin(), animations_.end(),
                       [&](const scene::PictureAnimation& a) { return a.layer == layer; });
}

void TextureStore::derive_emission(u32 layer, Vec3 hue) {
    if (layer >= derived_.size() || painted_[layer] || derived_[layer]) return;
    derived_[layer] = 1;
    hues_[layer] = normalized(hue);
    brighten(layer);
}

void TextureStore::brighten(u32 layer) {
    const u32* albedo = albedo_.data() + std::size_t(layer) * layer_words_;
    u32* material = material_.data() + std::size_t(layer) * layer_words_;
    // Light of the lamp's color: gray stone around a red gem counts little.
    const auto strength = [&](u32 texel) {
        const Vec3 c = linear_from_srgb(color_of(texel));
        const float along = dot(c, hues_[layer]), all = length(c);
        const float alike = all > 0 ? along / all : 0;
        return is_hole(texel) ? 0 : along * alike * alike * alike * alike;
    };
    float most = 0;
    for (u32 i = 0; i < format_.size * format_.size; ++i)
        most = std::max(most, strength(albedo[i]));
    if (most <= 0) return;
    for (u32 i = 0; i < layer_words_; ++i) {
        // As the eye compares, which is nearer to a cube root than to light.
        const float share = smoothstep(0.65f, 0.90f, std::cbrt(strength(albedo[i]) / most));
        material[i] = (material[i] & 0xffffff) | u32(share * 255 + 0.5f) << 24;
    }
}

PictureMean TextureStore::mean(u32 layer) const {
    if (layer >= format_.layers) return {};
    const u32* texel = albedo_.data() + std::size_t(layer) * layer_words_;
    const u32 texels = format_.size * format_.size;
    Vec3 sum;
    float alpha = 0;
    for (u32 i = 0; i < texels; ++i) {
        sum += linear_from_srgb(color_of(texel[i])) * alpha_of(texel[i]);
        alpha += alpha_of(texel[i]);
    }
    if (alpha <= 0) return {{1, 1, 1}, 0};
    return {sum * (1 / alpha), alpha / float(texels)};
}

void TextureStore::animate(double seconds, std::vector<u32>& changed) {
    for (std::size_t i = 0; i < animations_.size(); ++i) {
        const scene::PictureAnimation& a = animations_[i];
        const scene::PictureAnimation::Moment now = a.at(seconds);
        if (now.key == shown_[i]) continue;
        shown_[i] = now.key;
        const auto show = [&](std::vector<u32>& to, const std::vector<scene::MipChain>& frames) {
            if (frames.empty()) return;
            u32* words = to.data() + std::size_t(a.layer) * layer_words_;
            if (now.from == now.to) return scene::copy_levels(frames[now.from], words);
            scene::mix_frames(frames[now.from], frames[now.to], now.share, mixed_);
            scene::copy_levels(mixed_, words);
        };
        show(albedo_, a.albedo);
        show(material_, a.material);
        if (derived_[a.layer]) brighten(a.layer);
        changed.push_back(a.layer);
    }
}

TextureView TextureStore::view() const {
    TextureView v;
    v.albedo = albedo_.data();
    v.material = material_.data();
    v.size_bits = format_.levels - 1;
    v.levels = format_.levels;
    v.layers = format_.layers;
    v.layer_words = layer_words_;
    return v;
}

} // namespace vitrail::trace
