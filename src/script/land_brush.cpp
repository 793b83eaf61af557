#include "script/land_brush.h"

#include "base/hash.h"

#include <algorithm>
#include <cmath>

namespace vitrail {

namespace {

float spline(float a, float b, float c, float d, float t) {
    return b + .5f * t * (c - a + t * (2 * a - 5 * b + 4 * c - d + t * (3 * (b - c) + d - a)));
}

double corner(i64 x, i64 z, u64 seed, double dx, double dz) {
    const u64 h = mix64(mix64(seed ^ u64(x) * 0x9e3779b97f4a7c15ull) ^ u64(z));
    const auto unit = [](u64 bits) { return double(bits & 0xffff) / 32767.5 - 1; };
    return unit(h) * dx + unit(h >> 16) * dz;
}

double noise(double x, double z, u64 seed) {
    const double fx = std::floor(x), fz = std::floor(z), dx = x - fx, dz = z - fz;
    const auto ease = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
    const i64 ix = i64(fx), iz = i64(fz);
    const double u = ease(dx), v = ease(dz);
    const double near = corner(ix, iz, seed, dx, dz) * (1 - u) + corner(ix + 1, iz, seed, dx - 1, dz) * u;
    const double far =
        corner(ix, iz + 1, seed, dx, dz - 1) * (1 - u) + corner(ix + 1, iz + 1, seed, dx - 1, dz - 1) * u;
    return (near * (1 - v) + far * v) * 1.6;
}

// One chunk column of land.
struct Heights {
    std::array<i32, 256> top; // the highest block of land
    std::array<float, 256> slope;
    i32 lowest, highest;
};

Heights heights_of(const LandBrush& land, i32 x0, i32 z0) {
    Heights out{{}, {}, std::numeric_limits<i32>::max(), std::numeric_limits<i32>::min()};
    std::array<float, 18 * 18> h; // one more on each side, for slopes
    for (i32 z = 0; z < 18; ++z)
        for (i32 x = 0; x < 18; ++x)
            h[std::size_t(z * 18 + x)] = land_height(land, x0 + x - 1, z0 + z - 1);
    for (i32 z = 0; z < 16; ++z)
        for (i32 x = 0; x < 16; ++x) {
            const std::size_t i = std::size_t((z + 1) * 18 + x + 1), o = std::size_t(x | z << 4);
            out.top[o] = i32(std::floor(h[i])) - 1;
            const float dx = (h[i + 1] - h[i - 1]) * .5f, dz = (h[i + 18] - h[i - 18]) * .5f;
            out.slope[o] = std::sqrt(dx * dx + dz * dz);
            out.lowest = std::min(out.lowest, out.top[o]);
            out.highest = std::max(out.highest, out.top[o]);
        }
    return out;
}

const LandCover* cover_of(const LandBrush& land, i32 x, i32 z, i32 top, float slope) {
    for (const LandCover& cover : land.covers) {
        const float y =
            float(top) + (cover.wander > 0 ? cover.wander * float(script_noise(x * .11, z * .11, 77, 2)) : 0.f);
        if (y >= cover.above && y < cover.below && slope >= cover.steeper && slope < cover.flatter) return &cover;
    }
    return nullptr;
}

} // namespace

double script_noise(double x, double z, u64 seed, u32 octaves) {
    double sum = 0, strength = 1, all = 0;
    for (u32 i = 0; i < octaves; ++i) {
        sum += strength * noise(x, z, seed + i);
        all += strength;
        x *= 2, z *= 2, strength *= .5;
    }
    return all > 0 ? sum / all : 0;
}

float land_height(const LandBrush& land, i32 x, i32 z) {
    const i32 columns = i32(land.width), rows = i32(land.depth());
    const float fx = std::clamp(float(x - land.x) / float(land.step), 0.f, float(columns - 1));
    const float fz = std::clamp(float(z - land.z) / float(land.step), 0.f, float(rows - 1));
    const i32 ix = std::min(i32(fx), columns - 2), iz = std::min(i32(fz), rows - 2);
    const auto at = [&](i32 cx, i32 cz) {
        return land.heights[std::size_t(std::clamp(cz, 0, rows - 1)) * land.width +
                            std::size_t(std::clamp(cx, 0, columns - 1))];
    };
    float row[4];
    for (i32 k = 0; k < 4; ++k)
        row[k] = spline(at(ix - 1, iz + k - 1), at(ix, iz + k - 1), at(ix + 1, iz + k - 1), at(ix + 2, iz + k - 1),
                        fx - float(ix));
    return spline(row[0], row[1], row[2], row[3], fz - float(iz));
}

Result<> paint_land(BlockCanvas& canvas, const LandBrush& land) {
    const i32 x_end = land.x + land.step * i32(land.width - 1), z_end = land.z + land.step * i32(land.depth() - 1);
    VX_TRY(canvas.check({{land.x, land.bottom, land.z}, {x_end - 1, land.bottom, z_end - 1}}));
    i32 deepest = 0;
    for (const LandCover& cover : land.covers)
        deepest = std::max(deepest, cover.depth);
    for (i32 z0 = land.z & ~15; z0 < z_end; z0 += 16)
        for (i32 x0 = land.x & ~15; x0 < x_end; x0 += 16) {
            VX_TRY(canvas.charge(16 * (324 + 256 * u64(land.covers.size())))); // what splines and noise cost
            const Heights heights = heights_of(land, x0, z0);
            const i32 highest = std::max(heights.highest, land.water_level);
            if (highest < land.bottom) continue;
            VX_TRY(canvas.check({{land.x, land.bottom, land.z}, {land.x, highest, land.z}}));
            const i32 xa = std::max(x0, land.x), xb = std::min(x0 + 16, x_end), za = std::max(z0, land.z),
                      zb = std::min(z0 + 16, z_end);
            // Chunks of rock alone first.
            i32 y = land.bottom;
            const i32 rock_end = heights.lowest - deepest + 1; // rock everywhere below it
            if (rock_end > y) {
                VX_TRY(canvas.fill({{xa, y, za}, {xb - 1, rock_end - 1, zb - 1}}, land.rock));
                y = rock_end;
            }
            std::array<const LandCover*, 256> covers;
            for (u32 i = 0; i < 256; ++i)
                covers[i] = cover_of(land, x0 + i32(i & 15), z0 + i32(i >> 4), heights.top[i], heights.slope[i]);
            for (i32 cy = y >> 4; cy <= highest >> 4; ++cy) {
                VX_TRY_ASSIGN(auto* cells, canvas.cells({x0 >> 4, cy, z0 >> 4}));
                for (i32 by = std::max(y, cy * 16); by <= std::min(highest, cy * 16 + 15); ++by)
                    for (i32 z = za; z < zb; ++z)
                        for (i32 x = xa; x < xb; ++x) {
                            const u32 i = u32((x & 15) | (z & 15) << 4);
                            const i32 down = heights.top[i] - by; // blocks below the surface
                            StateId& cell = (*cells)[local_of({x, by, z}).index];
                            if (down < 0) {
                                if (by <= land.water_level) cell = land.water;
                            } else
                                cell = !covers[i] || down >= covers[i]->depth ? land.rock
                                       : down > 0                             ? covers[i]->under
                                                                              : covers[i]->top;
                        }
            }
        }
    return {};
}

} // namespace vitrail
