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
    i32 ix = i32(x), iy = i32(y); // down to whole numbers, without a call of floor
    ix -= float(ix) > x, iy -= float(iy) > y;
    const float fx = x - float(ix), fy = y - float(iy);
    const u32 x0 = u32(ix) & mask, x1 = (x0 + 1) & mask, y0 = u32(iy) & mask, y1 = (y0 + 1) & mask;
    const u8* p = noise + 2 * CloudNoise::level(level) + channel;
    const u32 upper = y0 * side, lower = y1 * side;
    const float a = float(i32(p[2 * (upper + x0)])), b = float(i32(p[2 * (upper + x1)])),
                c = float(i32(p[2 * (lower + x0)])), d = float(i32(p[2 * (lower + x1)]));
    return lerp(lerp(a, b, fx), lerp(c, d, fx), fy) * (1.0f / 255);
}
VX_HD float cloud_noise_at(const u8* noise, u32 channel, Vec2 at, float level) {
    const float l = clamp(level, 0.0f, float(CloudNoise::kLevels - 1));
    const u32 fine = u32(l);
    const float between = l - float(fine), a = cloud_noise_in(noise, channel, at, fine);
    return between > 0 ? lerp(a, cloud_noise_in(noise, channel, at, fine + 1), between) : a;
}

} // namespace vitrail::scene
