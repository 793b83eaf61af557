// Gradient noise on an integer lattice (after Perlin 2002), kernel-safe. Positions are fixed point, 1/256 block in 64
// bits, and periods powers of two: cell and fraction come from shifts, so that no detail is lost at any distance from
// the origin.
#pragma once

#include "base/hash.h"
#include "base/hd.h"
#include "base/types.h"

namespace vitrail {

inline constexpr i32 kNoiseFraction = 8; // bits of a block's fraction

// A noise of its own: the seed mixed with one constant for each use.
struct NoiseKey {
    u32 hash = 0;
    i64 shift_x = 0, shift_y = 0, shift_z = 0; // so that lattices of several noises do not meet in the same points
};

VX_HD constexpr NoiseKey noise_key(u64 seed, u32 purpose) {
    const u64 a = hash_combine(seed, purpose), b = mix64(a + 1), c = mix64(b + 2);
    return {u32(a), i64(a >> 36), i64(b >> 36), i64(c >> 36)};
}

// Mixes lattice coordinates; they wrap at 2^32, which no world reaches at periods of 4 blocks and more.
VX_HD constexpr u32 lattice_hash(u32 key, u32 x, u32 y, u32 z) {
    u32 h = key ^ x * 0x9e3779b1u;
    h = (h ^ h >> 15) + y * 0x85ebca77u;
    h = (h ^ h >> 13) * 0xc2b2ae3du + z * 0x27d4eb2fu;
    h = (h ^ h >> 15) * 0x2c1b3c6du;
    h = (h ^ h >> 12) * 0x297a2d39u;
    return h ^ h >> 15;
}

VX_HD constexpr float noise_fade(float t) {
    return t * t * t * (t * (t * 6.0f - 15.0f) + 10.0f);
}
VX_HD constexpr float noise_mix(float a, float b, float t) {
    return a + (b - a) * t;
}

VX_HD constexpr float gradient2(u32 h, float x, float z) {
    const float gx = float(i32(h & 0xffff) - 32768), gz = float(i32(h >> 16) - 32768);
    return (gx * x + gz * z) * (1.0f / 32768.0f);
}
VX_HD constexpr float gradient3(u32 h, float x, float y, float z) {
    const float gx = float(i32(h & 1023) - 512), gy = float(i32(h >> 10 & 1023) - 512),
                gz = float(i32(h >> 20 & 1023) - 512);
    return (gx * x + gy * y + gz * z) * (1.0f / 512.0f);
}

// Noise with cells of 2^log2_period blocks at a fixed-point position; standard deviation about 0.45, rarely beyond
// -1.2..1.2.
VX_HD constexpr float noise2(const NoiseKey& key, i64 x, i64 z, i32 log2_period) {
    const i32 bits = log2_period + kNoiseFraction;
    x += key.shift_x;
    z += key.shift_z;
    const u32 cx = u32(x >> bits), cz = u32(z >> bits), octave = u32(log2_period);
    const i64 mask = (i64(1) << bits) - 1;
    const float scale = 1.0f / float(i64(1) << bits);
    const float fx = float(x & mask) * scale, fz = float(z & mask) * scale;
    const float u = noise_fade(fx), v = noise_fade(fz);
    const float a = gradient2(lattice_hash(key.hash, cx, octave, cz), fx, fz);
    const float b = gradient2(lattice_hash(key.hash, cx + 1, octave, cz), fx - 1.0f, fz);
    const float c = gradient2(lattice_hash(key.hash, cx, octave, cz + 1), fx, fz - 1.0f);
    const float d = gradient2(lattice_hash(key.hash, cx + 1, octave, cz + 1), fx - 1.0f, fz - 1.0f);
    return noise_mix(noise_mix(a, b, u), noise_mix(c, d, u), v) * 1.75f;
}

VX_HD constexpr float noise3(const NoiseKey& key, i64 x, i64 y, i64 z, i32 log2_period) {
    const i32 bits = log2_period + kNoiseFraction;
    x += key.shift_x;
    y += key.shift_y;
    z += key.shift_z;
    const u32 cx = u32(x >> bits), cy = u32(y >> bits), cz = u32(z >> bits);
    const i64 mask = (i64(1) << bits) - 1;
    const float scale = 1.0f / float(i64(1) << bits);
    const float fx = float(x & mask) * scale, fy = float(y & mask) * scale, fz = float(z & mask) * scale;
    const float u = noise_fade(fx), v = noise_fade(fy), w = noise_fade(fz);
    float corner[8] = {};
    for (u32 i = 0; i < 8; ++i) {
        const u32 dx = i & 1, dy = i >> 1 & 1, dz = i >> 2;
        corner[i] = gradient3(lattice_hash(key.hash, cx + dx, cy + dy, cz + dz), fx - float(dx), fy - float(dy),
                              fz - float(dz));
    }
    const float low = noise_mix(noise_mix(corner[0], corner[1], u), noise_mix(corner[2], corner[3], u), v);
    const float high = noise_mix(noise_mix(corner[4], corner[5], u), noise_mix(corner[6], corner[7], u), v);
    return noise_mix(low, high, w) * 1.75f;
}

// Octaves of halving period and amplitude; same scale as one octave.
VX_HD constexpr float fractal2(const NoiseKey& key, i64 x, i64 z, i32 log2_period, i32 octaves) {
    float sum = 0, amplitude = 1, total = 0;
    for (i32 o = 0; o < octaves; ++o) {
        sum += noise2(key, x, z, log2_period - o) * amplitude;
        total += amplitude * amplitude;
        amplitude *= 0.5f;
    }
    // octaves are independent: deviations add in squares; one step of Newton from 1.15 is within 0.1 % of the root of
    // total
    const float root = 0.5f * (1.15f + total / 1.15f);
    return sum / root;
}

} // namespace vitrail
