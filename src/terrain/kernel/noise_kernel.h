// Simplex and cellular noise (Perlin 2001; Gustavson 2005; Worley 1996) without loss at any distance: the lattice
// coordinate of the anchor, a block whose x and z are multiples of 16, is computed in 32.32 fixed point; floats hold only
// offsets from it. A block's value is always computed from its own anchor, so it does not depend on who asks.
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
    u64 fixed_a = 0, fixed_b = 0; // a, b in units of 2^-32
    u64 shift_x = 0, shift_y = 0, shift_z = 0; // so that lattices of two noises never share an origin
    float a = 0, b = 0;
    u32 prime_x = 1, prime_y = 1, prime_z = 1, key = 0; // odd multipliers of its own: no period in common
    float amplitude = 1;
    u32 padding = 0;
};

inline constexpr float kSimplex2Unskew = 0.211324865405187f; // (3 - sqrt 3) / 6
inline constexpr float kSimplex3Unskew = 1.0f / 6.0f;
inline constexpr float kSimplex2Scale = 99.2043345f; // 1 / the largest sum with gradients of length 1
inline constexpr float kSimplex3Scale = 76.0f;       // with gradients of length sqrt 2

namespace noise_detail {

template <class U>
VX_HD U lattice_bits(U h) {
    h = h ^ h >> 15;
    h = h * 0x2c1b3c6du;
    h = h ^ h >> 12;
    h = h * 0x297a2d39u;
    return h ^ h >> 15;
}

VX_HD float fraction_of(u64 phase) { return float(i32(u32(phase) >> 8)) * (1.0f / 16777216.0f); }

// Falloff and gradient of one corner. Eight directions, 22.5 degrees off the axes, so that no line of the lattice shows.
template <class L>
VX_HD typename L::F corner2(typename L::U h, typename L::F x, typename L::F y) {
    using F = typename L::F;
    const F t = greatest(0.5f - x * x - y * y, L::f(0.0f));
    const auto swap = as_int(h << 29) < L::i(0);
    const F u = select(swap, y, x), v = select(swap, x, y);
    const F gu = select(as_int(h << 31) < L::i(0), -u, u), gv = select(as_int(h << 30) < L::i(0), -v, v);
    const F t2 = t * t;
    return t2 * t2 * (gu * 0.923879533f + gv * 0.382683432f);
}

// Twelve directions to the middles of a cube's edges (Perlin 2002).
template <class L>
VX_HD typename L::F corner3(typename L::U h, typename L::F x, typename L::F y, typename L::F z) {
    using F = typename L::F;
    const F t = greatest(0.5f - x * x - y * y - z * z, L::f(0.0f));
    const typename L::U low = h & 15u;
    const F u = select(low < L::u(8), x, y);
    const F v = select(low < L::u(4), y, select((low | 2u) == L::u(14), x, z));
    const F g = select(as_int(h << 31) < L::i(0), -u, u) + select(as_int(h << 30) < L::i(0), -v, v);
    const F t2 = t * t;
    return t2 * t2 * g;
}

} // namespace noise_detail

// -1..1
template <class L>
VX_HD_FN typename L::F simplex2(const NoiseOctave& o, const Spot<L>& p) {
    using namespace noise_detail;
    using F = typename L::F;
    using U = typename L::U;
    const u64 bx = u64(i64(p.x)), bz = u64(i64(p.z));
    const u64 base_u = o.shift_x + bx * o.fixed_a + bz * o.fixed_b, base_v = o.shift_z + bz * o.fixed_a + bx * o.fixed_b;
    F u = p.dx * o.a + p.dz * o.b + fraction_of(base_u), v = p.dz * o.a + p.dx * o.b + fraction_of(base_v);
    const auto iu = floor_int<L>(u), iv = floor_int<L>(v);
    u = u - to_float(iu);
    v = v - to_float(iv);
    const F t = (u + v) * kSimplex2Unskew;
    const F x0 = u - t, y0 = v - t;
    const auto x_first = x0 > y0;
    const F one = L::f(1.0f), zero = L::f(0.0f);
    const F x1 = x0 - select(x_first, one, zero) + kSimplex2Unskew, y1 = y0 - select(x_first, zero, one) + kSimplex2Unskew;
    const F x2 = x0 - (1.0f - 2.0f * kSimplex2Unskew), y2 = y0 - (1.0f - 2.0f * kSimplex2Unskew);
    const U h0 = (as_uint(iu) + u32(base_u >> 32)) * o.prime_x + (as_uint(iv) + u32(base_v >> 32)) * o.prime_z + o.key;
    const U h1 = h0 + select(x_first, L::u(o.prime_x), L::u(o.prime_z)), h2 = h0 + (o.prime_x + o.prime_z);
    const F n = corner2<L>(lattice_bits(h0), x0, y0) + corner2<L>(lattice_bits(h1), x1, y1) + corner2<L>(lattice_bits(h2), x2, y2);
    return n * kSimplex2Scale;
}

