#include "scene/block_pictures.h"

#include "base/log.h"
#include "scene/pack_looks.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <filesystem>
#include <fmt/format.h>

namespace vitrail::scene {

namespace {

constexpr u32 kContentSize = PictureFormat::kContentSize;
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
TextureArt read_texture(const BlockRegistry& registry, const std::string& name, u32 frame_time) {
    TextureArt out;
    // Names come from content that a server may have sent: no way out of the folder.
    if (name.empty() || name.find("..") != std::string::npos || name[0] == '/') return out;
    for (const std::string& root : registry.content_roots) {
        const std::string stem = root + "/textures/" + name;
        out.albedo = read_quietly(stem + ".png");
        if (out.albedo.width == 0) continue;
        out.normal = read_quietly(stem + "_n.png");
        // Content's maps have green up, as most tools paint them; resource packs' and ours in memory have it down.
        for (u32 i = 0; i < out.normal.width * out.normal.height; ++i) {
            u8& green = out.normal.pixels[std::size_t(i) * out.normal.channels + 1];
            green = u8(std::min(256 - green, 255));
        }
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

u64 bytes_of(const MipChain& chain) {
    u64 sum = 0;
    for (const auto& level : chain.levels)
        sum += level.size();
    return sum;
}

} // namespace

void mix_frames(const MipChain& a, const MipChain& b, u32 share_of_256, MipChain& out) {
    out.levels.resize(a.levels.size());
    for (std::size_t l = 0; l < a.levels.size(); ++l) {
        out.levels[l].resize(a.levels[l].size());
        for (std::size_t i = 0; i < a.levels[l].size(); ++i)
            out.levels[l][i] = u8((a.levels[l][i] * (256 - share_of_256) + b.levels[l][i] * share_of_256 + 128) >> 8);
    }
}

// Layers as large as the largest picture, within the memory that may be spent.
u32 choose_picture_size(u32 layers, u32 largest, const PictureLimits& limits) {
    u32 size = std::bit_ceil(std::clamp(largest, kContentSize, std::max(limits.size_most, kContentSize)));
    while (size > kContentSize && u64(layers) * size * size * 4 * 4 / 3 * 2 > limits.bytes_most)
        size /= 2;
    return size;
}

PictureFormat choose_picture_format(const BlockRegistry& registry, const PackLooks* packs,
                                    const PictureLimits& limits) {
    PictureFormat format;
    format.layers = std::max<u32>({u32(registry.textures().size()), packs ? packs->texture_count() : 0, 1});
    format.size = choose_picture_size(format.layers, packs ? packs->largest_side() : 0, limits);
    format.levels = u32(std::bit_width(format.size));
    return format;
}

PictureStock read_block_pictures(const BlockRegistry& registry, const PackLooks* packs, const PictureFormat& format,
                                 const PictureSink& sink) {
    const auto& textures = registry.textures();
    const u32 size = format.size;
    PictureStock out;
    if (packs && std::bit_ceil(packs->largest_side()) > size)
        log_info(fmt::format("pictures of packs have up to {0} x {0} texels: {1} x {1} of them are shown",
                             packs->largest_side(), size));
    u64 frame_bytes = 0;
    bool break_animations = false;
    const Image plain = plain_pattern();
    const MipChain plain_albedo = make_albedo_mips(plain, 0, size),
                   plain_material = make_material_mips(nullptr, nullptr, nullptr, 0, size);
    for (u32 id = 0; id < format.layers; ++id) {
        const bool content = id > 0 && id < textures.size();
        const TextureArt* art = packs ? packs->art(TextureId(id)) : nullptr;
        TextureArt own;
        if (!art && content) own = read_texture(registry, textures[id].name, textures[id].frame_time);
        if (!art) art = &own;
        if (art->albedo.width == 0) {
            if (content) out.missing.push_back(textures[id].name);
            sink(id, plain_albedo, plain_material);
            continue;
        }
        const bool has_material = art->normal.width || art->roughness.width || art->emission.width;
        const auto albedo_of = [&](u32 frame) { return make_albedo_mips(art->albedo, frame, size, art->tint_mask); };
        const auto material_of = [&](u32 frame) {
            return make_material_mips(or_null(art->normal), or_null(art->roughness), or_null(art->emission), frame,
                                      size);
        };
        const u32 shown = art->steps.empty() ? 0 : art->steps[0].frame;
        sink(id, albedo_of(shown), has_material ? material_of(shown) : plain_material);
        if (art->steps.size() < 2) continue;
        PictureAnimation a;
        a.layer = id, a.interpolate = art->interpolate;
        std::vector<u32> place(frames_of(art->albedo), ~0u); // of a frame in a.albedo
        for (const TextureArt::Step& step : art->steps) {
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
            break_animations = true;
        }
        if (!break_animations && a.steps.size() > 1) out.animations.push_back(std::move(a));
    }
    if (packs) out.missing.insert(out.missing.end(), packs->missing().begin(), packs->missing().end());
    return out;
}

PictureAnimation::Moment PictureAnimation::at(double seconds) const {
    const u32 now = u32(u64(std::max(seconds, 0.0) * kTicksASecond) % ticks);
    const std::size_t step =
        std::size_t(std::upper_bound(steps.begin(), steps.end(), now, [](u32 t, const Step& s) { return t < s.end; }) -
                    steps.begin());
    Moment m;
    m.key = interpolate ? now : step;
    m.from = m.to = steps[step].frame;
    if (!interpolate) return m;
    m.to = steps[(step + 1) % steps.size()].frame;
    const u32 begin = step ? steps[step - 1].end : 0;
    m.share = m.from == m.to ? 0 : (now - begin) * 256 / (steps[step].end - begin);
    return m;
}

BlockPictures BlockPictures::load(const BlockRegistry& registry, const PackLooks* packs, const PictureLimits& limits) {
    BlockPictures out;
    out.format = choose_picture_format(registry, packs, limits);
    for (u32 side = out.format.size; side > 0; side /= 2)
        out.layer_words += side * side;
    out.albedo.resize(std::size_t(out.format.layers) * out.layer_words);
    out.material.resize(out.albedo.size());
    const auto keep = [&](std::vector<u32>& to, u32 layer, const MipChain& chain) {
        copy_levels(chain, to.data() + std::size_t(layer) * out.layer_words);
    };
    PictureStock stock = read_block_pictures(registry, packs, out.format,
                                             [&](u32 layer, const MipChain& albedo, const MipChain& material) {
                                                 keep(out.albedo, layer, albedo);
                                                 keep(out.material, layer, material);
                                             });
    out.animations = std::move(stock.animations);
    out.missing = std::move(stock.missing);
    return out;
}

void copy_levels(const MipChain& chain, u32* to) {
    for (const std::vector<u8>& level : chain.levels) {
        std::memcpy(to, level.data(), level.size());
        to += level.size() / 4;
    }
}

} // namespace vitrail::scene
