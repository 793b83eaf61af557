// Noise and programs over whole columns on a CPU, outside the stages: for tests, benchmarks and pictures. Compiled
// three times as the stages are (noise_rows_*.cpp); the bits are the same.
#pragma once

#include "terrain/cpu/stages.h"

namespace vitrail {

struct NoiseRows {
    // out: 256 values, x | z << 4.
    void (*fractal2)(const NoiseOctave*, i32 count, ColumnPos at, float* out) = nullptr;
    // out: 256 values a level, from y = first on.
    void (*fractal3)(const NoiseOctave*, i32 count, ColumnPos at, i32 first, i32 levels, float* out) = nullptr;
    // out: F1, F2, F3 and unit_of(cell), 256 values each.
    void (*cells2)(const NoiseOctave&, ColumnPos at, float* out) = nullptr;
    void (*cells3)(const NoiseOctave&, ColumnPos at, i32 y, float stretch_y, float* out) = nullptr;
    // At y. inputs: kInputs values for the whole column.
    void (*program)(const TerrainTables&, Program, ColumnPos at, i32 y, const float* inputs, float* out) = nullptr;
};

const NoiseRows& noise_rows(Isa isa); // the CPU must have it

} // namespace vitrail
