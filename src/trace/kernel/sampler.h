// Numbers for a path: Sobol's (0,2)-sequence, Owen-scrambled by hashing (Burley, "Practical Hash-based Owen
// Scrambling", 2020), as many pairs of dimensions as are asked for, each with its own order and its own scrambling.
// Kernel-safe; nothing is looked up.
//
// The first kDithered draws of a path, which decide about most of what is seen, also stand well over the screen: all
// pixels share a sequence there, and each moves it by exclusive or with a point of a second sequence that goes over the
// picture in Morton's order. So the samples of a small block of pixels fill the square evenly, the error of neighbors
// differs, and what is left after a small blur is less than of random numbers (the aim of Ahmed and Wonka,
// "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via Hierarchical Ordering of Pixels", 2020, without
// its fixed number of samples). Each pixel's own samples stay a (0,2)-sequence. Later draws are scrambled for each
// pixel alone.
#pragma once

#include "base/hd.h"
#include "base/types.h"
#include "math/vec.h"

namespace vitrail::trace {

struct Sampler {
    u32 sample;    // number in the pixel's sequence, bits reversed
    u32 place;     // of the pixel in Morton's order, bits reversed
    u32 frame;     // hash of the seed: the same for all pixels
    u32 pixel;     // hash of seed and pixel
    u32 drawn = 0; // draws so far
};

inline constexpr u32 kDithered = 8;

VX_HD constexpr u32 mixed(u32 x) { // a permutation of 32 bits (constants of Wellons, "Hash Function Prospector", 2018)
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x *= 0x846ca68bu;
    return x ^ x >> 16;
}

VX_HD constexpr u32 reversed_bits(u32 x) {
#if defined(__CUDA_ARCH__)
    return __brev(x);
#else
    x = __builtin_bswap32(x);
    x = (x & 0x0f0f0f0fu) << 4 | (x >> 4 & 0x0f0f0f0fu);
    x = (x & 0x33333333u) << 2 | (x >> 2 & 0x33333333u);
    return (x & 0x55555555u) << 1 | (x >> 1 & 0x55555555u);
#endif
}
// Two numbers whose bits are reversed as shares of 2^32, 0..1, by 24 bits.
VX_HD constexpr Vec2 shares_of_reversed(u32 x, u32 y) {
#if defined(__CUDA_ARCH__)
    return {float(__brev(x) >> 8) * 0x1p-24f, float(__brev(y) >> 8) * 0x1p-24f};
#else
    u64 both = __builtin_bswap64(u64(x) << 32 | y);
    both = (both & 0x0f0f0f0f0f0f0f0full) << 4 | (both >> 4 & 0x0f0f0f0f0f0f0f0full);
    both = (both & 0x3333333333333333ull) << 2 | (both >> 2 & 0x3333333333333333ull);
    both = (both & 0x5555555555555555ull) << 1 | (both >> 1 & 0x5555555555555555ull);
    return {float(i32(u32(both) >> 8)) * 0x1p-24f, float(i32(both >> 40)) * 0x1p-24f};
#endif
}

// Owen's scrambling of a number whose bits are reversed: a bit is turned by a hash of those below it alone (Laine and
// Karras, "Stratified Sampling for Stochastic Transparency", 2011; rounds of Vegdahl, "Building a Better LK Hash",
// 2021).
VX_HD constexpr u32 scrambled_reversed(u32 x, u32 seed) {
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// The second of Sobol's dimensions, bits reversed (the first is the index itself): its matrix is Pascal's triangle
// modulo 2, a product of five steps.
VX_HD constexpr u32 second_sobol_reversed(u32 x) {
    x ^= x >> 1 & 0x55555555u;
    x ^= x >> 2 & 0x33333333u;
    x ^= x >> 4 & 0x0f0f0f0fu;
    x ^= x >> 8 & 0x00ff00ffu;
    return x ^ x >> 16;
}

// x and y: pixels; what lies 2^16 apart has the same numbers. sample: number in the pixel's sequence. Same arguments,
// same numbers.
VX_HD constexpr Sampler make_sampler(u32 x, u32 y, u32 sample, u32 seed) {
    const auto spread = [](u32 v) { // bit k to bit 2k
        v &= 0xffffu;
        v = (v | v << 8) & 0x00ff00ffu;
        v = (v | v << 4) & 0x0f0f0f0fu;
        v = (v | v << 2) & 0x33333333u;
        return (v | v << 1) & 0x55555555u;
    };
    const u32 place = spread(x) | spread(y) << 1, frame = mixed(seed + 0x9e3779b9u);
    return {reversed_bits(sample), reversed_bits(place), frame, mixed(place ^ mixed(frame)), 0};
}

// The point of one draw, 0 <= x, y < 1.
VX_HD constexpr Vec2 point_of_draw(const Sampler& s, u32 draw) {
    const bool dithered = draw < kDithered;
    const u32 key = mixed((dithered ? s.frame : s.pixel) + draw * 0x9e3779b9u);
    const u32 index = reversed_bits(scrambled_reversed(s.sample, key));
    u32 x = scrambled_reversed(index, key ^ 0x68bc21ebu);
    u32 y = scrambled_reversed(second_sobol_reversed(index), key ^ 0x02e5be93u);
    if (dithered) {
        const u32 place = reversed_bits(scrambled_reversed(s.place, key ^ 0x967a889bu));
        x ^= scrambled_reversed(place, key ^ 0xb79f3abfu);
        y ^= scrambled_reversed(second_sobol_reversed(place), key ^ 0x3c8a6f5du);
    }
    return shares_of_reversed(x, y);
}

// A point of the unit square.
VX_HD constexpr Vec2 next_2d(Sampler& s) {
    return point_of_draw(s, s.drawn++);
}

// 0 <= result < 1: the x of what next_2d would give.
VX_HD constexpr float next_1d(Sampler& s) {
    const u32 draw = s.drawn++, dithered = draw < kDithered;
    const u32 key = mixed((dithered ? s.frame : s.pixel) + draw * 0x9e3779b9u);
    u32 x = scrambled_reversed(reversed_bits(scrambled_reversed(s.sample, key)), key ^ 0x68bc21ebu);
    if (dithered)
        x ^= scrambled_reversed(reversed_bits(scrambled_reversed(s.place, key ^ 0x967a889bu)), key ^ 0xb79f3abfu);
    return float(i32(reversed_bits(x) >> 8)) * 0x1p-24f;
}

} // namespace vitrail::trace
