// Included by the three noise_rows_*.cpp only, each under flags of its own.
#pragma once

#include "terrain/cpu/noise_rows.h"
#include "terrain/kernel/program_kernel.h"

namespace vitrail {

struct LanePlaces {
    float x[32], z[32];
};
inline constexpr LanePlaces kLanePlaces = [] {
    LanePlaces out{};
    for (i32 l = 0; l < 32; ++l) {
        out.x[l] = float(l & 15);
        out.z[l] = float(l >> 4);
    }
    return out;
}();

// Places of the lanes: 16 of row z, or of rows z and z + 1.
template <class L>
VX_HD void lane_places(i32 z, typename L::F& dx, typename L::F& dz) {
    dx = L::load(kLanePlaces.x);
    dz = L::load(kLanePlaces.z) + float(z);
}

template <class L>
void rows_fractal2(const NoiseOctave* octaves, i32 count, ColumnPos at, float* out) {
    AnchoredOctave anchored[8];
    for (i32 i = 0; i < count; ++i)
        anchored[i] = anchored2(octaves[i], i32(u32(at.x) << 4), i32(u32(at.z) << 4));
    for (i32 z = 0; z < 16; z += L::kWidth / 16) {
        typename L::F dx, dz;
        lane_places<L>(z, dx, dz);
        L::store(out + (z << 4), fractal2<L>(anchored, count, dx, dz));
    }
}

template <class L>
void rows_fractal3(const NoiseOctave* octaves, i32 count, ColumnPos at, i32 first, i32 levels, float* out) {
    AnchoredOctave anchored[8];
    for (i32 i = 0; i < count; ++i)
        anchored[i] = anchored3(octaves[i], i32(u32(at.x) << 4), i32(u32(at.z) << 4));
    for (i32 z = 0; z < 16; z += L::kWidth / 16) {
        typename L::F dx, dz;
        lane_places<L>(z, dx, dz);
        for (i32 y = 0; y < levels; ++y)
            L::store(out + (y << 8 | z << 4), fractal3<L>(anchored, count, dx, L::f(float(first + y)), dz));
    }
}

template <class L>
void store_cells(float* out, const Cellular<L>& c) {
    L::store(out, c.f1);
    L::store(out + 256, c.f2);
    L::store(out + 512, c.f3);
    L::store(out + 768, unit_of(c.cell));
}

template <class L>
Spot<L> row_spot(ColumnPos at, i32 y, i32 z) {
    Spot<L> spot{i32(u32(at.x) << 4), i32(u32(at.z) << 4), L::f(0.0f), L::f(float(y)), L::f(0.0f)};
    lane_places<L>(z, spot.dx, spot.dz);
    return spot;
}

template <class L>
void rows_cells2(const NoiseOctave& octave, ColumnPos at, float* out) {
    for (i32 z = 0; z < 16; z += L::kWidth / 16)
        store_cells<L>(out + (z << 4), worley2<L>(octave, row_spot<L>(at, 0, z)));
}

template <class L>
void rows_cells3(const NoiseOctave& octave, ColumnPos at, i32 y, float stretch_y, float* out) {
    const typename L::F none = L::f(0.0f);
    for (i32 z = 0; z < 16; z += L::kWidth / 16)
        store_cells<L>(out + (z << 4), worley3<L>(octave, row_spot<L>(at, y, z), stretch_y, none, none, none));
}

template <class L>
void rows_program(const TerrainTables& t, Program program, ColumnPos at, i32 y, const float* inputs, float* out) {
    typename L::F wide[kInputs];
    for (u32 i = 0; i < kInputs; ++i)
        wide[i] = L::f(inputs[i]);
    for (i32 z = 0; z < 16; z += L::kWidth / 16)
        L::store(out + (z << 4), run_program<L>(t, program, row_spot<L>(at, y, z), wide));
}

template <int I>
NoiseRows make_noise_rows() {
    using L = PairLanes<I>;
    return {&rows_fractal2<L>, &rows_fractal3<L>, &rows_cells2<L>, &rows_cells3<L>, &rows_program<WideLanes<I>>};
}

} // namespace vitrail
