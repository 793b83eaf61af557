// The film's last stages: light on albedo, antialiasing in time, the plain mean. Kernel-safe.
#pragma once

#include "trace/kernel/film.h"
#include "trace/kernel/reproject.h"

namespace vitrail::trace {

// Without denoising: the mean, or where the view does not rest the frame itself (which is the same sum).
VX_HD void plain_pixel(const FilmPlanes& p, i32 x, i32 y) {
    const u32 i = level_at(p, x, y);
    p.color[i] = mean_of(p, i);
}

VX_HD Vec4 radiance_at(const FilmPlanes& p, const Framed4& light, const Framed3& air, i32 x, i32 y) {
    const u32 i = level_at(p, x, y);
    const i32 j = framed_at(p, x, y);
    const Vec4 b = p.base[i], a = p.albedo[i];
    return {b.x + a.x * light.r[j] + air.r[j], b.y + a.y * light.g[j] + air.g[j], b.z + a.z * light.b[j] + air.b[j],
            p.now.inverse_depth[j]};
}

// Light squeezed to 0..1, so that one bright pixel does not rule its neighbors (Karis, "High-Quality Temporal
// Supersampling", 2014), as luma and two differences (YCoCg: edges there lie along the axes).
VX_HD Vec3 squeezed(Vec4 c) {
    const float s = 1 / (1 + luminance_of(c.x, c.y, c.z));
    const float r = c.x * s, g = c.y * s, b = c.z * s;
    return {0.25f * r + 0.5f * g + 0.25f * b, 0.5f * r - 0.5f * b, -0.25f * r + 0.5f * g - 0.25f * b};
}
VX_HD void put_merged(const FilmPlanes& p, u32 i, Vec4 c) {
    const Vec3 s = squeezed(c);
    p.color[i] = c;
    p.merged[i] = {s.x, s.y, s.z, c.w};
}

// Light, air: as the filters left them. A pixel without any shows what its neighbors do.
VX_HD void merge_pixel(const FilmPlanes& p, const Framed4& light, const Framed3& air, i32 x, i32 y) {
    const u32 i = level_at(p, x, y);
    if (p.base[i].x >= 0 && light.v[framed_at(p, x, y)] >= 0) {
        put_merged(p, i, radiance_at(p, light, air, x, y));
        return;
    }
    Vec4 sum;
    float count = 0;
    for (i32 k = 0; k < 9; ++k) {
        const i32 qx = x + k % 3 - 1, qy = y + k / 3 - 1;
        if (qx < 0 || qy < 0 || qx >= i32(p.width) || qy >= i32(p.height) || p.base[level_at(p, qx, qy)].x < 0 ||
            light.v[framed_at(p, qx, qy)] < 0)
            continue;
        sum = plus(sum, radiance_at(p, light, air, qx, qy), 1);
        count += 1;
    }
    put_merged(p, i, scaled(sum, 1 / larger(1, count)));
}

VX_HD Vec3 unsqueezed(Vec3 c) {
    const float t = c.x - c.z;
    const Vec3 rgb{larger(0, t + c.y), larger(0, c.x + c.z), larger(0, t - c.y)};
    return rgb * (1 / larger(1e-4f, 1 - luminance_of(rgb)));
}

// Where a path chooses between mirror and passage (water, glass), a pixel shows now one surface, now another, and what
// it shows (base, guides) is noise, too. flips: in how many frames of late it was another than just before, which goes
// from frame to frame with the picture. Silhouettes flip under jitter, but they are thin lines. Returns 0..1: how sure
// it is that all around flips.
VX_HD float see_through(const FilmPlanes& p, const FilmFrame& f, i32 x, i32 y, float depth, float& flips) {
    const Earlier e = earlier_place(f, float(x), float(y), depth);
    const i32 ex = i32(std::floor(e.x + 0.5f)), ey = i32(std::floor(e.y + 0.5f));
    if (!(e.depth >= 0) || ex < 0 || ey < 0 || ex >= i32(p.width) || ey >= i32(p.height)) return 0;
    const i32 j = framed_at(p, x, y);
    const float there = p.before.inverse_depth[framed_at(p, ex, ey)];
    const float slope = std::fabs(p.slope_x[j]) + std::fabs(p.slope_y[j]);
    const float other = std::fabs(there - e.depth) > 0.05f * larger(there, e.depth) + 2 * slope ? 1.0f : 0.0f;
    const Vec4* past = p.past.color + level_at(p, ex, ey);
    flips = lerp(past[0].w, other, 0.08f);
    const i64 left = ex > 1 ? -2 : 0, right = ex + 2 < i32(p.width) ? 2 : 0, up = ey > 1 ? -2 * i64(p.width) : 0,
              down = ey + 2 < i32(p.height) ? 2 * i64(p.width) : 0;
    const float least =
        smaller(past[0].w, smaller(smaller(past[left].w, past[right].w), smaller(past[up].w, past[down].w)));
    return smoothstep(0.01f, 0.06f, least);
}

// Mean of 3x3 pixels before antialiasing.
VX_HD Vec4 mean_around(const FilmPlanes& p, i32 x, i32 y) {
    Vec3 sum;
    for (i32 k = 0; k < 9; ++k) {
        const i32 qx = x + k % 3 - 1, qy = y + k / 3 - 1;
        const Vec4 c = p.merged[level_at(p,
                                         qx < 0               ? 0
                                         : qx >= i32(p.width) ? x
                                                              : qx,
                                         qy < 0                ? 0
                                         : qy >= i32(p.height) ? y
                                                               : qy)];
        sum += unsqueezed({c.x, c.y, c.z});
    }
    sum = sum * (1.0f / 9);
    return {sum.x, sum.y, sum.z, 0};
}

// Antialiasing in time, and the plain mean as it becomes better than the filtered picture.
VX_HD void resolve_pixel(const FilmPlanes& p, const FilmFrame& f, i32 x, i32 y) {
    const u32 i = level_at(p, x, y);
    Vec4 now = p.color[i];
    const Vec4 own = p.merged[i];
    Vec4 sum, squares;
    const i32 left = x > 0 ? x - 1 : 0, right = x + 1 < i32(p.width) ? x + 1 : x, up = y > 0 ? y - 1 : 0,
              below = y + 1 < i32(p.height) ? y + 1 : y;
    float nearest = own.w * 1.02f;
    i32 nearest_at = 4;
    VX_UNROLL
    for (i32 k = 0; k < 9; ++k) { // at borders some count twice
        const Vec4 c = p.merged[level_at(p,
                                         k % 3 == 0   ? left
                                         : k % 3 == 1 ? x
                                                      : right,
                                         k / 3 == 0   ? up
                                         : k / 3 == 1 ? y
                                                      : below)];
        sum = plus(sum, c, 1);
        squares = plus(squares, times(c, c), 1);
        nearest_at = c.w > nearest ? k : nearest_at;
        nearest = larger(nearest, c.w);
    }
    // Silhouettes move with what is in front.
    const i32 column = nearest_at % 3, row = nearest_at / 3;
    const i32 nx = column == 0 ? left : column == 1 ? x : right, ny = row == 0 ? up : row == 1 ? y : below;
    if (nearest_at == 4) nearest = own.w;
    float flips = 0;
    const float mixed = f.history ? see_through(p, f, x, y, own.w, flips) : 0.0f;
    if (mixed > 0) now = toward(now, mean_around(p, x, y), mixed);
    Vec4 out = now;
    const Earlier e = f.history ? earlier_place(f, float(nx), float(ny), nearest) : Earlier{};
    const float ex = e.x + float(x - nx), ey = e.y + float(y - ny);
    if (e.depth >= 0 && ex >= 0 && ey >= 0 && ex <= float(p.width - 1) && ey <= float(p.height - 1)) {
        const bool whole = ex == std::floor(ex) && ey == std::floor(ey);
        Vec4 past =
            whole ? p.past.color[level_at(p, i32(ex), i32(ey))] : sharp_lookup(p.past.color, p.width, p.height, ex, ey);
        // Held to what the neighborhood's colors allow (Salvi 2016), wider the longer the view rests.
        const float scale = 1.0f / 9, calm = larger(0, float(f.rested) - 20), wide = 1.25f + 0.25f * calm;
        const Vec3 mean{sum.x * scale, sum.y * scale, sum.z * scale};
        const Vec3 v = Vec3{squares.x, squares.y, squares.z} * scale - mean * mean;
        const Vec3 d{wide * std::sqrt(larger(0, v.x)) + 1e-5f, wide * std::sqrt(larger(0, v.y)) + 1e-5f,
                     wide * std::sqrt(larger(0, v.z)) + 1e-5f};
        const Vec3 from = squeezed(past) - mean;
        const float over = larger(std::fabs(from.x) / d.x, larger(std::fabs(from.y) / d.y, std::fabs(from.z) / d.z));
        if (over > 1) {
            const Vec3 held = unsqueezed(mean + from * (1 / over));
            past = {held.x, held.y, held.z, 0};
        }
        // What was only just uncovered, or lit anew, has no picture to keep. Under jitter single pixels at silhouettes
        // seem so too, but not all around.
        const Vec4* h = p.next.light + i;
        const i64 across = x > 1 && x + 2 < i32(p.width) ? 2 : 0,
                  down = y > 1 && y + 2 < i32(p.height) ? 2 * p.width : 0;
        const float known = larger(h[0].w, larger(larger(h[-across].w, h[across].w), larger(h[-down].w, h[down].w)));
        const float part = larger(1 / clamp(calm, f.rest ? 10.0f : 6.0f, 512), 1 / (1 + known));
        out = toward(past, now, lerp(part, smaller(part, 0.07f), mixed));
    }
    const float distance = p.albedo[i].w;
    out.w = flips;
    p.next.color[i] = out;
    Vec4 shown = out;
    if (f.to_mean > 0 && p.sum[i].w > 0) shown = toward(shown, mean_of(p, i), f.to_mean);
    shown.w = distance;
    p.color[i] = shown;
}

} // namespace vitrail::trace
