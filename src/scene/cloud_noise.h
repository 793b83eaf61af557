// What clouds, the moon's seas and the milky way are made of, for raster and tracer alike: noise that repeats, two
// bytes a texel (0: wide shapes; 1: heaps, round above and sharp between), 256 texels a side, all levels down to one
// texel behind each other. Read as a GPU reads it: bilinear in a level, linear between levels. Kernel-safe.
#pragma once

#include "base/hd.h"
#include "math/vec.h"

#include <vector>

namespace vitrail::scene {

struct CloudNoise {
    static constexpr u32 kSide = 256, kLevels = 9;
    // First texel of a level.
    static VX_HD constexpr u32 level(u32 number) {
        return (kSide * kSide - (kSide >> number) * (kSide >> number)) * 4 / 3;
    }
    static constexpr u32 kTexels = (kSide * kSide * 4 - 1) / 3;
};

// Made at the first call (about 20 ms); 2 * CloudNoise::kTexels bytes.
const std::vector<u8>& cloud_noise();

// One channel in one level, 0..1. at: texture coordinates, any.
VX_HD float cloud_noise_in(const u8* noise, u32 channel, Vec2 at, u32 level) {
    const u32 side = CloudNoise::kSide >> level, mask = side - 1;
    const float x = at.x * float(side) - 0.5f, y = at.y * float(side) - 0.5f;
    const float ix = std::floor(x), iy = std::floor(y), fx = x - ix, fy = y - iy;
    const u32 x0 = u32(i32(ix)) & mask, x1 = (x0 + 1) & mask, y0 = u32(i32(iy)) & mask, y1 = (y0 + 1) & mask;
    const u8* p = noise + 2 * CloudNoise::level(level) + channel;
    const u8 *upper = p + 2 * y0 * side, *lower = p + 2 * y1 * side;
    return lerp(lerp(float(upper[2 * x0]), float(upper[2 * x1]), fx),
                lerp(float(lower[2 * x0]), float(lower[2 * x1]), fx), fy) *
           (1.0f / 255);
}
VX_HD float cloud_noise_at(const u8* noise, u32 channel, Vec2 at, float level) {
    const float l = clamp(level, 0.0f, float(CloudNoise::kLevels - 1));
    const u32 fine = u32(l);
    const float between = l - float(fine), a = cloud_noise_in(noise, channel, at, fine);
    return between > 0 ? lerp(a, cloud_noise_in(noise, channel, at, fine + 1), between) : a;
}

} // namespace vitrail::scene
