// Noise over rows of block columns on one core, the best vector set this CPU has. Reference: FastNoise2 with AVX-512
// makes 195 million 5-octave 3-D simplex samples a second on our machine.
#include "bench/harness.h"

#include "terrain/compile/noise_tables.h"
#include "terrain/cpu/noise_rows.h"

#include <memory>
#include <vector>

namespace vitrail {

void register_noise_benches(bench::Suite& suite);

namespace {

constexpr i32 kColumns = 64, kLevels = 48;

NoiseOctave* octaves_of(TerrainTables& t, NoiseKind kind, u32 octaves) {
    t.seed = 7;
    TableBuilder builder(t);
    return &t.octave[t.noise[builder.add_noise(kind, 0.01, octaves, 1).value()].first];
}

void fbm(bench::Context& c, bool three) {
    const auto tables = std::make_unique<TerrainTables>();
    const NoiseOctave* octaves = octaves_of(*tables, three ? NoiseKind::simplex3 : NoiseKind::simplex2, 5);
    const NoiseRows& rows = noise_rows(best_isa());
    std::vector<float> out(256 * kLevels);
    c.measure(256.0 * kColumns * (three ? kLevels : 16), [&] {
        for (i32 i = 0; i < (three ? kColumns : kColumns * 16); ++i) {
            if (three)
                rows.fractal3(octaves, 5, {i * 5, 1000 - i}, 0, kLevels, out.data());
            else
                rows.fractal2(octaves, 5, {i * 5, 1000 - i}, out.data());
            bench::keep(out[0]);
        }
    });
}

void cells3(bench::Context& c) {
    const auto tables = std::make_unique<TerrainTables>();
    const NoiseOctave* octave = octaves_of(*tables, NoiseKind::cellular, 1);
    const NoiseRows& rows = noise_rows(best_isa());
    std::vector<float> out(1024);
    c.measure(256.0 * kColumns * 16, [&] {
        for (i32 i = 0; i < kColumns * 16; ++i) {
            rows.cells3(*octave, {i / 16 * 5, 7}, i % 16, 1.6f, out.data());
            bench::keep(out[0]);
        }
    });
}

} // namespace

void register_noise_benches(bench::Suite& suite) {
    suite.add("noise.fbm5_3d", "M/s", "5-octave 3-D simplex samples, rows of 16 upwards, one core",
              [](bench::Context& c) { fbm(c, true); });
    suite.add("noise.fbm5_2d", "M/s", "5-octave 2-D simplex samples, a column at a time, one core",
              [](bench::Context& c) { fbm(c, false); });
    suite.add("noise.worley3", "M/s", "3-D Worley samples, F1 to F3 of 27 cells, one core", cells3);
}

} // namespace vitrail
