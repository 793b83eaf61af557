// Noise: its range, evenness and lack of direction, the same bits for every lane type, no loss far away.
#include "base/rng.h"
#include "terrain/compile/names.h"
#include "terrain/compile/noise_tables.h"
#include "terrain/cpu/noise_rows.h"
#include "terrain/kernel/program_kernel.h"

#include <array>
#include <cmath>
#include <cstring>
#include <gtest/gtest.h>
#include <memory>
#include <numeric>

using namespace vitrail;

namespace {

using L = ScalarLanes;

Spot<L> spot_at(i32 x, float y, i32 z) {
    return {x & ~15, z & ~15, float(x & 15), y, float(z & 15)};
}
u32 bits_of(float v) {
    u32 b;
    std::memcpy(&b, &v, sizeof b);
    return b;
}
std::vector<Isa> isas() {
    std::vector<Isa> out{Isa::portable};
    if (best_isa() >= Isa::avx2) out.push_back(Isa::avx2);
    if (best_isa() >= Isa::avx512) out.push_back(Isa::avx512);
    return out;
}
// Columns near the origin, anywhere, and at the edges of the world: blocks up to +-(2^31 - 512).
ColumnPos random_column(Rng& rng) {
    const auto one = [&] {
        constexpr i32 kEdge = (1 << 27) - 32;
        switch (rng.below(4)) {
        case 0:
            return i32(rng.below(64)) - 32;
        case 1:
            return kEdge - i32(rng.below(4));
        case 2:
            return -kEdge + i32(rng.below(4));
        default:
            return i32(rng.next() % (2 * u64(kEdge))) - kEdge;
        }
    };
    const i32 x = one();
    return {x, one()};
}
struct Tables {
    std::unique_ptr<TerrainTables> t = std::make_unique<TerrainTables>();
    TableBuilder builder{*t};
    explicit Tables(u64 seed = 5) { t->seed = seed; }
    const NoiseOctave* add(NoiseKind kind, double frequency, u32 octaves, u64 purpose) {
        return &t->octave[t->noise[builder.add_noise(kind, frequency, octaves, purpose).value()].first];
    }
};

} // namespace

TEST(Noise, StaysWithinOneAndHasNoMean) {
    double sum2 = 0, sum3 = 0, square2 = 0, square3 = 0, most2 = 0, most3 = 0;
    int n = 0;
    for (u64 seed = 0; seed < 100; ++seed) {
        const NoiseOctave flat = make_octave(NoiseKind::simplex2, 0.37, seed, 1, 0);
        const NoiseOctave solid = make_octave(NoiseKind::simplex3, 0.37, seed, 2, 0);
        Rng rng(seed);
        for (int i = 0; i < 3000; ++i, ++n) {
            const auto spot = spot_at(i32(rng.next()), float(rng.below(384)), i32(rng.next()));
            const double a = double(simplex2<L>(flat, spot)), b = double(simplex3<L>(solid, spot));
            sum2 += a;
            sum3 += b;
            square2 += a * a;
            square3 += b * b;
            most2 = std::max(most2, std::abs(a));
            most3 = std::max(most3, std::abs(b));
        }
    }
    EXPECT_LE(most2, 1.0);
    EXPECT_LE(most3, 1.0);
    EXPECT_GT(most2, 0.95);
    EXPECT_GT(most3, 0.93);
    // Samples are independent: five standard errors.
    EXPECT_NEAR(sum2 / n, 0, 5 * std::sqrt(square2 / n / n));
    EXPECT_NEAR(sum3 / n, 0, 5 * std::sqrt(square3 / n / n));
    EXPECT_NEAR(std::sqrt(square2 / n), 0.54, 0.02);
    EXPECT_NEAR(std::sqrt(square3 / n), 0.39, 0.02);
}

