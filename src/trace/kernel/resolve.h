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

// Light, air: as the filters left them. A pixel whose samples were all dropped shows what its neighbors do.
VX_HD void merge_pixel(const FilmPlanes& p, const Framed4& light, const Framed3& air, i32 x, i32 y) {
    const u32 i = level_at(p, x, y);
    if (p.base[i].x >= 0) {
        p.merged[i] = radiance_at(p, light, air, x, y);
        return;
    }
    Vec4 sum;
    float count = 0;
    for (i32 k = 0; k < 9; ++k) {
        const i32 qx = x + k % 3 - 1, qy = y + k / 3 - 1;
        if (qx < 0 || qy < 0 || qx >= i32(p.width) || qy >= i32(p.height) || p.base[level_at(p, qx, qy)].x < 0)
            continue;
        sum = plus(sum, radiance_at(p, light, air, qx, qy), 1);
        count += 1;
    }
    p.merged[i] = scaled(sum, 1 / larger(1, count));
}

// Light squeezed to 0..1, so that one bright pixel does not rule its neighbors (Karis, "High-Quality Temporal
// Supersampling", 2014), as luma and two differences (YCoCg: edges there lie along the axes).
VX_HD Vec3 squeezed(Vec4 c) {
    const float s = 1 / (1 + luminance(c.x, c.y, c.z));
    const float r = c.x * s, g = c.y * s, b = c.z * s;
    return {0.25f * r + 0.5f * g + 0.25f * b, 0.5f * r - 0.5f * b, -0.25f * r + 0.5f * g - 0.25f * b};
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
        for (i32 dx = 0; dx < 4; ++dx) {
            const i32 qx = x0 + dx - 1, cx = qx < 0 ? 0 : qx >= i32(width) ? i32(width) - 1 : qx;
            sum = plus(sum, picture[u32(cy) * width + u32(cx)], wx[dx] * wy[dy]);
        }
    }
    return {larger(0, sum.x), larger(0, sum.y), larger(0, sum.z), sum.w};
}

// Antialiasing in time, and the plain mean as it becomes better than the filtered picture.
VX_HD void resolve_pixel(const FilmPlanes& p, const FilmFrame& f, i32 x, i32 y) {
    const u32 i = level_at(p, x, y);
    const Vec4 now = p.merged[i];
    const Vec3 own = squeezed(now);
    Vec3 sum = own, squares = own * own;
    float count = 1, nearest = now.w;
    i32 nx = x, ny = y;
    for (i32 k = 0; k < 9; ++k) {
        const i32 qx = x + k % 3 - 1, qy = y + k / 3 - 1;
        if (k == 4 || qx < 0 || qy < 0 || qx >= i32(p.width) || qy >= i32(p.height)) continue;
        const Vec4 q = p.merged[level_at(p, qx, qy)];
        const Vec3 c = squeezed(q);
        sum += c;
        squares += c * c;
        count += 1;
        if (q.w > nearest * 1.02f) nearest = q.w, nx = qx, ny = qy; // silhouettes move with what is in front
    }
    Vec4 out = now;
    const Earlier e = f.history ? earlier_place(f, float(nx), float(ny), nearest) : Earlier{};
    const float ex = e.x + float(x - nx), ey = e.y + float(y - ny);
    if (e.depth >= 0 && ex >= 0 && ey >= 0 && ex <= float(p.width - 1) && ey <= float(p.height - 1)) {
        const bool whole = ex == std::floor(ex) && ey == std::floor(ey);
        Vec4 past =
            whole ? p.past.color[level_at(p, i32(ex), i32(ey))] : sharp_lookup(p.past.color, p.width, p.height, ex, ey);
        // Held to what the neighborhood's colors allow (Salvi 2016), wider the longer the view rests.
        const float scale = 1 / count, wide = 1.25f + 0.25f * smaller(float(f.rested), 1e4f);
        const Vec3 mean = sum * scale;
        const Vec3 v = squares * scale - mean * mean;
        const Vec3 d{wide * std::sqrt(larger(0, v.x)) + 1e-5f, wide * std::sqrt(larger(0, v.y)) + 1e-5f,
                     wide * std::sqrt(larger(0, v.z)) + 1e-5f};
        const Vec3 from = squeezed(past) - mean;
        const float over = larger(std::fabs(from.x) / d.x, larger(std::fabs(from.y) / d.y, std::fabs(from.z) / d.z));
        if (over > 1) {
            const Vec3 held = unsqueezed(mean + from * (1 / over));
            past = {held.x, held.y, held.z, 0};
        }
        out = toward(past, now, f.rest ? 1 / smaller(float(f.rested) + 10, 512) : 0.1f);
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
