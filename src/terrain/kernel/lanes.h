// Lanes: one kernel source for 16 block columns at a time on a CPU and for one a thread on a GPU. A kernel is a
// template over L, with L::F floats, L::I and L::U 32-bit integers, L::M masks; operators are those of the types, the
// functions below are the rest. Scalar numbers on the right of an operator spread over all lanes; L::f(v), L::i(v),
// L::u(v) spread by hand. Every operation is exact or rounded as IEEE 754 says, so that all lane types give the same
// bits.
#pragma once

#include "base/hd.h"
#include "base/types.h"

#ifdef __CUDACC__
#include <cmath>
#endif

namespace vitrail {

struct ScalarLanes {
    static constexpr i32 kWidth = 1;
    using F = float;
    using I = i32;
    using U = u32;
    using M = bool;
    static VX_HD F f(float v) { return v; }
    static VX_HD I i(i32 v) { return v; }
    static VX_HD U u(u32 v) { return v; }
    static VX_HD F load(const float* p) { return *p; }
    static VX_HD I load(const i32* p) { return *p; }
    static VX_HD U load(const u32* p) { return *p; }
    static VX_HD U load_bytes(const u8* p) { return *p; }
    static VX_HD void store(float* p, F v) { *p = v; }
    static VX_HD void store(i32* p, I v) { *p = v; }
    static VX_HD void store(u32* p, U v) { *p = v; }
    static VX_HD void store_bytes(u8* p, U v) { *p = u8(v); }
    static VX_HD bool any(M m) { return m; }
    static VX_HD bool all(M m) { return m; }
};

VX_HD float select(bool m, float a, float b) {
    return m ? a : b;
}
VX_HD i32 select(bool m, i32 a, i32 b) {
    return m ? a : b;
}
VX_HD u32 select(bool m, u32 a, u32 b) {
    return m ? a : b;
}
VX_HD i32 to_int(float v) {
    return i32(v);
} // towards zero; the value must fit
VX_HD float to_float(i32 v) {
    return float(v);
}
VX_HD float to_float(u32 v) {
    return float(i32(v));
} // below 2^31
VX_HD u32 as_uint(i32 v) {
    return u32(v);
}
VX_HD i32 as_int(u32 v) {
    return i32(v);
}
VX_HD u32 float_bits(float v) {
    u32 bits;
    __builtin_memcpy(&bits, &v, sizeof bits);
    return bits;
}
VX_HD float float_of_bits(u32 bits) {
    float v;
    __builtin_memcpy(&v, &bits, sizeof v);
    return v;
}
VX_HD float square_root(float v) {
#ifdef __CUDACC__
    return sqrtf(v);
#else
    return __builtin_sqrtf(v);
#endif
}

#ifndef __CUDACC__
using FloatLanes = float __attribute__((vector_size(64)));
using IntLanes = i32 __attribute__((vector_size(64)));
using UintLanes = u32 __attribute__((vector_size(64)));

// Isa only keeps the instantiations of differently compiled files apart (cpu/stages.h lists them).
template <int Isa>
struct WideLanes {
    static constexpr i32 kWidth = 16;
    using F = FloatLanes;
    using I = IntLanes;
    using U = UintLanes;
    using M = IntLanes; // 0 or -1
    static VX_HD F f(float v) { return F{} + v; }
    static VX_HD I i(i32 v) { return I{} + v; }
    static VX_HD U u(u32 v) { return U{} + v; }
    template <class V, class T>
    static VX_HD V load_as(const T* p) {
        V v;
        __builtin_memcpy(&v, p, sizeof v);
        return v;
    }
    static VX_HD F load(const float* p) { return load_as<F>(p); }
    static VX_HD I load(const i32* p) { return load_as<I>(p); }
    static VX_HD U load(const u32* p) { return load_as<U>(p); }
    static VX_HD void store(float* p, F v) { __builtin_memcpy(p, &v, sizeof v); }
    static VX_HD void store(i32* p, I v) { __builtin_memcpy(p, &v, sizeof v); }
    static VX_HD void store(u32* p, U v) { __builtin_memcpy(p, &v, sizeof v); }
    using Bytes16 = u8 __attribute__((vector_size(16)));
    static VX_HD U load_bytes(const u8* p) {
        Bytes16 b;
        __builtin_memcpy(&b, p, sizeof b);
        return __builtin_convertvector(b, U);
    }
    static VX_HD void store_bytes(u8* p, U v) {
        const Bytes16 b = __builtin_convertvector(v, Bytes16);
        __builtin_memcpy(p, &b, sizeof b);
    }
    static VX_HD bool any(M m) {
        u64 w[8];
        __builtin_memcpy(w, &m, sizeof w);
        return ((w[0] | w[1]) | (w[2] | w[3]) | (w[4] | w[5]) | (w[6] | w[7])) != 0;
    }
    static VX_HD bool all(M m) { return !any(~m); }
};

VX_HD FloatLanes select(IntLanes m, FloatLanes a, FloatLanes b) {
    return m ? a : b;
}
VX_HD IntLanes select(IntLanes m, IntLanes a, IntLanes b) {
    return m ? a : b;
}
VX_HD UintLanes select(IntLanes m, UintLanes a, UintLanes b) {
    return m ? a : b;
}
VX_HD IntLanes to_int(FloatLanes v) {
    return __builtin_convertvector(v, IntLanes);
}
VX_HD FloatLanes to_float(IntLanes v) {
    return __builtin_convertvector(v, FloatLanes);
}
VX_HD FloatLanes to_float(UintLanes v) {
    return __builtin_convertvector((IntLanes)v, FloatLanes);
}
VX_HD UintLanes as_uint(IntLanes v) {
    return (UintLanes)v;
}
VX_HD IntLanes as_int(UintLanes v) {
    return (IntLanes)v;
}
VX_HD UintLanes float_bits(FloatLanes v) {
    return (UintLanes)v;
}
VX_HD FloatLanes float_of_bits(UintLanes bits) {
    return (FloatLanes)bits;
}
VX_HD FloatLanes square_root(FloatLanes v) {
#if defined(__clang__)
    return __builtin_elementwise_sqrt(v);
#else
    FloatLanes r;
    for (int i = 0; i < 16; ++i)
        r[i] = __builtin_sqrtf(v[i]);
    return r;
#endif
}

// Two rows of 16 at once, for what is nothing but arithmetic: a chain of operations as long as noise leaves half of a
// CPU idle when it waits alone. Lanes 16.. are the second row.
using FloatPair = float __attribute__((vector_size(128)));
using IntPair = i32 __attribute__((vector_size(128)));
using UintPair = u32 __attribute__((vector_size(128)));

template <int Isa>
struct PairLanes {
    static constexpr i32 kWidth = 32;
    using F = FloatPair;
    using I = IntPair;
    using U = UintPair;
    using M = IntPair; // 0 or -1
    static VX_HD F f(float v) { return F{} + v; }
    static VX_HD F f(F v) { return v; }
    static VX_HD I i(i32 v) { return I{} + v; }
    static VX_HD U u(u32 v) { return U{} + v; }
    static VX_HD F load(const float* p) {
        F v;
        __builtin_memcpy(&v, p, sizeof v);
        return v;
    }
    static VX_HD void store(float* p, F v) { __builtin_memcpy(p, &v, sizeof v); }
    static VX_HD void store(u32* p, U v) { __builtin_memcpy(p, &v, sizeof v); }
    static VX_HD bool any(M m) {
        IntLanes half[2];
        __builtin_memcpy(half, &m, sizeof m);
        return WideLanes<Isa>::any(half[0] | half[1]);
    }
    static VX_HD bool all(M m) { return !any(~m); }
};

VX_HD FloatPair select(IntPair m, FloatPair a, FloatPair b) {
    return m ? a : b;
}
VX_HD IntPair select(IntPair m, IntPair a, IntPair b) {
    return m ? a : b;
}
VX_HD UintPair select(IntPair m, UintPair a, UintPair b) {
    return m ? a : b;
}
VX_HD IntPair to_int(FloatPair v) {
    return __builtin_convertvector(v, IntPair);
}
VX_HD FloatPair to_float(IntPair v) {
    return __builtin_convertvector(v, FloatPair);
}
VX_HD FloatPair to_float(UintPair v) {
    return __builtin_convertvector((IntPair)v, FloatPair);
}
VX_HD UintPair as_uint(IntPair v) {
    return (UintPair)v;
}
VX_HD IntPair as_int(UintPair v) {
    return (IntPair)v;
}
VX_HD UintPair float_bits(FloatPair v) {
    return (UintPair)v;
}
VX_HD FloatPair float_of_bits(UintPair bits) {
    return (FloatPair)bits;
}
VX_HD FloatPair square_root(FloatPair v) {
    FloatLanes half[2];
    __builtin_memcpy(half, &v, sizeof v);
    for (FloatLanes& h : half)
        h = square_root(h);
    __builtin_memcpy(&v, half, sizeof v);
    return v;
}
#endif

// For every lane type; NaN in `a` gives b, as the comparison says.
template <class F>
VX_HD F least(F a, F b) {
    return select(a < b, a, b);
}
template <class F>
VX_HD F greatest(F a, F b) {
    return select(a > b, a, b);
}
// The other sign where the highest of the bits is set.
template <class F, class U>
VX_HD F flip_sign(F v, U bits) {
    return float_of_bits(float_bits(v) ^ (bits & 0x80000000u));
}
// (template over L for what needs constants)
template <class L>
VX_HD typename L::F clamp01(typename L::F v) {
    return greatest(least(v, L::f(1.0f)), L::f(0.0f));
}
template <class L>
VX_HD typename L::F absolute(typename L::F v) {
    return select(v < L::f(0.0f), -v, v);
}
// Rounded down; |v| < 2^31.
template <class L>
VX_HD typename L::I floor_int(typename L::F v) {
    const typename L::I t = to_int(v);
    return select(to_float(t) > v, t - 1, t);
}
// Hermite step: 0 at a and before, 1 at b and after; a > b descends. a != b.
template <class L>
VX_HD typename L::F step_between(float a, float b, typename L::F v) {
    const typename L::F t = clamp01<L>((v - a) * (1.0f / (b - a)));
    return t * t * (3.0f - 2.0f * t);
}
// With edges of its own in each lane. Another name, because with one lane the two would be the same function with other
// bits.
template <class L>
VX_HD typename L::F step_between_lanes(typename L::F a, typename L::F b, typename L::F v) {
    const typename L::F t = clamp01<L>((v - a) / (b - a));
    return t * t * (3.0f - 2.0f * t);
}

} // namespace vitrail
