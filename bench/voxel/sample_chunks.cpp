#include "bench/voxel/sample_chunks.h"

#include "base/rng.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace vitrail::bench {

namespace {

constexpr i32 kHeight = 256, kSea = 63;

enum Material : u16 {
    air = 0,
    stone = 12,
    granite = 40,
    diorite = 41,
    andesite = 43,
    dirt = 77,
    grass = 78,
    sand = 130,
    gravel = 131,
    water = 300,
    deepslate = 501,
    coal = 210,
    iron = 214,
    copper = 215,
    gold = 218,
    diamond = 230,
    bedrock = 9,
    oak_log = 333,
    oak_leaves = 340,
    tall_grass = 402,
    poppy = 411,
    torch = 650,
    lava = 301,
    planks = 700,
    tuff = 520,
};

float smooth(float t) {
    return t * t * (3 - 2 * t);
}
float lerp(float a, float b, float t) {
    return a + (b - a) * t;
}

// Value noise of one octave, in [-1, 1].
float noise3(u64 seed, u32 purpose, float x, float y, float z) {
    const float fx = std::floor(x), fy = std::floor(y), fz = std::floor(z);
    const i32 ix = i32(fx), iy = i32(fy), iz = i32(fz);
    auto at = [&](i32 a, i32 b, i32 c) { return random_unit({seed, purpose}, ix + a, iy + b, iz + c) * 2 - 1; };
    const float u = smooth(x - fx), v = smooth(y - fy), w = smooth(z - fz);
    auto plane = [&](i32 c) { return lerp(lerp(at(0, 0, c), at(1, 0, c), u), lerp(at(0, 1, c), at(1, 1, c), u), v); };
    return lerp(plane(0), plane(1), w);
}

float fbm(u64 seed, u32 purpose, float x, float y, float z, int octaves) {
    float sum = 0, weight = 1;
    for (int o = 0; o < octaves; ++o, weight *= 0.5f, x *= 2, y *= 2, z *= 2)
        sum += weight * noise3(seed, purpose + u32(o), x, y, z);
    return sum;
}

struct Region {
    i32 side; // blocks
    std::vector<u16> cells, light;
    std::size_t index(i32 x, i32 y, i32 z) const {
        return (std::size_t(y) * std::size_t(side) + std::size_t(z)) * std::size_t(side) + std::size_t(x);
    }
    bool inside(i32 x, i32 y, i32 z) const { return x >= 0 && z >= 0 && y >= 0 && x < side && z < side && y < kHeight; }
    u16& at(i32 x, i32 y, i32 z) { return cells[index(x, y, z)]; }
};

// Light lost on entering a cell: 16 stops all.
int opacity(u16 m) {
    switch (m) {
    case air:
    case tall_grass:
    case poppy:
    case torch:
        return 1;
    case water:
    case oak_leaves:
        return 2;
    case lava:
        return 1;
    default:
        return 16;
    }
}

void fill_ground(Region& r, u64 seed) {
    for (i32 z = 0; z < r.side; ++z)
        for (i32 x = 0; x < r.side; ++x) {
            const float fx = float(x), fz = float(z);
            const i32 height = i32(80 + 34 * fbm(seed, 1, fx / 90, 0, fz / 90, 5));
            const bool beach = height < kSea + 2;
            for (i32 y = 0; y < kHeight; ++y) {
                u16 m = air;
                if (y == 0 || (y < 5 && random_unit({seed, 20}, x, y, z) < 0.5f))
                    m = bedrock;
                else if (y < height - 4) {
                    m = y < 16 + i32(6 * noise3(seed, 21, fx / 8, 0, fz / 8)) ? deepslate : stone;
                    const float patch = noise3(seed, 22, fx / 7, float(y) / 7, fz / 7);
                    if (patch > 0.62f) m = random_unit({seed, 23}, x >> 4, y >> 4, z >> 4) < 0.5f ? granite : andesite;
                    if (patch < -0.66f) m = m == deepslate ? tuff : diorite;
                } else if (y < height)
                    m = beach ? sand : dirt;
                else if (y == height)
                    m = beach ? sand : grass;
                else if (y <= kSea)
                    m = water;
                if (m != air && m != water && m != bedrock && y < height + 1) {
                    const float a = fbm(seed, 30, fx / 22, float(y) / 15, fz / 22, 3);
                    const float b = fbm(seed, 35, fx / 22, float(y) / 15, fz / 22, 3);
                    if (a * a + b * b < 0.011f && !(beach && y > height - 6)) m = y < 11 ? lava : air;
                }
                r.at(x, y, z) = m;
            }
        }
}

void add_ores(Region& r, u64 seed) {
    struct Ore {
        u16 state;
        i32 top;
        u32 veins, size;
    };
    static constexpr Ore ores[] = {{coal, 110, 18, 12}, {iron, 70, 14, 8},   {copper, 90, 10, 9},
                                   {gold, 34, 3, 8},    {diamond, 18, 3, 6}, {gravel, 100, 4, 25}};
    Rng rng(seed ^ 0x0e5);
    const u32 chunk_columns = u32(r.side / 16) * u32(r.side / 16);
    for (const Ore& ore : ores)
        for (u32 v = 0; v < ore.veins * chunk_columns; ++v) {
            i32 x = i32(rng.below(u32(r.side))), y = 2 + i32(rng.below(u32(ore.top))), z = i32(rng.below(u32(r.side)));
            for (u32 i = 0; i < ore.size; ++i) {
                if (r.inside(x, y, z)) {
                    u16& m = r.at(x, y, z);
                    if (m == stone || m == deepslate || m == granite || m == diorite || m == andesite || m == tuff)
                        m = u16(ore.state + (m == deepslate ? 1 : 0));
                }
                const u32 turn = rng.below(6);
                (turn < 2 ? x : turn < 4 ? y : z) += turn & 1 ? 1 : -1;
            }
        }
}

void add_plants(Region& r, u64 seed) {
    Rng rng(seed ^ 0x71ee);
    for (i32 z = 3; z < r.side - 3; ++z)
        for (i32 x = 3; x < r.side - 3; ++x) {
            i32 y = kHeight - 20;
            while (y > 0 && r.at(x, y, z) == air)
                --y;
            if (r.at(x, y, z) != grass) continue;
            const u32 dice = rng.below(1000);
            if (dice < 150)
                r.at(x, y + 1, z) = tall_grass;
            else if (dice < 160)
                r.at(x, y + 1, z) = poppy;
            else if (dice < 172) {
                const i32 tall = 4 + i32(rng.below(3));
                for (i32 dy = tall - 3; dy <= tall + 1; ++dy)
                    for (i32 dz = -2; dz <= 2; ++dz)
                        for (i32 dx = -2; dx <= 2; ++dx) {
                            const i32 wide = dy >= tall ? 1 : 2;
                            if (std::abs(dx) > wide || std::abs(dz) > wide) continue;
                            if (std::abs(dx) == wide && std::abs(dz) == wide && rng.below(2)) continue;
                            u16& m = r.at(x + dx, y + 1 + dy, z + dz);
                            if (m == air) m = oak_leaves;
                        }
                for (i32 dy = 0; dy < tall; ++dy)
                    r.at(x, y + 1 + dy, z) = oak_log;
            }
        }
}

void add_lamps(Region& r, u64 seed) {
    Rng rng(seed ^ 0x1a3b);
    for (i32 i = 0; i < r.side * r.side / 40; ++i) {
        const i32 x = i32(rng.below(u32(r.side))), y = 8 + i32(rng.below(90)), z = i32(rng.below(u32(r.side)));
        if (r.at(x, y, z) == air && r.at(x, y - 1, z) != air && r.at(x, y - 1, z) != water) r.at(x, y, z) = torch;
    }
}

// Spreads one of the four kinds of light (nibble `shift`) from queues by level, bright to dark.
void spread(Region& r, std::array<std::vector<u32>, 16>& queues, int shift) {
    static constexpr i32 steps[6][3] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
    for (int level = 15; level > 1; --level)
        for (std::size_t k = 0; k < queues[std::size_t(level)].size(); ++k) {
            const u32 cell = queues[std::size_t(level)][k];
            if (int(r.light[cell] >> shift & 15) != level) continue;
            const i32 x = i32(cell) % r.side, z = i32(cell) / r.side % r.side, y = i32(cell) / (r.side * r.side);
            for (const auto& s : steps) {
                if (!r.inside(x + s[0], y + s[1], z + s[2])) continue;
                const std::size_t to = r.index(x + s[0], y + s[1], z + s[2]);
                const int next = level - opacity(r.cells[to]);
                if (next <= int(r.light[to] >> shift & 15)) continue;
                r.light[to] = u16((r.light[to] & ~(15 << shift)) | next << shift);
                queues[std::size_t(next)].push_back(u32(to));
            }
        }
}

void add_light(Region& r) {
    r.light.assign(r.cells.size(), 0);
    for (int shift : {0, 4, 8, 12}) {
        std::array<std::vector<u32>, 16> queues;
        for (i32 z = 0; z < r.side; ++z)
            for (i32 x = 0; x < r.side; ++x) {
                bool open = true;
                for (i32 y = kHeight - 1; y >= 0; --y) {
                    const std::size_t i = r.index(x, y, z);
                    const u16 m = r.cells[i];
                    int level = 0;
                    if (shift == 0) {
                        open = open && opacity(m) == 1;
                        level = open ? 15 : 0;
                    } else if (m == torch || m == lava) {
                        const int colors[2][3] = {{14, 12, 9}, {15, 9, 4}};
                        level = colors[m == lava][shift / 4 - 1];
                    }
                    if (level == 0) continue;
                    r.light[i] = u16(r.light[i] | level << shift);
                    queues[std::size_t(level)].push_back(u32(i));
                }
            }
        spread(r, queues, shift);
    }
}

ChunkPtr cut_chunk(const Region& r, ChunkPos at, u64 seed) {
    auto chunk = std::make_shared<Chunk>();
    std::array<StateId, kChunkVolume> states;
    auto light = std::make_shared<LightVolume>();
    auto& cells = light->writable();
    for (u32 i = 0; i < u32(kChunkVolume); ++i) {
        const BlockPos p = block_at(at, LocalPos(i));
        states[i] = StateId(r.cells[r.index(p.x, p.y, p.z)]);
        cells[i] = Light(r.light[r.index(p.x, p.y, p.z)]);
    }
    chunk->blocks = BlockStorage::from_states(states);
    light->compact();
    chunk->light = std::move(light);
    for (u32 i = 0; i < 64; ++i) {
        const float x = float(at.x * 16) + float(i & 3) * 4, z = float(at.z * 16) + float(i >> 2 & 3) * 4;
        chunk->biomes.cells[i] = BiomeId(u16(3 + i32(2.5f * (1 + noise3(seed, 50, x / 150, 0, z / 150)))));
    }
    chunk->revision = 1 + (mix64(std::hash<ChunkPos>()(at)) & 3);
    return chunk;
}

} // namespace

std::vector<SampleChunk> make_sample_chunks(i32 columns, u64 seed) {
    Region r{columns * 16, {}, {}};
    r.cells.resize(std::size_t(r.side) * std::size_t(r.side) * kHeight);
    fill_ground(r, seed);
    add_ores(r, seed);
    add_plants(r, seed);
    add_lamps(r, seed);
    add_light(r);
    std::vector<SampleChunk> out;
    for (i32 z = 0; z < columns; ++z)
        for (i32 x = 0; x < columns; ++x)
            for (i32 y = 0; y < kHeight / 16; ++y)
                out.push_back({{x, y, z}, cut_chunk(r, {x, y, z}, seed)});
    return out;
}

} // namespace vitrail::bench
