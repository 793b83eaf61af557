// A scene whose light is known in closed form, seen with the noise of one path a pixel: a plain of blocks, pillars and
// a wall under sun and sky, a lamp that can be lit, mist.
#pragma once

#include "base/hash.h"
#include "trace/film/film.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace vitrail::trace::film_scene {

struct Scene {
    Vec3 sun{0.5f, 0.7f, -0.4f}; // towards it, not unit
    float sun_strength = 2.5f, sky = 0.35f;
    bool lamp = false, wall = true;
    float mist = 0;      // extinction a block
    float rare = 0.004f; // share of spikes,
    float spike = 60;    // which are so many times as bright
    bool noise = true;
};

struct Solid {
    Vec3 least, most;
    u32 state;
};
inline std::vector<Solid> solids(const Scene& s) {
    std::vector<Solid> all;
    for (i32 i = 0; i < 5; ++i)
        all.push_back({{float(i * 5 - 11), 0, -12}, {float(i * 5 - 10), 5, -11}, 10});
    all.push_back({{-3, 0, -7}, {-1, 2, -5}, 11});
    all.push_back({{2, 0, -9}, {3, 1, -8}, 12});
    if (s.wall) all.push_back({{1, 0, -6}, {5, 3, -5}, 13});
    return all;
}

struct Met {
    float t = kFar;
    Vec3 normal;
    u32 state = 0;
};
inline Met meet(const std::vector<Solid>& all, Vec3 from, Vec3 dir) {
    Met m;
    if (dir.y < -1e-6f) m = {-from.y / dir.y, {0, 1, 0}, 1};
    for (const Solid& s : all) {
        const float o[3] = {from.x, from.y, from.z}, d[3] = {dir.x, dir.y, dir.z};
        const float a[3] = {s.least.x, s.least.y, s.least.z}, b[3] = {s.most.x, s.most.y, s.most.z};
        float in = 1e-4f, out = kFar;
        i32 axis = -1;
        for (i32 k = 0; k < 3; ++k) {
            const float i = 1 / (std::fabs(d[k]) > 1e-9f ? d[k] : 1e-9f);
            const float t0 = ((i > 0 ? a[k] : b[k]) - o[k]) * i, t1 = ((i > 0 ? b[k] : a[k]) - o[k]) * i;
            if (t0 > in) in = t0, axis = k;
            out = std::min(out, t1);
        }
        if (axis < 0 || in >= out || in >= m.t) continue;
        float n[3] = {};
        n[axis] = d[axis] > 0 ? -1.0f : 1.0f;
        m = {in, {n[0], n[1], n[2]}, s.state};
    }
    return m;
}

inline float unit(u64 i) {
    return float(mix64(i) >> 40) * 0x1p-24f;
}

// The light that arrives, over pi. sure: the sun's share, which is sampled directly; luck: of all else.
inline Vec3 light_at(const Scene& s, const std::vector<Solid>& all, Vec3 at, Vec3 normal, float sure, float luck) {
    const Vec3 sun = normalized(s.sun), from = at + normal * 1e-3f;
    const float open = 0.5f + 0.5f * normal.y, corner = 1 - 0.5f * std::exp(-2 * std::max(0.0f, at.y));
    Vec3 light = Vec3{0.7f, 0.85f, 1.1f} * (luck * s.sky * open * (normal.y > 0.5f ? 1 : corner));
    const float cosine = dot(normal, sun);
    if (cosine > 0 && meet(all, from, sun).t >= kFar) light += Vec3{1, 0.93f, 0.8f} * (sure * s.sun_strength * cosine);
    if (s.lamp) {
        const Vec3 to = Vec3{-0.5f, 2.5f, -4} - at;
        const float d = length(to), facing = dot(normal, to) / d;
        if (facing > 0 && meet(all, from, to * (1 / d)).t > d)
            light += Vec3{1, 0.6f, 0.25f} * (luck * 12 * facing / (d * d + 0.5f));
    }
    return light;
}

