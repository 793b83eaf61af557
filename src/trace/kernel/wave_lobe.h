// Slopes of waves too small to be seen one by one: a Gaussian around the slope that is seen, and of it what an eye sees
// from one side, each slope in proportion to the area that it shows (Ross, Dion and Potvin, "Detailed Analytical
// Approach to the Gaussian Surface Bidirectional Reflectance Distribution Function Specular Component Applied to the
// Sea Surface", 2005; Heitz, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", 2014). A slope s
// has the normal (-s.x, 1, -s.y); directions have y up on the eye's side. Kernel-safe.
//
// Seen from `o` a slope shows q = o.y - o.x s.x - o.z s.y of its level area, which is Gaussian as s is. So a slope that
// is seen is found by q, whose density is that of a Gaussian times q where q > 0, and by the Gaussian that s has across
// when q is known.
#pragma once

#include "math/exp.h"
#include "math/vec.h"
#include "scene/water.h"

namespace vitrail::trace {

// The normal distribution: its density, and the probability of less than x, within 1e-7 (Abramowitz and Stegun,
// "Handbook of Mathematical Functions", 1964, 26.2.17).
struct NormalAt {
    float density, below;
};
VX_HD NormalAt normal_at(float x) {
    const float density = 0.39894228f * exp_of(-0.5f * x * x), t = 1 / (1 + 0.2316419f * std::fabs(x));
    const float tail =
        density * t *
        (0.319381530f + t * (-0.356563782f + t * (1.781477937f + t * (-1.821255978f + t * 1.330274429f))));
    return {density, x > 0 ? 1 - tail : tail};
}
// x below which so much of it lies, within 5e-4; 0 < share < 1 (as above, 26.2.23).
VX_HD float normal_place(float share) {
    const float less = share < 0.5f ? share : 1 - share, p = less > 1e-8f ? less : 1e-8f;
    const float t = std::sqrt(-2 * log_of(p));
    const float x =
        t - (2.515517f + t * (0.802853f + t * 0.010328f)) / (1 + t * (1.432788f + t * (0.189269f + t * 0.001308f)));
    return share < 0.5f ? -x : x;
}

// x > -c with the density (c + x) normal_at(x).density, over its integral; c >= 0. u: 0..1. By Newton's steps from
// between the places of c = 0 and of c beyond all bounds: the share of lesser x is u within 1e-4.
VX_HD float visible_place(float c, float u) {
    const NormalAt edge = normal_at(c);
    const float whole = c * edge.below + edge.density, want = u * whole + c * (1 - edge.below) - edge.density;
    const float share = clamp(u, 1e-7f, 1 - 1e-7f), even = c * c / (c * c + 0.9f * c + 0.2f);
    float x = lerp(std::sqrt(-2 * log_of(1 - share)), normal_place(share), even);
    // Near -c it lies between these.
    const float q2 = 2 * share * whole, most = std::sqrt(q2 / (edge.density > 1e-12f ? edge.density : 1e-12f)) - c;
    if (most < 0 && x > most) x = most;
    const float least = std::sqrt(q2 * 2.5066283f) - c;
    x = x > least ? x : least;
    const float first = (c < 5.6f ? -c : -5.6f) + 1e-4f;
    for (u32 step = 0; step < 3; ++step) {
        const NormalAt at = normal_at(x);
        const float grows = (c + x) * at.density;
        x = clamp(x - (c * at.below - at.density - want) / (grows > 1e-9f ? grows : 1e-9f), first, 5.8f);
    }
    return x;
}

struct WaveLobe {
    Vec2 mean;
    scene::Covariance inverse;       // of the covariance
    float peak = 0;                  // density of the mean
    float facing = 0, deviation = 1; // of q: mean (0 or more) and its standard deviation
    float visible = 0;               // mean of q where it is above 0
    Vec2 along, across;              // a slope: mean - along x + across y, x as visible_place, y normal
};

// spread: no line, so its determinant is above 0. normal: of the mean, either side. o: to the eye, unit, y above 0.
VX_HD WaveLobe wave_lobe(const scene::Covariance& spread, Vec3 normal, Vec3 o) {
    WaveLobe w;
    w.mean = {-normal.x / normal.y, -normal.z / normal.y};
    const float det = spread.xx * spread.zz - spread.xz * spread.xz, over = 1 / det;
    w.inverse = {spread.zz * over, -spread.xz * over, spread.xx * over};
    w.peak = std::sqrt(over) * (0.5f / 3.14159265f);
    // Seen from straight above, any direction serves.
    const bool slanted = o.x * o.x + o.z * o.z > 1e-8f;
    const Vec2 d{slanted ? o.x : 1e-4f, slanted ? o.z : 0.0f};
    const Vec2 g{spread.xx * d.x + spread.xz * d.y, spread.xz * d.x + spread.zz * d.y};
    w.deviation = std::sqrt(d.x * g.x + d.y * g.y);
    const float facing = o.y - o.x * w.mean.x - o.z * w.mean.y, one = 1 / w.deviation;
    w.facing = facing > 0 ? facing : 0;
    const NormalAt at = normal_at(w.facing * one);
    w.visible = w.facing * at.below + w.deviation * at.density;
    w.along = {g.x * one, g.y * one};
    const float rest = std::sqrt(det) * one;
    w.across = {-d.y * rest, d.x * rest};
    return w;
}

// Of all slopes, seen or not, an area of slopes. 0 beyond what sample_slope may come to.
VX_HD float density_of_slope(const WaveLobe& w, Vec2 s) {
    const float x = s.x - w.mean.x, z = s.y - w.mean.y;
    const float e = 0.5f * (x * x * w.inverse.xx + 2 * x * z * w.inverse.xz + z * z * w.inverse.zz);
    return e < 34 ? w.peak * exp_of(-e) : 0.0f;
}

// A slope as it is seen: with density density_of_slope times q over w.visible. u: 0..1 each.
VX_HD Vec2 sample_slope(const WaveLobe& w, Vec2 u) {
    const float x = visible_place(w.facing / w.deviation, u.x), y = normal_place(clamp(u.y, 1e-7f, 1 - 1e-7f));
    return {w.mean.x - w.along.x * x + w.across.x * y, w.mean.y - w.along.y * x + w.across.y * y};
}

} // namespace vitrail::trace
