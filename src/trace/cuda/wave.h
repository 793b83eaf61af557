// Memory of many paths that go on together, an event at a time, and how what a path carries is packed there. Values and
// pointers of one device; functions compile for the host too, where tests run them.
//
// Paths of a batch have numbers: sample * pixels + pixel, a pixel's number as tile_pixel (below) tells. What belongs to
// a path lies in planes of 16-byte words, plane after plane, a word a path; so lanes with paths of successive numbers
// read whole lines.
#pragma once

#include "trace/cuda/launch.h"
#include "trace/cuda/words.h"
#include "trace/kernel/path.h"

namespace vitrail::trace::cuda {

// Counters of a round, each in a line of its own: warps of the whole device add to them.
struct WaveRound {
    struct alignas(128) Count {
        u32 n;
    };
    Count rays;   // paths whose rays this round traces
    Count taken;  // of these, by warps that trace them
    Count met;    // paths that meet something, counted from the front of Wave::ends
    Count missed; // paths that leave for the sky, from its back
    Count lights; // rays to lights that its events send
    Count lights_taken;
    Count hard, hard_taken;               // rays whose way is not easy: in the place of the next round's paths
    Count hard_lights, hard_lights_taken; // rays to lights, likewise: Wave::hard_lights
};

inline constexpr u32 kWaveMost = 1u << 21; // paths of a batch: a picture of 1920x1080 is one
inline constexpr u32 kRoundsMost = 16;     // paths that need more go on one by one

struct Wave {
    static constexpr u32 kPathWords = 5, kHitWords = 2, kLightWords = 4, kSumWords = 6;
    u32 paths = 0;       // that there is room for
    u32 lights_each = 0; // rays to lights that an event may send, 1..3
    Word4 *path = nullptr, *hit = nullptr, *sum = nullptr;
    Word4* light = nullptr; // planes of paths * lights_each
    u32* going[2] = {};     // numbers of paths with a ray to trace: of even and of odd rounds
    u32* ends = nullptr;
    u32* hard_lights = nullptr;  // places of rays to lights
    WaveRound* rounds = nullptr; // kRoundsMost + 1
};

// Pixels of a batch: of the job's bands, in tiles of 8x4 that a warp takes, four tiles above each other.
struct WaveJob {
    PathJob job;
    Wave wave;
    float pixel_width = 0;     // camera's (path.h)
    u32 first = 0, pixels = 0; // of all pixels in tiles
    u32 rounds = 0;
};

inline constexpr u32 kTileWide = 8, kTileHigh = 4, kTilesDown = kBand / kTileHigh;

// The row of the picture that is the n-th of the bands.
VX_HD u32 row_of(u32 n, u32 band, u32 bands) {
    return (n / kBand * bands + band) * kBand + n % kBand;
}
VX_HD u32 tile_pixels(u32 width, u32 rows) {
    return (width + kTileWide - 1) / kTileWide * kTileWide * rows;
}

struct TilePixel {
    u32 x, y, row; // row: of the bands. May lie outside of the picture
};
VX_HD TilePixel tile_pixel(const PathJob& j, u32 n) {
    const u32 tile = n / (kTileWide * kTileHigh), lane = n % (kTileWide * kTileHigh);
    const u32 column = tile / kTilesDown, wide = (j.film.width + kTileWide - 1) / kTileWide;
    TilePixel p;
    p.x = column % wide * kTileWide + lane % kTileWide;
    p.row = column / wide * kBand + tile % kTilesDown * kTileHigh + lane / kTileWide;
    p.y = row_of(p.row, j.band, j.bands);
    return p;
}

// Samples of a pixel: where the frame wants no light of it, one, for its guides.
VX_HD u32 samples_at(const PathJob& j, const TilePixel& p) {
    if (p.x >= j.film.width || p.y >= j.film.height) return 0;
    return light_wanted(j.frame, p.x, p.y) ? j.samples : 1;
}
VX_HD PathSettings settings_at(const PathJob& j, u32 x, u32 y) {
    PathSettings s = j.settings;
    if (!light_wanted(j.frame, x, y)) s.bounces = 0;
    return s;
}

// ---- Packing.

// What a path has counted: bounces and events 10 bits each, medium 8, Since 2, sharp, bent.
inline constexpr u32 kEventsMost = 1023;

VX_HD u32 flags_of(const PathState& p) {
    return p.bounces | p.events << 10 | p.medium << 20 | u32(p.since) << 28 | u32(p.sharp) << 30 | u32(p.bent) << 31;
}

// Beyond its ray, a path's pixel and how often it drew number; its sampler follows from these.
VX_HD void store_path(const Wave& w, u32 path, const PathState& p, u32 x, u32 y) {
    const u32 n = w.paths;
    Word4* to = w.path + path;
    to[0] = words_of(p.ray.from.cell, flags_of(p));
    to[n] = words_of(p.ray.from.at, bits_of(p.ray.dir.x));
    to[2 * n] = {bits_of(p.ray.dir.y), bits_of(p.ray.dir.z), x | y << 16, p.sampler.drawn};
    to[3 * n] = words_of(p.carried, bits_of(p.pdf));
    to[4 * n] = words_of(p.sharp ? Vec3{p.wide, p.spread, 0} : p.scatter_side, bits_of(p.way));
}

// Of a path its ray and medium alone.
VX_HD Ray load_ray(const Wave& w, u32 path, u32& medium) {
    const u32 n = w.paths;
    const Word4 a = w.path[path];
    medium = a.w >> 20 & 255;
    return ray_of(a, w.path[path + n], w.path[path + 2 * n]);
}

VX_HD PathState load_path(const WaveJob& j, u32 path, u32& x, u32& y) {
    const u32 n = j.wave.paths;
    const Word4* from = j.wave.path + path;
    const Word4 a = from[0], b = from[n], c = from[2 * n], d = from[3 * n], e = from[4 * n];
    PathState p;
    p.ray = ray_of(a, b, c);
    p.bounces = a.w & 1023, p.events = a.w >> 10 & 1023, p.medium = a.w >> 20 & 255;
    p.since = Since(u8(a.w >> 28 & 3));
    p.sharp = a.w >> 30 & 1, p.bent = a.w >> 31 & 1;
    x = c.z & 0xffff, y = c.z >> 16;
    p.sampler = sampler_of_path(j.job.settings, x, y, path / j.pixels);
    p.sampler.drawn = c.w;
    p.carried = vec_of(d), p.pdf = float_of(d.w);
    if (p.sharp)
        p.wide = float_of(e.x), p.spread = float_of(e.y); // lights from all sides
    else
        p.scatter_side = vec_of(e);
    p.way = float_of(e.w);
    return p;
}

VX_HD void store_hit(const Wave& w, u32 path, const Hit& h) {
    words_of(h, w.hit[path], w.hit[path + w.paths]);
}
VX_HD Hit load_hit(const Wave& w, u32 path) {
    return hit_of(w.hit[path], w.hit[path + w.paths]);
}

// Rays to lights of one event go to sums of their own, so that it does not matter which arrives first.
enum class Purse : u8 { light, second, air };

VX_HD void store_light(const Wave& w, u32 place, u32 path, const LightRay& r, Purse purse) {
    const u32 n = w.paths * w.lights_each;
    Word4* to = w.light + place;
    to[0] = words_of(r.ray.from.cell, path);
    to[n] = words_of(r.ray.from.at, bits_of(r.ray.dir.x));
    to[2 * n] = {bits_of(r.ray.dir.y), bits_of(r.ray.dir.z), bits_of(r.distance),
                 r.medium | u32(r.counts) << 8 | u32(purse) << 16};
    to[3 * n] = words_of(r.value, 0);
}
VX_HD LightRay load_light(const Wave& w, u32 place, u32& path, Purse& purse) {
    const u32 n = w.paths * w.lights_each;
    const Word4* from = w.light + place;
    const Word4 a = from[0], b = from[n], c = from[2 * n], d = from[3 * n];
    LightRay r;
    r.ray = ray_of(a, b, c);
    r.distance = float_of(c.z);
    r.medium = c.w & 255, r.counts = LightRay::Counts(u8(c.w >> 8 & 255)), purse = Purse(u8(c.w >> 16));
    r.value = vec_of(d);
    path = a.w;
    return r;
}

// ---- What a path has found: words base and surface; light; light of second rays; air; albedo and distance; normal and
// roughness.

VX_HD void clear_sum(const Wave& w, u32 path) {
    const PixelSample none;
    for (u32 k = 0; k < 4; ++k)
        w.sum[k * w.paths + path] = {};
    w.sum[4 * w.paths + path] = words_of(none.albedo, bits_of(none.distance));
    w.sum[5 * w.paths + path] = words_of(none.normal, bits_of(none.roughness));
}

VX_HD bool is_zero(Vec3 v) {
    return v.x == 0 && v.y == 0 && v.z == 0;
}
VX_HD void add_to(Word4& sum, Vec3 v) {
    sum = words_of(vec_of(sum) + v, sum.w);
}

// What one event found. It told guides if it told how far off they are.
VX_HD void add_event(const Wave& w, u32 path, const PixelSample& found) {
    Word4* to = w.sum + path;
    const u32 n = w.paths;
    if (found.distance > 0) {
        to[0] = words_of(vec_of(to[0]) + found.base, found.surface);
        to[4 * n] = words_of(found.albedo, bits_of(found.distance));
        to[5 * n] = words_of(found.normal, bits_of(found.roughness));
    } else if (!is_zero(found.base)) {
        add_to(to[0], found.base);
    }
    if (!is_zero(found.light)) add_to(to[n], found.light);
}

// What a ray to a light brought.
VX_HD void add_light_ray(const Wave& w, u32 path, Purse purse, LightRay::Counts counts, Vec3 value,
                         const PathSettings& settings) {
    PixelSample sum;
    add_arrived(sum, counts, value, settings);
    add_to(w.sum[(1 + u32(purse)) * w.paths + path], purse == Purse::air ? sum.air : sum.light);
}

VX_HD PixelSample load_sum(const Wave& w, u32 path) {
    const u32 n = w.paths;
    const Word4* from = w.sum + path;
    const Word4 a = from[0], e = from[4 * n], f = from[5 * n];
    PixelSample s;
    s.base = vec_of(a), s.surface = a.w;
    s.light = vec_of(from[n]) + vec_of(from[2 * n]);
    s.air = vec_of(from[3 * n]);
    s.albedo = vec_of(e), s.distance = float_of(e.w);
    s.normal = vec_of(f), s.roughness = float_of(f.w);
    return s;
}

} // namespace vitrail::trace::cuda
