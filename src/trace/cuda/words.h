// Rays and hits in words of 16 bytes, which lanes of a warp read and write side by side: word k of all in a plane of
// its own.
#pragma once

#include "trace/kernel/air_walk.h"

namespace vitrail::trace::cuda {

struct alignas(16) Word4 {
    u32 x, y, z, w;
};

VX_HD Word4 words_of(Vec3 v, u32 w) {
    return {bits_of(v.x), bits_of(v.y), bits_of(v.z), w};
}
VX_HD Vec3 vec_of(Word4 w) {
    return {float_of(w.x), float_of(w.y), float_of(w.z)};
}
VX_HD Word4 words_of(IVec3 v, u32 w) {
    return {u32(v.x), u32(v.y), u32(v.z), w};
}
VX_HD IVec3 ivec_of(Word4 w) {
    return {i32(w.x), i32(w.y), i32(w.z)};
}

// A ray: 3 words, of which a.w and the last two of c are free.
inline constexpr u32 kRayWords = 3, kHitWords = 2;

VX_HD void words_of(const Ray& r, Word4& a, Word4& b, Word4& c) {
    a = words_of(r.from.cell, 0);
    b = words_of(r.from.at, bits_of(r.dir.x));
    c = {bits_of(r.dir.y), bits_of(r.dir.z), 0, 0};
}
VX_HD Ray ray_of(Word4 a, Word4 b, Word4 c) {
    return {{ivec_of(a), vec_of(b)}, {float_of(b.w), float_of(c.x), float_of(c.y)}};
}

// State ids lie below 2^25.
VX_HD void words_of(const Hit& h, Word4& a, Word4& b) {
    a = words_of(h.cell, bits_of(h.t));
    b = {h.state | u32(h.kind) << 25 | u32(h.face) << 28 | u32(h.leaving) << 31, h.quad, bits_of(h.u), bits_of(h.v)};
}
VX_HD Hit hit_of(Word4 a, Word4 b) {
    Hit h;
    h.cell = ivec_of(a), h.t = float_of(a.w);
    h.state = b.x & 0x1ffffff;
    h.kind = HitKind(u8(b.x >> 25 & 7)), h.face = u8(b.x >> 28 & 7), h.leaving = b.x >> 31;
    h.quad = b.y, h.u = float_of(b.z), h.v = float_of(b.w);
    return h;
}

} // namespace vitrail::trace::cuda
