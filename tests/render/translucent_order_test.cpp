// The order of translucent quads against rays: along any of them, what is drawn later lies nearer.
#include "render/translucent_order.h"

#include "base/rng.h"
#include "math/vec.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>

namespace vitrail::render {

namespace {

using Cells = std::array<u8, 4096>; // y outermost; 0 air, else a kind of what lets light through
u8 cell_at(const Cells& cells, i32 x, i32 y, i32 z) {
    return std::min({x, y, z}) < 0 || std::max({x, y, z}) > 15 ? u8(0) : cells[std::size_t((y * 16 + z) * 16 + x)];
}

// Faces between unlike cells, merged greedily along u, then v.
std::vector<Quad> faces_of(const Cells& cells) {
    std::vector<Quad> out;
    for (u32 f = 0; f < 6; ++f) {
        const u32 axis = f >> 1, u = axis == 0 ? 2 : 0, v = axis == 1 ? 2 : 1;
        for (i32 layer = 0; layer < 16; ++layer) {
            u8 open[16][16] = {};
            const auto place = [&](i32 i, i32 j) {
                IVec3 at{};
                i32* const c[3] = {&at.x, &at.y, &at.z};
                *c[axis] = layer, *c[u] = i, *c[v] = j;
                return at;
            };
            for (i32 j = 0; j < 16; ++j)
                for (i32 i = 0; i < 16; ++i) {
                    const IVec3 at = place(i, j), n = kFaceNormal[f];
                    const u8 own = cell_at(cells, at.x, at.y, at.z);
                    if (own != cell_at(cells, at.x + n.x, at.y + n.y, at.z + n.z)) open[j][i] = own;
                }
            for (i32 j = 0; j < 16; ++j)
                for (i32 i = 0; i < 16; ++i) {
                    const u8 kind = open[j][i];
                    if (kind == 0) continue;
                    i32 w = 1, h = 1;
                    while (i + w < 16 && open[j][i + w] == kind)
                        ++w;
                    const auto row_open = [&] {
                        return j + h < 16 &&
                               std::all_of(open[j + h] + i, open[j + h] + i + w, [&](u8 k) { return k == kind; });
                    };
                    while (row_open())
                        ++h;
                    for (i32 b = 0; b < h; ++b)
                        std::fill_n(open[j + b] + i, w, u8(0));
                    const IVec3 at = place(i, j);
                    out.push_back(Quad::cube({at.x, at.y, at.z}, u32(w), u32(h), Face(f), 255, TextureId(kind),
                                             TintKind::none, 0));
                }
        }
    }
    return out;
}

// Where a ray meets a quad, in lengths of `way`; below 0 where it does not.
float meets(Quad q, Vec3 from, Vec3 way) {
    const float o[3] = {from.x, from.y, from.z}, d[3] = {way.x, way.y, way.z};
    const u32 axis = u32(q.face()) >> 1, u = axis == 0 ? 2 : 0, v = axis == 1 ? 2 : 1;
    const float low[3] = {float(q.x()), float(q.y()), float(q.z())};
    const float plane = low[axis] + (u32(q.face()) & 1 ? 1.0f : 0.0f), t = (plane - o[axis]) / d[axis];
    const float a = o[u] + t * d[u] - low[u], b = o[v] + t * d[v] - low[v];
    return t > 0 && a >= 0 && b >= 0 && a <= float(q.w()) && b <= float(q.h()) ? t : -1.0f;
}

// Of 400 rays from one eye, the pairs that they meet in the wrong order.
u32 wrong_pairs(const std::vector<Quad>& sorted, Vec3 eye, Rng& rng, u32& pairs) {
    u32 wrong = 0;
    for (int ray = 0; ray < 400; ++ray) {
        const Vec3 way = normalized(Vec3{rng.unit() * 16, rng.unit() * 16, rng.unit() * 16} - eye);
        float last = 1e30f;
        bool last_away = false;
        u32 last_axis = 3;
        for (const Quad& q : sorted) {
            const float t = meets(q, eye, way);
            if (t < 0) continue;
            const IVec3 normal = kFaceNormal[u32(q.face())];
            const Vec3 n{float(normal.x), float(normal.y), float(normal.z)};
            const bool away = dot(n, way) > 0;
            // Two faces in one plane: the one that looks away is the nearer block's.
            const u32 axis = u32(q.face()) >> 1;
            wrong += std::abs(t - last) > 1e-3f ? t > last : axis == last_axis && last_away && !away;
            ++pairs;
            last = t, last_away = away, last_axis = axis;
        }
    }
    return wrong;
}

void fill(Cells& cells, IVec3 from, IVec3 to, u8 kind) {
    for (i32 y = from.y; y <= to.y; ++y)
        for (i32 z = from.z; z <= to.z; ++z)
            for (i32 x = from.x; x <= to.x; ++x)
                cells[std::size_t((y * 16 + z) * 16 + x)] = kind;
}

void expect_back_to_front(const Cells& cells, u64 seed, const std::string& what) {
    std::vector<Quad> quads = faces_of(cells);
    cut_where_planes_cross(quads);
    Rng rng(seed);
    u32 pairs = 0;
    for (int turn = 0; turn < 24; ++turn) {
        const std::array<i8, 3> cell{i8(i32(rng.below(18)) - 1), i8(i32(rng.below(18)) - 1),
                                     i8(i32(rng.below(18)) - 1)};
        // An eye outside stands anywhere on its side.
        float at[3];
        for (u32 k = 0; k < 3; ++k)
            at[k] = float(cell[k]) + 0.02f + 0.96f * rng.unit() +
                    (cell[k] < 0    ? -30
                     : cell[k] > 15 ? 30
                                    : 0) *
                        rng.unit();
        sort_back_to_front(quads, cell);
        const u32 wrong = wrong_pairs(quads, {at[0], at[1], at[2]}, rng, pairs);
        ASSERT_EQ(wrong, 0u) << what << ": eye in cell " << int(cell[0]) << " " << int(cell[1]) << " " << int(cell[2])
                             << ", " << quads.size() << " quads";
    }
    EXPECT_GT(pairs, 2000u);
}

} // namespace

// A window of red glass stands in a lake and reaches out of it, a blue one in the open beside; a glass roof lies over
// all.
TEST(TranslucentOrder, GlassInAndOverWater) {
    Cells cells{};
    fill(cells, {0, 0, 0}, {15, 6, 15}, 1);
    fill(cells, {2, 2, 5}, {12, 11, 5}, 2);
    fill(cells, {9, 3, 2}, {9, 13, 13}, 3);
    fill(cells, {0, 15, 0}, {15, 15, 15}, 2);
    expect_back_to_front(cells, 1, "lake");
}

// A red box inside a blue box inside water.
TEST(TranslucentOrder, NestedBoxes) {
    Cells cells{};
    fill(cells, {0, 0, 0}, {15, 13, 15}, 1);
    fill(cells, {2, 2, 3}, {13, 12, 12}, 2);
    fill(cells, {4, 3, 5}, {10, 15, 10}, 3);
    fill(cells, {6, 5, 7}, {8, 9, 8}, 0);
    expect_back_to_front(cells, 2, "nested");
}

TEST(TranslucentOrder, RandomBoxes) {
    for (u64 seed = 0; seed < 40; ++seed) {
        Rng rng(seed + 100);
        Cells cells{};
        for (int box = 0; box < 5; ++box) {
            IVec3 from{i32(rng.below(14)), i32(rng.below(14)), i32(rng.below(14))};
            const IVec3 size{i32(rng.below(12)), i32(rng.below(12)), i32(rng.below(12))};
            fill(cells, from,
                 {std::min(from.x + size.x, 15), std::min(from.y + size.y, 15), std::min(from.z + size.z, 15)},
                 u8(1 + rng.below(3)));
        }
        expect_back_to_front(cells, seed, "random " + std::to_string(seed));
    }
}

} // namespace vitrail::render
