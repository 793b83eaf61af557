// GGX: rough surfaces as small mirrors (Trowbridge and Reitz 1975; Walter et al., "Microfacet Models for Refraction
// through Rough Surfaces", 2007), shadowed after Smith. All directions are local: z along the normal. Kernel-safe.
#pragma once

#include "base/hd.h"
#include "math/vec.h"

namespace vitrail::trace {

inline constexpr float kPi = 3.14159265f;

// Axes of a surface: x, y across, z along `n` (unit). After Duff et al., "Building an Orthonormal Basis, Revisited",
// 2017.
struct Frame {
    Vec3 x, y, z;
};
VX_HD Frame frame_of(Vec3 n) {
    const float sign = n.z >= 0 ? 1.0f : -1.0f, a = -1 / (sign + n.z), b = n.x * n.y * a;
    return {{1 + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}
VX_HD Vec3 to_world(const Frame& f, Vec3 v) {
    return f.x * v.x + f.y * v.y + f.z * v.z;
}
VX_HD Vec3 to_local(const Frame& f, Vec3 v) {
    return {dot(v, f.x), dot(v, f.y), dot(v, f.z)};
}

// Cosine and sine of so many turns, 0..1; within 1e-6, by polynomials on an eighth.
VX_HD Vec2 on_circle(float turns) {
    const i32 quarter = i32(turns * 4 + 0.5f);
    const float a = (turns - float(quarter) * 0.25f) * (2 * kPi), a2 = a * a;
    const float s = a * (1 + a2 * (-1.0f / 6 + a2 * (1.0f / 120 - a2 * (1.0f / 5040)))),
                c = 1 + a2 * (-0.5f + a2 * (1.0f / 24 + a2 * (-1.0f / 720 + a2 * (1.0f / 40320))));
    const float x = quarter & 1 ? -s : c, y = quarter & 1 ? c : s;
    return quarter & 2 ? Vec2{-x, -y} : Vec2{x, y};
}

// Share of mirrors whose normal is h, per solid angle.
VX_HD float ggx_density(Vec3 h, float alpha) {
    const float a2 = alpha * alpha, s = (h.x * h.x + h.y * h.y) / a2 + h.z * h.z;
    return 1 / (kPi * a2 * s * s);
}

// Smith's Lambda: hidden area over visible area, seen along v (either side).
VX_HD float ggx_hidden(Vec3 v, float alpha) {
    const float z2 = v.z * v.z;
    return 0.5f * (std::sqrt(1 + alpha * alpha * (v.x * v.x + v.y * v.y) / (z2 > 1e-12f ? z2 : 1e-12f)) - 1);
}

// A normal in proportion to what of it is seen from `eye` (eye.z > 0): density
// ggx_density(h) max(eye . h, 0) / ((1 + ggx_hidden(eye)) eye.z). After Dupuy and Benyoub, "Sampling Visible GGX
// Normals with Spherical Caps", 2023.
VX_HD Vec3 sample_visible_normal(Vec3 eye, float alpha, Vec2 u) {
    const Vec3 e = normalized({eye.x * alpha, eye.y * alpha, eye.z});
    const float z = (1 - u.y) * (1 + e.z) - e.z, s = std::sqrt(clamp(1 - z * z, 0.0f, 1.0f)), up = z + e.z;
    const Vec2 turn = on_circle(u.x);
    return normalized({(s * turn.x + e.x) * alpha, (s * turn.y + e.y) * alpha, up > 1e-6f ? up : 1e-6f});
}

// What a white GGX surface (every mirror of it reflects all) sends on after one reflection is 1 - lost; `grazing` is
// how much of that a reflectance of schlick(eye . h) alone would leave. With normal reflectance f0 a surface mirrors
// f0 (1 - lost - grazing) + grazing. Fitted to both integrals by least squares over cosine 0.004..1 and roughness 0..1:
// within 0.008. roughness: alpha is its square.
struct MirrorLoss {
    float lost, grazing;
};
VX_HD MirrorLoss mirror_loss(float cosine, float roughness) {
    const float x = clamp(cosine, 0.001f, 1.0f), r = roughness, r2 = r * r, t = r2 / (r2 + x);
    const float lost = t * (t * (1.3941f + t * (-2.1264f + t * t * 0.74461f)) +
                            x * (t * r * (10.796f + 15.039f * r - 14.641f * t) - 7.8264f * r2 * r +
                                 x * (-7.5094f * r2 + t * (-6.3231f + 41.4f * r - 42.8f * t) + 0.41531f * x * x)));
    const float m = 1 - x, m2 = m * m;
    const float grazing =
        m2 * m2 * m *
        (1.0073f + 3.7379f * r2 +
         t * (-1.445f * r2 * r + x * (-6.1007f + 16.863f * r - 13.67f * r2) +
              t * (-1.7297f + x * (-24.95f + 17.111f * r) + t * (3.3213f - 3.3669f * r - 1.4872f * t))));
    return {clamp(lost, 0.0f, 1.0f), clamp(grazing, 0.0f, 1.0f)};
}
// Means over the hemisphere, weighted by the cosine; the same fits' (within 0.001).
VX_HD MirrorLoss mean_mirror_loss(float roughness) {
    const float r = roughness;
    return {r * r * (0.26287f + r * (-1.5728f + r * (9.4246f + r * (-15.726f + r * (11.547f - 3.3437f * r))))),
            0.047269f + r * (0.033444f + r * (-0.4125f + r * (0.58449f - 0.25213f * r)))};
}

} // namespace vitrail::trace
