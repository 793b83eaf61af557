#include "terrain/compile/noise_tables.h"

#include "terrain/compile/names.h"

#include <fmt/format.h>

namespace vitrail {

namespace {

// A sequence of its own for every (seed, purpose, octave).
class TableRandom {
public:
    TableRandom(u64 seed, u64 purpose, u32 octave)
        : state_(hash_combine(hash_combine(mix64(seed + 0x9e3779b97f4a7c15ull), purpose), octave)) {}
    u64 next() { return mix64(state_ += 0x9e3779b97f4a7c15ull); }

private:
    u64 state_;
};

// Inverse of an odd number modulo 2^32 (Newton's iteration doubles the right bits).
u32 inverse_of_odd(u32 v) {
    u32 r = v;
    for (int i = 0; i < 5; ++i)
        r *= 2 - v * r;
    return r;
}

// Squared length of the shortest shift (a, b) != 0 after which hashes of a * p + b * q repeat, a p + b q = 0 modulo
// 2^32: the shortest vector of that lattice, by the reduction of Lagrange and Gauss.
i64 period_squared(u32 p, u32 q) {
    i64 ax = i64(1) << 32, ay = 0, bx = i64(u32(0u - q * inverse_of_odd(p))), by = 1;
    for (;;) {
        // All components stay below 2^32; products of the first rounds need more than 64 bits.
        const auto aa = __int128(ax) * ax + __int128(ay) * ay, bb = __int128(bx) * bx + __int128(by) * by;
        if (bb > aa) {
            std::swap(ax, bx);
            std::swap(ay, by);
            continue;
        }
        const auto dot = __int128(ax) * bx + __int128(ay) * by;
        const auto twice = 2 * dot + (dot < 0 ? -bb : bb);
        const i64 m = i64(twice / (2 * bb)); // dot / bb to the nearest
        if (m == 0) return i64(bb);
        ax -= m * bx;
        ay -= m * by;
    }
}

// In units of 2^-32, rounded to the nearest; 0 <= v < 2^20.
u64 fixed_of(double v) {
    return u64(v * 4294967296.0 + 0.5);
}

} // namespace

NoiseOctave make_octave(NoiseKind kind, double frequency, u64 seed, u64 purpose, u32 octave) {
    NoiseOctave o;
    double a = frequency, b = 0;
    if (kind == NoiseKind::simplex2) {
        const double skew = 0.36602540378443864676; // (sqrt 3 - 1) / 2
        a = frequency * (1.0 + skew);
        b = frequency * skew;
    } else if (kind == NoiseKind::simplex3) {
        a = frequency * 4.0 / 3.0;
        b = frequency / 3.0;
    }
    o.fixed_a = fixed_of(a);
    o.fixed_b = fixed_of(b);
    o.a = float(a);
    o.b = float(b);
    TableRandom random(seed, purpose, octave);
    o.shift_x = random.next();
    o.shift_y = random.next();
    o.shift_z = random.next();
    o.key = u32(random.next());
    // Two random odd numbers repeat after some 2^16 cells; pairs that do much earlier are thrown again.
    constexpr i64 kPeriodLeast = 20000;
    do {
        o.prime_x = u32(random.next()) | 1u;
        o.prime_y = u32(random.next()) | 1u;
        o.prime_z = u32(random.next()) | 1u;
    } while (period_squared(o.prime_x, o.prime_z) < kPeriodLeast * kPeriodLeast ||
             period_squared(o.prime_x, o.prime_y) < kPeriodLeast * kPeriodLeast ||
             period_squared(o.prime_y, o.prime_z) < kPeriodLeast * kPeriodLeast);
    return o;
}

Result<u16> TableBuilder::add_noise(NoiseKind kind, double frequency, u32 octaves, u64 purpose) {
    if (octaves < 1 || octaves > kFractalOctavesMost || (kind == NoiseKind::cellular && octaves != 1))
        return fail(ErrorCode::invalid_argument,
                    fmt::format("{} octaves; expected 1 to {}, and 1 of cellular noise", octaves, kFractalOctavesMost));
    // The comparison also refuses what is no number; below the least one nothing changes within the world's width.
    if (!(frequency >= 1e-6 && frequency <= kFrequencyMost))
        return fail(ErrorCode::invalid_argument,
                    fmt::format("frequency {}; expected 0.000001 to {} a block", frequency, kFrequencyMost));
    if (noises_ >= kNoisesMost || octaves_ + octaves > kOctavesMost)
        return fail(ErrorCode::limit, fmt::format("more than {} noises or {} octaves", kNoisesMost, kOctavesMost));
    const u32 index = noises_++;
    tables_.noise[index] = {u16(octaves_), u16(octaves)};
    for (u32 i = 0; i < octaves; ++i) {
        const double times = double(1u << i);
        NoiseOctave& o = tables_.octave[octaves_++] = make_octave(kind, frequency * times, tables_.seed, purpose, i);
        o.amplitude = octaves == 1 ? 1.0f : float(0.5 / times);
    }
    return u16(index);
}

Result<Program> TableBuilder::add_program(std::span<const Instruction> code) {
    if (code.size() > kInstructionsMost - instructions_)
        return fail(ErrorCode::limit, fmt::format("more than {} instructions", kInstructionsMost));
    const Program program{u16(instructions_), u16(code.size())};
    for (const Instruction& in : code)
        tables_.instruction[instructions_++] = in;
    return program;
}

} // namespace vitrail
