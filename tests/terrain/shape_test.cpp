// Shapes of features: bounds, caps, determinism, that nothing floats, that none is stunted, and shares of kinds.
#include "shape_voxels.h"
#include "terrain/kernel/shapes/build_shape.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>
#include <string>

namespace vitrail {
namespace {

using namespace shape_voxels;

constexpr auto kBuild = [](ShapeBuilder<ScalarLanes>& b) { build_shape(b); };

struct Plant {
    Shape shape;
    u32 primitives; // at most
    u32 voxels;     // at least, with the default numbers
    float top;      // least top as a share of the least height (numbers[0]); 0: not by height
};
// The shapes that stand on their own, which draw their own ground line.
constexpr Plant kPlants[] = {
    {Shape::acacia, 24, 90, 0.95f},
    {Shape::redwood, 48, 600, 0.95f},
    {Shape::cypress, 60, 900, 0.95f},
    {Shape::birch, 16, 60, 0.95f},
    {Shape::pine, 24, 40, 0.9f},
    {Shape::shrub, 6, 6, 0},
    {Shape::rafflesia, 60, 250, 0.9f},
    {Shape::jungle_tree, 60, 900, 0.95f},
    {Shape::small_jungle_tree, 16, 60, 0.9f},
    {Shape::mushroom, 40, 2000, 1.0f},
    {Shape::medium_mushroom, 16, 80, 1.0f},
    {Shape::crystal, 40, 500, 0.6f},
    {Shape::palm, 32, 60, 0.95f},
};

const char* name_of(Shape s) {
    return shape_infos()[u32(s)].name;
}

u32 bits_of(u32 i) {
    return mix_bits(i * 0x9e3779b9u + 0x1234u);
}

u64 hash_of(const FeatureTile& tile) {
    u64 h = tile.primitives;
    for (u32 i = 0; i < tile.primitives; ++i) {
        const Primitive& p = tile.primitive[i];
        for (const float v : {p.a.x, p.a.y, p.a.z, p.b.x, p.b.y, p.b.z, p.ra, p.rb, p.wobble}) {
            u32 word = 0;
            std::memcpy(&word, &v, sizeof word);
            h = hash_combine(h, word);
        }
        h = hash_combine(h, u64(p.block) | u64(p.other) << 8 | u64(p.solid) << 16 | u64(p.flags) << 24 |
                                u64(p.other_share) << 32 | u64(p.missing_share) << 40);
        for (int k = 0; k < 3; ++k)
            h = hash_combine(h, u64(u16(p.low[k])) | u64(u16(p.high[k])) << 16);
    }
    return h;
}

// Every number anywhere in its allowed range, but NAME_least <= NAME_most, which follow each other.
FeatureRow random_row(Shape shape, u32 bits) {
    FeatureRow row = row_of(shape);
    const ShapeInfo& info = shape_infos()[u32(shape)];
    for (u32 i = 0; i < kFeatureNumbers && info.numbers[i].name; ++i) {
        const float s = unit_of(random_next(bits, i));
        row.numbers[i] = info.numbers[i].least + (info.numbers[i].most - info.numbers[i].least) * s;
        if (i > 0 && std::string(info.numbers[i].name).ends_with("_most") && row.numbers[i] < row.numbers[i - 1])
            std::swap(row.numbers[i], row.numbers[i - 1]);
    }
    return row;
}

TEST(ShapeInfo, RowsAreComplete) {
    ASSERT_EQ(shape_infos().size(), u32(Shape::count));
    std::set<std::string> names;
    for (const ShapeInfo& s : shape_infos()) {
        ASSERT_NE(s.name, nullptr);
        EXPECT_TRUE(names.insert(s.name).second) << s.name;
        std::set<std::string> inner;
        bool ended = false;
        for (const ShapeNumber& n : s.numbers) {
            if (!n.name) {
                ended = true;
                continue;
            }
            EXPECT_FALSE(ended) << s.name << ": a gap before " << n.name;
            EXPECT_TRUE(inner.insert(n.name).second) << s.name << " " << n.name;
            EXPECT_LE(n.least, n.fallback) << s.name << " " << n.name;
            EXPECT_LE(n.fallback, n.most) << s.name << " " << n.name;
        }
        ASSERT_NE(s.blocks[0], nullptr) << s.name;
        ended = false;
        for (const char* b : s.blocks) {
            if (!b) {
                ended = true;
                continue;
            }
            EXPECT_FALSE(ended) << s.name << ": a gap before " << b;
            EXPECT_TRUE(inner.insert(b).second) << s.name << " " << b;
        }
        EXPECT_LE(s.reach, 16 * kFeatureReach - 1) << s.name;
    }
}

// With bounds that cut nothing off, whatever numbers a row may have. Feet may be cut off: they are under the ground.
TEST(Shapes, StayInsideTheirBounds) {
    Built f;
    for (const Plant& plant : kPlants) {
        const u32 s = u32(plant.shape);
        const ShapeInfo& info = shape_infos()[s];
        i32 low = 999, high = -999, reach = 0;
        for (u32 i = 0; i < 2000; ++i) {
            const u32 bits = bits_of(i);
            FeatureRow row = i < 1000 ? row_of(Shape(s)) : random_row(Shape(s), bits);
            row.bound_low = -400;
            row.bound_high = 400;
            row.reach = 400;
            f.make(row, bits, kBuild, 0, 0, 0, 4 + i32(i % 90));
            EXPECT_TRUE(f.fits) << info.name;
            for (u32 k = 0; k < f.tile->primitives; ++k) {
                const Primitive& p = f.tile->primitive[k];
                low = std::min<i32>(low, p.low[1]);
                high = std::max<i32>(high, p.high[1]);
                for (const int axis : {0, 2})
                    reach = std::max({reach, -i32(p.low[axis]), i32(p.high[axis])});
            }
        }
        EXPECT_LE(low, info.bound_low) << info.name << " has no feet";
        EXPECT_LE(high, info.bound_high) << info.name;
        EXPECT_LE(reach, info.reach) << info.name;
        // Bounds much too wide cost time for nothing.
        EXPECT_GE(reach + 6, info.reach) << info.name;
    }
}

TEST(Shapes, FewSolids) {
    Built f;
    for (const Plant& plant : kPlants)
        for (u32 i = 0; i < 2000; ++i) {
            f.make(i < 1000 ? row_of(plant.shape) : random_row(plant.shape, bits_of(i)), bits_of(i), kBuild);
            ASSERT_LE(f.tile->primitives, plant.primitives) << name_of(plant.shape);
            ASSERT_GE(f.tile->primitives, 2u) << name_of(plant.shape);
            ASSERT_EQ(f.placement.count, f.tile->primitives);
        }
}

TEST(Shapes, FollowFromTheirBitsAlone) {
    Built f;
    for (u32 s = 0; s < u32(Shape::count); ++s) {
        const FeatureRow row = row_of(Shape(s));
        std::set<u64> seen;
        for (u32 i = 0; i < 2000; ++i) {
            f.make(row, bits_of(i), kBuild, 0, 0, 0, 40);
            const u64 h = hash_of(*f.tile);
            seen.insert(h);
            if (i % 10 != 0) continue;
            f.make(row, bits_of(i), kBuild, i32(bits_of(i + 7)), 200, i32(bits_of(i + 9)), 40);
            ASSERT_EQ(hash_of(*f.tile), h) << name_of(Shape(s)) << " depends on its place";
        }
        if (std::any_of(std::begin(kPlants), std::end(kPlants), [&](const Plant& p) { return u32(p.shape) == s; })) {
            EXPECT_EQ(seen.size(), 2000u) << name_of(Shape(s)) << ": two of 2000 are twins";
        }
    }
}

// One number for all compilers and vector widths: worlds keep the shapes they were made with. Who changes a shape on
// purpose writes the new number here, from a run of either compiler that the other one confirms.
TEST(Shapes, SameBitsFromEveryCompiler) {
    Built f;
    u64 all = 0;
    for (const Plant& plant : kPlants) {
        u64 h = 0;
        for (u32 i = 0; i < 2000; ++i) {
            f.make(i < 1000 ? row_of(plant.shape) : random_row(plant.shape, bits_of(i)), bits_of(i), kBuild);
            h = hash_combine(h, hash_of(*f.tile));
        }
        RecordProperty(name_of(plant.shape), std::to_string(h));
        all = hash_combine(all, h);
    }
    EXPECT_EQ(all, 0x34fd1563520d590au);
}

TEST(Shapes, FullTileIsRefused) {
    Built f;
    const FeatureRow row = row_of(Shape::cypress);
    f.make(row, 5, [&](ShapeBuilder<ScalarLanes>& b) {
        b.out.primitives = kPrimitivesMost - 3;
        build_shape(b);
    });
    EXPECT_FALSE(f.fits);
    EXPECT_EQ(f.tile->primitives, kPrimitivesMost);
}

// Voxels that neither stand in the ground (y <= 0) nor touch, over 26 neighbors, what does.
u32 floating_voxels(const Voxels& v) {
    std::vector<u8> held(v.block.size(), 0);
    std::vector<i32> stack;
    const i32 nx = v.size[0], ny = v.size[1], nz = v.size[2];
    const auto index = [&](i32 x, i32 y, i32 z) { return (y * nz + z) * nx + x; };
    const auto take = [&](i32 i) {
        if (v.block[size_t(i)] == kAir || held[size_t(i)]) return;
        held[size_t(i)] = 1;
        stack.push_back(i);
    };
    for (i32 y = 0; y < ny && y + v.low[1] <= 0; ++y)
        for (i32 i = 0; i < nx * nz; ++i)
            take(y * nz * nx + i);
    while (!stack.empty()) {
        const i32 i = stack.back();
        stack.pop_back();
        const i32 x = i % nx, z = i / nx % nz, y = i / nx / nz;
        for (i32 b = std::max(y - 1, 0); b <= std::min(y + 1, ny - 1); ++b)
            for (i32 c = std::max(z - 1, 0); c <= std::min(z + 1, nz - 1); ++c)
                for (i32 a = std::max(x - 1, 0); a <= std::min(x + 1, nx - 1); ++a)
                    take(index(a, b, c));
    }
    u32 floating = 0;
    for (size_t i = 0; i < held.size(); ++i)
        floating += v.block[i] != kAir && !held[i];
    return floating;
}

void check_voxels(u32 count) {
    Built f;
    for (const Plant& plant : kPlants) {
        const FeatureRow row = row_of(plant.shape);
        u32 all = 0, floating = 0, least = ~0u;
        for (u32 i = 0; i < count; ++i) {
            f.make(row, bits_of(i), kBuild, i32(i * 977u), 130, -i32(i * 1013u));
            const Voxels v = draw(f);
            u32 voxels = 0;
            i32 top = -99;
            for (size_t k = 0; k < v.block.size(); ++k)
                if (v.block[k] != kAir) {
                    ++voxels;
                    top = std::max(top, v.low[1] + i32(k) / (v.size[0] * v.size[2]));
                }
            const u32 loose = floating_voxels(v);
            // A leaf that lost its neighbors to missing_share may hang; a limb or a cap may not.
            EXPECT_LE(loose, std::max(2u, voxels / 200)) << name_of(plant.shape) << " of bits " << bits_of(i);
            EXPECT_GE(float(top) + 1.5f, plant.top * row.numbers[0])
                << name_of(plant.shape) << " of bits " << bits_of(i);
            all += voxels;
            floating += loose;
            least = std::min(least, voxels);
        }
        EXPECT_GE(least, plant.voxels) << name_of(plant.shape);
        EXPECT_LE(floating, all / 1000 + 1) << name_of(plant.shape);
    }
}

// Nothing floats with any numbers that a row may have either.
TEST(Shapes, HangTogetherWhateverTheirNumbers) {
    Built f;
    for (const Plant& plant : kPlants)
        for (u32 i = 0; i < 40; ++i) {
            f.make(random_row(plant.shape, bits_of(i)), bits_of(i), kBuild, -i32(i * 311u), 130, i32(i * 733u));
            const Voxels v = draw(f);
            const u32 voxels = u32(v.block.size()) - u32(std::count(v.block.begin(), v.block.end(), Block(kAir)));
            EXPECT_GE(voxels, 5u) << name_of(plant.shape) << " of bits " << bits_of(i);
            EXPECT_LE(floating_voxels(v), std::max(2u, voxels / 200))
                << name_of(plant.shape) << " of bits " << bits_of(i);
        }
}
TEST(Shapes, HangTogetherAndAreNotStunted) {
    check_voxels(30);
}
TEST(Shapes, HangTogetherAndAreNotStuntedLong) {
    if (!std::getenv("VITRAIL_LONG")) GTEST_SKIP() << "set VITRAIL_LONG";
    check_voxels(2000);
}

// Within five standard deviations.
void expect_share(u32 count, u32 of, double share, const char* what) {
    const double deviation = std::sqrt(share * (1 - share) * of);
    EXPECT_NEAR(double(count), share * of, 5 * deviation) << what;
}

TEST(Shapes, BirchesTakeColorsAndHeightsAtTheirShares) {
    Built f;
    FeatureRow row = row_of(Shape::birch);
    row.numbers[parts::birch::height_least] = row.numbers[parts::birch::height_most] = 10;
    u32 tall = 0;
    std::map<u32, u32> colors;
    constexpr u32 kCount = 20000;
    for (u32 i = 0; i < kCount; ++i) {
        f.make(row, bits_of(i), kBuild);
        tall += f.placement.high[1] > 15;
        std::set<u32> leaves;
        for (u32 k = 0; k < f.tile->primitives; ++k)
            if (const u32 part = f.tile->primitive[k].block - kFirstPart; part != parts::birch::trunk)
                leaves.insert(part);
        ASSERT_EQ(leaves.size(), 1u) << "leaves of two colors on one tree";
        ++colors[*leaves.begin()];
    }
    expect_share(tall, kCount, 0.08, "tall");
    expect_share(colors[parts::birch::leaves_yellow], kCount, 0.1, "yellow");
    expect_share(colors[parts::birch::leaves_orange], kCount, 0.1, "orange");
}

TEST(Shapes, GiantRedwoodsAndCrystalColorsComeAtTheirShares) {
    Built f;
    FeatureRow row = row_of(Shape::redwood);
    row.numbers[parts::redwood::height_least] = row.numbers[parts::redwood::height_most] = 30;
    constexpr u32 kCount = 20000;
    u32 giants = 0;
    for (u32 i = 0; i < kCount; ++i) {
        f.make(row, bits_of(i), kBuild);
        giants += f.placement.high[1] > 37;
    }
    expect_share(giants, kCount, 0.12, "giants");
    u32 colors[3] = {};
    for (u32 i = 0; i < kCount; ++i) {
        f.make(row_of(Shape::crystal), bits_of(i), kBuild);
        for (u32 k = 0; k < f.tile->primitives; ++k)
            ASSERT_EQ(f.tile->primitive[k].block, f.tile->primitive[0].block);
        ++colors[f.tile->primitive[0].block - kFirstPart];
    }
    for (const u32 c : colors)
        expect_share(c, kCount, 1.0 / 3, "color");
}

TEST(Shapes, CypressesHaveTheBranchesTheyShould) {
    Built f;
    std::map<i32, u32> counts;
    for (u32 i = 0; i < 5000; ++i) {
        FeatureRow row = row_of(Shape::cypress);
        row.numbers[parts::cypress::branches_least] = 6;
        f.make(row, bits_of(i), kBuild);
        u32 pads = 0;
        for (u32 k = 0; k < f.tile->primitives; ++k)
            pads += f.tile->primitive[k].solid == Solid::ball;
        ++counts[i32(pads) - 2]; // two make the top
    }
    ASSERT_EQ(counts.size(), 5u);
    for (i32 n = 6; n <= 10; ++n)
        expect_share(counts[n], 5000, 0.2, "branches");
}

} // namespace
} // namespace vitrail
