#include "render/texture_set.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <fmt/format.h>

namespace vitrail::render {

namespace {

void upload(const gfx::Texture& texture, u32 layer, const scene::MipChain& chain) {
    for (u32 level = 0; level < chain.levels.size(); ++level) {
        const GLsizei side = GLsizei(texture.width >> level);
        glTextureSubImage3D(texture.name(), GLint(level), 0, 0, GLint(layer), side, side, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                            chain.levels[level].data());
    }
}

} // namespace

Result<> TextureSet::load(const BlockRegistry& registry, const scene::PackLooks* packs, const TextureLimits& limits,
                          bool smooth, float anisotropy) {
    const scene::PictureFormat format = scene::choose_picture_format(registry, packs, limits);
    GLint most = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
    if (format.layers > u32(most))
        return fail(ErrorCode::limit, fmt::format("{} textures, this OpenGL holds {}", format.layers, most));
    size_ = format.size;
    albedo_ = gfx::make_texture_2d_array(GL_RGBA8, size_, size_, format.layers, format.levels);
    material_ = gfx::make_texture_2d_array(GL_RGBA8, size_, size_, format.layers, format.levels);
    scene::PictureStock stock = scene::read_block_pictures(
        registry, packs, format, [&](u32 layer, const scene::MipChain& albedo, const scene::MipChain& material) {
            upload(albedo_, layer, albedo);
            upload(material_, layer, material);
        });
    animations_ = std::move(stock.animations);
    shown_.assign(animations_.size(), ~u64(0));
    missing_ = std::move(stock.missing);
    set_smooth(smooth, anisotropy);
    return {};
}

void TextureSet::set_level_bias(float levels) {
    for (const gfx::Texture* texture : {&albedo_, &material_})
        glTextureParameterf(texture->name(), GL_TEXTURE_LOD_BIAS, levels);
}

void TextureSet::set_smooth(bool smooth, float anisotropy) {
    for (const gfx::Texture* texture : {&albedo_, &material_}) {
        if (!*texture) continue;
        gfx::set_filter(*texture, smooth ? GL_NEAREST_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST, GL_NEAREST, GL_REPEAT);
        if (smooth && anisotropy > 1) {
            gfx::set_filter(*texture, GL_LINEAR_MIPMAP_LINEAR, GL_NEAREST, GL_REPEAT);
            glTextureParameterf(texture->name(), GL_TEXTURE_MAX_ANISOTROPY_EXT, std::min(anisotropy, 8.0f));
        } else if (anisotropy > 1) {
            glTextureParameterf(texture->name(), GL_TEXTURE_MAX_ANISOTROPY_EXT, 1);
        }
    }
}

void TextureSet::animate(double seconds) {
    for (std::size_t i = 0; i < animations_.size(); ++i) {
        const scene::PictureAnimation& a = animations_[i];
        const scene::PictureAnimation::Moment now = a.at(seconds);
        if (now.key == shown_[i]) continue;
        shown_[i] = now.key;
        const auto show = [&](const gfx::Texture& texture, const std::vector<scene::MipChain>& frames) {
            if (frames.empty()) return;
            if (now.from == now.to) return upload(texture, a.layer, frames[now.from]);
            scene::mix_frames(frames[now.from], frames[now.to], now.share, mixed_);
            upload(texture, a.layer, mixed_);
        };
        show(albedo_, a.albedo);
        show(material_, a.material);
    }
}

u64 TextureSet::gpu_bytes() const {
    return albedo_.bytes() + material_.bytes();
}

} // namespace vitrail::render
