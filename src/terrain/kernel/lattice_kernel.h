// The two fields that caves are made of, at one point each of a lattice of 4 blocks: how nearly three cells of Worley's
// noise meet in a place (closeness: the ratio of the third distance to the first, less 1; tunnels follow the edges
// where it is 0), and how wide a cave may be there. Both are smooth enough that what lies between is interpolated
// (kernel/cave_kernel.h).
#pragma once

#include "terrain/tiles.h"

namespace vitrail {

// Where these differ from the reference table (1.8 and .24 + .12 F): three warps that know nothing of each other fold
// space more than one does, and would shred tunnels into crumbs; narrower caves leave a tenth of the rock open instead
// of a fifth.
inline constexpr float kCaveStretch = 1.6f; // cells are flatter than wide
inline constexpr float kCaveWarp = 1.2f;    // cells
inline constexpr float kCaveWidth = 0.15f, kCaveWidthChange = 0.08f, kCaveHallWidth = 1.4f;
inline constexpr float kClosenessMost = 16.0f;                       // a cap, where a place is a cell's very point
inline constexpr i32 kCaveTop = (kLatticeLevels - 1) * kLatticeStep; // caves lie below

// Fields of the places `at`: blocks.
template <class L>
VX_HD_FN void cave_fields(const TerrainTables& t, const Spot<L>& at, typename L::F& closeness, typename L::F& width) {
    using F = typename L::F;
    const auto fractal = [&](Noise n) { return fractal3<L>(t.octave + n.first, n.octaves, at); };
    const auto warp = [&](Noise n) { return fractal(n) * kCaveWarp; };
    const F wx = warp(t.cave_warp_x), wy = warp(t.cave_warp_y), wz = warp(t.cave_warp_z);
    const Cellular<L> cells = worley3<L>(t.octave[t.cave_cells.first], at, kCaveStretch, wx, wy, wz);
    closeness = least(cells.f3 / greatest(cells.f1, L::f(1e-4f)) - 1.0f, L::f(kClosenessMost));
    const F gate = 1.0f + step_between<L>(0.2f, 0.4f, fractal(t.cave_gate)) * kCaveHallWidth;
    width = (fractal(t.cave_width) * kCaveWidthChange + kCaveWidth) * gate;
}

// Points of the lattice of the column `at`: lane l (GPU: `point`) is the block column (4 * (l & 3), 4 * (l >> 2)).
template <class L>
struct LatticePoints {
    i32 x = 0, z = 0; // least corner of the column, blocks
    i32 index = 0;    // of lane 0 (GPU: of the point) in a level
    typename L::F dx, dz;
};

// One level, 0 <= level < kLatticeLevels.
template <class L>
VX_HD_FN void lattice_level(const TerrainTables& t, const LatticePoints<L>& points, i32 level, LatticeTile& out) {
    using F = typename L::F;
    F closeness, width;
    cave_fields<L>(t, Spot<L>{points.x, points.z, points.dx, L::f(float(level * kLatticeStep)), points.dz}, closeness,
                   width);
    L::store(out.closeness[level] + points.index, closeness);
    L::store(out.width[level] + points.index, width);
}

#ifndef __CUDACC__
template <class L>
VX_HD LatticePoints<L> wide_points(ColumnPos at) {
    LatticePoints<L> p;
    p.x = i32(u32(at.x) << 4);
    p.z = i32(u32(at.z) << 4);
    for (int l = 0; l < 16; ++l) {
        p.dx[l] = float((l & 3) * kLatticeStep);
        p.dz[l] = float((l >> 2) * kLatticeStep);
    }
    return p;
}
#endif
VX_HD LatticePoints<ScalarLanes> thread_point(ColumnPos at, i32 point) {
    LatticePoints<ScalarLanes> p;
    p.x = i32(u32(at.x) << 4);
    p.z = i32(u32(at.z) << 4);
    p.index = point;
    p.dx = float((point & 3) * kLatticeStep);
    p.dz = float((point >> 2) * kLatticeStep);
    return p;
}

} // namespace vitrail
