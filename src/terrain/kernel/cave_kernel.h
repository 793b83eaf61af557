// Which blocks of a block column are open: caves, interpolated from the lattice's fields, and ravines. theta = width *
// height factors; open where theta > .07 and closeness < theta (kernel/lattice_kernel.h says what the fields are).
#pragma once

#include "terrain/kernel/lattice_kernel.h"
#include "terrain/kernel/program_kernel.h"

namespace vitrail {

// Where these differ from the reference table: theta of at least .07 for .04 (narrower caves are rows of crumbs);
// mouths, of which it has none; the ravines' sine turns 40 for 15 times and their rims are (.45, .8) for (.4, .6),
// which makes long canyons of round pits.
inline constexpr float kThetaLeast = 0.07f;
inline constexpr float kMouthRise = 44.0f; // blocks: in some places caves reach so much higher, and through the surface
inline constexpr i32 kOpenWords = 5;       // of CaveTile::open: nothing opens at y >= 160
inline constexpr i32 kKeptFromWater = 8;   // blocks of rock under standing water
inline constexpr float kDryHeight = 4.0f;  // land at least so far above the sea may be opened to the sky
inline constexpr float kRavineRadius = 0.12f;                     // cells
inline constexpr float kRavineCell = 1.0f / 0.0015f;              // blocks
inline constexpr float kRavineTurns = 40 * 0.0015f / 6.28318531f; // of the sine across it, a block
inline constexpr float kRavineSkyGap = 18.0f; // a ravine breaks through what lies so far above its top

namespace cave_detail {

// Interpolation between lattice points is a + (b - a) * f with f = 0, 1/4, 1/2 or 3/4: such a result never leaves [a,
// b] even after rounding, so that skipping by the points' bounds changes nothing.
template <class F>
VX_HD F between(F a, F b, float f) {
    return a + (b - a) * f;
}

// One level of one field for a row, between the points around each lane.
VX_HD float field_row(const float* near, const float* near_x, const float* far, const float* far_x,
                      const Row<ScalarLanes>& row) {
    const i32 x = i32(row.dx), p = x >> 2;
    const float fz = float(i32(row.dz) & 3) * 0.25f;
    const float left = between(near[p], far[p], fz);
    const float right = p == 3 ? between(near_x[0], far_x[0], fz) : between(near[p + 1], far[p + 1], fz);
    return left + (right - left) * (float(x & 3) * 0.25f);
}

#ifndef __CUDACC__
using Quad = float __attribute__((vector_size(16)));
template <int I>
VX_HD FloatLanes field_row(const float* near, const float* near_x, const float* far, const float* far_x,
                           const Row<WideLanes<I>>& row) {
    Quad a, b;
    __builtin_memcpy(&a, near, sizeof a);
    __builtin_memcpy(&b, far, sizeof b);
    const float fz = float(i32(row.dz) & 3) * 0.25f;
    const Quad q = between(a, b, fz), next = Quad{between(near_x[0], far_x[0], fz)};
    const FloatLanes left = __builtin_shufflevector(q, q, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
    const FloatLanes right = __builtin_shufflevector(q, next, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4);
    constexpr FloatLanes fx = {0, .25f, .5f, .75f, 0, .25f, .5f, .75f, 0, .25f, .5f, .75f, 0, .25f, .5f, .75f};
    return left + (right - left) * fx;
}
#endif

// The row's values one block along x (d = 1 or -1); a column's last lane has no neighbor and gives itself.
VX_HD float beside(const float* values, const Row<ScalarLanes>& row, i32 d) {
    const i32 x = i32(row.dx) + d;
    return values[x >= 0 && x < 16 ? row.index + d : row.index];
}
#ifndef __CUDACC__
template <int I>
VX_HD FloatLanes beside(const float* values, const Row<WideLanes<I>>& row, i32 d) {
    const FloatLanes v = WideLanes<I>::load(values + row.index);
    return d < 0 ? __builtin_shufflevector(v, v, 0, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14)
                 : __builtin_shufflevector(v, v, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 15);
}
#endif

// The least height of the ground at a block column and the four beside it. A stage sees no ground but its own column's,
// so beyond a border the slope goes on: a cliff that begins right there is missed.
template <class L>
VX_HD_FN typename L::F lowest_around(const float* top, const Row<L>& row) {
    using F = typename L::F;
    const F own = L::load(top + row.index), west = beside(top, row, -1), east = beside(top, row, 1);
    const i32 z = i32(row.dz);
    const F north = L::load(top + (z > 0 ? row.index - 16 : row.index)),
            south = L::load(top + (z < 15 ? row.index + 16 : row.index));
    const F twice = own + own;
    const F x = select(row.dx == L::f(0.0f), least(east, twice - east),
                       select(row.dx == L::f(15.0f), least(west, twice - west), least(west, east)));
    const F y = z == 0 ? least(south, twice - south) : z == 15 ? least(north, twice - north) : least(north, south);
    return least(own, least(x, y));
}

// Bits 0 .. n - 1 of a word; all for n >= 32, none for n <= 0.
template <class L>
VX_HD typename L::U bits_below(typename L::I n) {
    const auto some = n > L::i(0), all = n >= L::i(32);
    const typename L::U shift = as_uint(select(some, select(all, L::i(0), n), L::i(0)));
    return select(all, L::u(~0u), (L::u(1) << shift) - 1u);
}

} // namespace cave_detail

// The fields of one level for a row: y = 4 * level.
template <class L>
VX_HD_FN void cave_fields_row(const LatticeTile* const lattices[4], const Row<L>& row, i32 level,
                              typename L::F& closeness, typename L::F& width) {
    using namespace cave_detail;
    const i32 q = i32(row.dz) >> 2;
    // The four corners come from the column itself, its +x, its +z and its +x+z neighbor.
    const i32 near = q << 2, far = q == 3 ? 0 : near + 4, beyond = q == 3 ? 2 : 0;
    const LatticeTile &a = *lattices[0], &ax = *lattices[1], &b = *lattices[beyond], &bx = *lattices[beyond + 1];
    closeness = field_row(a.closeness[level] + near, ax.closeness[level] + near, b.closeness[level] + far,
                          bx.closeness[level] + far, row);
    width = field_row(a.width[level] + near, ax.width[level] + near, b.width[level] + far, bx.width[level] + far, row);
}

// What a lane's ravine takes: blocks low <= y < high, where high > low.
template <class L>
struct RavineSpan {
    typename L::F low, high;
};

// ocean: 0..1; top: of the ground.
template <class L>
VX_HD_FN RavineSpan<L> ravine_span(const TerrainTables& t, const Row<L>& row, typename L::F ocean, typename L::F top) {
    using F = typename L::F;
    const F none = L::f(0.0f);
    const auto fractal = [&](Noise n, const Spot<L>& p) { return fractal2<L>(t.octave + n.first, n.octaves, p); };
    const Spot<L> place = row.spot(none);
    // .03 of r are 20 blocks. The other axis reads the same noise with x and z exchanged.
    const Spot<L> mirrored{row.z, row.x, L::f(row.dz), none, row.dx};
    Spot<L> moved = place;
    moved.dx = moved.dx + fractal(t.ravine_warp, place) * (0.03f * kRavineCell);
    moved.dz = moved.dz + fractal(t.ravine_warp, mirrored) * (0.03f * kRavineCell);
    const Cellular<L> cells = worley2<L>(t.octave[t.ravine_cells.first], moved);
    const F reach = (1.0f - ocean) * kRavineRadius;
    const auto inside = cells.f1 < reach;
    RavineSpan<L> out{none, none};
    if (!L::any(inside)) return out;
    // sin(40 (rx + rz) + 4 F): the part that grows with x and z is counted in turns, in 2^-64 of one, so that it wraps.
    constexpr u64 turns = u64(kRavineTurns * 18446744073709551616.0f);
    const u64 base = (u64(i64(row.x)) + u64(i64(row.z))) * turns;
    const F angle = (noise_detail::fraction_of(base >> 32) + (moved.dx + moved.dz) * kRavineTurns) * 6.28318531f +
                    fractal(t.ravine_gate, place) * 4.0f;
    const F gate = step_between<L>(0.45f, 0.8f, sine_of<L>(angle));
    const F rim = step_between<L>(0.0f, 0.3f, 1.0f - cells.f1 / select(inside, reach, L::f(1.0f)));
    const F depth = (fractal(t.ravine_depth, place) * 26.0f + 60.0f) * rim * gate;
    const F rim_y = unit_of(cells.cell) * 24.0f + 120.0f, low = rim_y - depth;
    // Through to the sky, or under a vault.
    const F high =
        select(top < rim_y + kRavineSkyGap, L::f(float(kOpenWords * 32)), rim_y - (1.0f - rim * gate) * 10.0f);
    const auto deep = inside & (depth > L::f(1.0f));
    out.low = select(deep, low, none);
    out.high = select(deep, high, none);
    return out;
}

// Open bits of a row and its cave attributes' offsets. levels: bit l says whether any block from y = 4 l to 4 l + 3 may
// be open as a cave (cave_levels, or all ones: the result is the same).
template <class L>
VX_HD_FN void cave_row(const TerrainTables& t, const GroundTile& ground, const LatticeTile* const lattices[4],
                       const Row<L>& row, u64 levels, CaveTile& out) {
    using namespace cave_detail;
    using F = typename L::F;
    using I = typename L::I;
    using U = typename L::U;
    const i32 at = row.index;
    const F top = L::load(ground.top + at);
    const F ocean = t.ocean >= 0 ? L::load(ground.attribute[t.ocean] + at) : L::f(0.0f);
    // Land near the sea's height, and what stands right beside such land, keeps a roof over all caves and has no
    // ravine.
    const F low_land = lowest_around<L>(ground.top, row);
    const auto dry = low_land >= L::f(float(kTerrainSeaLevel) + kDryHeight);
    const F roof =
        greatest(least(select(dry, top, low_land - float(kKeptFromWater)), L::f(float(kTerrainHeight))), L::f(0.0f));
    const I limit = -floor_int<L>(-roof); // y < roof for y < limit
    const RavineSpan<L> ravine = ravine_span<L>(t, row, select(dry, ocean, L::f(1.0f)), top);
    const I ravine_low = floor_int<L>(ravine.low), ravine_high = floor_int<L>(ravine.high);

    const Noise n = t.ravine_depth;
    const F high = fractal2<L>(t.octave + n.first, n.octaves, row.spot(L::f(0.0f)));
    const F lower = ocean * 50.0f - step_between<L>(0.25f, 0.5f, high) * kMouthRise; // that much, as the caves see it

    F closeness = L::f(kClosenessMost), width = L::f(0.0f);
    i32 have = -1; // the level they are of
    for (i32 word = 0; word < kOpenWords; ++word) {
        U bits = L::u(0);
        for (i32 level = word * 8; level < word * 8 + 8 && level < kLatticeLevels - 1; ++level) {
            if ((levels >> level & 1) == 0) continue;
            if (have != level) cave_fields_row<L>(lattices, row, level, closeness, width);
            const F c0 = closeness, w0 = width;
            cave_fields_row<L>(lattices, row, level + 1, closeness, width);
            have = level + 1;
            if (!L::any(least(c0, closeness) < greatest(w0, width) * 1.001f)) continue;
            for (i32 i = 0; i < kLatticeStep; ++i) {
                const i32 y = level * kLatticeStep + i;
                const float f = float(i) * 0.25f;
                const F low = 0.3f + 0.7f * step_between<ScalarLanes>(5.0f, 20.0f, float(y)) + L::f(0.0f);
                const F theta = between(w0, width, f) * (step_between<L>(142.0f, 95.0f, lower + float(y)) * low);
                const auto open = (theta > L::f(kThetaLeast)) & (between(c0, closeness, f) < theta);
                bits = bits | select(open, L::u(1u << (y & 31)), L::u(0));
            }
        }
        const i32 base = word * 32;
        bits = bits | (bits_below<L>(ravine_high - base) ^ bits_below<L>(least(ravine_low, ravine_high) - base));
        bits = bits & bits_below<L>(limit - base);
        if (word == 0) bits = bits & ~1u; // bedrock
        L::store(out.open[word] + at, bits);
    }
    for (i32 word = kOpenWords; word < kTerrainHeight / 32; ++word)
        L::store(out.open[word] + at, L::u(0));

    F inputs[kInputs];
    for (u32 i = 0; i < kAttributesMost; ++i)
        inputs[i] = i < t.attributes ? L::load(ground.attribute[i] + at) : L::f(0.0f);
    inputs[kInputHeight] = L::load(ground.land + at);
    for (u32 i = 0; i < t.cave_attributes; ++i)
        L::store(out.offset[i] + at, run_program<L>(t, t.cave_attribute[i].offset, row.spot(L::f(0.0f)), inputs));
}

} // namespace vitrail
