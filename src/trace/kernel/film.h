// Taking samples: several of a pixel become one, what is no light is dropped, sums at rest. Kernel-safe.
//
//     SampleMean mean;
//     for each sample of (x, y) in this frame: add_sample(mean, trace_path(...));
//     dropped += put_samples(planes, frame, x, y, mean);
#pragma once

#include "trace/kernel/film_planes.h"

namespace vitrail::trace {

// Samples of one pixel in one frame.
struct SampleMean {
    Vec3 radiance, base, lit, air; // sums over `samples`; lit: albedo * light
    Vec3 lit_albedo;               // sum over `samples`
    Vec3 albedo, normal;           // sums over `seen`
    float distance = 0;            // sum over `hits`
    u32 samples = 0, seen = 0, hits = 0, dropped = 0;
    // Of the first sample with sound guides: they guide the filter.
    Vec3 first_albedo{1, 1, 1}, first_normal;
    float first_distance = 0, first_roughness = 1;
    u32 first_surface = 0;
};

// NaN, infinite, negative: no.
VX_HD bool is_light(Vec3 c) {
    return c.x >= 0 && c.x <= kMostLight && c.y >= 0 && c.y <= kMostLight && c.z >= 0 && c.z <= kMostLight;
}
VX_HD bool guides_sound(const PixelSample& s) {
    return s.albedo.x >= 0 && s.albedo.x <= 1e6f && s.albedo.y >= 0 && s.albedo.y <= 1e6f && s.albedo.z >= 0 &&
           s.albedo.z <= 1e6f && dot(s.normal, s.normal) <= 4 && s.distance >= 0 && s.distance <= kFar &&
           s.roughness >= 0 && s.roughness <= 4;
}

VX_HD void add_sample(SampleMean& m, const PixelSample& s) {
    if (!guides_sound(s)) {
        ++m.dropped;
        return;
    }
    const bool hit = s.distance > 0;
    if (m.seen == 0) {
        m.first_albedo = s.albedo;
        m.first_normal = s.normal;
        m.first_distance = s.distance;
        m.first_roughness = s.roughness;
        m.first_surface = s.surface;
    }
    ++m.seen;
    m.albedo += s.albedo;
    m.normal += s.normal;
    if (hit) {
        ++m.hits;
        m.distance += s.distance;
    }
    const Vec3 lit = s.albedo * s.light, all = s.base + lit + s.air;
    if (!is_light(s.base) || !is_light(s.light) || !is_light(s.air) || !is_light(all)) {
        ++m.dropped;
        return;
    }
    ++m.samples;
    m.radiance += all;
    m.base += s.base;
    m.lit += lit;
    m.air += s.air;
    m.lit_albedo += s.albedo;
}

VX_HD float ratio_or(float a, float b, float otherwise) {
    return b > 1e-6f ? a / b : otherwise;
}

// sum + rest + x, as two floats that hold it to twice a float's precision (Dekker 1971). Terms are 0 or more.
VX_HD void add_exactly(float& sum, float& rest, float x) {
    const float t = sum + x, error = (sum < x ? x - t : sum - t) + (sum < x ? sum : x);
    rest += error;
    sum = t + rest;
    rest -= sum - t;
}

// Does this frame want light for the pixel? Where not, only guides and base are read of its samples.
VX_HD bool light_wanted(const FilmFrame& f, u32 x, u32 y) {
    return !f.half || ((x & 1) == f.half_x && (y & 1) == f.half_y);
}

// A frame's samples of a pixel go into the planes. Returns how many were dropped.
VX_HD u32 put_samples(const FilmPlanes& p, const FilmFrame& f, u32 x, u32 y, const SampleMean& m) {
    const u32 i = y * p.width + x;
    const bool lit = m.samples > 0 && light_wanted(f, x, y);
    if (f.sum) {
        Vec4 sum, rest, albedo, normal;
        if (!f.sum_first) sum = p.sum[i], rest = p.sum_rest[i], albedo = p.sum_albedo[i], normal = p.sum_normal[i];
        if (lit) {
            add_exactly(sum.x, rest.x, m.radiance.x);
            add_exactly(sum.y, rest.y, m.radiance.y);
            add_exactly(sum.z, rest.z, m.radiance.z);
            sum.w += float(m.samples);
        }
        p.sum[i] = sum;
        p.sum_rest[i] = {rest.x, rest.y, rest.z, rest.w + float(m.hits)};
        p.sum_albedo[i] = {albedo.x + m.albedo.x, albedo.y + m.albedo.y, albedo.z + m.albedo.z, albedo.w + m.distance};
        p.sum_normal[i] = {normal.x + m.normal.x, normal.y + m.normal.y, normal.z + m.normal.z,
                           normal.w + float(m.seen)};
    }
    const float n = m.samples > 0 ? 1.0f / float(m.samples) : 0;
    const bool hit = m.first_distance > 0;
    p.base[i] = {m.samples > 0 ? m.base.x * n : kMissing, m.base.y * n, m.base.z * n, m.first_roughness};
    p.albedo[i] = {m.first_albedo.x, m.first_albedo.y, m.first_albedo.z, m.first_distance};
    const i32 j = framed_at(p, i32(x), i32(y));
    p.light.r[j] = lit ? ratio_or(m.lit.x, m.lit_albedo.x, 0) : kMissing;
    p.light.g[j] = lit ? ratio_or(m.lit.y, m.lit_albedo.y, 0) : 0;
    p.light.b[j] = lit ? ratio_or(m.lit.z, m.lit_albedo.z, 0) : 0;
    p.air.r[j] = lit ? m.air.x * n : 0;
    p.air.g[j] = lit ? m.air.y * n : 0;
    p.air.b[j] = lit ? m.air.z * n : 0;
    p.now.normal.r[j] = m.first_normal.x;
    p.now.normal.g[j] = m.first_normal.y;
    p.now.normal.b[j] = m.first_normal.z;
    p.now.surface[i] = m.first_surface;
    // The unnormalized direction is 1 long along the view's axis.
    const float u = 2 * (float(x) + 0.5f + f.now.jitter.x) / float(p.width) - 1,
                v = 1 - 2 * (float(y) + 0.5f + f.now.jitter.y) / float(p.height);
    const Vec3 d = f.now.forward + f.now.right * u + f.now.up * v;
    p.now.inverse_depth[j] = hit ? length(d) / m.first_distance : 0;
    return m.dropped;
}

// The mean of all samples since the view rests; distance.
VX_HD Vec4 mean_of(const FilmPlanes& p, u32 i) {
    const Vec4 s = p.sum[i], r = p.sum_rest[i];
    const float n = s.w > 0 ? 1.0f / s.w : 0;
    return {(s.x + r.x) * n, (s.y + r.y) * n, (s.z + r.z) * n, ratio_or(p.sum_albedo[i].w, r.w, 0)};
}

} // namespace vitrail::trace
