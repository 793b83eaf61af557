// The clear dome as a small table, for C++ and GLSL alike (render/passes/common/sky.glsl reads it the same way). Both
// lights of the sky stand in one vertical plane, so half a turn of azimuth is enough: columns go from the sun's azimuth
// (0) to the opposite one (1) by the sine of half the angle between, rows from the horizon (0) to the zenith (1) by the
// square root of the direction's y. Texels sit on the ends of both ranges. Kernel-safe.
#pragma once

#include "base/hd.h"
#include "math/vec.h"

namespace vitrail::scene {

struct SkyTable {
    static constexpr u32 kWidth = 48, kHeight = 32;
    Vec3 texels[kWidth * kHeight]; // linear RGB, units of sky.h; row by row from the horizon
};

// Column 0..1 and row 0..1 of a direction (any length, upper half; lower ones take the horizon's row). towards_sun:
// unit, horizontal (x, z).
VX_HD Vec2 sky_table_place(Vec3 d, Vec2 towards_sun) {
    const float flat2 = d.x * d.x + d.z * d.z;
    const float c = (d.x * towards_sun.x + d.z * towards_sun.y) / std::sqrt(flat2 > 1e-8f ? flat2 : 1e-8f);
    return {std::sqrt(clamp(0.5f - 0.5f * c, 0.0f, 1.0f)), std::sqrt(clamp(d.y, 0.0f, 1.0f))};
}

// Bilinear.
VX_HD Vec3 sky_table_at(const SkyTable& table, Vec2 place) {
    const float x = place.x * float(SkyTable::kWidth - 1), y = place.y * float(SkyTable::kHeight - 1);
    u32 column = u32(x), row = u32(y);
    column = column < SkyTable::kWidth - 2 ? column : SkyTable::kWidth - 2;
    row = row < SkyTable::kHeight - 2 ? row : SkyTable::kHeight - 2;
    const float fx = x - float(column), fy = y - float(row);
    const Vec3* p = table.texels + row * SkyTable::kWidth + column;
    return lerp(lerp(p[0], p[1], fx), lerp(p[SkyTable::kWidth], p[SkyTable::kWidth + 1], fx), fy);
}

} // namespace vitrail::scene
