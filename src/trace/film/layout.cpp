#include "trace/film/layout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace vitrail::trace {

namespace {

constexpr u64 kAlign = 16; // floats

u64 aligned(u64 floats) {
    return (floats + kAlign - 1) / kAlign * kAlign;
}

// Hands out pieces of a block; without a block it counts.
struct Carver {
    float* at;
    u64 used = 0;
    float* take(u64 floats) {
        float* piece = at ? at + used : nullptr;
        used += aligned(floats);
        return piece;
    }
};

u64 carve(FilmPlanes& p, u32 width, u32 height, float* memory) {
    p.width = width;
    p.height = height;
    p.stride = u32(aligned(width + 2 * kFrame));
    p.tiles_wide = (width + kTile - 1) / kTile;
    p.tiles_high = (height + kTile - 1) / kTile;
    const u64 pixels = u64(width) * height, tiles = u64(p.tiles_wide) * p.tiles_high;
    Carver c{memory};
    const auto framed = [&] {
        float* piece = c.take(film_framed_floats(p));
        return piece ? piece + framed_margin(p) : nullptr;
    };
    const auto framed3 = [&] {
        Framed3 f;
        f.r = framed(), f.g = framed(), f.b = framed();
        return f;
    };
    const auto framed4 = [&] {
        Framed4 f;
        f.r = framed(), f.g = framed(), f.b = framed(), f.v = framed();
        return f;
    };
    const auto level = [&] { return reinterpret_cast<Vec4*>(c.take(pixels * 4)); };
    // Framed planes first: they are filled before the first frame.
    for (FilmGuides* g : {&p.now, &p.before}) {
        g->inverse_depth = framed();
        g->normal = framed3();
    }
    p.light = framed3(), p.air = framed3(), p.fresh = framed3();
    for (float** plane : {&p.slope_x, &p.slope_y, &p.keep, &p.give})
        *plane = framed();
    p.even = framed4(), p.odd = framed4();
    p.air_even = framed3(), p.air_odd = framed3();
    for (Vec4** plane : {&p.sum, &p.sum_rest, &p.sum_albedo, &p.sum_normal, &p.base, &p.albedo, &p.color, &p.merged})
        *plane = level();
    for (FilmHistory* h : {&p.past, &p.next})
        h->light = level(), h->fast = level(), h->air = level(), h->color = level();
    for (FilmGuides* g : {&p.now, &p.before})
        g->surface = reinterpret_cast<u32*>(c.take(pixels));
    p.tiles = reinterpret_cast<Vec4*>(c.take(tiles * 4));
    p.change = c.take(tiles);
    return c.used;
}

// Radical inverse: low discrepancy in each dimension (Halton 1964).
float radical_inverse(u32 i, u32 base) {
    float f = 1, r = 0;
    for (; i; i /= base) {
        f /= float(base);
        r += f * float(i % base);
    }
    return r;
}

bool same_view(const Camera& a, const Camera& b) {
    return a.eye.cell == b.eye.cell && a.eye.at == b.eye.at && a.right == b.right && a.up == b.up &&
           a.forward == b.forward && a.width == b.width && a.height == b.height && a.medium == b.medium;
}

// pixel_of(before, direction_through(now)) with the divisions taken out, in double precision.
void find_way(FilmFrame& f) {
    const Camera &a = f.now, &b = f.before;
    const double w = b.width, h = b.height;
    const auto dot_of = [](Vec3 u, Vec3 v) {
        return double(u.x) * double(v.x) + double(u.y) * double(v.y) + double(u.z) * double(v.z);
    };
    const auto seen = [&](Vec3 d) { // homogeneous pixel
        const double z = dot_of(d, b.forward), r = dot_of(d, b.right) / dot_of(b.right, b.right),
                     u = dot_of(d, b.up) / dot_of(b.up, b.up);
        return std::array<double, 3>{(r + z) * 0.5 * w, (z - u) * 0.5 * h, z};
    };
    const auto forward = seen(a.forward), right = seen(a.right), up = seen(a.up), shift = seen(f.shift);
    const auto vec = [](auto&& at) { return Vec3{float(at(0)), float(at(1)), float(at(2))}; };
    f.way = vec([&](u32 k) { return forward[k] - right[k] + up[k]; });
    f.way_x = vec([&](u32 k) { return right[k] * 2 / a.width; });
    f.way_y = vec([&](u32 k) { return up[k] * -2 / a.height; });
    f.way_shift = vec([&](u32 k) { return shift[k]; });
}

} // namespace

u64 film_framed_floats(const FilmPlanes& p) {
    return u64(p.stride) * (p.height + 2 * kFrame);
}
u64 framed_margin(const FilmPlanes& p) {
    return u64(p.stride) * kFrame + kFrame;
}

u64 film_bytes(u32 width, u32 height) {
    FilmPlanes p;
    return carve(p, width, height, nullptr) * sizeof(float);
}

FilmPlanes film_planes(u32 width, u32 height, void* memory) {
    FilmPlanes p;
    carve(p, width, height, static_cast<float*>(memory));
    return p;
}

void turn_film(FilmPlanes& p) {
    std::swap(p.now, p.before);
    std::swap(p.past, p.next);
}

FilmFrame next_film_frame(const FilmFrame& last, u32 frames, u32& samples, const Camera& now,
                          const FilmSettings& settings, bool changed) {
    FilmFrame f;
    f.now = now;
    f.now.jitter = {};
    f.before = frames ? last.now : now;
    f.shift = offset(f.before.eye, now.eye);
    find_way(f);
    f.denoise = settings.denoise;
    f.half = settings.half && settings.denoise;
    const bool same =
        frames > 0 && !changed && same_view(now, last.now) && last.denoise == settings.denoise && last.half == f.half;
    f.rest = same && settings.accumulate;
    f.rested = f.rest ? last.rested + 1 : 0;
    f.history = f.denoise && last.denoise && frames > 0 && now.width == last.now.width && now.height == last.now.height;
    // Denoised, the first frame of a rest is one of motion: sums need not be kept until there is a second.
    f.sum = !f.denoise || f.rested > 0;
    f.sum_first = f.denoise ? f.rested == 1 : f.rested == 0;
    if (f.half) { // diagonal neighbors follow each other
        const u32 phase = frames & 3;
        f.half_x = phase == 1 || phase == 2;
        f.half_y = phase == 1 || phase == 3;
    }
    if (f.denoise) {
        // In motion 16 places are enough, and come back soon; at rest all are new. In half mode each place serves four
        // frames, so that every pixel gets all of them.
        const u32 step = f.half ? frames / 4 : frames;
        const u32 i = 1 + (f.rest ? (f.half ? f.rested / 4 : f.rested) : step % 16);
        f.now.jitter = {radical_inverse(i, 2) - 0.5f, radical_inverse(i, 3) - 0.5f};
    }
    f.longest = f.rest ? kLongest : 32;
    samples = !f.sum ? 0 : (f.sum_first ? 0 : samples) + settings.samples;
    const float own = float(f.half ? samples / 4 : samples);
    if (!f.denoise)
        f.to_mean = 1;
    else if (own > 64)
        f.to_mean = smoothstep(6, 12, std::log2(own));
    f.spike = settings.spread_spikes;
    return f;
}

} // namespace vitrail::trace