// -1..1
template <class L>
VX_HD_FN typename L::F simplex3(const NoiseOctave& o, const Spot<L>& p) {
    using namespace noise_detail;
    using F = typename L::F;
    using U = typename L::U;
    const u64 bx = u64(i64(p.x)), bz = u64(i64(p.z));
    const u64 base_u = o.shift_x + bx * o.fixed_a + bz * o.fixed_b, base_v = o.shift_y + (bx + bz) * o.fixed_b,
              base_w = o.shift_z + bz * o.fixed_a + bx * o.fixed_b;
    const F skew = (p.dx + p.dy + p.dz) * o.b;
    const float own = o.a - o.b;
    F u = p.dx * own + skew + fraction_of(base_u), v = p.dy * own + skew + fraction_of(base_v),
      w = p.dz * own + skew + fraction_of(base_w);
    const auto iu = floor_int<L>(u), iv = floor_int<L>(v), iw = floor_int<L>(w);
    u = u - to_float(iu);
    v = v - to_float(iv);
    w = w - to_float(iw);
    const F t = (u + v + w) * kSimplex3Unskew;
    const F x0 = u - t, y0 = v - t, z0 = w - t;
    const auto xy = x0 >= y0, yz = y0 >= z0, xz = x0 >= z0;
    // The second corner steps along the largest offset, the third along all but the least.
    const F one = L::f(1.0f), zero = L::f(0.0f);
    const F i1 = select(xy & xz, one, zero), j1 = select(xy, zero, select(yz, one, zero)), k1 = select(xz | yz, zero, one);
    const F i2 = select(xy | xz, one, zero), j2 = select(xy, select(yz, one, zero), one), k2 = select(xz & yz, zero, one);
    const U cu = (as_uint(iu) + u32(base_u >> 32)) * o.prime_x, cv = (as_uint(iv) + u32(base_v >> 32)) * o.prime_y,
            cw = (as_uint(iw) + u32(base_w >> 32)) * o.prime_z;
    const U h0 = cu + cv + cw + o.key, none = L::u(0);
    const U px = L::u(o.prime_x), py = L::u(o.prime_y), pz = L::u(o.prime_z);
    const U h1 = h0 + select(xy & xz, px, select(xz | yz, select(xy, none, py), pz));
    const U h2 = h0 + (select(xy | xz, px, none) + select(xy, select(yz, py, none), py) + select(xz & yz, none, pz));
    const U h3 = h0 + (o.prime_x + o.prime_y + o.prime_z);
    constexpr float g = kSimplex3Unskew;
    F n = corner3<L>(lattice_bits(h0), x0, y0, z0);
    n = n + corner3<L>(lattice_bits(h1), x0 - i1 + g, y0 - j1 + g, z0 - k1 + g);
    n = n + corner3<L>(lattice_bits(h2), x0 - i2 + 2.0f * g, y0 - j2 + 2.0f * g, z0 - k2 + 2.0f * g);
    n = n + corner3<L>(lattice_bits(h3), x0 - (1.0f - 3.0f * g), y0 - (1.0f - 3.0f * g), z0 - (1.0f - 3.0f * g));
    return n * kSimplex3Scale;
}

// Octaves one after another, each times its amplitude.
template <class L>
VX_HD_FN typename L::F fractal2(const NoiseOctave* octaves, i32 count, const Spot<L>& p) {
    typename L::F sum = simplex2<L>(octaves[0], p) * octaves[0].amplitude;
    for (i32 i = 1; i < count; ++i)
        sum = sum + simplex2<L>(octaves[i], p) * octaves[i].amplitude;
    return sum;
}
template <class L>
VX_HD_FN typename L::F fractal3(const NoiseOctave* octaves, i32 count, const Spot<L>& p) {
    typename L::F sum = simplex3<L>(octaves[0], p) * octaves[0].amplitude;
    for (i32 i = 1; i < count; ++i)
        sum = sum + simplex3<L>(octaves[i], p) * octaves[i].amplitude;
    return sum;
}

// Distances to the nearest, second and third of the points, one in each unit cell; `cell` is random bits of the nearest.
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
            const F x = to_float(h & 0xffffu) * (1.0f / 65536.0f) + float(dx) - u;
            const F y = to_float(h >> 16) * (1.0f / 65536.0f) + float(dz) - v;
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
VX_HD_FN Cellular<L> worley3(const NoiseOctave& o, const Spot<L>& p, float stretch_y, typename L::F warp_x, typename L::F warp_y,
                             typename L::F warp_z) {
    using F = typename L::F;
    using U = typename L::U;
    const u64 base_u = o.shift_x + u64(i64(p.x)) * o.fixed_a, base_w = o.shift_z + u64(i64(p.z)) * o.fixed_a;
    F u = p.dx * o.a + noise_detail::fraction_of(base_u) + warp_x, w = p.dz * o.a + noise_detail::fraction_of(base_w) + warp_z;
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
                const U h = noise_detail::lattice_bits(h0 + (u32(dx) * o.prime_x + u32(dy) * o.prime_y + u32(dz) * o.prime_z));
                const F x = to_float(h & 1023u) * (1.0f / 1024.0f) + float(dx) - u;
                const F y = to_float(h >> 10 & 1023u) * (1.0f / 1024.0f) + float(dy) - v;
                const F z = to_float(h >> 20 & 1023u) * (1.0f / 1024.0f) + float(dz) - w;
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
