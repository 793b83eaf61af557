// The one source of chance: even, and without memory of neighbors, quadrants or purposes.
#include "terrain/compile/names.h"
#include "terrain/kernel/random_kernel.h"

#include <array>
#include <cmath>
#include <gtest/gtest.h>

using namespace vitrail;

namespace {

constexpr i32 kFar = 2147483647 - 300;
struct Place {
    i32 x, z;
};
constexpr Place kPlaces[] = {{0, 0}, {-256, 0}, {0, -256}, {-256, -256}, {kFar - 256, 77}, {-kFar, -kFar}};

double correlation(double n, double sum_a, double sum_b, double aa, double bb, double ab) {
    const double va = aa / n - sum_a / n * sum_a / n, vb = bb / n - sum_b / n * sum_b / n;
    return (ab / n - sum_a / n * sum_b / n) / std::sqrt(va * vb);
}

// Correlation of two numbers over 256 x 256 places from `at` on.
template <class A, class B>
double correlate(Place at, A&& a, B&& b) {
    double sa = 0, sb = 0, aa = 0, bb = 0, ab = 0;
    for (i32 i = 0; i < 65536; ++i) {
        const u32 x = u32(at.x) + u32(i & 255), z = u32(at.z) + u32(i >> 8);
        const double va = double(unit_of(a(x, z))), vb = double(unit_of(b(x, z)));
        sa += va, sb += vb, aa += va * va, bb += vb * vb, ab += va * vb;
    }
    return correlation(65536, sa, sb, aa, bb, ab);
}
constexpr double kMost = 5.0 / 256; // five standard errors

} // namespace

TEST(RandomKernel, EveryByteIsEven) {
    for (u64 seed = 0; seed < 8; ++seed) {
        const RandomKey key = random_key(seed, purpose_of("even"));
        for (const Place at : kPlaces) {
            std::array<std::array<double, 256>, 4> counts{};
            for (i32 i = 0; i < 65536; ++i) {
                const u32 bits = random_bits(key, u32(at.x) + u32(i & 255), u32(at.z) + u32(i >> 8));
                for (std::size_t byte = 0; byte < 4; ++byte)
                    ++counts[byte][bits >> (8 * byte) & 255];
            }
            for (const auto& of_byte : counts) {
                double chi = 0;
                for (const double n : of_byte)
                    chi += (n - 256) * (n - 256) / 256;
                EXPECT_NEAR((chi - 255) / std::sqrt(510.0), 0, 5.5) << at.x << ' ' << at.z << " seed " << seed;
            }
        }
    }
}

TEST(RandomKernel, NeighborsDoNotKnowOfEachOther) {
    const RandomKey key = random_key(3, purpose_of("neighbors"));
    const auto here = [&](u32 x, u32 z) { return random_bits(key, x, z); };
    for (const Place at : kPlaces) {
        for (i32 dx = -2; dx <= 2; ++dx)
            for (i32 dz = 0; dz <= 2; ++dz) {
                if (dz == 0 && dx <= 0) continue;
                EXPECT_NEAR(
                    correlate(at, here, [&](u32 x, u32 z) { return random_bits(key, x + u32(dx), z + u32(dz)); }), 0,
                    kMost);
            }
        // Mirrored and exchanged coordinates, levels, further numbers.
        EXPECT_NEAR(correlate(at, here, [&](u32 x, u32 z) { return random_bits(key, 0u - x - 1, z); }), 0, kMost);
        EXPECT_NEAR(correlate(at, here, [&](u32 x, u32 z) { return random_bits(key, x, 0u - z - 1); }), 0, kMost);
        if (at.x != at.z) {
            EXPECT_NEAR(correlate(at, here, [&](u32 x, u32 z) { return random_bits(key, z, x); }), 0, kMost);
        }
        EXPECT_NEAR(correlate(
                        at, [&](u32 x, u32 z) { return random_bits(key, x, 5u, z); },
                        [&](u32 x, u32 z) { return random_bits(key, x, 6u, z); }),
                    0, kMost);
        EXPECT_NEAR(correlate(at, here, [&](u32 x, u32 z) { return random_next(random_bits(key, x, z), 0); }), 0,
                    kMost);
        EXPECT_NEAR(correlate(
                        at, [&](u32 x, u32 z) { return random_next(random_bits(key, x, z), 0); },
                        [&](u32 x, u32 z) { return random_next(random_bits(key, x, z), 1); }),
                    0, kMost);
    }
}

TEST(RandomKernel, PurposesAndSeedsAreIndependent) {
    for (const Place at : kPlaces) {
        const auto of = [](u64 seed, const char* purpose) {
            return [key = random_key(seed, purpose_of(purpose))](u32 x, u32 z) { return random_bits(key, x, z); };
        };
        EXPECT_NEAR(correlate(at, of(1, "a"), of(1, "b")), 0, kMost);
        EXPECT_NEAR(correlate(at, of(1, "a"), of(2, "a")), 0, kMost);
        EXPECT_NEAR(correlate(at, of(0, "a"), of(~0ull, "a")), 0, kMost);
        EXPECT_NEAR(correlate(at, of(1, "feature oak"), of(1, "feature oak 2")), 0, kMost);
    }
    EXPECT_NE(purpose_of("a", 0), purpose_of("a", 1));
    EXPECT_NE(purpose_of("a", 0), purpose_of("a"));
}

TEST(RandomKernel, RangesHold) {
    EXPECT_EQ(unit_of(0u), 0.0f);
    EXPECT_LT(unit_of(~0u), 1.0f);
    EXPECT_EQ(below_of(~0u, 65536), 65535u);
    EXPECT_EQ(below_of(0, 7), 0u);
    EXPECT_EQ(below_of(~0u, 1), 0u);
}

// Worlds that exist stand on these.
TEST(RandomKernel, PinnedValues) {
    const RandomKey key = random_key(1234567890123ull, purpose_of("pinned"));
    EXPECT_EQ(random_bits(key, 1u, 2u), 1080832334u);
    EXPECT_EQ(random_bits(key, u32(-1), 300u, u32(-17)), 1041029999u);
    EXPECT_EQ(random_next(77u, 3), 1832740186u);
}
