// Colors as numbers: linear light of the sRGB primaries (Rec. 709). Kernel-safe.
#pragma once

#include "math/vec.h"

namespace vitrail {

// How bright an eye finds linear light: weights of Rec. ITU-R BT.709 (2015), 3.2. In the unit of the channels.
VX_HD constexpr float luminance_of(float r, float g, float b) {
    return 0.2126f * r + 0.7152f * g + 0.0722f * b;
}
VX_HD constexpr float luminance_of(Vec3 linear) {
    return luminance_of(linear.x, linear.y, linear.z);
}

} // namespace vitrail
