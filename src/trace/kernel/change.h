// Has light changed? And what follows for history and variance. Kernel-safe.
#pragma once

#include "trace/kernel/reproject.h"

namespace vitrail::trace {

// Histories shorter than this have nothing to compare.
inline constexpr float kWatched = 6;

// Of a tile: sums over its pixels of what the short mean says more than the long one, of that difference's square, and
// of the brighter of the two.
VX_HD void watch_tile(const FilmPlanes& p, i32 tx, i32 ty) {
    Vec4 sum;
    for (i32 k = 0; k < i32(kTile * kTile); ++k) {
        const i32 x = tx * i32(kTile) + k % i32(kTile), y = ty * i32(kTile) + k / i32(kTile);
        if (x >= i32(p.width) || y >= i32(p.height)) continue;
        const u32 i = level_at(p, x, y);
        const Vec4 light = p.next.light[i], fast = p.next.fast[i];
        if (light.w < kWatched) continue;
        const float slow_l = luminance_of(light.x, light.y, light.z), fast_l = luminance_of(fast.x, fast.y, fast.z);
        const float d = fast_l - slow_l;
        sum = plus(sum, {d, d * d, larger(fast_l, slow_l), 1}, 1);
    }
    p.tiles[u32(ty) * p.tiles_wide + u32(tx)] = sum;
}

// The test, over 3x3 tiles: is the mean difference more than its scatter explains? In standard errors, of a ninth of
// the pixels: spread spikes and filled gaps are shared by so many. A lone spike stays at 1, an even change has no
// bound, one of half the area gives 4. The scatter over pixels serves better than the moments, which a change itself
// blows up.
VX_HD void test_tile(const FilmPlanes& p, i32 tx, i32 ty) {
    Vec4 sum;
    for (i32 k = 0; k < 9; ++k) {
        const i32 x = tx + k % 3 - 1, y = ty + k / 3 - 1;
        if (x >= 0 && y >= 0 && x < i32(p.tiles_wide) && y < i32(p.tiles_high))
            sum = plus(sum, p.tiles[u32(y) * p.tiles_wide + u32(x)], 1);
    }
    const float scale = 1 / larger(1, sum.w), mean = std::fabs(sum.x) * scale;
    const float scatter = std::sqrt(larger(0, sum.y * scale - mean * mean));
    const float sure = smoothstep(2.2f, 3.6f, mean * std::sqrt(sum.w / 9) / (scatter + 1e-6f * mean + 1e-20f));
    const float matters = smoothstep(0.01f, 0.05f, mean / (sum.z * scale + 1e-20f));
    p.change[u32(ty) * p.tiles_wide + u32(tx)] = sum.w >= 9 ? sure * matters : 0.0f;
}

VX_HD float change_at(const FilmPlanes& p, i32 x, i32 y) {
    const float fx = larger(0, (float(x) + 0.5f) / float(kTile) - 0.5f),
                fy = larger(0, (float(y) + 0.5f) / float(kTile) - 0.5f);
    const u32 x0 = u32(fx), y0 = u32(fy), x1 = x0 + 1 < p.tiles_wide ? x0 + 1 : x0,
              y1 = y0 + 1 < p.tiles_high ? y0 + 1 : y0;
    const float ax = fx - float(x0), ay = fy - float(y0);
    const float* c = p.change;
    return lerp(lerp(c[y0 * p.tiles_wide + x0], c[y0 * p.tiles_wide + x1], ax),
                lerp(c[y1 * p.tiles_wide + x0], c[y1 * p.tiles_wide + x1], ax), ay);
}

// Variance of one sample's luminance, of this frame's samples on the surface around (7x7).
VX_HD float variance_around(const FilmPlanes& p, const FilmFrame& f, i32 x, i32 y) {
    const i32 j = framed_at(p, x, y);
    const Framed3 light = fresh_light(p, f);
    const Site own = site_at(p.now, j);
    const float scale = depth_scale(own.depth), sx = p.slope_x[j], sy = p.slope_y[j];
    float weight = 0, sum = 0, squares = 0;
    for (i32 dy = -3; dy <= 3; ++dy)
        for (i32 dx = -3; dx <= 3; ++dx) {
            const i32 q = j + dy * i32(p.stride) + dx;
            if (!(light.r[q] >= 0)) continue;
            const Site s = site_at(p.now, q);
            const float off = std::fabs(s.depth - own.depth - sx * float(dx) - sy * float(dy)) * scale;
            const float w = power_32(own.nx * s.nx + own.ny * s.ny + own.nz * s.nz) * falloff(off);
            const float l = luminance_of(light.r[q], light.g[q], light.b[q]);
            weight += w;
            sum += w * l;
            squares += w * l * l;
        }
    if (weight < 1e-3f) return 0;
    const float mean = sum / weight;
    const float variance = larger(0, squares / weight - mean * mean);
    // Alone, or among few: nothing is known, so as much as there is light.
    return weight < 3 ? larger(variance, mean * mean) : variance * weight / (weight - 1);
}

// History follows a change; then the filter's input: light, its variance, air.
VX_HD void respond_pixel(const FilmPlanes& p, const FilmFrame& f, i32 x, i32 y) {
    const u32 i = level_at(p, x, y);
    const i32 j = framed_at(p, x, y);
    Vec4 light = p.next.light[i], fast = p.next.fast[i], air = p.next.air[i];
    const float change = f.history ? change_at(p, x, y) : 0;
    const bool surface = p.now.inverse_depth[j] > 0;
    float one = 0; // variance of a sample
    if (surface) {
        const float known = smoothstep(3, 6, light.w * (1 - change));
        const float around = known < 1 ? variance_around(p, f, x, y) : 0;
        const float times = light.w > 1.5f ? light.w / (light.w - 1) : 1;
        one = lerp(around, larger(0, fast.w - air.w * air.w) * times, known);
        if (change > 0) {
            const Framed3 fresh = f.half ? Framed3{p.even.r, p.even.g, p.even.b} : fresh_light(p, f);
            if (fresh.r[j] >= 0) {
                const Vec4 now{fresh.r[j], fresh.g[j], fresh.b[j], 0};
                const float w = fast.w;
                fast = toward(fast, now, 0.5f * change);
                fast.w = w;
            }
            const float length = light.w, l = luminance_of(fast.x, fast.y, fast.z);
            light = toward(light, fast, change);
            light.w = lerp(length, smaller(length, 1.0f), change);
            fast.w = lerp(fast.w, l * l + around, change);
            air.w = lerp(air.w, l, change);
            p.next.light[i] = light;
            p.next.fast[i] = fast;
            p.next.air[i] = air;
        }
    }
    const float roughness = p.base[i].w;
    // Reflections in what shines have edges of their own.
    const float soft = lerp(0.3f, 1.0f, smoothstep(0.1f, 0.4f, roughness));
    p.odd.r[j] = light.x;
    p.odd.g[j] = light.y;
    p.odd.b[j] = light.z;
    // Noise of neighbors that share spikes is not independent, so the filter's levels lower it less than they think;
    // and of short histories the variance is little known.
    const float unsure = (f.spike > 0 ? 2.0f : 1.0f) + 8 / (larger(1, light.w) * larger(1, light.w));
    p.odd.v[j] = surface && light.w <= 0 ? kMissing : soft * unsure * one / larger(1, light.w);
    p.air_odd.r[j] = air.x;
    p.air_odd.g[j] = air.y;
    p.air_odd.b[j] = air.z;
}

} // namespace vitrail::trace