// dir: unit. seed 0: without noise.
inline PixelSample look(const Scene& s, const std::vector<Solid>& all, Vec3 eye, Vec3 dir, u64 seed) {
    const Met m = meet(all, eye, dir);
    PixelSample p;
    // Mean 1: half of the paths find light, few find much.
    const float u = unit(seed), u2 = unit(seed ^ 0xABCDEF);
    const float rest = (1 - s.rare * s.spike) / 0.5f;
    const float luck = seed == 0 || !s.noise ? 1 : (u < s.rare ? s.spike : 0) + (u2 < 0.5f ? rest : 0);
    const float sure = seed == 0 || !s.noise ? 1 : 0.85f + 0.3f * unit(seed ^ 0x55);
    const float fog_luck = seed == 0 || !s.noise ? 1 : 2 * unit(seed ^ 0x77777);
    if (m.t >= 200) {
        const float h = std::max(0.0f, dir.y);
        p.base = Vec3{0.5f, 0.7f, 1} * (0.6f + 0.4f * h);
        if (s.mist > 0) {
            p.base = p.base * 0.2f;
            p.air = Vec3{0.6f, 0.65f, 0.7f} * (0.8f * fog_luck);
        }
        return p;
    }
    const Vec3 at = eye + dir * m.t;
    const Vec3 in = at - m.normal * 0.01f;
    const i32 bx = i32(std::floor(in.x)), by = i32(std::floor(in.y)), bz = i32(std::floor(in.z));
    const u64 block = hash_combine(hash_combine(u64(u32(bx)), u64(u32(by))), u64(u32(bz)));
    const u64 texel = hash_combine(hash_combine(u64(i64(std::floor(in.x * 8))), u64(i64(std::floor(in.y * 8)))),
                                   u64(i64(std::floor(in.z * 8))));
    const float shade = (0.25f + 0.5f * unit(block)) * (0.85f + 0.3f * unit(texel));
    p.albedo = m.state == 1 ? Vec3{0.5f, 0.8f, 0.35f} * shade : Vec3{0.8f, 0.7f, 0.6f} * shade;
    p.normal = m.normal;
    p.distance = m.t;
    p.light = light_at(s, all, at, m.normal, sure, luck);
    p.surface = m.state * 64 + u32(i32(m.normal.x) + 1 + (i32(m.normal.y) + 1) * 4 + (i32(m.normal.z) + 1) * 16);
    if (s.mist > 0) {
        const float left = std::exp(-s.mist * m.t);
        p.albedo = p.albedo * left;
        p.air = Vec3{0.6f, 0.65f, 0.7f} * ((1 - left) * fog_luck);
    }
    return p;
}

inline Camera camera(u32 w, u32 h, Vec3 eye, float yaw = 0, float pitch = -0.12f, float half_angle = 0.7f) {
    Camera c;
    const Vec3 whole{std::floor(eye.x), std::floor(eye.y), std::floor(eye.z)};
    c.eye = {{i32(whole.x), i32(whole.y), i32(whole.z)}, eye - whole};
    c.forward = {std::sin(yaw) * std::cos(pitch), std::sin(pitch), -std::cos(yaw) * std::cos(pitch)};
    const Vec3 right = normalized(cross(c.forward, {0, 1, 0})), up = cross(right, c.forward);
    c.right = right * std::tan(half_angle);
    c.up = up * (std::tan(half_angle) * float(h) / float(w));
    c.width = w;
    c.height = h;
    return c;
}
inline Vec3 eye_of(const Camera& c) {
    return Vec3{float(c.eye.cell.x), float(c.eye.cell.y), float(c.eye.cell.z)} + c.eye.at;
}

// The view that most tests look at.
inline constexpr u32 kW = 128, kH = 72;
inline constexpr Vec3 kEye{0.3f, 2.2f, 2.7f};
inline Camera usual_camera(Vec3 moved = {}) {
    return camera(kW, kH, kEye + moved);
}