TEST(Noise, NoDirectionStandsOut) {
    // Mean squared difference between places a step apart, by direction; 22 lattices, 8,000 pairs each.
    for (const double step : {1.0, 6.0, 12.0}) { // blocks; cells are 20
        std::array<double, 8> flat{}, solid{};
        for (u64 seed = 0; seed < 22; ++seed) {
            const NoiseOctave two = make_octave(NoiseKind::simplex2, 0.05, seed, 1, 0);
            const NoiseOctave three = make_octave(NoiseKind::simplex3, 0.05, seed, 2, 0);
            Rng rng(seed + 100);
            for (int i = 0; i < 8000; ++i) {
                const float x = rng.unit() * 900, y = rng.unit() * 900, z = rng.unit() * 900;
                const double a = double(simplex2<L>(two, {0, 0, x, 0, z})),
                             b = double(simplex3<L>(three, {0, 0, x, y, z}));
                for (std::size_t d = 0; d < 8; ++d) {
                    const double turn = double(d) * 3.14159265 / 8, c = std::cos(turn) * step,
                                 s = std::sin(turn) * step;
                    // flat: around; solid: around an axis that is not the lattice's
                    const double up = d % 2 ? 0.5 : -0.5;
                    const double v = double(simplex2<L>(two, {0, 0, float(x + c), 0, float(z + s)}));
                    const double w = double(simplex3<L>(
                        three, {0, 0, float(x + c * 0.8660254), float(y + up * step), float(z + s * 0.8660254)}));
                    flat[d] += (v - a) * (v - a);
                    solid[d] += (w - b) * (w - b);
                }
            }
        }
        for (const auto& sums : {flat, solid}) {
            const auto [least, most] = std::minmax_element(sums.begin(), sums.end());
            EXPECT_LT(*most / *least, 1.05) << "step " << step;
        }
    }
}

TEST(Noise, EveryVectorSetGivesTheBitsOfOneLane) {
    Tables tables;
    const NoiseOctave* flat = tables.add(NoiseKind::simplex2, 0.017, 5, 1);
    const NoiseOctave* solid = tables.add(NoiseKind::simplex3, 0.031, 5, 2);
    const NoiseOctave* cells = tables.add(NoiseKind::cellular, 0.043, 1, 3);
    std::vector<float> out(1024);
    for (const Isa isa : isas()) {
        const NoiseRows& rows = noise_rows(isa);
        Rng rng(1);
        for (int round = 0; round < 60; ++round) {
            const ColumnPos at = random_column(rng);
            const i32 x = i32(u32(at.x) << 4), z = i32(u32(at.z) << 4), y = i32(rng.below(384));
            const auto spot = [&](int i) { return Spot<L>{x, z, float(i & 15), float(y), float(i >> 4)}; };
            rows.fractal2(flat, 5, at, out.data());
            for (int i = 0; i < 256; ++i)
                ASSERT_EQ(bits_of(out[std::size_t(i)]), bits_of(fractal2<L>(flat, 5, spot(i)))) << at.x << ' ' << at.z;
            rows.fractal3(solid, 5, at, y, 1, out.data());
            for (int i = 0; i < 256; ++i)
                ASSERT_EQ(bits_of(out[std::size_t(i)]), bits_of(fractal3<L>(solid, 5, spot(i)))) << at.x << ' ' << at.z;
            const auto check_cells = [&](int i, const Cellular<L>& c) {
                const float wanted[4] = {c.f1, c.f2, c.f3, unit_of(c.cell)};
                for (int k = 0; k < 4; ++k)
                    ASSERT_EQ(bits_of(out[std::size_t(k * 256 + i)]), bits_of(wanted[k])) << at.x << ' ' << at.z;
            };
            rows.cells2(*cells, at, out.data());
            for (int i = 0; i < 256; ++i)
                check_cells(i, worley2<L>(*cells, spot(i)));
            rows.cells3(*cells, at, y, 1.6f, out.data());
            for (int i = 0; i < 256; ++i)
                check_cells(i, worley3<L>(*cells, spot(i), 1.6f, 0, 0, 0));
        }
    }
}

