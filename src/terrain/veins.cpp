// Ores and pockets of other rock: blobs placed by column, drawn by every column they touch.
#include "terrain/column_canvas.h"

#include "base/rng.h"

#include <algorithm>

namespace vitrail {

namespace {

struct Vein {
    TerrainBlock in_stone, in_deepslate;
    float count; // a column
    float radius_min, radius_max;
    i32 low, high;        // height of the center
    bool peaked;          // commonest halfway, else even
    float least_mountain; // only where the mountain mask is above this
};

using enum TerrainBlock;
constexpr Vein kVeins[] = {
    {granite, tuff, 3.0f, 2.5f, 4.6f, -10, 110, false, -1},
    {diorite, tuff, 3.0f, 2.5f, 4.6f, -10, 110, false, -1},
    {andesite, tuff, 3.0f, 2.5f, 4.6f, -10, 110, false, -1},
    {tuff, tuff, 2.5f, 2.5f, 4.6f, -64, 4, false, -1},
    {gravel, gravel, 2.0f, 2.0f, 3.4f, -60, 90, false, -1},
    {dirt, dirt, 2.0f, 2.0f, 3.4f, 5, 100, false, -1},
    {coal_ore, deepslate_coal_ore, 15.0f, 1.1f, 2.1f, -6, 150, true, -1},
    {iron_ore, deepslate_iron_ore, 11.0f, 1.0f, 1.75f, -40, 80, true, -1},
    {iron_ore, deepslate_iron_ore, 6.0f, 1.0f, 1.75f, 90, 230, false, -1},
    {copper_ore, deepslate_copper_ore, 7.0f, 1.1f, 2.0f, -10, 105, true, -1},
    {gold_ore, deepslate_gold_ore, 3.2f, 1.0f, 1.7f, -62, 30, true, -1},
    {redstone_ore, deepslate_redstone_ore, 4.5f, 1.0f, 1.7f, -63, 14, false, -1},
    {lapis_ore, deepslate_lapis_ore, 1.8f, 1.0f, 1.6f, -50, 40, true, -1},
    {diamond_ore, deepslate_diamond_ore, 2.6f, 0.9f, 1.55f, -63, 8, false, -1},
    {emerald_ore, deepslate_emerald_ore, 4.0f, 0.6f, 1.0f, 20, 200, false, 0.25f},
};

void draw_vein(ColumnCanvas& c, const Vein& vein, u32 kind, i32 cx, i32 cz, u32 n) {
    const RngKey key{c.keys.seed, 0x7e220200u + kind};
    const u64 h = random_u64(key, cx, i32(n), cz), g = mix64(h + 1);
    if (n + 1 > u32(vein.count) && float(g >> 40) * (1.0f / 16777216.0f) > vein.count - float(n)) return;
    const i32 x0 = (cx * 16 + i32(h & 15)) - c.base_x, z0 = (cz * 16 + i32(h >> 4 & 15)) - c.base_z;
    const float radius = vein.radius_min + float(h >> 8 & 255) * (1.0f / 255.0f) * (vein.radius_max - vein.radius_min);
    const i32 r = i32(radius) + 1;
    if (x0 + r < 0 || x0 - r > 15 || z0 + r < 0 || z0 - r > 15) return;
    const u32 range = u32(vein.high - vein.low);
    const u32 a = u32(h >> 16 & 0xffff) * range >> 16, b = u32(h >> 32 & 0xffff) * range >> 16;
    const i32 y0 = vein.low + i32(vein.peaked ? (a + b) / 2 : a);
    const float flat = 0.8f + float(h >> 48 & 255) * (0.7f / 255.0f); // some lie, some stand
    for (i32 y = std::max(y0 - r, kTerrainMinY); y <= std::min(y0 + r, kTerrainMaxY - 1); ++y)
        for (i32 z = std::max(z0 - r, 0); z <= std::min(z0 + r, 15); ++z)
            for (i32 x = std::max(x0 - r, 0); x <= std::min(x0 + r, 15); ++x) {
                const float dx = float(x - x0), dy = float(y - y0) * flat, dz = float(z - z0);
                const u64 rough = mix64(h ^ u64(u32((x - x0) * 289 + (y - y0) * 17 + (z - z0))));
                const float reach = radius * (0.75f + float(rough >> 56) * (0.45f / 255.0f));
                if (dx * dx + dy * dy + dz * dz > reach * reach) continue;
                const TerrainBlock old = c.get(x, y, z);
                const bool deep = old == deepslate;
                if (old != stone && !deep) continue;
                if (vein.least_mountain >= 0 && c.land_at(x, z).mountain < vein.least_mountain) continue;
                c.put(x, y, z, deep ? vein.in_deepslate : vein.in_stone);
            }
}

} // namespace

void place_veins(ColumnCanvas& c) {
    const i32 cx = c.base_x >> 4, cz = c.base_z >> 4;
    for (u32 kind = 0; kind < std::size(kVeins); ++kind) {
        const u32 most = u32(kVeins[kind].count) + (float(u32(kVeins[kind].count)) < kVeins[kind].count);
        for (i32 dz = -1; dz <= 1; ++dz)
            for (i32 dx = -1; dx <= 1; ++dx)
                for (u32 n = 0; n < most; ++n)
                    draw_vein(c, kVeins[kind], kind, cx + dx, cz + dz, n);
    }
}

} // namespace vitrail
