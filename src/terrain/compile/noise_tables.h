// Octaves of noise as kernels read them (kernel/noise_kernel.h), made for a frequency, a seed and a purpose. Only
// exactly rounded double operations, so that every machine and compiler makes the same tables.
#pragma once

#include "base/result.h"
#include "terrain/tables.h"

#include <span>
#include <string>
#include <vector>

namespace vitrail {

enum class NoiseKind : u8 { simplex2, simplex3, cellular };

// Of the first octave, lattice cells a block.
inline constexpr double kFrequencyMost = 0.5;
inline constexpr u32 kFractalOctavesMost = 8;

// The octave-th octave of a noise: its frequency as given, amplitude 1. frequency: above 0, below 2^10.
NoiseOctave make_octave(NoiseKind kind, double frequency, u64 seed, u64 purpose, u32 octave);

// Adds noises and programs to tables whose seed is set.
class TableBuilder {
public:
    explicit TableBuilder(TerrainTables& tables)
        : tables_(tables) {}

    // `octaves` of them, each of twice the frequency of the last and half its amplitude, the first 1/2; a single one
    // has amplitude 1. Returns the index in tables.noise. Errors: invalid_argument (frequency, octaves), limit (tables
    // full).
    Result<u16> add_noise(NoiseKind kind, double frequency, u32 octaves, u64 purpose);
    Noise noise(u16 index) const { return tables_.noise[index]; }
    // Errors: limit.
    Result<Program> add_program(std::span<const Instruction> code);

    // Names that expressions may read, by input number of the program; empty: not readable.
    std::vector<std::string> inputs;

private:
    TerrainTables& tables_;
    u32 noises_ = 0, octaves_ = 0, instructions_ = 0;
};

} // namespace vitrail
