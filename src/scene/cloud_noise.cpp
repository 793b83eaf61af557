#include "scene/cloud_noise.h"

#include "base/rng.h"

#include <algorithm>
#include <cmath>

namespace vitrail::scene {

namespace {

constexpr u32 kSide = CloudNoise::kSide;
enum Purpose : u32 { gradient = 100, point_x = 200, point_y = 300 };

float at_lattice(u32 purpose, i32 x, i32 y) {
    return random_unit({.seed = 78, .purpose = purpose}, x, 0, y);
}

// Gradient noise (Perlin 1985) whose lattice wraps at `cells`; about -0.7..0.7.
float gradient_noise(float x, float y, i32 cells, u32 octave) {
    const i32 ix = i32(x), iy = i32(y);
    const float fx = x - float(ix), fy = y - float(iy);
    const auto corner = [&](i32 dx, i32 dy) {
        const float turn = 6.2831853f * at_lattice(gradient + octave, (ix + dx) % cells, (iy + dy) % cells);
        return std::cos(turn) * (fx - float(dx)) + std::sin(turn) * (fy - float(dy));
    };
    const auto ease = [](float t) { return t * t * t * (t * (t * 6 - 15) + 10); };
    const float sx = ease(fx), sy = ease(fy);
    const float a = corner(0, 0) + (corner(1, 0) - corner(0, 0)) * sx;
    const float b = corner(0, 1) + (corner(1, 1) - corner(0, 1)) * sx;
    return a + (b - a) * sy;
}

// 1 less the distance to the nearest of points strewn one a cell (Worley 1996), in cells: heaps.
float heaps(float x, float y, i32 cells, u32 octave) {
    const i32 ix = i32(x), iy = i32(y);
    float nearest = 4;
    for (i32 dy = -1; dy <= 1; ++dy)
        for (i32 dx = -1; dx <= 1; ++dx) {
            const i32 cx = (ix + dx + cells) % cells, cy = (iy + dy + cells) % cells;
            const float px = float(ix + dx) + at_lattice(point_x + octave, cx, cy) - x;
            const float py = float(iy + dy) + at_lattice(point_y + octave, cx, cy) - y;
            nearest = std::min(nearest, px * px + py * py);
        }
    return 1 - std::sqrt(nearest);
}

u8 byte_of(float v) {
    return u8(std::clamp(v * 255 + 0.5f, 0.0f, 255.0f));
}

std::vector<u8> make() {
    std::vector<u8> pixels(std::size_t(CloudNoise::kTexels) * 2);
    for (u32 y = 0; y < kSide; ++y)
        for (u32 x = 0; x < kSide; ++x) {
            float wide = 0, heap = 0, amount = 1;
            i32 cells = 6;
            for (u32 octave = 0; octave < 5; ++octave, cells *= 2, amount *= 0.5f) {
                const float scale = float(cells) / float(kSide);
                wide += gradient_noise(float(x) * scale, float(y) * scale, cells, octave) * amount;
                if (octave < 3) {
                    const float finer = float(cells * 2) / float(kSide);
                    heap += heaps(float(x) * finer, float(y) * finer, cells * 2, octave) * amount * (1 / 1.75f);
                }
            }
            u8* p = &pixels[(std::size_t(y) * kSide + x) * 2];
            p[0] = byte_of(0.5f + 0.62f * wide);
            p[1] = byte_of(heap);
        }
    for (u32 level = 1; level < CloudNoise::kLevels; ++level) {
        const u32 side = kSide >> level;
        const u8* from = &pixels[std::size_t(CloudNoise::level(level - 1)) * 2];
        u8* to = &pixels[std::size_t(CloudNoise::level(level)) * 2];
        for (u32 y = 0; y < side; ++y)
            for (u32 i = 0; i < side * 2; ++i) {
                const u32 x = i / 2 * 4 + i % 2, upper = y * 2 * side * 4, lower = upper + side * 4;
                to[y * side * 2 + i] =
                    u8((from[upper + x] + from[upper + x + 2] + from[lower + x] + from[lower + x + 2] + 2) / 4);
            }
    }
    return pixels;
}

} // namespace

const std::vector<u8>& cloud_noise() {
    static const std::vector<u8> made = make();
    return made;
}

} // namespace vitrail::scene
