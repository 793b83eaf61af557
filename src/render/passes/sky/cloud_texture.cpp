#include "render/passes/sky/cloud_texture.h"

#include "base/rng.h"

#include <algorithm>
#include <cmath>
#include <epoxy/gl.h>
#include <vector>

namespace vitrail::render {

namespace {

constexpr u32 kSide = 256;
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

} // namespace

gfx::Texture make_cloud_texture() {
    std::vector<u8> pixels(std::size_t(kSide) * kSide * 2);
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
    gfx::Texture texture = gfx::make_texture_2d(GL_RG8, kSide, kSide, 9);
    glTextureSubImage2D(texture.name(), 0, 0, 0, kSide, kSide, GL_RG, GL_UNSIGNED_BYTE, pixels.data());
    glGenerateTextureMipmap(texture.name());
    gfx::set_filter(texture, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
    return texture;
}

} // namespace vitrail::render
