// The film's memory and what its stages are told of a frame: plain pointers of one device. Kernel-safe.
//
// Two kinds of planes, row by row from the top:
//   level   width * height entries of Vec4 or u32: index y * width + x
//   framed  floats with kFrame of margin around, so that filters read neighbors without asking for the border (the
//           margin's inverse depth, kNothing, belongs to no surface): index y * stride + x, the pointer is pixel 0, 0's
#pragma once

#include "math/color.h"
#include "trace/kernel/camera.h"
#include "trace/kernel/pixel.h"

namespace vitrail::trace {

inline constexpr i32 kFrame = 48;          // pixels on each side; the widest filter reaches 32, vectors run 15 over
inline constexpr float kNothing = -1e3f;   // inverse depth of the margin
inline constexpr float kMissing = -1;      // red of light and base where this frame has no sample
inline constexpr u32 kTile = 4;            // side of the tiles that watch for changes, pixels
inline constexpr float kLongest = 4096;    // of a history, frames (at rest; in motion FilmFrame::longest)
inline constexpr float kFastLength = 5;    // frames of the short history
inline constexpr float kMostLight = 1e12f; // radiance beyond is no light but a fault

// Loops over a filter's taps: unrolled, so that compilers see one straight body to run on vectors.
#if defined(__CUDACC__) || defined(__clang__)
#define VX_UNROLL _Pragma("unroll")
#else
#define VX_UNROLL _Pragma("GCC unroll 32")
#endif

// Framed planes: three or four floats a pixel.
struct Framed3 {
    float *r = nullptr, *g = nullptr, *b = nullptr;
};
struct Framed4 {
    float *r = nullptr, *g = nullptr, *b = nullptr;
    float* v = nullptr; // variance of the luminance; kMissing: no light known
};

// What is kept of a frame's first surfaces.
struct FilmGuides {
    Framed3 normal;                 // x, y, z
    float* inverse_depth = nullptr; // framed; 1 / blocks along the view's axis: linear over a flat surface. 0: sky
    u32* surface = nullptr;
};

// What is kept of the frames before (level).
struct FilmHistory {
    Vec4* light = nullptr; // mean over the history; its length in frames
    Vec4* fast = nullptr;  // mean over the last few frames; mean of the squared luminance of `light`
    Vec4* air = nullptr;   // mean; mean luminance of `light`, as the moments count it
    Vec4* color = nullptr; // antialiased picture; how often the pixel shows another surface (resolve.h)
};

struct FilmPlanes {
    u32 width = 0, height = 0;
    u32 stride = 0; // of framed planes
    u32 tiles_wide = 0, tiles_high = 0;

    // At rest (level): sums over all samples.
    Vec4* sum = nullptr;        // radiance; sound samples
    Vec4* sum_rest = nullptr;   // what rounding took from `sum`; samples that met a surface
    Vec4* sum_albedo = nullptr; // albedo; distance
    Vec4* sum_normal = nullptr; // normal; samples with sound guides

    // This frame, as traced.
    Vec4* base = nullptr;   // level: base (x = kMissing: no sound sample); roughness
    Vec4* albedo = nullptr; // level: albedo; distance, 0 sky
    Framed3 light, air;     // light over albedo; light.r = kMissing: no sample here

    Framed3 fresh; // light with spikes spread
    FilmGuides now, before;
    float *slope_x = nullptr, *slope_y = nullptr; // framed: of the inverse depth, per pixel to the right and down
    float *keep = nullptr, *give = nullptr;       // framed: share of a sample that stays; what of it each neighbor gets
    FilmHistory past, next;
    Vec4* tiles = nullptr;   // of kTile^2 pixels: sum of fast - slow, of its variance, of the brighter one; pixels
    float* change = nullptr; // of a tile: 0 nothing changed .. 1 light is another than before
    Framed4 even, odd;       // light between filter levels, in turns; `even` before them: samples filled in (half)
    Framed3 air_even, air_odd;
    Vec4* merged = nullptr; // level, before antialiasing: radiance squeezed (resolve.h); inverse depth
    Vec4* color = nullptr;  // level, the picture: linear radiance; distance (before antialiasing: inverse depth)
};

// What is the same for all pixels of a frame.
struct FilmFrame {
    Camera now, before; // `now.jitter` is where this frame's rays went through their pixels
    Vec3 shift;         // now.eye seen from before.eye, blocks
    // From a place of this picture to the last one's: for pixel coordinates x, y and inverse depth d of a surface,
    // w = way + way_x x + way_y y + way_shift d: it was at w.x / w.z, w.y / w.z, its inverse depth was d / w.z.
    Vec3 way, way_x, way_y, way_shift;
    bool denoise = true;
    bool history = false;       // `past` and `before` hold something
    bool rest = false;          // nothing moved since the frame before
    bool sum = false;           // samples are added to the sums,
    bool sum_first = false;     // which start with this frame
    bool half = false;          // a quarter of the pixels has light,
    u32 half_x = 0, half_y = 0; // those with x % 2, y % 2 so
    u32 rested = 0;             // frames since something moved
    float longest = 32;         // history, frames
    float to_mean = 0;          // share of the plain mean in the picture
    float spike = 0;            // luminance over that of the neighborhood's that is spread; 0: none
};

VX_HD i32 framed_at(const FilmPlanes& p, i32 x, i32 y) {
    return y * i32(p.stride) + x;
}
VX_HD u32 level_at(const FilmPlanes& p, i32 x, i32 y) {
    return u32(y) * p.width + u32(x);
}
// Vec4 as one register.
#if defined(__CUDACC__)
VX_HD Vec4 plus(Vec4 a, Vec4 b, float w) {
    return {a.x + b.x * w, a.y + b.y * w, a.z + b.z * w, a.w + b.w * w};
}
VX_HD Vec4 scaled(Vec4 a, float s) {
    return {a.x * s, a.y * s, a.z * s, a.w * s};
}
VX_HD Vec4 times(Vec4 a, Vec4 b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z, a.w * b.w};
}
VX_HD Vec4 toward(Vec4 a, Vec4 b, float t) {
    return {lerp(a.x, b.x, t), lerp(a.y, b.y, t), lerp(a.z, b.z, t), lerp(a.w, b.w, t)};
}
#else
using Quad = float __attribute__((vector_size(16)));
VX_HD Quad quad(Vec4 a) {
    return __builtin_bit_cast(Quad, a);
}
VX_HD Vec4 plus(Vec4 a, Vec4 b, float w) {
    return __builtin_bit_cast(Vec4, quad(a) + quad(b) * w);
}
VX_HD Vec4 scaled(Vec4 a, float s) {
    return __builtin_bit_cast(Vec4, quad(a) * s);
}
VX_HD Vec4 times(Vec4 a, Vec4 b) {
    return __builtin_bit_cast(Vec4, quad(a) * quad(b));
}
VX_HD Vec4 toward(Vec4 a, Vec4 b, float t) {
    return __builtin_bit_cast(Vec4, quad(a) + (quad(b) - quad(a)) * t);
}
#endif

} // namespace vitrail::trace
