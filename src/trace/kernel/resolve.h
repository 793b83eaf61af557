// The film's last stages: light on albedo, antialiasing in time, the plain mean. Kernel-safe.
#pragma once

#include "trace/kernel/change.h"
#include "trace/kernel/film.h"

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
    const float s = 1 / (1 + luminance(c.x, c.y, c.z));
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
    return rgb * (1 / larger(1e-4f, 1 - luminance(rgb)));
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

// Antialiasing in time, and the plain mean as it becomes better than the filtered picture.
VX_HD void resolve_pixel(const FilmPlanes& p, const FilmFrame& f, i32 x, i32 y) {
    const u32 i = level_at(p, x, y);
    const Vec4 now = p.color[i], own = p.merged[i];
    Vec4 sum, squares;
    const i32 left = x > 0 ? -1 : 0, right = x + 1 < i32(p.width) ? 1 : 0, up = y > 0 ? -1 : 0,
              down = y + 1 < i32(p.height) ? 1 : 0;
    float nearest = own.w;
    i32 nx = x, ny = y;
    for (i32 dy = up; dy <= down; ++dy) {
        const Vec4* row = p.merged + i64(i) + i64(dy) * p.width;
        for (i32 dx = left; dx <= right; ++dx) {
            const Vec4 c = row[dx];
            sum = plus(sum, c, 1);
            squares = plus(squares, times(c, c), 1);
            if (c.w > nearest * 1.02f)
                nearest = c.w, nx = x + dx, ny = y + dy; // silhouettes move with what is in front
        }
    }
    const float count = float((right - left + 1) * (down - up + 1));
    Vec4 out = now;
    const Earlier e = f.history ? earlier_place(f, float(nx), float(ny), nearest) : Earlier{};
    const float ex = e.x + float(x - nx), ey = e.y + float(y - ny);
    if (e.depth >= 0 && ex >= 0 && ey >= 0 && ex <= float(p.width - 1) && ey <= float(p.height - 1)) {
        const bool whole = ex == std::floor(ex) && ey == std::floor(ey);
        Vec4 past =
            whole ? p.past.color[level_at(p, i32(ex), i32(ey))] : sharp_lookup(p.past.color, p.width, p.height, ex, ey);
        // Held to what the neighborhood's colors allow (Salvi 2016), wider the longer the view rests.
        const float scale = 1 / count, calm = larger(0, float(f.rested) - 20), wide = 1.25f + 0.25f * calm;
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
        const float part = 1 / clamp(calm, 10, 512);
        out = toward(past, now, lerp(part, larger(part, 0.4f), change_at(p, x, y)));
    }
    const float distance = p.albedo[i].w;
    out.w = distance;
    p.next.color[i] = out;
    Vec4 shown = out;
    if (f.to_mean > 0 && p.sum[i].w > 0) shown = toward(shown, mean_of(p, i), f.to_mean);
    shown.w = distance;
    p.color[i] = shown;
}

} // namespace vitrail::trace
