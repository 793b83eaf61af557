#include "render/texture_set.h"

#include "base/log.h"
#include "scene/pack_looks.h"

#include <algorithm>
#include <array>
#include <bit>
#include <epoxy/gl.h>
#include <filesystem>
#include <fmt/format.h>

namespace vitrail::render {

namespace {

constexpr u32 kContentSize = TextureSet::kSize;
constexpr u32 kContentFramesMost = 64;
constexpr u64 kFrameBytesMost = u64(256) << 20; // of animations, in memory
constexpr float kTicksASecond = 20;

// A calm woven pattern in light gray: what is missing should not shout.
Image plain_pattern() {
    Image image{kContentSize, kContentSize, 4, std::vector<u8>(kContentSize * kContentSize * 4)};
    for (u32 y = 0; y < kContentSize; ++y)
        for (u32 x = 0; x < kContentSize; ++x) {
            const bool across = ((x / 4) + (y / 4)) % 2 == 0;
            const u32 ridge = across ? y % 4 : x % 4;
            const u8 v = u8(158 + (ridge == 0 ? -16 : ridge == 1 ? 8 : ridge == 2 ? 10 : -4) + (across ? 4 : 0));
            u8* p = image.at(x, y);
            p[0] = v, p[1] = u8(v - 2), p[2] = u8(v - 8), p[3] = 255;
        }
    return image;
}

Image read_quietly(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return {};
    Result<Image> image = read_png(path);
    return image ? std::move(*image) : Image{};
}

// Nothing is in `albedo` where it is not there.
scene::TextureArt read_texture(const BlockRegistry& registry, const std::string& name, u32 frame_time) {
    scene::TextureArt out;
    // Names come from content that a server may have sent: no way out of the folder.
    if (name.empty() || name.find("..") != std::string::npos || name[0] == '/') return out;
    for (const std::string& root : registry.content_roots) {
        const std::string stem = root + "/textures/" + name;
        out.albedo = read_quietly(stem + ".png");
        if (out.albedo.width == 0) continue;
        out.normal = read_quietly(stem + "_n.png");
        out.roughness = read_quietly(stem + "_r.png");
        out.emission = read_quietly(stem + "_e.png");
        if (const u32 count = std::min(frames_of(out.albedo), kContentFramesMost); count > 1)
            for (u32 f = 0; f < count; ++f)
                out.steps.push_back({u16(f), u16(std::clamp(frame_time, 1u, 65535u))});
        return out;
    }
    return out;
}

const Image* or_null(const Image& image) {
    return image.width ? &image : nullptr;
}

void upload(const gfx::Texture& texture, u32 layer, const MipChain& chain) {
    for (u32 level = 0; level < chain.levels.size(); ++level) {
        const GLsizei side = GLsizei(texture.width >> level);
        glTextureSubImage3D(texture.name(), GLint(level), 0, 0, GLint(layer), side, side, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                            chain.levels[level].data());
    }
}

u64 bytes_of(const MipChain& chain) {
    u64 sum = 0;
    for (const auto& level : chain.levels)
        sum += level.size();
    return sum;
}

void mix(const MipChain& a, const MipChain& b, u32 share_of_256, MipChain& out) {
    out.levels.resize(a.levels.size());
    for (std::size_t l = 0; l < a.levels.size(); ++l) {
        out.levels[l].resize(a.levels[l].size());
        for (std::size_t i = 0; i < a.levels[l].size(); ++i)
            out.levels[l][i] = u8((a.levels[l][i] * (256 - share_of_256) + b.levels[l][i] * share_of_256 + 128) >> 8);
    }
}

} // namespace

// Layers as large as the largest picture, within the memory that may be spent.
u32 TextureSet::choose_size(u32 layers, u32 largest, const TextureLimits& limits) {
    u32 size = std::bit_ceil(std::clamp(largest, kContentSize, std::max(limits.size_most, kContentSize)));
    while (size > kContentSize && u64(layers) * size * size * 4 * 4 / 3 * 2 > limits.bytes_most)
        size /= 2;
    return size;
}

Result<> TextureSet::load(const BlockRegistry& registry, const scene::PackLooks* packs, const TextureLimits& limits,
                          bool smooth, float anisotropy) {
    const auto& textures = registry.textures();
    const u32 layers = std::max<u32>({u32(textures.size()), packs ? packs->texture_count() : 0, 1});
    GLint most = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
    if (layers > u32(most))
        return fail(ErrorCode::limit, fmt::format("{} textures, this OpenGL holds {}", layers, most));
    size_ = choose_size(layers, packs ? packs->largest_side() : 0, limits);
    if (packs && std::bit_ceil(packs->largest_side()) > size_)
        log_info(fmt::format("pictures of packs have up to {0} x {0} texels: {1} x {1} of them are shown",
                             packs->largest_side(), size_));
    const u32 levels = u32(std::bit_width(size_));
    albedo_ = gfx::make_texture_2d_array(GL_RGBA8, size_, size_, layers, levels);
    material_ = gfx::make_texture_2d_array(GL_RGBA8, size_, size_, layers, levels);
    animations_.clear();
    break_animations_ = false;
    missing_.clear();
    u64 frame_bytes = 0;
    const Image plain = plain_pattern();
    const MipChain plain_albedo = make_albedo_mips(plain, 0, size_),
                   plain_material = make_material_mips(nullptr, nullptr, nullptr, 0, size_);
    for (u32 id = 0; id < layers; ++id) {
        const bool content = id > 0 && id < textures.size();
        const scene::TextureArt* art = packs ? packs->art(TextureId(id)) : nullptr;
        scene::TextureArt own;
        if (!art && content) own = read_texture(registry, textures[id].name, textures[id].frame_time);
        if (!art) art = &own;
        if (art->albedo.width == 0) {
            if (content) missing_.push_back(textures[id].name);
            upload(albedo_, id, plain_albedo);
            upload(material_, id, plain_material);
            continue;
        }
        const bool has_material = art->normal.width || art->roughness.width || art->emission.width;
        const auto albedo_of = [&](u32 frame) { return make_albedo_mips(art->albedo, frame, size_, art->tint_mask); };
        const auto material_of = [&](u32 frame) {
            return make_material_mips(or_null(art->normal), or_null(art->roughness), or_null(art->emission), frame,
                                      size_);
        };
        const u32 shown = art->steps.empty() ? 0 : art->steps[0].frame;
        upload(albedo_, id, albedo_of(shown));
        upload(material_, id, has_material ? material_of(shown) : plain_material);
        if (art->steps.size() < 2) continue;
        Animation a;
        a.layer = id, a.interpolate = art->interpolate;
        std::vector<u32> place(frames_of(art->albedo), ~0u); // of a frame in a.albedo
        for (const scene::TextureArt::Step& step : art->steps) {
            if (step.frame >= place.size()) continue;
            if (place[step.frame] == ~0u) {
                place[step.frame] = u32(a.albedo.size());
                a.albedo.push_back(albedo_of(step.frame));
                if (has_material) a.material.push_back(material_of(step.frame));
                frame_bytes += bytes_of(a.albedo.back()) * (has_material ? 2 : 1);
            }
            a.ticks += std::max<u32>(step.ticks, 1);
            a.steps.push_back({place[step.frame], a.ticks});
            if (frame_bytes > kFrameBytesMost) break;
        }
        if (frame_bytes > kFrameBytesMost) {
            log_info(fmt::format("animations take more than {} MiB: {} and those after it stand still",
                                 kFrameBytesMost >> 20, art->name));
            break_animations_ = true;
        }
        if (!break_animations_ && a.steps.size() > 1) animations_.push_back(std::move(a));
    }
    if (packs) missing_.insert(missing_.end(), packs->missing().begin(), packs->missing().end());
    set_smooth(smooth, anisotropy);
    return {};
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
    const u64 tick = u64(std::max(seconds, 0.0) * kTicksASecond);
    for (Animation& a : animations_) {
        const u32 now = u32(tick % a.ticks);
        const std::size_t step =
            std::size_t(std::upper_bound(a.steps.begin(), a.steps.end(), now,
                                         [](u32 t, const Animation::Step& s) { return t < s.end; }) -
                        a.steps.begin());
        const u64 key = a.interpolate ? now : step;
        if (key == a.shown) continue;
        a.shown = key;
        const u32 from = a.steps[step].frame;
        const auto show = [&](const gfx::Texture& texture, const std::vector<MipChain>& frames) {
            if (frames.empty()) return;
            const u32 to = a.steps[(step + 1) % a.steps.size()].frame;
            if (!a.interpolate || from == to) return upload(texture, a.layer, frames[from]);
            const u32 begin = step ? a.steps[step - 1].end : 0;
            mix(frames[from], frames[to], (now - begin) * 256 / (a.steps[step].end - begin), mixed_);
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
