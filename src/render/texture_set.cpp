#include "render/texture_set.h"

#include "base/hash.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <epoxy/gl.h>
#include <filesystem>
#include <fmt/format.h>

namespace vitrail::render {

namespace {

constexpr u32 kSize = TextureSet::kSize, kLevels = TextureSet::kLevels;

float linear_of(u8 v) {
    static const std::array<float, 256> table = [] {
        std::array<float, 256> t{};
        for (int i = 0; i < 256; ++i) {
            const float c = float(i) / 255;
            t[std::size_t(i)] = c <= 0.04045f ? c / 12.92f : std::pow((c + 0.055f) / 1.055f, 2.4f);
        }
        return t;
    }();
    return table[v];
}

u8 srgb_of(float v) {
    const float c = v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
    return u8(std::clamp(c * 255 + 0.5f, 0.0f, 255.0f));
}

// A frame of a strip: width x width pixels, stretched to a layer by nearest pixels.
std::array<u8, 4> texel(const Image& image, u32 frame, u32 x, u32 y) {
    const u32 side = std::min(image.width, image.height);
    const u32 sx = x * image.width / kSize, sy = std::min(frame * side + y * side / kSize, image.height - 1);
    const u8* p = image.at(sx, sy);
    return {p[0], p[1], p[2], image.channels == 4 ? p[3] : u8(255)};
}

u32 frames_of(const Image& image) {
    return image.height > image.width ? image.height / image.width : 1;
}

float coverage(const std::vector<u8>& level) {
    u32 passed = 0;
    for (std::size_t i = 3; i < level.size(); i += 4)
        passed += level[i] >= 128;
    return float(passed) / float(level.size() / 4);
}

// A calm woven pattern in light gray: what is missing should not shout.
Image plain_pattern() {
    Image image{kSize, kSize, 4, std::vector<u8>(kSize * kSize * 4)};
    for (u32 y = 0; y < kSize; ++y)
        for (u32 x = 0; x < kSize; ++x) {
            const bool across = ((x / 4) + (y / 4)) % 2 == 0;
            const u32 ridge = across ? y % 4 : x % 4;
            const u8 v = u8(158 + (ridge == 0 ? -16 : ridge == 1 ? 8 : ridge == 2 ? 10 : -4) + (across ? 4 : 0));
            u8* p = image.at(x, y);
            p[0] = v, p[1] = u8(v - 2), p[2] = u8(v - 8), p[3] = 255;
        }
    return image;
}

struct Loaded {
    Image albedo;
    Image normal, roughness, emission; // empty where there is none
    bool found = false;
};

Image read_quietly(const std::string& path) {
    std::error_code error;
    if (!std::filesystem::exists(path, error)) return {};
    Result<Image> image = read_png(path);
    return image ? std::move(*image) : Image{};
}

Loaded read_texture(const BlockRegistry& registry, const std::string& name) {
    Loaded out;
    // Names come from content that a server may have sent: no way out of the folder.
    if (name.empty() || name.find("..") != std::string::npos || name[0] == '/') return out;
    for (const std::string& root : registry.content_roots) {
        const std::string stem = root + "/textures/" + name;
        out.albedo = read_quietly(stem + ".png");
        if (out.albedo.width == 0) continue;
        out.found = true;
        out.normal = read_quietly(stem + "_n.png");
        out.roughness = read_quietly(stem + "_r.png");
        out.emission = read_quietly(stem + "_e.png");
        return out;
    }
    return out;
}

const Image* or_null(const Image& image) {
    return image.width ? &image : nullptr;
}

void upload(const gfx::Texture& texture, u32 layer, const MipChain& chain) {
    for (u32 level = 0; level < kLevels; ++level) {
        const GLsizei side = GLsizei(kSize >> level);
        glTextureSubImage3D(texture.name(), GLint(level), 0, 0, GLint(layer), side, side, 1, GL_RGBA, GL_UNSIGNED_BYTE,
                            chain.levels[level].data());
    }
}

} // namespace

MipChain make_albedo_mips(const Image& image, u32 frame) {
    struct Pixel {
        float r, g, b, a;
    };
    std::vector<Pixel> now(kSize * kSize);
    MipChain chain;
    std::vector<u8> first(kSize * kSize * 4);
    float sum[3] = {}, weight = 0;
    for (u32 y = 0; y < kSize; ++y)
        for (u32 x = 0; x < kSize; ++x) {
            const auto t = texel(image, frame, x, y);
            const Pixel p{linear_of(t[0]), linear_of(t[1]), linear_of(t[2]), float(t[3]) / 255};
            now[y * kSize + x] = p;
            sum[0] += p.r * p.a, sum[1] += p.g * p.a, sum[2] += p.b * p.a, weight += p.a;
            std::copy(t.begin(), t.end(), first.begin() + (y * kSize + x) * 4);
        }
    // Clear texels take the mean color, so that filtering draws no dark rims.
    if (weight > 0)
        for (u32 i = 0; i < kSize * kSize; ++i)
            if (first[i * 4 + 3] == 0) {
                now[i] = {sum[0] / weight, sum[1] / weight, sum[2] / weight, 0};
                for (u32 c = 0; c < 3; ++c)
                    first[i * 4 + c] = srgb_of(sum[c] / weight);
            }
    chain.levels.push_back(std::move(first));
    const float wanted = coverage(chain.levels[0]);
    const bool holes = wanted < 1 && wanted > 0;
    for (u32 level = 1, side = kSize / 2; level < kLevels; ++level, side /= 2) {
        std::vector<Pixel> next(side * side);
        std::vector<u8> bytes(side * side * 4);
        for (u32 y = 0; y < side; ++y)
            for (u32 x = 0; x < side; ++x) {
                Pixel p{0, 0, 0, 0};
                float plain[3] = {};
                for (u32 k = 0; k < 4; ++k) {
                    const Pixel& q = now[(y * 2 + k / 2) * side * 2 + x * 2 + k % 2];
                    p.r += q.r * q.a, p.g += q.g * q.a, p.b += q.b * q.a, p.a += q.a;
                    plain[0] += q.r / 4, plain[1] += q.g / 4, plain[2] += q.b / 4;
                }
                if (p.a > 0)
                    p = {p.r / p.a, p.g / p.a, p.b / p.a, p.a / 4};
                else
                    p = {plain[0], plain[1], plain[2], 0};
                next[y * side + x] = p;
                u8* out = &bytes[(y * side + x) * 4];
                out[0] = srgb_of(p.r), out[1] = srgb_of(p.g), out[2] = srgb_of(p.b), out[3] = u8(p.a * 255 + 0.5f);
            }
        if (holes) {
            // As many texels pass the test as in level 0: those with most alpha, ties broken by a hash. (A scale for all, as is
            // usual, jumps where many texels have the same alpha, as in art with hard edges.)
            const u32 count = side * side, passing = u32(wanted * float(count) + 0.5f);
            std::vector<std::pair<u32, u32>> order(count);
            for (u32 i = 0; i < count; ++i) order[i] = {(255u - bytes[i * 4 + 3]) << 16 | (u32(mix64(i + 1)) & 0xffff), i};
            std::sort(order.begin(), order.end());
            for (u32 k = 0; k < count; ++k) {
                u8& alpha = bytes[order[k].second * 4 + 3];
                alpha = k < passing ? std::max<u8>(alpha, 160) : std::min<u8>(alpha, 95);
            }
        }
        now = std::move(next);
        chain.levels.push_back(std::move(bytes));
    }
    return chain;
}

MipChain make_material_mips(const Image* normal, const Image* roughness, const Image* emission, u32 frame) {
    auto frame_in = [&](const Image& image) { return frame % frames_of(image); };
    std::vector<u8> now(kSize * kSize * 4);
    for (u32 y = 0; y < kSize; ++y)
        for (u32 x = 0; x < kSize; ++x) {
            u8* out = &now[(y * kSize + x) * 4];
            out[0] = out[1] = 128, out[2] = 230, out[3] = 0;
            if (normal) {
                const auto n = texel(*normal, frame_in(*normal), x, y);
                out[0] = n[0], out[1] = n[1];
            }
            if (roughness) out[2] = texel(*roughness, frame_in(*roughness), x, y)[0];
            if (emission) out[3] = texel(*emission, frame_in(*emission), x, y)[0];
        }
    MipChain chain;
    chain.levels.push_back(now);
    for (u32 level = 1, side = kSize / 2; level < kLevels; ++level, side /= 2) {
        std::vector<u8> next(side * side * 4);
        for (u32 y = 0; y < side; ++y)
            for (u32 x = 0; x < side; ++x)
                for (u32 c = 0; c < 4; ++c) {
                    u32 sum = 2;
                    for (u32 k = 0; k < 4; ++k)
                        sum += now[((y * 2 + k / 2) * side * 2 + x * 2 + k % 2) * 4 + c];
                    next[(y * side + x) * 4 + c] = u8(sum / 4);
                }
        chain.levels.push_back(next);
        now = std::move(next);
    }
    return chain;
}

Result<> TextureSet::load(const BlockRegistry& registry, bool smooth, float anisotropy) {
    const auto& textures = registry.textures();
    const u32 layers = std::max<u32>(u32(textures.size()), 1);
    GLint most = 0;
    glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &most);
    if (layers > u32(most))
        return fail(ErrorCode::limit, fmt::format("{} textures, this OpenGL holds {}", layers, most));
    albedo_ = gfx::make_texture_2d_array(GL_RGBA8, kSize, kSize, layers, kLevels);
    material_ = gfx::make_texture_2d_array(GL_RGBA8, kSize, kSize, layers, kLevels);
    animations_.clear();
    missing_.clear();
    const Image plain = plain_pattern();
    const MipChain plain_albedo = make_albedo_mips(plain, 0),
                   plain_material = make_material_mips(nullptr, nullptr, nullptr, 0);
    std::vector<std::pair<MipChain, MipChain>> frames;
    for (u32 id = 0; id < layers; ++id) {
        const bool unknown = id == 0 || id >= textures.size();
        const Loaded loaded = unknown ? Loaded{} : read_texture(registry, textures[id].name);
        if (!loaded.found) {
            if (!unknown) missing_.push_back(textures[id].name);
            upload(albedo_, id, plain_albedo);
            upload(material_, id, plain_material);
            continue;
        }
        const bool has_material = loaded.normal.width || loaded.roughness.width || loaded.emission.width;
        auto material_of = [&](u32 frame) {
            return has_material ? make_material_mips(or_null(loaded.normal), or_null(loaded.roughness),
                                                     or_null(loaded.emission), frame)
                                : plain_material;
        };
        const MipChain first = make_albedo_mips(loaded.albedo, 0);
        const MipChain first_material = material_of(0);
        upload(albedo_, id, first);
        upload(material_, id, first_material);
        const u32 count = std::min(frames_of(loaded.albedo), 64u);
        if (count <= 1) continue;
        animations_.push_back({id, u32(frames.size()), count, std::max(textures[id].frame_time, 1u), 0});
        frames.emplace_back(first, first_material);
        for (u32 f = 1; f < count; ++f)
            frames.emplace_back(make_albedo_mips(loaded.albedo, f), material_of(f));
    }
    if (!frames.empty()) {
        if (frames.size() > u32(most))
            return fail(ErrorCode::limit,
                        fmt::format("{} animation frames, this OpenGL holds {}", frames.size(), most));
        frames_albedo_ = gfx::make_texture_2d_array(GL_RGBA8, kSize, kSize, u32(frames.size()), kLevels);
        frames_material_ = gfx::make_texture_2d_array(GL_RGBA8, kSize, kSize, u32(frames.size()), kLevels);
        for (u32 i = 0; i < frames.size(); ++i) {
            upload(frames_albedo_, i, frames[i].first);
            upload(frames_material_, i, frames[i].second);
        }
    }
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
    const u64 tick = u64(std::max(seconds, 0.0) * 20);
    for (Animation& a : animations_) {
        const u32 frame = u32(tick / a.frame_time % a.frames);
        if (frame == a.shown) continue;
        a.shown = frame;
        for (u32 level = 0; level < kLevels; ++level) {
            const GLsizei side = GLsizei(kSize >> level);
            const GLint from = GLint(a.first_frame + frame), to = GLint(a.layer), at = GLint(level);
            glCopyImageSubData(frames_albedo_.name(), GL_TEXTURE_2D_ARRAY, at, 0, 0, from, albedo_.name(),
                               GL_TEXTURE_2D_ARRAY, at, 0, 0, to, side, side, 1);
            glCopyImageSubData(frames_material_.name(), GL_TEXTURE_2D_ARRAY, at, 0, 0, from, material_.name(),
                               GL_TEXTURE_2D_ARRAY, at, 0, 0, to, side, side, 1);
        }
    }
}

u64 TextureSet::gpu_bytes() const {
    return albedo_.bytes() + material_.bytes() + frames_albedo_.bytes() + frames_material_.bytes();
}

} // namespace vitrail::render
