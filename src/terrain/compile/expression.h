// The small language in which content writes numbers that follow from noise (docs/terrain.md), compiled to programs
// that kernels run (kernel/program_kernel.h).
//
//     n = abs(F(.0035)) + .05; 165 + 140(n^2 - .15) + 20 n F(.035)
//
// NAME = VALUE; any number of them before the value: computed once, read by name after.
// numbers 16 .0065 · + - * / ^ and unary minus · a b without a sign between is a * b · parentheses
// F(s) F1..F8(s)   2-D simplex fractal of frequency s a block, 5 (or 1..8) octaves, -1..1
// G(s) G1..G8(s)   the same in 3-D        S(s)  one 2-D octave, of amplitude 1
// W(s) E(s) R(s)   2-D Worley noise: F1, (F2 - F1) / 2 and a random number 0..1 of the nearest point; those of the same
//                  frequency in one text belong to the same points
// ss(a, b, x)      smoothstep, descending where a > b
// abs(x) sqrt(x) min(x, y, ..) max(x, y, ..) pow(x, y): x^y, 0 where x <= 0
// warp(x, z, v)    v at a place moved by x and z blocks; not one within another
// Everything else is a name: of a value before, or of an input (attributes, height).
//
// Two noises in one text differ, even of the same frequency: their random numbers follow from `owner` and from how many
// noises stand before. x^2, x^3 and x^4 are products and take negative x; other powers are pow. Division by 0 gives 0.
#pragma once

#include "base/result.h"
#include "terrain/compile/noise_tables.h"
#include "terrain/tables.h"

#include <string_view>

namespace vitrail {

inline constexpr u32 kExpressionLengthMost = 2000, kExpressionDepthMost = 48; // characters; nested parts

// owner: unique in the description, stays when rows around change; also names the error. Errors: invalid_argument
// ("OWNER: column N: expected ..."), limit (length, depth, registers, tables).
Result<Program> compile_expression(std::string_view text, std::string_view owner, TableBuilder& builder);

// "F3(.05)" alone: a fractal's octaves and frequency. Errors: invalid_argument.
struct FractalText {
    u32 octaves = 0;
    double frequency = 0;
};
Result<FractalText> parse_fractal(std::string_view text, std::string_view owner);

} // namespace vitrail
