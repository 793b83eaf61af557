// Directions towards a rectangle, uniform in solid angle (Urena, Fajardo and King, "An Area-Preserving
// Parametrization for Spherical Rectangles", 2013). Kernel-safe.
#pragma once

#include "base/hd.h"
#include "math/vec.h"

namespace vitrail::trace {

// Seen from the middle: x0 <= x <= x1, y0 <= y <= y1 in the plane z = z0 < 0.
struct SphericalRect {
    float x0 = 0, x1 = 0, y0 = 0, y1 = 0, z0 = -1;
    float b0 = 0, b1 = 0, k = 0;
    float solid_angle = 0; // steradians
};

VX_HD SphericalRect make_spherical_rect(float x0, float x1, float y0, float y1, float z0) {
    SphericalRect r{x0, x1, y0, y1, z0};
    // The z of the normals of the four planes through the middle and an edge.
    const float z2 = z0 * z0, n0 = -y0 / std::sqrt(z2 + y0 * y0), n1 = x1 / std::sqrt(z2 + x1 * x1),
                n2 = y1 / std::sqrt(z2 + y1 * y1), n3 = -x0 / std::sqrt(z2 + x0 * x0);
    const float g0 = std::acos(-n0 * n1), g1 = std::acos(-n1 * n2), g2 = std::acos(-n2 * n3), g3 = std::acos(-n3 * n0);
    r.b0 = n0;
    r.b1 = n2;
    r.k = 6.2831853072f - g2 - g3;
    r.solid_angle = g0 + g1 - r.k;
    return r;
}

// x and y in the plane.
VX_HD Vec2 place_on_rect(const SphericalRect& r, Vec2 u) {
    const float angle = u.x * r.solid_angle + r.k;
    const float f = (std::cos(angle) * r.b0 - r.b1) / std::sin(angle);
    float c = 1 / std::sqrt(f * f + r.b0 * r.b0);
    c = clamp(f > 0 ? c : -c, -1, 1);
    const float s = std::sqrt(1 - c * c);
    const float x = clamp(-(c * r.z0) / (s > 1e-7f ? s : 1e-7f), r.x0, r.x1);
    const float d = std::sqrt(x * x + r.z0 * r.z0);
    const float h0 = r.y0 / std::sqrt(d * d + r.y0 * r.y0), h1 = r.y1 / std::sqrt(d * d + r.y1 * r.y1);
    const float h = h0 + u.y * (h1 - h0), h2 = h * h;
    const float y = h2 < 1 - 1e-6f ? h * d / std::sqrt(1 - h2) : r.y1;
    return {x, clamp(y, r.y0, r.y1)};
}

} // namespace vitrail::trace