// The largest step between neighbors within columns, and across their borders, must be alike.
TEST(Noise, ColumnsMeetWithoutAStep) {
    Tables tables;
    const NoiseOctave* flat = tables.add(NoiseKind::simplex2, 0.01, 5, 1);
    const NoiseOctave* solid = tables.add(NoiseKind::simplex3, 0.01, 5, 2);
    for (const i32 origin : {0, -4000, 2147483647 - 6000, -2147483647 + 1200}) {
        double inside[2] = {}, across[2] = {};
        for (i32 x = origin; x < origin + 4800; ++x) {
            for (const bool along_z : {false, true}) {
                const auto at = [&](i32 v) {
                    return along_z ? spot_at(origin + 77, 60, v) : spot_at(v, 60, origin + 77);
                };
                const double steps[2] = {
                    std::abs(double(fractal2<L>(flat, 5, at(x + 1)) - fractal2<L>(flat, 5, at(x)))),
                    std::abs(double(fractal3<L>(solid, 5, at(x + 1)) - fractal3<L>(solid, 5, at(x))))};
                for (int i = 0; i < 2; ++i) {
                    double& most = ((x + 1) & 15) == 0 ? across[i] : inside[i];
                    most = std::max(most, steps[i]);
                }
            }
        }
        for (int i = 0; i < 2; ++i) {
            EXPECT_LT(across[i], inside[i] * 1.1) << origin;
            EXPECT_GT(across[i], inside[i] * 0.5) << origin;
        }
    }
    // Half a block to either side of a border by way of both columns' anchors: the same place, the same value.
    for (const i32 border : {16, -160, 2147483632 - 512, -2147483632 + 512}) {
        for (const float z : {0.0f, 3.0f, 15.0f}) {
            const Spot<L> left{border - 16, 32, 16.0f, 70, z}, right{border, 32, 0.0f, 70, z};
            EXPECT_NEAR(fractal2<L>(flat, 5, left), fractal2<L>(flat, 5, right), 2e-5f) << border;
            EXPECT_NEAR(fractal3<L>(solid, 5, left), fractal3<L>(solid, 5, right), 2e-5f) << border;
        }
    }
}

// Mean squares of value and of the step to the next block, in the four quadrants and at the world's corners.
TEST(Noise, EveryQuadrantAndTheFarEdgeAreAlike) {
    constexpr i32 kFar = 2147483647 - 200000;
    const std::array<std::array<i32, 2>, 8> centers{{{100000, 100000},
                                                     {-100000, 100000},
                                                     {100000, -100000},
                                                     {-100000, -100000},
                                                     {kFar, kFar},
                                                     {-kFar, kFar},
                                                     {kFar, -kFar},
                                                     {-kFar, -kFar}}};
    std::array<double, 8> value{}, step{};
    for (u64 seed = 0; seed < 12; ++seed) {
        Tables tables(seed);
        const NoiseOctave* flat = tables.add(NoiseKind::simplex2, 0.02, 4, 1);
        const NoiseOctave* solid = tables.add(NoiseKind::simplex3, 0.02, 4, 2);
        for (std::size_t q = 0; q < centers.size(); ++q) {
            Rng rng(seed * 8 + q);
            for (int i = 0; i < 4000; ++i) {
                const i32 x = centers[q][0] + i32(rng.below(200000)) - 100000,
                          z = centers[q][1] + i32(rng.below(200000)) - 100000;
                const float y = float(rng.below(384));
                const double a = double(fractal2<L>(flat, 4, spot_at(x, y, z))),
                             b = double(fractal3<L>(solid, 4, spot_at(x, y, z)));
                const double c = double(fractal2<L>(flat, 4, spot_at(x + 1, y, z))),
                             d = double(fractal3<L>(solid, 4, spot_at(x, y, z + 1)));
                value[q] += a * a + b * b;
                step[q] += (a - c) * (a - c) + (b - d) * (b - d);
            }
        }
    }
    for (const auto& sums : {value, step}) {
        const double mean = std::accumulate(sums.begin(), sums.end(), 0.0) / double(sums.size());
        for (const double s : sums)
            EXPECT_NEAR(s / mean, 1, 0.04);
    }
}

