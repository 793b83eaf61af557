// Light from all around in nine numbers a color: spherical harmonics up to the second order, in which irradiance of any
// distant light is within a few percent (Ramamoorthi and Hanrahan, "An Efficient Representation for Irradiance
// Environment Maps", 2001). Axes as in the world, y up. Kernel-safe.
#pragma once

#include "base/hd.h"
#include "math/vec.h"

namespace vitrail::scene {

// Of irradiance divided by pi: what a white surface sends back. The cosine and all constants are folded in, so that
// irradiance_of is a plain polynomial (passes/common/ambient.glsl has the same).
struct Irradiance {
    Vec3 c[9]; // of 1, y, z, x, xy, yz, 3zz-1, xz, xx-yy
};

// Adds light of this radiance from a small solid angle around d (unit).
VX_HD void add_light(Irradiance& sum, Vec3 d, Vec3 radiance, float solid_angle) {
    // Basis constant squared, times the cosine lobe's factor (pi, 2 pi / 3, pi / 4), divided by pi.
    constexpr float b0 = 0.0795774715f, b1 = 0.159154943f, b2 = 0.298415518f, b20 = 0.0248679599f, b22 = 0.0746038795f;
    const Vec3 l = radiance * solid_angle;
    sum.c[0] += l * b0;
    sum.c[1] += l * (b1 * d.y);
    sum.c[2] += l * (b1 * d.z);
    sum.c[3] += l * (b1 * d.x);
    sum.c[4] += l * (b2 * d.x * d.y);
    sum.c[5] += l * (b2 * d.y * d.z);
    sum.c[6] += l * (b20 * (3 * d.z * d.z - 1));
    sum.c[7] += l * (b2 * d.x * d.z);
    sum.c[8] += l * (b22 * (d.x * d.x - d.y * d.y));
}

VX_HD Vec3 irradiance_of(const Irradiance& light, Vec3 n) {
    return light.c[0] + light.c[1] * n.y + light.c[2] * n.z + light.c[3] * n.x + light.c[4] * (n.x * n.y) +
           light.c[5] * (n.y * n.z) + light.c[6] * (3 * n.z * n.z - 1) + light.c[7] * (n.x * n.z) +
           light.c[8] * (n.x * n.x - n.y * n.y);
}

} // namespace vitrail::scene
