#include "scene/water.h"

#include <algorithm>

namespace vitrail::scene {

WaveSurface wave_at(BlockPos place, Vec2 inside, float seconds, float wave_height) {
    constexpr float kTurn = 6.2831853f, kPer = 1.0f / float(kWavePeriod);
    const float x = float(place.x & (kWavePeriod - 1)) + inside.x, z = float(place.z & (kWavePeriod - 1)) + inside.y;
    const float t = std::fmod(seconds, float(kWavePeriod));
    WaveSurface out;
    for (u32 i = 0; i < kSwells + kRipples; ++i) {
        const Wave& w = kWaves[i];
        float turns = (float(w.x) * x + float(w.z) * z - float(w.t) * t) * kPer;
        turns -= std::floor(turns);
        const float height = i < kSwells ? w.height * wave_height : w.height * (wave_height / 0.06f);
        (i < kSwells ? out.swell : out.ripple) += height * std::sin(turns * kTurn);
        const float steep = height * kTurn * kPer * std::cos(turns * kTurn);
        out.slope.x += steep * float(w.x), out.slope.y += steep * float(w.z);
    }
    return out;
}

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