// Bits that choose gradients, held against chance: pairs of neighbors and three in a row. Squares without the shift
// before them fail this by 15,000 standard deviations.
TEST(Noise, GradientsOfNeighborsAreIndependent) {
    constexpr int kSide = 256;
    std::vector<u32> grid(kSide * kSide);
    double worst = 0;
    for (u64 seed = 0; seed < 16; ++seed) {
        const NoiseOctave o = make_octave(NoiseKind::simplex2, 0.1, seed, 9, 0);
        for (u32 x = 0; x < kSide; ++x)
            for (u32 z = 0; z < kSide; ++z)
                grid[x * kSide + z] = noise_detail::gradient_bits(x * o.prime_x + z * o.prime_z + o.key) >> 29;
        for (int dx = -1; dx <= 1; ++dx) {
            for (int dz = 0; dz <= 1; ++dz) {
                if (dz == 0 && dx <= 0) continue;
                std::array<double, 512> counts{};
                double all = 0;
                for (int x = 2; x < kSide - 2; ++x) {
                    for (int z = 0; z < kSide - 2; ++z, ++all) {
                        u32 three = 0;
                        for (int k = 0; k < 3; ++k)
                            three = three << 3 | grid[std::size_t((x + k * dx) * kSide + z + k * dz)];
                        ++counts[three];
                    }
                }
                double chi = 0;
                for (const double n : counts)
                    chi += (n - all / 512) * (n - all / 512) / (all / 512);
                worst = std::max(worst, (chi - 511) / std::sqrt(2.0 * 511));
            }
        }
    }
    EXPECT_LT(worst, 5.5);
}

TEST(Noise, CellDistancesEqualASearchOfAllPoints) {
    const NoiseOctave o = make_octave(NoiseKind::cellular, 0.04, 3, 1, 0);
    Rng rng(4);
    int differ = 0;
    for (int i = 0; i < 2000; ++i) {
        const i32 x = i32(rng.next()) / 4, z = i32(rng.next()) / 4;
        const auto c2 = worley2<L>(o, spot_at(x, 0, z));
        const auto c3 = worley3<L>(o, spot_at(x, float(x & 255), z), 1.6f, 0, 0, 0);
        EXPECT_LE(c2.f1, c2.f2);
        EXPECT_LE(c2.f2, c2.f3);
        EXPECT_LE(c3.f1, c3.f2);
        EXPECT_LE(c3.f2, c3.f3);
        // Points of 7 x 7 cells, in doubles.
        const u64 u = o.shift_x + u64(i64(x)) * o.fixed_a, v = o.shift_z + u64(i64(z)) * o.fixed_a;
        double best[2] = {99, 99};
        for (int dz = -3; dz <= 3; ++dz) {
            for (int dx = -3; dx <= 3; ++dx) {
                const u32 h = noise_detail::lattice_bits((u32(u >> 32) + u32(dx)) * o.prime_x +
                                                         (u32(v >> 32) + u32(dz)) * o.prime_z + o.key);
                const double px = double(h & 0xffff) / 65536 + dx - double(u32(u)) / 4294967296.0;
                const double pz = double(h >> 16) / 65536 + dz - double(u32(v)) / 4294967296.0;
                const double d = std::sqrt(px * px + pz * pz);
                if (d < best[0])
                    best[1] = best[0], best[0] = d;
                else
                    best[1] = std::min(best[1], d);
            }
        }
        if (best[0] < 0.999) {
            EXPECT_NEAR(c2.f1, best[0], 1e-5);
        }
        differ += std::abs(double(c2.f1) - best[0]) > 1e-5 || std::abs(double(c2.f2) - best[1]) > 1e-5;
    }
    EXPECT_LT(differ, 40); // 3 x 3 cells miss few
}

