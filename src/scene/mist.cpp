#include "scene/mist.h"

#include <cmath>

namespace vitrail::scene {

// 1 at `center` of the day, about gone `width` away from it.
static float hour(float time, float center, float width) {
    float away = std::abs(time - center);
    if (away > 12000) away = 24000 - away;
    const float x = away / width;
    return std::exp(-x * x);
}

Mist mist_at(const SkyState& sky) {
    const float dawn = hour(sky.time, 100, 1500), dusk = hour(sky.time, 12300, 1100);
    Mist mist;
    mist.haze = 0.0004f + 0.0014f * dawn + 0.0009f * dusk;
    mist.mist = 0.0012f + 0.022f * dawn + 0.009f * dusk + 0.003f * sky.stars;
    return mist;
}

} // namespace vitrail::scene
