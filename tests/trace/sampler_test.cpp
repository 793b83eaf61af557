// The samples of paths: even in every elementary interval, scrambled apart, the same again, and better than chance.
#include "trace/kernel/sampler.h"

#include "base/rng.h"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace vitrail::trace {

// The n-th pair (from 0) of a pixel's sample.
static Vec2 draw(u32 x, u32 y, u32 sample, u32 seed, u32 n) {
    Sampler s = make_sampler(x, y, sample, seed);
    for (u32 i = 0; i < n; ++i)
        (void)next_2d(s);
    return next_2d(s);
}

TEST(Sampler, EveryPixelsPairsAreNets) {
    for (u32 bits : {1u, 4u, 6u})
        for (u32 n : {0u, 3u, kDithered - 1, kDithered, 17u})
            for (u32 first : {0u, 1u << bits, 37u << bits})
                // (0, 2)-sequence: each run of 2^bits samples has one in each box 2^-k x 2^-(bits-k).
                for (u32 k = 0; k <= bits; ++k) {
                    std::vector<u32> counts(1u << bits);
                    for (u32 i = 0; i < 1u << bits; ++i) {
                        const Vec2 p = draw(123, 45, first + i, 9, n);
                        ASSERT_TRUE(p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1);
                        ++counts[u32(p.x * float(1u << k)) << (bits - k) | u32(p.y * float(1u << (bits - k)))];
                    }
                    for (u32 c : counts)
                        ASSERT_EQ(c, 1u) << bits << ' ' << n << ' ' << first << ' ' << k;
                }
}

TEST(Sampler, SingleNumbersAreStratified) {
    for (u32 n : {0u, kDithered + 3}) {
        std::vector<u32> counts(64);
        for (u32 i = 0; i < 64; ++i) {
            Sampler s = make_sampler(7, 8, i, 1);
            for (u32 k = 0; k < n; ++k)
                (void)next_1d(s);
            ++counts[u32(next_1d(s) * 64)];
        }
        for (u32 c : counts)
            EXPECT_EQ(c, 1u);
    }
}

TEST(Sampler, SameArgumentsSameNumbersOthersDiffer) {
    for (u32 n : {0u, kDithered + 2}) {
        const Vec2 a = draw(10, 20, 30, 40, n), b = draw(10, 20, 30, 40, n);
        EXPECT_EQ(a.x, b.x);
        EXPECT_EQ(a.y, b.y);
        for (const Vec2 other :
             {draw(11, 20, 30, 40, n), draw(10, 21, 30, 40, n), draw(10, 20, 31, 40, n), draw(10, 20, 30, 41, n)})
            EXPECT_TRUE(other.x != a.x && other.y != a.y);
    }
}

// First of all even numbers: mean, and moments of higher order, over seeds.
TEST(Sampler, EvenOverSeedsAndPixels) {
    for (u32 n : {0u, kDithered + 3}) {
        double sums[4] = {};
        constexpr u32 count = 1 << 14;
        std::vector<u32> boxes(256);
        for (u32 i = 0; i < count; ++i) {
            const Vec2 p = draw(i * 7919 % 1000, i * 104729 % 1000, 0, i, n);
            sums[0] += double(p.x), sums[1] += double(p.y), sums[2] += double(p.x * p.y), sums[3] += double(p.x * p.x);
            ++boxes[u32(p.x * 16) * 16 + u32(p.y * 16)];
        }
        EXPECT_NEAR(sums[0] / count, 0.5, 0.01);
        EXPECT_NEAR(sums[1] / count, 0.5, 0.01);
        EXPECT_NEAR(sums[2] / count, 0.25, 0.01);
        EXPECT_NEAR(sums[3] / count, 1.0 / 3, 0.01);
        double chi = 0;
        for (u32 c : boxes)
            chi += (c - count / 256.0) * (c - count / 256.0) / (count / 256.0);
        EXPECT_LT(chi, 255 + 5 * std::sqrt(2 * 255.0));
    }
}

