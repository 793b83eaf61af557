#include "scene/tone_curve.h"

#include <cmath>

namespace vitrail::scene {

static float fitted(float v) {
    return (v * (v + 0.0245786f) - 0.000090537f) / (v * (0.983729f * v + 0.4329510f) + 0.238081f);
}

static float held(float x) {
    return x < 0 ? 0 : x > 1 ? 1 : x;
}

Vec3 filmic(Vec3 color) {
    const Vec3 c = color * 1.75f;
    const float r = fitted(0.59719f * c.x + 0.35458f * c.y + 0.04823f * c.z);
    const float g = fitted(0.07600f * c.x + 0.90834f * c.y + 0.01566f * c.z);
    const float b = fitted(0.02840f * c.x + 0.13383f * c.y + 0.83777f * c.z);
    return {held(1.60475f * r - 0.53108f * g - 0.07367f * b), held(-0.10208f * r + 1.10813f * g - 0.00605f * b),
            held(-0.00327f * r - 0.07276f * g + 1.07602f * b)};
}

float srgb_encode(float x) {
    return x <= 0.0031308f ? 12.92f * x : 1.055f * std::pow(x, 1 / 2.4f) - 0.055f;
}

} // namespace vitrail::scene
