// Runs a program of the tables for one row of block columns.
#pragma once

#include "terrain/kernel/power_kernel.h"
#include "terrain/tables.h"

namespace vitrail {

namespace program_detail {

// Division; 0 where b is 0.
template <class L>
VX_HD typename L::F divide(typename L::F a, typename L::F b) {
    const auto none = b == L::f(0.0f);
    return select(none, L::f(0.0f), a / select(none, L::f(1.0f), b));
}
// Smoothstep between edges a and b; equal edges step at once.
template <class L>
VX_HD typename L::F smoothstep(typename L::F a, typename L::F b, typename L::F v) {
    const typename L::F width = b - a;
    const auto none = width == L::f(0.0f);
    const typename L::F s = clamp01<L>((v - a) / select(none, L::f(1.0f), width));
    return select(none, select(v < a, L::f(0.0f), L::f(1.0f)), s * s * (3.0f - 2.0f * s));
}

// A warp's blocks, so that whatever a program says, places stay where noise can be read.
template <class L>
VX_HD typename L::F within(typename L::F v) {
    return greatest(least(v, L::f(4096.0f)), L::f(-4096.0f));
}

} // namespace program_detail

// inputs: kInputs values (attributes, height), or null where the program reads none.
template <class L>
VX_HD_FN typename L::F run_program(const TerrainTables& t, Program program, const Spot<L>& place,
                                   const typename L::F* inputs) {
    using F = typename L::F;
    F r[kProgramRegisters];
    r[0] = L::f(0.0f);
    Spot<L> p = place;
    for (u32 i = program.first; i < u32(program.first) + program.count; ++i) {
        const Instruction in = t.instruction[i];
        const Noise noise = t.noise[in.noise];
        const NoiseOctave* octaves = &t.octave[noise.first];
        switch (in.op) {
        case Op::constant:
            r[in.to] = L::f(in.k);
            break;
        case Op::input:
            r[in.to] = inputs[in.a];
            break;
        case Op::add:
            r[in.to] = r[in.a] + r[in.b];
            break;
        case Op::subtract:
            r[in.to] = r[in.a] - r[in.b];
            break;
        case Op::multiply:
            r[in.to] = r[in.a] * r[in.b];
            break;
        case Op::divide:
            r[in.to] = program_detail::divide<L>(r[in.a], r[in.b]);
            break;
        case Op::least:
            r[in.to] = least(r[in.a], r[in.b]);
            break;
        case Op::greatest:
            r[in.to] = greatest(r[in.a], r[in.b]);
            break;
        case Op::absolute:
            r[in.to] = absolute<L>(r[in.a]);
            break;
        case Op::square_root:
            r[in.to] = square_root(greatest(r[in.a], L::f(0.0f)));
            break;
        case Op::negate:
            r[in.to] = -r[in.a];
            break;
        case Op::power:
            r[in.to] = power_of<L>(r[in.a], r[in.b]);
            break;
        case Op::smoothstep:
            r[in.to] = program_detail::smoothstep<L>(r[in.a], r[in.b], r[in.c]);
            break;
        case Op::fractal2:
            r[in.to] = fractal2<L>(octaves, noise.octaves, p);
            break;
        case Op::fractal3:
            r[in.to] = fractal3<L>(octaves, noise.octaves, p);
            break;
        case Op::cell_distance:
            r[in.to] = worley2<L>(octaves[0], p).f1;
            break;
        case Op::cell_edge: {
            const Cellular<L> c = worley2<L>(octaves[0], p);
            r[in.to] = (c.f2 - c.f1) * 0.5f;
            break;
        }
        case Op::cell_random:
            r[in.to] = unit_of(worley2<L>(octaves[0], p).cell);
            break;
        case Op::warp:
            p.dx = place.dx + program_detail::within<L>(r[in.a]);
            p.dz = place.dz + program_detail::within<L>(r[in.b]);
            break;
        case Op::unwarp:
            p = place;
            break;
        }
    }
    return r[0];
}

} // namespace vitrail