// Correlation of what two draws give, over many pixels or samples.
TEST(Sampler, PairsAndPixelsAreIndependent) {
    const auto correlation = [](auto&& pair_of) {
        double xy = 0, xx = 0, yy = 0;
        for (u32 i = 0; i < 8192; ++i) {
            const auto [a, b] = pair_of(i);
            xy += double((a - 0.5f) * (b - 0.5f));
            xx += double((a - 0.5f) * (a - 0.5f)), yy += double((b - 0.5f) * (b - 0.5f));
        }
        return xy / std::sqrt(xx * yy);
    };
    const double most = 4.5 / std::sqrt(8192.0);
    for (u32 n = 0; n < 9; ++n)
        for (u32 m = n + 1; m < 10; ++m) {
            EXPECT_LT(std::abs(correlation([&](u32 i) {
                          return std::pair{draw(5, 6, i, 1, n).x, draw(5, 6, i, 1, m).x};
                      })),
                      most)
                << n << ' ' << m;
            EXPECT_LT(std::abs(correlation([&](u32 i) {
                          return std::pair{draw(i % 128, i / 128, 3, 1, n).x, draw(i % 128, i / 128, 3, 1, m).y};
                      })),
                      most)
                << n << ' ' << m;
        }
    // Pixels far from each other; where nothing is dithered neighbors too, sample by sample.
    for (u32 n : {0u, 2u, 7u, 12u})
        EXPECT_LT(std::abs(correlation([&](u32 i) {
                      const u32 x = mixed(i) & 1023, y = mixed(i) >> 20 & 1023;
                      return std::pair{draw(x, y, i & 7, 1, n).x, draw(x + 317, y, i & 7, 1, n).x};
                  })),
                  most)
            << n;
    EXPECT_LT(std::abs(correlation([](u32 i) {
                  return std::pair{draw(3, 4, i, 1, kDithered + 1).x, draw(4, 4, i, 1, kDithered + 1).x};
              })),
              most);
}

// Integrals over the square, smooth and with an edge.
static double smooth_part(Vec2 p) {
    return double(std::sin(3 * p.x + 1) * std::exp(p.y));
}
static double edge_part(Vec2 p) {
    return p.x * 0.7f + p.y * 0.6f < 0.55f ? 1 : 0;
}

TEST(Sampler, ErrorFallsFasterThanByChance) {
    for (auto* f : {smooth_part, edge_part})
        for (u32 n : {1u, kDithered + 2})
            for (u32 count : {16u, 256u}) {
                double exact = 0;
                for (u32 i = 0; i < 512; ++i)
                    for (u32 j = 0; j < 512; ++j)
                        exact += f({(float(i) + 0.5f) / 512, (float(j) + 0.5f) / 512}) / (512.0 * 512);
                Rng rng(5);
                double ours = 0, chance = 0;
                for (u32 pixel = 0; pixel < 64; ++pixel) {
                    double a = 0, b = 0;
                    for (u32 i = 0; i < count; ++i) {
                        a += f(draw(pixel * 13, pixel * 7, i, 2, n)) / count;
                        b += f({rng.unit(), rng.unit()}) / count;
                    }
                    ours += (a - exact) * (a - exact), chance += (b - exact) * (b - exact);
                }
                const double better = f == smooth_part ? (count == 16 ? 20 : 200) : (count == 16 ? 2.5 : 6);
                EXPECT_LT(ours * better, chance) << n << ' ' << count;
            }
}

// With one sample a pixel the mean of a small block is far nearer to the truth than of random numbers.
TEST(Sampler, ErrorIsSpreadOverTheScreen) {
    for (auto* f : {smooth_part, edge_part}) {
        double exact = 0;
        for (u32 i = 0; i < 512; ++i)
            for (u32 j = 0; j < 512; ++j)
                exact += f({(float(i) + 0.5f) / 512, (float(j) + 0.5f) / 512}) / (512.0 * 512);
        Rng rng(6);
        double ours = 0, chance = 0;
        for (u32 block = 0; block < 256; ++block) { // 5 x 5 pixels, anywhere
            double a = 0, b = 0;
            const u32 x = rng.below(500), y = rng.below(500);
            for (u32 i = 0; i < 25; ++i) {
                a += f(draw(x + i % 5, y + i / 5, block, 2, 2)) / 25;
                b += f({rng.unit(), rng.unit()}) / 25;
            }
            ours += (a - exact) * (a - exact), chance += (b - exact) * (b - exact);
        }
        EXPECT_LT(ours * 1.7, chance);
    }
}

} // namespace vitrail::trace
