// Light over time: what earlier frames knew of the surface that a pixel shows now. Kernel-safe.
//
// As in SVGF (Schied et al., "Spatiotemporal Variance-Guided Filtering", 2017): light over albedo is looked up where
// the surface was, tested by depth, normal and surface, and blended with the new sample; the moments of its luminance
// give the variance. Beside the long mean a short one is kept. Where over an area of 12x12 pixels the two differ by
// more than noise explains, light has changed, and the short one takes the long one's place (trace/kernel/change.h).
#pragma once

#include "trace/kernel/filter.h"

namespace vitrail::trace {

// Where a pixel's surface was in the frame before, as an index (0, 0: middle of the first pixel); and the inverse depth
// that it had there. inverse_depth: of this frame. Behind the eye: depth < 0.
struct Earlier {
    float x = 0, y = 0, depth = -1;
};
VX_HD Earlier earlier_place(const FilmFrame& f, float x, float y, float inverse_depth) {
    const float px = x + 0.5f + f.now.jitter.x, py = y + 0.5f + f.now.jitter.y;
    // Scaled by the inverse depth, so that the sky lies at infinity.
    const Vec3 q = f.way + f.way_x * px + f.way_y * py + f.way_shift * larger(0, inverse_depth);
    Earlier e;
    if (q.z <= 1e-4f) return e;
    // The pixel's middle moves as the place that its ray met does: so nothing is resampled while the view rests.
    const float z = 1 / q.z;
    e.x = x + (q.x * z - px);
    e.y = y + (q.y * z - py);
    const float rx = std::floor(e.x + 0.5f), ry = std::floor(e.y + 0.5f);
    if (std::fabs(e.x - rx) < 2e-3f) e.x = rx;
    if (std::fabs(e.y - ry) < 2e-3f) e.y = ry;
    e.depth = larger(0, inverse_depth) * z;
    return e;
}

struct Tap {
    i32 x, y;
    float weight;
};

// How far the pixel `t` of the frame before is the same surface: 0..1.
VX_HD float same_surface(const FilmPlanes& p, i32 tx, i32 ty, const Site& own, float depth, float tolerance,
                         u32 surface) {
    if (tx < 0 || ty < 0 || tx >= i32(p.width) || ty >= i32(p.height)) return 0;
    const i32 j = framed_at(p, tx, ty);
    const float there = p.before.inverse_depth[j];
    if (depth <= 0) return there == 0 ? 1.0f : 0.0f;
    if (std::fabs(there - depth) > tolerance) return 0;
    const float n = own.nx * p.before.normal.r[j] + own.ny * p.before.normal.g[j] + own.nz * p.before.normal.b[j];
    if (n < 0.8f) return 0;
    // Other blocks in the same plane get about the same light, but one's own are better.
    return p.before.surface[level_at(p, tx, ty)] == surface ? 1.0f : 0.1f;
}

struct Mix {
    Vec4 light, fast, air;
    float weight = 0;
};
VX_HD void mix_in(Mix& m, const FilmHistory& h, u32 i, float w) {
    m.light = plus(m.light, h.light[i], w);
    m.fast = plus(m.fast, h.fast[i], w);
    m.air = plus(m.air, h.air[i], w);
    m.weight += w;
}
// The earlier picture between pixels: Catmull-Rom, which keeps it sharp where a bilinear lookup blurs a little each
// frame.
VX_HD Vec4 sharp_lookup(const Vec4* picture, u32 width, u32 height, float x, float y) {
    const i32 x0 = i32(std::floor(x)), y0 = i32(std::floor(y));
    const float fx = x - float(x0), fy = y - float(y0);
    const auto weights = [](float t, float* w) {
        w[0] = t * (-0.5f + t * (1 - 0.5f * t));
        w[1] = 1 + t * t * (-2.5f + 1.5f * t);
        w[2] = t * (0.5f + t * (2 - 1.5f * t));
        w[3] = t * t * (-0.5f + 0.5f * t);
    };
    float wx[4], wy[4];
    weights(fx, wx);
    weights(fy, wy);
    Vec4 sum;
    for (i32 dy = 0; dy < 4; ++dy) {
        const i32 qy = y0 + dy - 1, cy = qy < 0 ? 0 : qy >= i32(height) ? i32(height) - 1 : qy;
        const Vec4* row = picture + u64(u32(cy)) * width;
        Vec4 across;
        if (x0 >= 1 && x0 + 2 < i32(width)) {
            const Vec4* at = row + (x0 - 1);
            across = plus(plus(plus(scaled(at[0], wx[0]), at[1], wx[1]), at[2], wx[2]), at[3], wx[3]);
        } else {
            for (i32 dx = 0; dx < 4; ++dx) {
                const i32 qx = x0 + dx - 1, cx = qx < 0 ? 0 : qx >= i32(width) ? i32(width) - 1 : qx;
                across = plus(across, row[cx], wx[dx]);
            }
        }
        sum = plus(sum, across, wy[dy]);
    }
    return {larger(0, sum.x), larger(0, sum.y), larger(0, sum.z), sum.w};
}

VX_HD float least_of(float a, float b, float c, float d) {
    return smaller(smaller(a, b), smaller(c, d));
}
VX_HD float most_of(float a, float b, float c, float d) {
    return larger(larger(a, b), larger(c, d));
}

// The mean of the frame before around the place; weight 0: it was not seen.
VX_HD Mix look_back(const FilmPlanes& p, const FilmFrame& f, i32 x, i32 y) {
    Mix m;
    const i32 j = framed_at(p, x, y);
    const Site own = site_at(p.now, j);
    const Earlier e = earlier_place(f, float(x), float(y), own.depth);
    if (e.depth < 0 || !(e.x > -1 && e.y > -1 && e.x < float(p.width) && e.y < float(p.height))) return m;
    const u32 surface = p.now.surface[level_at(p, x, y)];
    const float slope = std::fabs(p.slope_x[j]) + std::fabs(p.slope_y[j]);
    const float tolerance = 0.02f * e.depth + 1.5f * slope;
    const i32 x0 = i32(std::floor(e.x)), y0 = i32(std::floor(e.y));
    const float fx = e.x - float(x0), fy = e.y - float(y0);
    for (i32 k = 0; k < 4; ++k) {
        const i32 dx = k & 1, dy = k >> 1;
        float w = (dx ? fx : 1 - fx) * (dy ? fy : 1 - fy);
        if (w > 0) w *= same_surface(p, x0 + dx, y0 + dy, own, e.depth, tolerance, surface);
        if (w > 0) mix_in(m, p.past, level_at(p, x0 + dx, y0 + dy), w);
    }
    const bool between = fx > 0 || fy > 0;
    const bool whole = m.weight > 0.999f;
    float most = kLongest;
    if (m.weight < 0.02f) { // around it, then: silhouettes under jitter
        m = Mix{};
        const i32 cx = i32(std::floor(e.x + 0.5f)), cy = i32(std::floor(e.y + 0.5f));
        for (i32 k = 0; k < 9; ++k) {
            const i32 tx = cx + k % 3 - 1, ty = cy + k / 3 - 1;
            const float w = same_surface(p, tx, ty, own, e.depth, tolerance, surface);
            if (w > 0) mix_in(m, p.past, level_at(p, tx, ty), w);
        }
        if (m.weight < 0.02f) {
            m.weight = 0;
            return m;
        }
        most = 16;
    }
    const float scale = 1 / m.weight;
    m.light = scaled(m.light, scale);
    m.fast = scaled(m.fast, scale);
    m.air = scaled(m.air, scale);
    if (between && whole) {
        // Where the surface goes on all around, the sharper lookup, held between what it lies between.
        bool on = true;
        for (i32 k = 0; k < 4; ++k) {
            const i32 tx = k == 0   ? x0 - 1
                           : k == 1 ? x0 + 2
                                    : x0 + k % 2,
                      ty = k == 2   ? y0 - 1
                           : k == 3 ? y0 + 2
                                    : y0 + k;
            on = on && same_surface(p, tx, ty, own, e.depth, tolerance + slope, surface) > 0;
        }
        if (on) {
            const Vec4* h = p.past.light + level_at(p, x0, y0);
            const Vec4 a = h[0], b = h[1], c = h[p.width], d = h[p.width + 1];
            const Vec4 sharp = sharp_lookup(p.past.light, p.width, p.height, e.x, e.y);
            m.light.x = clamp(sharp.x, least_of(a.x, b.x, c.x, d.x), most_of(a.x, b.x, c.x, d.x));
            m.light.y = clamp(sharp.y, least_of(a.y, b.y, c.y, d.y), most_of(a.y, b.y, c.y, d.y));
            m.light.z = clamp(sharp.z, least_of(a.z, b.z, c.z, d.z), most_of(a.z, b.z, c.z, d.z));
        }
    }
    m.light.w = smaller(m.light.w, most);
    return m;
}

// Frames that glossy light may be kept: until the eye has moved over a good part of the lobe.
VX_HD float glossy_length(const FilmFrame& f, float roughness, float depth) {
    if (roughness >= 0.6f) return kLongest;
    const float angle = length(f.shift) * depth;
    const float lobe = 0.02f + 0.5f * roughness * roughness;
    const float frames = larger(3, lobe / (angle + 1e-6f));
    return roughness < 0.5f ? frames : lerp(frames, larger(frames, 32), (roughness - 0.5f) * 10);
}

VX_HD void reproject_pixel(const FilmPlanes& p, const FilmFrame& f, i32 x, i32 y) {
    const u32 i = level_at(p, x, y);
    const i32 j = framed_at(p, x, y);
    Framed3 light = fresh_light(p, f), air = p.air;
    if (f.half) light = {p.even.r, p.even.g, p.even.b}, air = p.air_even;
    const bool sampled = light.r[j] >= 0, own = p.light.r[j] >= 0;
    Mix m;
    if (f.history) m = look_back(p, f, x, y);
    if (!sampled) { // nothing new
        if (m.weight <= 0) m.light = m.fast = m.air = Vec4{};
        p.next.light[i] = m.light;
        p.next.fast[i] = m.fast;
        p.next.air[i] = m.air;
        return;
    }
    const Vec4 now{light.r[j], light.g[j], light.b[j], 0};
    const float l = luminance_of(now.x, now.y, now.z);
    // A guess from neighbors counts less than a sample of one's own.
    const float count = own ? 1.0f : 0.4f;
    float old = 0;
    if (m.weight > 0)
        old = smaller(m.light.w, smaller(f.longest, glossy_length(f, p.base[i].w, p.now.inverse_depth[j])));
    const float total = old + count, part = count / total;
    const float quick = larger(part, 1 / kFastLength);
    const float air_part = f.rest ? part : larger(part, 1.0f / 16);
    Vec4 next = toward(m.light, now, part), fast = toward(m.fast, now, quick);
    next.w = smaller(total, f.longest);
    fast.w = lerp(m.fast.w, l * l, part);
    Vec4 a = toward(m.air, {air.r[j], air.g[j], air.b[j], 0}, air_part);
    a.w = lerp(m.air.w, l, part);
    p.next.light[i] = next;
    p.next.fast[i] = fast;
    p.next.air[i] = a;
}

} // namespace vitrail::trace
