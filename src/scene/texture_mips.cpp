#include "scene/texture_mips.h"

#include "base/hash.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vitrail::scene {

u32 frames_of(const Image& image) {
    return image.height > image.width ? image.height / image.width : 1;
}

namespace {

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
std::array<u8, 4> texel(const Image& image, u32 frame, u32 x, u32 y, u32 size) {
    const u32 side = std::min(image.width, image.height);
    const u32 sx = x * image.width / size, sy = std::min(frame * side + y * side / size, image.height - 1);
    const u8* p = image.at(sx, sy);
    return {p[0], p[1], p[2], image.channels == 4 ? p[3] : u8(255)};
}

float coverage(const std::vector<u8>& level) {
    u32 passed = 0;
    for (std::size_t i = 3; i < level.size(); i += 4)
        passed += level[i] >= 128;
    return float(passed) / float(level.size() / 4);
}

} // namespace

MipChain make_albedo_mips(const Image& image, u32 frame, u32 size, bool mask) {
    struct Pixel {
        float r, g, b, a;
    };
    std::vector<Pixel> now(size * size);
    MipChain chain;
    std::vector<u8> first(size * size * 4);
    float sum[3] = {}, weight = 0;
    for (u32 y = 0; y < size; ++y)
        for (u32 x = 0; x < size; ++x) {
            const auto t = texel(image, frame, x, y, size);
            const Pixel p{linear_of(t[0]), linear_of(t[1]), linear_of(t[2]), mask ? 1 : float(t[3]) / 255};
            now[y * size + x] = p;
            sum[0] += p.r * p.a, sum[1] += p.g * p.a, sum[2] += p.b * p.a, weight += p.a;
            std::copy(t.begin(), t.end(), first.begin() + (y * size + x) * 4);
        }
    // Clear texels take the mean color, so that filtering draws no dark rims.
    if (weight > 0 && !mask) {
        const u8 mean[3] = {srgb_of(sum[0] / weight), srgb_of(sum[1] / weight), srgb_of(sum[2] / weight)};
        for (u32 i = 0; i < size * size; ++i)
            if (first[i * 4 + 3] == 0) {
                now[i] = {sum[0] / weight, sum[1] / weight, sum[2] / weight, 0};
                std::copy_n(mean, 3, &first[i * 4]);
            }
    }
    chain.levels.push_back(std::move(first));
    const float wanted = coverage(chain.levels[0]);
    const bool holes = wanted < 1 && wanted > 0 && !mask;
    for (u32 side = size / 2; side > 0; side /= 2) {
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
        if (mask) // a share like any other
            for (u32 y = 0; y < side; ++y)
                for (u32 x = 0; x < side; ++x) {
                    const std::vector<u8>& finer = chain.levels.back();
                    u32 total = 2;
                    for (u32 k = 0; k < 4; ++k)
                        total += finer[((y * 2 + k / 2) * side * 2 + x * 2 + k % 2) * 4 + 3];
                    bytes[(y * side + x) * 4 + 3] = u8(total / 4);
                }
        if (holes) {
            // As many texels pass the test as in level 0: those with most alpha, ties broken by a hash. (A scale for
            // all, as is usual, jumps where many texels have the same alpha, as in art with hard edges.)
            const u32 count = side * side, passing = u32(wanted * float(count) + 0.5f);
            std::vector<std::pair<u32, u32>> order(count);
            for (u32 i = 0; i < count; ++i)
                order[i] = {(255u - bytes[i * 4 + 3]) << 16 | (u32(mix64(i + 1)) & 0xffff), i};
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

MipChain make_material_mips(const Image* normal, const Image* roughness, const Image* emission, u32 frame, u32 size) {
    auto frame_in = [&](const Image& image) { return frame % frames_of(image); };
    std::vector<u8> now(size * size * 4);
    for (u32 y = 0; y < size; ++y)
        for (u32 x = 0; x < size; ++x) {
            u8* out = &now[(y * size + x) * 4];
            out[0] = out[1] = 128, out[2] = 230, out[3] = 0;
            if (normal) {
                const auto n = texel(*normal, frame_in(*normal), x, y, size);
                out[0] = n[0], out[1] = n[1];
            }
            if (roughness) out[2] = texel(*roughness, frame_in(*roughness), x, y, size)[0];
            if (emission) out[3] = texel(*emission, frame_in(*emission), x, y, size)[0];
        }
    MipChain chain;
    chain.levels.push_back(now);
    for (u32 side = size / 2; side > 0; side /= 2) {
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

} // namespace vitrail::scene
