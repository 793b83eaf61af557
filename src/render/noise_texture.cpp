#include "render/noise_texture.h"

#include "base/rng.h"

#include <algorithm>
#include <epoxy/gl.h>
#include <vector>

namespace vitrail::render {

// Value noise whose lattice wraps at `cells`.
static float wrapped_noise(float x, float y, i32 cells, u32 octave) {
    const i32 ix = i32(x), iy = i32(y);
    const float fx = x - float(ix), fy = y - float(iy);
    const float sx = fx * fx * fx * (fx * (fx * 6 - 15) + 10), sy = fy * fy * fy * (fy * (fy * 6 - 15) + 10);
    auto at = [&](i32 dx, i32 dy) {
        return random_unit({.seed = 77, .purpose = octave}, (ix + dx) % cells, 0, (iy + dy) % cells);
    };
    const float a = at(0, 0) + (at(1, 0) - at(0, 0)) * sx, b = at(0, 1) + (at(1, 1) - at(0, 1)) * sx;
    return a + (b - a) * sy;
}

gfx::Texture make_noise_texture() {
    constexpr u32 kSide = 256;
    std::vector<u8> pixels(kSide * kSide);
    for (u32 y = 0; y < kSide; ++y)
        for (u32 x = 0; x < kSide; ++x) {
            float sum = 0, weight = 0;
            i32 cells = 8;
            float amount = 1;
            for (u32 octave = 0; octave < 5; ++octave, cells *= 2, amount *= 0.5f) {
                const float scale = float(cells) / float(kSide);
                sum += wrapped_noise(float(x) * scale, float(y) * scale, cells, octave) * amount;
                weight += amount;
            }
            const float v = (sum / weight - 0.5f) * 1.5f + 0.5f; // value noise crowds around its middle
            pixels[y * kSide + x] = u8(std::clamp(v * 255 + 0.5f, 0.0f, 255.0f));
        }
    gfx::Texture texture = gfx::make_texture_2d(GL_R8, kSide, kSide, 9);
    glTextureSubImage2D(texture.name(), 0, 0, 0, kSide, kSide, GL_RED, GL_UNSIGNED_BYTE, pixels.data());
    glGenerateTextureMipmap(texture.name());
    gfx::set_filter(texture, GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
    return texture;
}

} // namespace vitrail::render