TEST(Noise, TablesFollowFromSeedPurposeAndOctaveAlone) {
    const auto same = [](const NoiseOctave& a, const NoiseOctave& b) { return std::memcmp(&a, &b, sizeof a) == 0; };
    const NoiseOctave o = make_octave(NoiseKind::simplex2, 0.01, 1, purpose_of("a"), 0);
    EXPECT_TRUE(same(o, make_octave(NoiseKind::simplex2, 0.01, 1, purpose_of("a"), 0)));
    EXPECT_FALSE(same(o, make_octave(NoiseKind::simplex2, 0.01, 2, purpose_of("a"), 0)));
    EXPECT_FALSE(same(o, make_octave(NoiseKind::simplex2, 0.01, 1, purpose_of("b"), 0)));
    EXPECT_FALSE(same(o, make_octave(NoiseKind::simplex2, 0.01, 1, purpose_of("a"), 1)));
    for (u64 seed = 0; seed < 50; ++seed) {
        const NoiseOctave p = make_octave(NoiseKind::simplex3, 0.01, seed, 1, 0);
        EXPECT_EQ(p.prime_x & p.prime_y & p.prime_z & 1, 1u);
        // No two lattice points less than 100 cells apart share a hash.
        for (u32 a = 0; a <= 100; ++a)
            for (u32 b = 0; b <= 100; ++b) {
                if (a == 0 && b == 0) continue;
                ASSERT_NE(a * p.prime_x, b * p.prime_z);
                ASSERT_NE(a * p.prime_x, 0u - b * p.prime_z);
            }
    }
    EXPECT_EQ(make_octave(NoiseKind::simplex3, 0.25, 1, 1, 0).fixed_a, 1431655765u);
    EXPECT_EQ(make_octave(NoiseKind::simplex3, 0.25, 1, 1, 0).fixed_b, 357913941u);
    EXPECT_EQ(make_octave(NoiseKind::cellular, 0.5, 1, 1, 0).fixed_a, 2147483648u);
}

TEST(Noise, BuilderRefusesWhatKernelsCannotRead) {
    Tables tables;
    for (const double f : {0.0, -0.1, 0.51, 1e-9, std::nan(""), HUGE_VAL})
        EXPECT_FALSE(tables.builder.add_noise(NoiseKind::simplex2, f, 1, 1)) << f;
    EXPECT_FALSE(tables.builder.add_noise(NoiseKind::simplex2, 0.1, 0, 1));
    EXPECT_FALSE(tables.builder.add_noise(NoiseKind::simplex2, 0.1, 9, 1));
    EXPECT_FALSE(tables.builder.add_noise(NoiseKind::cellular, 0.1, 2, 1));
    Result<u16> last = u16(0);
    u32 made = 0;
    while ((last = tables.builder.add_noise(NoiseKind::simplex2, 0.1, 8, made)))
        ++made;
    EXPECT_EQ(last.error().code, ErrorCode::limit);
    EXPECT_EQ(made, kOctavesMost / 8);
}

// The noise of worlds that exist: these bits never change, under no compiler.
TEST(Noise, PinnedValues) {
    Tables tables(20240607);
    const NoiseOctave* flat = tables.add(NoiseKind::simplex2, 0.0065, 5, purpose_of("pinned flat"));
    const NoiseOctave* solid = tables.add(NoiseKind::simplex3, 0.004, 5, purpose_of("pinned solid"));
    const NoiseOctave* cells = tables.add(NoiseKind::cellular, 0.005, 1, purpose_of("pinned cells"));
    u64 hash = 0;
    for (const i32 x : {0, 1, -1, 1000, -123456, 2147483647 - 512, -2147483647 + 512}) {
        for (const i32 z : {0, 15, 16, -16, -17, 2147483647 - 512, -2147483647 + 512}) {
            const auto spot = spot_at(x, 61, z);
            for (const float v : {fractal2<L>(flat, 5, spot), fractal3<L>(solid, 5, spot), worley2<L>(*cells, spot).f1,
                                  worley3<L>(*cells, spot, 1.6f, 0.1f, -0.7f, 0.3f).f3})
                hash = hash_combine(hash, bits_of(v));
        }
    }
    EXPECT_EQ(hash, 14905970617453611566u);
    EXPECT_EQ(flat->prime_x, 1910675883u);
    EXPECT_EQ(purpose_of("pinned"), 14651013074940236263u);
}
