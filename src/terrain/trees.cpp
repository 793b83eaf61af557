// Trees, cacti and boulders: at most one in each cell of 4x4 blocks, drawn by every column that it touches.
#include "terrain/column_canvas.h"

#include "base/rng.h"

#include <algorithm>

namespace vitrail {

namespace {

using enum TerrainBlock;

constexpr i32 kCell = 4;
constexpr i32 kReach = 7; // no tree is wider from its trunk; kMargin - 1, so that slopes are known

enum class Growth : u8 { none, oak, big_oak, birch, spruce, cactus, boulder };

struct Seedling {
    i32 x = 0, z = 0; // world block
    u64 dice = 0;
};

Seedling seedling_in(const TerrainKeys& keys, i32 cell_x, i32 cell_z) {
    const u64 h = random_u64({keys.seed, 0x7e220301u}, cell_x, 0, cell_z);
    return {cell_x * kCell + i32((h & 0xffff) % 3), cell_z * kCell + i32((h >> 16 & 0xffff) % 3), mix64(h)};
}

float part_of(u64 dice, u32 shift) {
    return float(dice >> shift & 0xffff) * (1.0f / 65536.0f);
}

// Rolls that no biome lets grow: spares looking at the land.
bool may_grow(const Seedling& s) {
    const float roll = part_of(s.dice, 0);
    return roll < 0.36f * 1.5f || roll > 0.985f;
}

Growth growth_of(const TerrainKeys& keys, const Seedling& s, TerrainBiome biome, float slope, i32 ground_y,
                 float height) {
    if (ground_y <= kTerrainSeaLevel || slope > 1.9f) return Growth::none;
    // groves and clearings
    const float grove = clamp(0.75f + noise2(keys.plants, fixed_block(s.x), fixed_block(s.z), 6) * 0.9f, 0.05f, 1.5f);
    const float roll = part_of(s.dice, 0), kind = part_of(s.dice, 16);
    switch (biome) {
    case TerrainBiome::forest:
        if (roll > 0.34f * grove) return Growth::none;
        return kind < 0.12f ? Growth::big_oak : kind < 0.78f ? Growth::oak : Growth::birch;
    case TerrainBiome::birch_forest:
        return roll < 0.36f * grove ? (kind < 0.06f ? Growth::oak : Growth::birch) : Growth::none;
    case TerrainBiome::taiga:
        if (roll > 0.985f && kind < 0.3f) return Growth::boulder;
        return roll < 0.32f * grove ? Growth::spruce : Growth::none;
    case TerrainBiome::snowy_taiga:
        return roll < 0.26f * grove ? Growth::spruce : Growth::none;
    case TerrainBiome::plains:
        return roll < 0.008f ? (kind < 0.35f ? Growth::big_oak : Growth::oak) : Growth::none;
    case TerrainBiome::snowy_plains:
        return roll < 0.006f ? Growth::spruce : Growth::none;
    case TerrainBiome::meadow:
        if (height > 122.0f) return Growth::none;
        return roll < 0.09f * (grove - 0.4f) ? Growth::spruce : Growth::none;
    case TerrainBiome::desert:
        return roll < 0.022f ? Growth::cactus : Growth::none;
    default:
        return Growth::none;
    }
}

bool leaves_at(u64 dice, i32 x, i32 y, i32 z, u32 of_256) {
    return (mix64(dice ^ (u64(u32(x * 31 + y * 977 + z * 7919)) << 3)) & 255) < of_256;
}

struct Brush {
    ColumnCanvas& c;
    i32 x, y, z; // lowest trunk block, relative to the column
    u64 dice;

