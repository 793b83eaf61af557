#include "scene/water.h"

#include <algorithm>

namespace vitrail::scene {

LiquidOptics water_optics(Vec3 tint) {
    const auto absorbed = [](float srgb) {
        const float c = std::clamp(srgb, 0.0f, 1.0f);
        const float linear = c * (c * (c * 0.305306011f + 0.682171111f) + 0.012522878f);
        return -0.085f * std::log(std::max(linear, 0.012f));
    };
    // However blue a tint: what takes green takes some blue too, else deep water would be violet.
    const float green = absorbed(tint.y);
    return {Vec3{absorbed(tint.x), green, std::max(absorbed(tint.z), 0.35f * green)} + Vec3{0.030f, 0.030f, 0.025f},
            {0.030f, 0.034f, 0.038f}};
}

} // namespace vitrail::scene