using Picture = std::vector<Vec3>;

inline Picture picture_of(const Film& film) {
    Picture out;
    for (const Vec4& p : film.color())
        out.push_back({p.x, p.y, p.z});
    return out;
}

// One frame through the film.
inline Picture frame(Film& film, const Scene& s, const Camera& view, const FilmSettings& settings, bool changed,
                     u64 seed) {
    const Camera c = film.begin(view, settings, changed);
    const std::vector<Solid> all = solids(s);
    const Vec3 eye = eye_of(c);
    for (u32 y = 0; y < c.height; ++y)
        for (u32 x = 0; x < c.width; ++x) {
            const u64 id = hash_combine(seed, u64(y) * c.width + x) | 1;
            const float jx = settings.denoise ? c.jitter.x : unit(id ^ 0x1234567) - 0.5f,
                        jy = settings.denoise ? c.jitter.y : unit(id ^ 0x7654321) - 0.5f;
            const Vec3 dir = direction_through(c, float(x) + 0.5f + jx, float(y) + 0.5f + jy);
            film.put(x, y, look(s, all, eye, dir, id));
        }
    film.finish(nullptr);
    return picture_of(film);
}
// Several, each with other noise; the last one's picture. changed: with the first of them light became another.
inline Picture frames(Film& film, const Scene& s, const Camera& view, const FilmSettings& settings, u32 count, u64 seed,
                      bool changed = false) {
    Picture p;
    for (u32 n = 0; n < count; ++n)
        p = frame(film, s, view, settings, changed && n == 0, seed + n);
    return p;
}

// What the film should tend to: the mean over each pixel, without noise.
inline Picture truth(const Scene& s, const Camera& c, u32 side = 4) {
    const std::vector<Solid> all = solids(s);
    Picture out;
    for (u32 y = 0; y < c.height; ++y)
        for (u32 x = 0; x < c.width; ++x) {
            Vec3 sum;
            for (u32 k = 0; k < side * side; ++k) {
                const float jx = (float(k % side) + 0.5f) / float(side), jy = (float(k / side) + 0.5f) / float(side);
                sum += radiance_of(look(s, all, eye_of(c), direction_through(c, float(x) + jx, float(y) + jy), 0));
            }
            out.push_back(sum * (1.0f / float(side * side)));
        }
    return out;
}

inline Picture noisy(const Scene& s, const Camera& c, u64 seed) {
    Film film;
    film.resize(c.width, c.height);
    return frame(film, s, c, {.denoise = false}, false, seed);
}

template <class Where>
double rmse(const Picture& a, const Picture& b, Where&& where) {
    double sum = 0, n = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (!where(i)) continue;
        const Vec3 d = a[i] - b[i];
        sum += double(dot(d, d)) / 3;
        n += 1;
    }
    return n > 0 ? std::sqrt(sum / n) : 0;
}
inline double rmse(const Picture& a, const Picture& b) {
    return rmse(a, b, [](std::size_t) { return true; });
}
inline double mean(const Picture& a) {
    double sum = 0;
    for (const Vec3& c : a)
        sum += double(luminance_of(c));
    return sum / double(a.size());
}

// For a look: VITRAIL_PICTURES=DIR writes DIR/NAME.ppm.
inline void show(const std::string& name, const Picture& a, u32 width) {
    const char* dir = std::getenv("VITRAIL_PICTURES");
    if (!dir) return;
    std::FILE* out = std::fopen((std::string(dir) + "/" + name + ".ppm").c_str(), "wb");
    if (!out) return;
    std::fprintf(out, "P6 %u %u 255\n", width, u32(a.size()) / width);
    for (const Vec3& c : a)
        for (const float v : {c.x, c.y, c.z})
            std::fputc(i32(255 * std::pow(clamp(v / (1 + 0.25f * v), 0, 1), 1 / 2.2f)), out);
    std::fclose(out);
}

} // namespace vitrail::trace::film_scene
