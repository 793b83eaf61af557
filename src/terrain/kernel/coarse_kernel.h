// Smooth noise under the ground, sampled at every fourth block of a column and interpolated in between: what bounds the
// strata and where veins run, which nobody sees as numbers. Points are computed from the column's own anchor, those on
// its far sides (offset 16) too, so a column asks no other. The same bits with and without CoarseFields: they only keep
// points.
#pragma once

#include "terrain/kernel/noise_kernel.h"
#include "terrain/tiles.h"

namespace vitrail {

inline constexpr i32 kCoarseStep = 4, kCoarsePoints = 25; // points x / 4 + 5 * (z / 4), x, z = 0, 4, ... 16
inline constexpr i32 kCoarseLevels = kTerrainHeight / kCoarseStep + 1;
inline constexpr u32 kCoarseVeins = 8; // veined rules whose points are kept; further ones ask their points anew

struct CoarsePlane {
    float point[40]; // kCoarsePoints of them, and room for whole vectors
};
struct CoarseStrata {
    u32 ready = 0; // bits
    CoarsePlane plane[kStrataMost];
};
struct CoarseFields {
    CoarseStrata strata;
    u32 veins = 0;        // how many of the following are in use
    u16 vein_rule[kCoarseVeins];
    u32 vein_ready[kCoarseVeins][(kCoarseLevels + 31) / 32];
    CoarsePlane vein[kCoarseVeins][kCoarseLevels];
};

template <class L>
VX_HD typename L::I lane_numbers() {
    if constexpr (L::kWidth == 1) {
        return 0;
    } else {
        typename L::I n{};
        for (i32 l = 0; l < L::kWidth; ++l)
            n[l] = l;
        return n;
    }
}

// Fractal noise in two (y < 0) or three dimensions.
template <class L>
VX_HD typename L::F coarse_sample(const TerrainTables& t, u32 noise, const Spot<L>& p, bool flat) {
    const Noise n = t.noise[noise];
    return flat ? fractal2<L>(&t.octave[n.first], n.octaves, p) : fractal3<L>(&t.octave[n.first], n.octaves, p);
}

// y: blocks, a multiple of 4; negative: noise in two dimensions.
template <class L>
VX_HD_FN void coarse_plane(const TerrainTables& t, u32 noise, i32 x, i32 z, i32 y, CoarsePlane& out) {
    for (i32 first = 0; first < kCoarsePoints; first += L::kWidth) {
        const typename L::I point = lane_numbers<L>() + first, row = point * 52 >> 8; // point / 5, below 48
        const Spot<L> p{x, z, to_float((point - row * 5) * kCoarseStep), L::f(float(y < 0 ? 0 : y)),
                        to_float(row * kCoarseStep)};
        L::store(out.point + first, coarse_sample<L>(t, noise, p, y < 0));
    }
}

// First between rows of points, then along the row.
template <class L>
VX_HD typename L::F coarse_at(const CoarsePlane& plane, const Row<L>& row) {
    const i32 in_z = i32(row.dz), first = (in_z >> 2) * 5;
    const float part_z = float(in_z & 3) * 0.25f;
    const typename L::I in_x = to_int(row.dx);
    const typename L::F part_x = to_float(in_x & 3) * 0.25f;
    typename L::F left, right;
    if constexpr (L::kWidth == 1) {
        const float* p = plane.point + first + (in_x >> 2);
        left = p[0] + (p[5] - p[0]) * part_z;
        right = p[1] + (p[6] - p[1]) * part_z;
    } else {
        const typename L::F p = L::load(plane.point + first), q = L::load(plane.point + first + 5);
        const typename L::F between = p + (q - p) * part_z; // the first five
        left = __builtin_shufflevector(between, between, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3);
        right = __builtin_shufflevector(between, between, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4);
    }
    return left + (right - left) * part_x;
}

// The same without kept points.
template <class L>
VX_HD_FN typename L::F coarse_anew(const TerrainTables& t, u32 noise, const Row<L>& row, i32 y) {
    using F = typename L::F;
    const i32 in_z = i32(row.dz);
    const float part_z = float(in_z & 3) * 0.25f;
    const typename L::I in_x = to_int(row.dx);
    const F part_x = to_float(in_x & 3) * 0.25f, west = to_float(in_x & ~3);
    const F north = L::f(float(in_z & ~3)), height = L::f(float(y < 0 ? 0 : y));
    F side[2];
    for (i32 i = 0; i < 2; ++i) {
        const F at = west + float(i * kCoarseStep);
        const F a = coarse_sample<L>(t, noise, Spot<L>{row.x, row.z, at, height, north}, y < 0);
        const F b = coarse_sample<L>(t, noise, Spot<L>{row.x, row.z, at, height, north + float(kCoarseStep)}, y < 0);
        side[i] = a + (b - a) * part_z;
    }
    return side[0] + (side[1] - side[0]) * part_x;
}

// strata: of this column, or null.
template <class L>
VX_HD typename L::F stratum_noise(const TerrainTables& t, u32 stratum, const Row<L>& row, CoarseStrata* strata) {
    const u32 noise = t.stratum[stratum].noise;
    if (!strata) return coarse_anew<L>(t, noise, row, -1);
    if ((strata->ready >> stratum & 1) == 0) {
        coarse_plane<L>(t, noise, row.x, row.z, -1, strata->plane[stratum]);
        strata->ready |= 1u << stratum;
    }
    return coarse_at<L>(strata->plane[stratum], row);
}

// Noise of veins at the block level y = 4 * level; rule: index of the cave rule.
template <class L>
VX_HD typename L::F vein_noise(const TerrainTables& t, u32 rule, i32 level, const Row<L>& row, CoarseFields* fields) {
    const u32 noise = t.cave_rule[rule].vein;
    u32 slot = 0;
    if (fields) {
        while (slot < fields->veins && fields->vein_rule[slot] != rule)
            ++slot;
        if (slot == fields->veins && slot < kCoarseVeins) {
            fields->vein_rule[slot] = u16(rule);
            for (u32& word : fields->vein_ready[slot])
                word = 0;
            ++fields->veins;
        }
    }
    if (!fields || slot == kCoarseVeins) return coarse_anew<L>(t, noise, row, level * kCoarseStep);
    u32& ready = fields->vein_ready[slot][level >> 5];
    CoarsePlane& plane = fields->vein[slot][level];
    if ((ready >> (level & 31) & 1) == 0) {
        coarse_plane<L>(t, noise, row.x, row.z, level * kCoarseStep, plane);
        ready |= 1u << (level & 31);
    }
    return coarse_at<L>(plane, row);
}

} // namespace vitrail
