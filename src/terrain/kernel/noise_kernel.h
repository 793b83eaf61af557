// Simplex and cellular noise (Perlin 2001; Gustavson 2005; Worley 1996) without loss at any distance: the lattice
// coordinate of the anchor, a block whose x and z are multiples of 16, is computed in 32.32 fixed point; floats hold
// only offsets from it. A block's value is always computed from its own anchor, so it does not depend on who asks.
#pragma once

#include "terrain/kernel/random_kernel.h"

namespace vitrail {

// Where noise is sampled: anchor (x and z multiples of 16; y is never large, its anchor is 0) and offsets in blocks.
template <class L>
struct Spot {
    i32 x = 0, z = 0;
    typename L::F dx, dy, dz;
};

// One octave at one frequency, compiled (compile/noise_tables.h). Lattice coordinates are sums a * own + b * others of
// the block's coordinates: simplex skews them so, cellular noise has b = 0.
struct NoiseOctave {
    u64 fixed_a = 0, fixed_b = 0;              // a, b in units of 2^-32
    u64 shift_x = 0, shift_y = 0, shift_z = 0; // so that lattices of two noises never share an origin
    float a = 0, b = 0;
    u32 prime_x = 1, prime_y = 1, prime_z = 1, key = 0; // odd multipliers of its own: no period in common
    float amplitude = 1;
    u32 padding = 0;
};

inline constexpr float kSimplex2Unskew = 0.211324865405187f; // (3 - sqrt 3) / 6
inline constexpr float kSimplex3Unskew = 1.0f / 6.0f;
inline constexpr float kSimplex2Scale = 100.0f; // 1 / 100.04: the largest sum of three corners, of four 1 / 62.15
inline constexpr float kSimplex3Scale = 62.0f;

namespace noise_detail {

// Added to |v| < 2^22, it leaves v rounded to a whole number in the low bits.
inline constexpr float kRounder = 12582912.0f; // 1.5 * 2^23
inline constexpr u32 kRounderBits = 0x4b400000u;

template <class U>
VX_HD U lattice_bits(U h) {
    h = h ^ h >> 15;
    h = h * 0x2c1b3c6du;
    h = h ^ h >> 12;
    h = h * 0x297a2d39u;
    return h ^ h >> 15;
}

// Few good bits, the highest ones: those of a square (tests/terrain/noise_test.cpp holds pairs and triples of neighbors
// against chance; without the shift, second differences would be constant).
template <class U>
VX_HD U gradient_bits(U h) {
    h = h ^ h >> 15;
    return h * h;
}

VX_HD float fraction_of(u64 phase) {
    return float(i32(u32(phase) >> 8)) * (1.0f / 16777216.0f);
}

// 1 + bits / 2^23, bits below 2^23
template <class U>
VX_HD auto from_one(U bits) {
    return float_of_bits(bits | 0x3f800000u);
}

// t^4 times the slope
template <class F>
VX_HD F faded(F t, F slope) {
    const F t2 = t * t;
    return t2 * t2 * slope;
}

// Slope along one of eight directions, 22.5 degrees off the axes, so that no line of the lattice shows.
template <class L>
VX_HD typename L::F slope2(typename L::U bits, typename L::F x, typename L::F y) {
    using F = typename L::F;
    const auto swap = as_int(bits) < L::i(0);
    const F u = select(swap, y, x), v = select(swap, x, y);
    return flip_sign(u, bits << 1) * 0.923879533f + flip_sign(v, bits << 2) * 0.382683432f;
}

template <class L>
VX_HD typename L::F corner2(typename L::U h, typename L::F x, typename L::F y) {
    return faded(greatest(0.5f - x * x - y * y, L::f(0.0f)), slope2<L>(gradient_bits(h), x, y));
}

// Slope towards one of the eight corners of a cube.
template <class L>
VX_HD typename L::F corner3(typename L::U h, typename L::F x, typename L::F y, typename L::F z) {
    const typename L::U bits = gradient_bits(h);
    return faded(greatest(0.5f - x * x - y * y - z * z, L::f(0.0f)),
                 flip_sign(x, bits) + flip_sign(y, bits << 1) + flip_sign(z, bits << 2));
}

} // namespace noise_detail

// An octave as seen from one anchor: what all its block columns share. Who reads many rows makes it once for them.
struct AnchoredOctave {
    float own = 0, other = 0;  // factors of a coordinate and of its skew
    float u = 0, v = 0, w = 0; // of the anchor within its lattice cell, less one half
    u32 prime_x = 1, prime_y = 1, prime_z = 1, key = 0;
    float scale = 1; // of the sum of corners
};

VX_HD AnchoredOctave anchored2(const NoiseOctave& o, i32 x, i32 z) {
    using namespace noise_detail;
    const u64 bx = u64(i64(x)), bz = u64(i64(z));
    const u64 u = o.shift_x + bx * o.fixed_a + bz * o.fixed_b, v = o.shift_z + bz * o.fixed_a + bx * o.fixed_b;
    AnchoredOctave out;
    out.own = o.a;
    out.other = o.b;
    out.u = fraction_of(u) - 0.5f;
    out.v = fraction_of(v) - 0.5f;
    out.prime_x = o.prime_x;
    out.prime_z = o.prime_z;
    out.key = (u32(u >> 32) - kRounderBits) * o.prime_x + (u32(v >> 32) - kRounderBits) * o.prime_z + o.key;
    out.scale = kSimplex2Scale * o.amplitude;
    return out;
}

VX_HD AnchoredOctave anchored3(const NoiseOctave& o, i32 x, i32 z) {
    using namespace noise_detail;
    const u64 bx = u64(i64(x)), bz = u64(i64(z));
    const u64 u = o.shift_x + bx * o.fixed_a + bz * o.fixed_b, v = o.shift_y + (bx + bz) * o.fixed_b,
              w = o.shift_z + bz * o.fixed_a + bx * o.fixed_b;
    AnchoredOctave out;
    out.own = o.a - o.b;
    out.other = o.b;
    out.u = fraction_of(u) - 0.5f;
    out.v = fraction_of(v) - 0.5f;
    out.w = fraction_of(w) - 0.5f;
    out.prime_x = o.prime_x;
    out.prime_y = o.prime_y;
    out.prime_z = o.prime_z;
    out.key = (u32(u >> 32) - kRounderBits) * o.prime_x + (u32(v >> 32) - kRounderBits) * o.prime_y +
              (u32(w >> 32) - kRounderBits) * o.prime_z + o.key;
    out.scale = kSimplex3Scale * o.amplitude;
    return out;
}

// -1..1 times the octave's amplitude, at blocks dx, dz from the anchor.
template <class L>
VX_HD typename L::F simplex2(const AnchoredOctave& o, typename L::F dx, typename L::F dz) {
    using namespace noise_detail;
    using F = typename L::F;
    using U = typename L::U;
    // Lattice coordinates less one half: rounding these to the nearest is rounding down. On a cell's border either cell
    // will do.
    const F u = dx * o.own + dz * o.other + o.u, v = dz * o.own + dx * o.other + o.v;
    const F ru = u + kRounder, rv = v + kRounder;
    const F fu = u - (ru - kRounder), fv = v - (rv - kRounder); // -0.5..0.5
    const F t = (fu + fv) * kSimplex2Unskew - (0.5f - kSimplex2Unskew);
    const F x0 = fu - t, y0 = fv - t;
    const auto x_first = x0 > y0;
    constexpr float g = kSimplex2Unskew;
    const F stay = L::f(g), step = L::f(g - 1.0f);
    const U h0 = float_bits(ru) * o.prime_x + float_bits(rv) * o.prime_z + o.key;
    const U h1 = h0 + select(x_first, L::u(o.prime_x), L::u(o.prime_z)), h2 = h0 + (o.prime_x + o.prime_z);
    const F n = corner2<L>(h0, x0, y0) +
                corner2<L>(h1, x0 + select(x_first, step, stay), y0 + select(x_first, stay, step)) +
                corner2<L>(h2, x0 + (2.0f * g - 1.0f), y0 + (2.0f * g - 1.0f));
    return n * o.scale;
}

// Likewise; `sum`: of dx, dz and dy, in this order.
template <class L>
VX_HD typename L::F simplex3(const AnchoredOctave& o, typename L::F dx, typename L::F dy, typename L::F dz,
                             typename L::F sum) {
    using namespace noise_detail;
    using F = typename L::F;
    using U = typename L::U;
    const F skew = sum * o.other;
    const F u = dx * o.own + skew + o.u, v = dy * o.own + skew + o.v, w = dz * o.own + skew + o.w; // as simplex2
    const F ru = u + kRounder, rv = v + kRounder, rw = w + kRounder;
    const F fu = u - (ru - kRounder), fv = v - (rv - kRounder), fw = w - (rw - kRounder);
    const F t = (fu + fv + fw) * kSimplex3Unskew - (0.5f - 1.5f * kSimplex3Unskew);
    const F x0 = fu - t, y0 = fv - t, z0 = fw - t;
    // The second corner steps along the largest offset, the third along all but the least.
    const auto xy = x0 >= y0, yz = y0 >= z0, xz = x0 >= z0;
    const auto x_most = xy & xz, z_less = xz | yz, x_more = xy | xz, z_least = xz & yz;
    constexpr float g = kSimplex3Unskew;
    const F stay1 = L::f(g), step1 = L::f(g - 1.0f), stay2 = L::f(2.0f * g), step2 = L::f(2.0f * g - 1.0f);
    const F x1 = x0 + select(x_most, step1, stay1), y1 = y0 + select(xy, stay1, select(yz, step1, stay1)),
            z1 = z0 + select(z_less, stay1, step1);
    const F x2 = x0 + select(x_more, step2, stay2), y2 = y0 + select(xy, select(yz, step2, stay2), step2),
            z2 = z0 + select(z_least, stay2, step2);
    constexpr float last = 3.0f * g - 1.0f;
    const u32 px = o.prime_x, py = o.prime_y, pz = o.prime_z, all = px + py + pz;
    const U h0 = float_bits(ru) * px + float_bits(rv) * py + float_bits(rw) * pz + o.key;
    const U h1 = h0 + select(x_most, L::u(px), select(z_less, L::u(py), L::u(pz)));
    const U h2 = h0 + select(z_least, L::u(all - pz), select(x_more, L::u(all - py), L::u(all - px)));
    const F n = corner3<L>(h0, x0, y0, z0) + corner3<L>(h1, x1, y1, z1) + corner3<L>(h2, x2, y2, z2) +
                corner3<L>(h0 + all, x0 + last, y0 + last, z0 + last);
    return n * o.scale;
}

template <class L>
VX_HD typename L::F simplex2(const NoiseOctave& o, const Spot<L>& p) {
    return simplex2<L>(anchored2(o, p.x, p.z), p.dx, p.dz);
}
template <class L>
VX_HD typename L::F simplex3(const NoiseOctave& o, const Spot<L>& p) {
    return simplex3<L>(anchored3(o, p.x, p.z), p.dx, p.dy, p.dz, p.dx + p.dz + p.dy);
}

// Octaves one after another.
template <class L>
VX_HD_FN typename L::F fractal2(const NoiseOctave* octaves, i32 count, const Spot<L>& p) {
    typename L::F sum = simplex2<L>(octaves[0], p);
    for (i32 i = 1; i < count; ++i)
        sum = sum + simplex2<L>(octaves[i], p);
    return sum;
}
template <class L>
VX_HD_FN typename L::F fractal3(const NoiseOctave* octaves, i32 count, const Spot<L>& p) {
    typename L::F sum = simplex3<L>(octaves[0], p);
    for (i32 i = 1; i < count; ++i)
        sum = sum + simplex3<L>(octaves[i], p);
    return sum;
}

// The same for many rows of one anchor: octaves anchored once. Inlined, as worley3: clang 19 misaligns vectors of 128 bytes
// (PairLanes) that are passed to a function while AddressSanitizer moves the stack.
template <class L>
VX_HD typename L::F fractal2(const AnchoredOctave* octaves, i32 count, typename L::F dx, typename L::F dz) {
    typename L::F sum = simplex2<L>(octaves[0], dx, dz);
    for (i32 i = 1; i < count; ++i)
        sum = sum + simplex2<L>(octaves[i], dx, dz);
    return sum;
}
template <class L>
VX_HD typename L::F fractal3(const AnchoredOctave* octaves, i32 count, typename L::F dx, typename L::F dy,
                                typename L::F dz) {
    const typename L::F all = dx + dz + dy;
    typename L::F sum = simplex3<L>(octaves[0], dx, dy, dz, all);
    for (i32 i = 1; i < count; ++i)
        sum = sum + simplex3<L>(octaves[i], dx, dy, dz, all);
    return sum;
}

// Distances to the nearest, second and third of the points, one in each unit cell; `cell` is random bits of the
// nearest.
template <class L>
struct Cellular {
    typename L::F f1, f2, f3;
    typename L::U cell;
};

// Two dimensions, 3 x 3 cells: exact for F1 up to 1, beyond it (one place in a thousand) and for F2 nearly so, and the
// same for everybody.
template <class L>
VX_HD_FN Cellular<L> worley2(const NoiseOctave& o, const Spot<L>& p) {
    using F = typename L::F;
    using U = typename L::U;
    const u64 base_u = o.shift_x + u64(i64(p.x)) * o.fixed_a, base_v = o.shift_z + u64(i64(p.z)) * o.fixed_a;
    F u = p.dx * o.a + noise_detail::fraction_of(base_u), v = p.dz * o.a + noise_detail::fraction_of(base_v);
    const auto iu = floor_int<L>(u), iv = floor_int<L>(v);
    u = u - to_float(iu);
    v = v - to_float(iv);
    const U h0 = (as_uint(iu) + u32(base_u >> 32)) * o.prime_x + (as_uint(iv) + u32(base_v >> 32)) * o.prime_z + o.key;
    Cellular<L> out{L::f(64.0f), L::f(64.0f), L::f(64.0f), L::u(0)};
    for (i32 dz = -1; dz <= 1; ++dz)
        for (i32 dx = -1; dx <= 1; ++dx) {
            const U h = noise_detail::lattice_bits(h0 + (u32(dx) * o.prime_x + u32(dz) * o.prime_z));
            const F x = noise_detail::from_one(h << 7 & 0x7fff80u) + (float(dx - 1) - u);
            const F y = noise_detail::from_one(h >> 9 & 0x7fff80u) + (float(dz - 1) - v);
            const F d = x * x + y * y;
            out.f3 = least(out.f3, greatest(out.f2, d));
            out.f2 = least(out.f2, greatest(out.f1, d));
            out.cell = select(d < out.f1, h, out.cell);
            out.f1 = least(out.f1, d);
        }
    out.f1 = square_root(out.f1);
    out.f2 = square_root(out.f2);
    out.f3 = square_root(out.f3);
    out.cell = mix_bits(out.cell + 0x68bc21ebu);
    return out;
}

// Three dimensions, 3 x 3 x 3 cells, likewise. `stretch_y` multiplies y's frequency; `warp` moves the place, in cells.
template <class L>
VX_HD Cellular<L> worley3(const NoiseOctave& o, const Spot<L>& p, float stretch_y, typename L::F warp_x,
                             typename L::F warp_y, typename L::F warp_z) {
    using F = typename L::F;
    using U = typename L::U;
    const u64 base_u = o.shift_x + u64(i64(p.x)) * o.fixed_a, base_w = o.shift_z + u64(i64(p.z)) * o.fixed_a;
    F u = p.dx * o.a + noise_detail::fraction_of(base_u) + warp_x,
      w = p.dz * o.a + noise_detail::fraction_of(base_w) + warp_z;
    F v = p.dy * (o.a * stretch_y) + noise_detail::fraction_of(o.shift_y) + warp_y;
    const auto iu = floor_int<L>(u), iv = floor_int<L>(v), iw = floor_int<L>(w);
    u = u - to_float(iu);
    v = v - to_float(iv);
    w = w - to_float(iw);
    const U h0 = (as_uint(iu) + u32(base_u >> 32)) * o.prime_x + as_uint(iv) * o.prime_y +
                 (as_uint(iw) + u32(base_w >> 32)) * o.prime_z + o.key;
    Cellular<L> out{L::f(64.0f), L::f(64.0f), L::f(64.0f), L::u(0)};
    for (i32 dy = -1; dy <= 1; ++dy)
        for (i32 dz = -1; dz <= 1; ++dz)
            for (i32 dx = -1; dx <= 1; ++dx) {
                const U h =
                    noise_detail::lattice_bits(h0 + (u32(dx) * o.prime_x + u32(dy) * o.prime_y + u32(dz) * o.prime_z));
                const F x = noise_detail::from_one(h << 13 & 0x7fe000u) + (float(dx - 1) - u);
                const F y = noise_detail::from_one(h << 3 & 0x7fe000u) + (float(dy - 1) - v);
                const F z = noise_detail::from_one(h >> 7 & 0x7fe000u) + (float(dz - 1) - w);
                const F d = x * x + y * y + z * z;
                out.f3 = least(out.f3, greatest(out.f2, d));
                out.f2 = least(out.f2, greatest(out.f1, d));
                out.cell = select(d < out.f1, h, out.cell);
                out.f1 = least(out.f1, d);
            }
    out.f1 = square_root(out.f1);
    out.f2 = square_root(out.f2);
    out.f3 = square_root(out.f3);
    out.cell = mix_bits(out.cell + 0x68bc21ebu);
    return out;
}

} // namespace vitrail
