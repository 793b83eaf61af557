// How much light a border between two media, or a metal, mirrors. Kernel-safe.
#pragma once

#include "base/hd.h"
#include "math/vec.h"

namespace vitrail::trace {

// Unpolarized light at a smooth border (Fresnel's equations). cosine: of the angle to the normal on the light's side,
// 0..1; ior: index behind the border over the index before it. 1 at total reflection. `behind`: cosine of the refracted
// ray, 0 at total reflection.
VX_HD float fresnel_dielectric(float cosine, float ior, float& behind) {
    const float sine2 = (1 - cosine * cosine) / (ior * ior);
    behind = 0;
    if (sine2 >= 1) return 1;
    behind = std::sqrt(1 - sine2);
    const float across = (cosine - ior * behind) / (cosine + ior * behind),
                along = (ior * cosine - behind) / (ior * cosine + behind);
    return 0.5f * (across * across + along * along);
}
VX_HD float fresnel_dielectric(float cosine, float ior) {
    float behind;
    return fresnel_dielectric(cosine, ior, behind);
}

// Seen straight on.
VX_HD float normal_reflectance(float ior) {
    const float r = (ior - 1) / (ior + 1);
    return r * r;
}

// (1 - cosine)^5: the share of white in Schlick's approximation ("An Inexpensive BRDF Model for Physically-based
// Rendering", 1994), reflectance = f0 + (1 - f0) schlick.
VX_HD float schlick(float cosine) {
    const float m = 1 - clamp(cosine, 0.0f, 1.0f), m2 = m * m;
    return m2 * m2 * m;
}

// A sheet of glass: light mirrored to and fro between its two faces adds up to 2 f / (1 + f). The rest goes through
// straight, what the glass absorbs aside.
VX_HD float slab_reflectance(float cosine, float ior) {
    const float f = fresnel_dielectric(cosine, ior);
    return 2 * f / (1 + f);
}

} // namespace vitrail::trace
