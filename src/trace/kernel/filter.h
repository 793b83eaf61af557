// Stages over space: spikes spread, gaps filled, light and air smoothed along surfaces. Kernel-safe. All read framed
// planes around their pixel and have no branch, so that compilers run them on vectors.
//
// The smoothing is the edge-avoiding a-trous wavelet (Dammertz et al. 2010) driven by variance (SVGF, Schied et al.
// 2017), with one change: how much two pixels' light may differ follows from the variance of both. Then what p takes of
// q and q of p weigh the same, and a bright outlier is shared out instead of being left out, which would darken.
#pragma once

#include "trace/kernel/film_planes.h"

namespace vitrail::trace {

// exp(-x) for x >= 0 within 0.03; 0 from 8 on.
VX_HD float falloff(float x) {
    float a = 1 - x * 0.125f;
    a = a > 0 ? a : 0;
    a *= a;
    a *= a;
    return a * a;
}
VX_HD float power_32(float x) { // of what is above 0
    x = x > 0 ? x : 0;
    x *= x;
    x *= x;
    x *= x;
    x *= x;
    return x * x;
}
VX_HD float larger(float a, float b) {
    return a > b ? a : b;
}
VX_HD float smaller(float a, float b) {
    return a < b ? a : b;
}

// Of a pixel, as filters compare it.
struct Site {
    float nx, ny, nz, depth; // depth: inverse
};
VX_HD Site site_at(const FilmGuides& g, i32 j) {
    return {g.normal.r[j], g.normal.g[j], g.normal.b[j], g.inverse_depth[j]};
}
// 1 / how far inverse depths may be from the surface's plane: a twentieth of a block, or 0.3 % of the depth.
VX_HD float depth_scale(float depth) {
    return 1.0f / (0.05f * depth * depth + 0.003f * depth + 1e-9f);
}

// Weight of two pixels that are neighbors, the same both ways; 0 over edges of a tenth of the depth.
VX_HD float neighbor_weight(const Site& p, const Site& q) {
    const float n = power_32(p.nx * q.nx + p.ny * q.ny + p.nz * q.nz);
    const float d = std::fabs(p.depth - q.depth) / (0.05f * std::fabs(p.depth + q.depth) + 1e-9f);
    return n * larger(0, 1 - d);
}

// Spikes, first stage: what is over `most` times the neighbors' mean is given away in equal shares by weight. Nothing
// is lost: the shares add up to it. step: 2 where only each other pixel has samples.
VX_HD void find_spike(const FilmPlanes& p, float most, i32 step, i32 x, i32 y) {
    const i32 j = framed_at(p, x, y);
    const Site own = site_at(p.now, j);
    float weight = 0, sum = 0;
    VX_UNROLL
    for (i32 dy = -1; dy <= 1; ++dy) {
        VX_UNROLL
        for (i32 dx = -1; dx <= 1; ++dx) {
            const i32 q = j + step * (dy * i32(p.stride) + dx);
            const float r = p.light.r[q], other = dx == 0 && dy == 0 ? 0.0f : 1.0f;
            const float like = other * neighbor_weight(own, site_at(p.now, q)), w = r >= 0 ? like : 0.0f;
            weight += w;
            sum += w * luminance_of(r, p.light.g[q], p.light.b[q]);
        }
    }
    const float l = luminance_of(p.light.r[j], p.light.g[j], p.light.b[j]);
    const float limit = most * sum / (weight + 1e-6f);
    const float over = larger(l, limit) + 1e-30f; // alone on its surface it stays whole
    const float within = (limit + 1e-30f) / over, keep = weight > 0.5f ? within : 1.0f;
    p.keep[j] = keep;
    p.give[j] = (1 - keep) / (1 + weight);
}

// Second stage: what is left and what the neighbors give.
VX_HD void spread_spikes(const FilmPlanes& p, i32 step, i32 x, i32 y) {
    const i32 j = framed_at(p, x, y);
    const Site own = site_at(p.now, j);
    const float here = p.light.r[j], kept = p.keep[j] + p.give[j];
    float r = here * kept, g = p.light.g[j] * kept, b = p.light.b[j] * kept;
    VX_UNROLL
    for (i32 k = 0; k < 9; ++k) {
        if (k == 4) continue;
        const i32 q = j + step * ((k / 3 - 1) * i32(p.stride) + k % 3 - 1);
        const float share = neighbor_weight(own, site_at(p.now, q)) * p.give[q], there = p.light.r[q];
        const float w = there >= 0 ? share : 0.0f;
        r += w * there;
        g += w * p.light.g[q];
        b += w * p.light.b[q];
    }
    p.fresh.r[j] = here >= 0 ? r : kMissing;
    p.fresh.g[j] = here >= 0 ? g : 0;
    p.fresh.b[j] = here >= 0 ? b : 0;
}

// The fresh light of this frame, by the stages that ran.
VX_HD Framed3 fresh_light(const FilmPlanes& p, const FilmFrame& f) {
    return f.spike > 0 ? p.fresh : p.light;
}

// Half mode: pixels without a sample take the mean of samples on their surface nearby; where there is none they stay
// missing. Air too, by depth alone.
VX_HD void fill_gap(const FilmPlanes& p, const Framed3& from, i32 x, i32 y) {
    const i32 j = framed_at(p, x, y);
    const Site own = site_at(p.now, j);
    const float own_scale = depth_scale(own.depth), sx = p.slope_x[j], sy = p.slope_y[j];
    float weight = 0, r = 0, g = 0, b = 0, air_weight = 0, ar = 0, ag = 0, ab = 0;
    VX_UNROLL
    for (i32 dy = -2; dy <= 2; ++dy) {
        VX_UNROLL
        for (i32 dx = -2; dx <= 2; ++dx) {
            const i32 q = j + dy * i32(p.stride) + dx;
            const Site s = site_at(p.now, q);
            const float near = 1.0f / (0.25f + float(dx * dx + dy * dy)), there = from.r[q];
            const float off = std::fabs(s.depth - own.depth - sx * float(dx) - sy * float(dy)) * own_scale;
            const float n = power_32(own.nx * s.nx + own.ny * s.ny + own.nz * s.nz);
            const float w = there >= 0 ? near * n * falloff(0.25f * off) : 0.0f;
            weight += w;
            r += w * there;
            g += w * from.g[q];
            b += w * from.b[q];
            const float d = std::fabs(own.depth - s.depth) / (std::fabs(own.depth + s.depth) + 1e-9f);
            const float a = there >= 0 ? near * (1e-3f + larger(0, 1 - 4 * d)) : 0.0f;
            air_weight += a;
            ar += a * p.air.r[q];
            ag += a * p.air.g[q];
            ab += a * p.air.b[q];
        }
    }
    const bool have = from.r[j] >= 0;
    const float scale = 1.0f / (weight + 1e-20f), air_scale = 1.0f / (air_weight + 1e-20f);
    const bool found = weight > 1e-4f;
    p.even.r[j] = have ? from.r[j] : found ? r * scale : kMissing;
    p.even.g[j] = have ? from.g[j] : found ? g * scale : 0;
    p.even.b[j] = have ? from.b[j] : found ? b * scale : 0;
    p.air_even.r[j] = have ? p.air.r[j] : ar * air_scale;
    p.air_even.g[j] = have ? p.air.g[j] : ag * air_scale;
    p.air_even.b[j] = have ? p.air.b[j] : ab * air_scale;
}

// How a surface's inverse depth runs: of the differences to both sides the smaller, so that edges do not count.
VX_HD void find_slope(const FilmPlanes& p, i32 x, i32 y) {
    const i32 j = framed_at(p, x, y), below = i32(p.stride);
    const float* d = p.now.inverse_depth;
    const float right = d[j + 1] - d[j], left = d[j] - d[j - 1], down = d[j + below] - d[j], up = d[j] - d[j - below];
    const float sx = std::fabs(right) < std::fabs(left) ? right : left;
    const float sy = std::fabs(down) < std::fabs(up) ? down : up;
    const float most = 0.3f * d[j];
    p.slope_x[j] = std::fabs(sx) < most ? sx : 0;
    p.slope_y[j] = std::fabs(sy) < most ? sy : 0;
}

inline constexpr u32 kFilterLevels = 5, kAirLevels = 4;

// B3 spline over distances of -2..2 steps.
VX_HD float spline_weight(i32 d) {
    return d == 0 ? 0.375f : (d == 1 || d == -1) ? 0.25f : 0.0625f;
}

// One level of the light's filter, 5x5 taps `step` apart. Variance goes along with the square of the weights;
// kMissing there says that no light is known: such a pixel takes and does not give.
VX_HD void filter_light(const FilmPlanes& p, const Framed4& from, const Framed4& to, i32 step, i32 x, i32 y) {
    const i32 j = framed_at(p, x, y);
    const Site own = site_at(p.now, j);
    const float own_scale = depth_scale(own.depth), sx = p.slope_x[j] * float(step), sy = p.slope_y[j] * float(step);
    const float r0 = from.r[j], g0 = from.g[j], b0 = from.b[j], v0 = from.v[j], l0 = luminance_of(r0, g0, b0);
    const float center = v0 >= 0 ? 0.375f * 0.375f : 0.0f, own_variance = v0 >= 0 ? v0 : 1e20f;
    float weight = center, r = center * r0, g = center * g0, b = center * b0, v = center * center * v0;
    VX_UNROLL
    for (i32 dy = -2; dy <= 2; ++dy) {
        VX_UNROLL
        for (i32 dx = -2; dx <= 2; ++dx) {
            if (dx == 0 && dy == 0) continue;
            const i32 q = j + step * (dy * i32(p.stride) + dx);
            const Site s = site_at(p.now, q);
            const float qr = from.r[q], qg = from.g[q], qb = from.b[q], qv = from.v[q];
            const float off = std::fabs(s.depth - own.depth - sx * float(dx) - sy * float(dy)) * own_scale;
            const float unlike = std::fabs(luminance_of(qr, qg, qb) - l0);
            const float light = unlike * unlike / (5 * (own_variance + qv) + 1e-12f);
            const float n = power_32(own.nx * s.nx + own.ny * s.ny + own.nz * s.nz);
            const float like = spline_weight(dx) * spline_weight(dy) * n * falloff(off + light);
            const float w = qv >= 0 ? like : 0.0f;
            weight += w;
            r += w * qr;
            g += w * qg;
            b += w * qb;
            v += w * w * qv;
        }
    }
    const float scale = 1.0f / (weight + 1e-20f);
    to.r[j] = r * scale;
    to.g[j] = g * scale;
    to.b[j] = b * scale;
    const float variance = v * scale * scale;
    to.v[j] = weight > 1e-9f ? variance : kMissing;
}

// One level of the air's: 3x3 taps, which mind only large steps of depth.
VX_HD void filter_air(const FilmPlanes& p, const Framed3& from, const Framed3& to, i32 step, i32 x, i32 y) {
    const i32 j = framed_at(p, x, y);
    const float depth = p.now.inverse_depth[j];
    float weight = 0.25f, r = weight * from.r[j], g = weight * from.g[j], b = weight * from.b[j];
    VX_UNROLL
    for (i32 k = 0; k < 9; ++k) {
        if (k == 4) continue;
        const i32 q = j + step * ((k / 3 - 1) * i32(p.stride) + k % 3 - 1);
        const float other = p.now.inverse_depth[q];
        const float d = std::fabs(depth - other) / (std::fabs(depth + other) + 1e-9f);
        const float w = (k % 2 ? 0.125f : 0.0625f) * falloff(8 * d);
        weight += w;
        r += w * from.r[q];
        g += w * from.g[q];
        b += w * from.b[q];
    }
    const float scale = 1.0f / weight;
    to.r[j] = r * scale;
    to.g[j] = g * scale;
    to.b[j] = b * scale;
}

} // namespace vitrail::trace