    void leaf(i32 dx, i32 dy, i32 dz, TerrainBlock b) const {
        if (ColumnCanvas::inside(x + dx, y + dy, z + dz) && c.get(x + dx, y + dy, z + dz) == air)
            c.put(x + dx, y + dy, z + dz, b);
    }
    void log(i32 dx, i32 dy, i32 dz, TerrainBlock b) const { c.draw(x + dx, y + dy, z + dz, b); }
    void trunk(i32 height, TerrainBlock b) const {
        c.draw(x, y - 1, z, dirt, true);
        for (i32 i = 0; i < height; ++i)
            log(0, i, 0, b);
    }
    void blob(i32 cx, i32 cy, i32 cz, float radius, float squash, TerrainBlock b) const {
        const i32 r = i32(radius) + 1;
        for (i32 dy = -r; dy <= r; ++dy)
            for (i32 dz = -r; dz <= r; ++dz)
                for (i32 dx = -r; dx <= r; ++dx) {
                    const float d = float(dx * dx + dz * dz) + float(dy * dy) * squash;
                    if (d > radius * radius) continue;
                    const bool rim = d > (radius - 0.8f) * (radius - 0.8f);
                    if (!rim || leaves_at(dice, cx + dx, cy + dy, cz + dz, 205)) leaf(cx + dx, cy + dy, cz + dz, b);
                }
    }
    // The round crown of a small tree: two wide layers, two narrow ones.
    void crown(i32 height, TerrainBlock b) const {
        for (i32 dy = height - 3; dy <= height; ++dy) {
            const i32 r = dy < height - 1 ? 2 : 1;
            for (i32 dz = -r; dz <= r; ++dz)
                for (i32 dx = -r; dx <= r; ++dx) {
                    const bool corner = (dx == r || dx == -r) && (dz == r || dz == -r);
                    if (corner && (dy == height || !leaves_at(dice, dx, dy, dz, 110))) continue;
                    leaf(dx, dy, dz, b);
                }
        }
    }
};

void draw_oak(const Brush& b) {
    const i32 height = 4 + i32((b.dice >> 32) % 3);
    b.trunk(height, oak_log);
    b.crown(height, oak_leaves);
}

void draw_birch(const Brush& b) {
    const i32 height = 5 + i32((b.dice >> 32) % 3);
    b.trunk(height, birch_log);
    b.crown(height, birch_leaves);
}

void draw_big_oak(const Brush& b) {
    const i32 height = 7 + i32((b.dice >> 32) & 3);
    b.trunk(height, oak_log);
    b.blob(0, height, 0, 2.7f, 1.7f, oak_leaves);
    const u32 limbs = 3 + u32(b.dice >> 36 & 1);
    for (u32 i = 0; i < limbs; ++i) {
        const u64 h = mix64(b.dice + i + 1);
        const u32 side = (u32(b.dice >> 40) + i) & 3; // around the trunk
        const i32 sx = side == 0 ? 1 : side == 1 ? -1 : 0, sz = side == 2 ? 1 : side == 3 ? -1 : 0;
        const i32 from = height - 2 - i32(h & 3), length = 2 + i32(h >> 2 & 1), bend = i32(h >> 4 & 1) ? 1 : -1;
        i32 x = 0, y = from, z = 0;
        for (i32 step = 1; step <= length; ++step) {
            x = sx * step + (sx == 0 && step > 1 ? bend : 0);
            z = sz * step + (sz == 0 && step > 1 ? bend : 0);
            y = from + step / 2;
            b.log(x, y, z, sx ? oak_log_x : oak_log_z);
        }
        b.blob(x, y + 1, z, 2.1f + float(h >> 8 & 1) * 0.4f, 1.8f, oak_leaves);
    }
}

void draw_spruce(const Brush& b) {
    const i32 height = 7 + i32((b.dice >> 32) % 6), bare = 1 + i32(b.dice >> 36 & 1);
    const i32 widest = height > 9 ? 3 : 2;
    b.trunk(height, spruce_log);
    b.leaf(0, height, 0, spruce_leaves);
    b.leaf(0, height + 1, 0, spruce_leaves);
    // skirts: each grows from its tip down, the lower the wider
    i32 radius = 1, limit = 1;
    for (i32 dy = height - 1; dy >= bare; --dy) {
        for (i32 dz = -radius; dz <= radius; ++dz)
            for (i32 dx = -radius; dx <= radius; ++dx) {
                if (radius > 0 && (dx == radius || dx == -radius) && (dz == radius || dz == -radius)) continue;
                if (radius == 3 && dx * dx + dz * dz > 10) continue;
                b.leaf(dx, dy, dz, spruce_leaves);
            }
        if (radius >= limit) {
            radius = 1;
            limit = std::min(limit + 1, widest);
        } else {
            ++radius;
        }
        if (dy == bare + 1) radius = std::min(radius, 2);
    }
}

void draw_cactus(const Brush& b) {
    const i32 height = 1 + i32((b.dice >> 32) % 3);
    for (i32 i = 0; i < height; ++i)
        b.log(0, i, 0, cactus);
}

void draw_boulder(const Brush& b) {
    const float radius = 1.3f + part_of(b.dice, 32) * 1.2f;
    for (i32 dy = -2; dy <= 2; ++dy)
        for (i32 dz = -3; dz <= 3; ++dz)
            for (i32 dx = -3; dx <= 3; ++dx) {
                const float reach = radius * (leaves_at(b.dice, dx, dy, dz, 128) ? 1.0f : 0.85f);
                if (float(dx * dx + dy * dy + dz * dz) <= reach * reach)
                    b.c.draw(b.x + dx, b.y + dy, b.z + dz, mossy_cobblestone, true);
            }
}

} // namespace

bool tree_stands_at(const TerrainKeys& keys, i32 x, i32 z) {
    const Seedling s = seedling_in(keys, x >> 2, z >> 2);
    if (s.x != x || s.z != z) return false;
    const LandPoint land = land_at(keys, x, z);
    const TerrainSurface surface = terrain_surface(keys.seed, x, z);
    return growth_of(keys, s, surface.biome, 0, surface.ground_y, land.height) != Growth::none;
}

void place_trees(ColumnCanvas& c) {
    static_assert(kReach < ColumnCanvas::kMargin);
    for (i32 cz = (c.base_z - kReach) >> 2; cz <= (c.base_z + 15 + kReach) >> 2; ++cz)
        for (i32 cx = (c.base_x - kReach) >> 2; cx <= (c.base_x + 15 + kReach) >> 2; ++cx) {
            const Seedling s = seedling_in(c.keys, cx, cz);
            const i32 x = s.x - c.base_x, z = s.z - c.base_z;
            if (x < -kReach || z < -kReach || x > 15 + kReach || z > 15 + kReach) continue;
            if (!may_grow(s)) continue;
            const ColumnCanvas::Land& l = c.land_at(x, z);
            const TerrainBiome biome = ColumnCanvas::inside(x, 0, z)
                                           ? l.biome
                                           : biome_of(c.keys, vitrail::land_at(c.keys, s.x, s.z), s.x, s.z);
            const Growth growth = growth_of(c.keys, s, biome, l.slope, l.ground_y, l.height);
            if (growth == Growth::none || in_cave(c.keys, s.x, l.ground_y - 1, s.z, l.ground_y)) continue;
            const Brush brush{c, x, l.ground_y, z, s.dice};
            switch (growth) {
            case Growth::oak:
                draw_oak(brush);
                break;
            case Growth::big_oak:
                draw_big_oak(brush);
                break;
            case Growth::birch:
                draw_birch(brush);
                break;
            case Growth::spruce:
                draw_spruce(brush);
                break;
            case Growth::cactus:
                // nothing may stand beside it
                if (std::max({c.land_at(x - 1, z).ground_y, c.land_at(x + 1, z).ground_y, c.land_at(x, z - 1).ground_y,
                              c.land_at(x, z + 1).ground_y}) <= l.ground_y)
                    draw_cactus(brush);
                break;
            case Growth::boulder:
                draw_boulder(brush);
                break;
            case Growth::none:
                break;
            }
        }
}

} // namespace vitrail
