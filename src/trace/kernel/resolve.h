// The film's last stages: light on albedo, antialiasing in time, the plain mean. Kernel-safe.
#pragma once

#include "trace/kernel/film.h"

namespace vitrail::trace {

// Without denoising: the mean, or where the view does not rest the frame itself (which is the same sum).
VX_HD void plain_pixel(const FilmPlanes& p, const FilmFrame& f, i32 x, i32 y) {
    const u32 i = level_at(p, x, y);
    if (f.sum) {
        p.color[i] = mean_of(p, i);
        return;
    }
    const i32 j = framed_at(p, x, y);
    const Vec4 b = p.base[i], a = p.albedo[i];
    const float lit = p.light.r[j] >= 0 ? 1.0f : 0.0f;
    p.color[i] = {b.x + a.x * lit * p.light.r[j] + p.air.r[j], b.y + a.y * lit * p.light.g[j] + p.air.g[j],
                  b.z + a.z * lit * p.light.b[j] + p.air.b[j], a.w};
}

} // namespace vitrail::trace
