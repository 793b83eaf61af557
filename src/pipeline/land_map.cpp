#include "pipeline/land_map.h"

#include "jobs/thread_pool.h"
#include "terrain/kernel/biome_kernel.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>

namespace vitrail {

namespace {

constexpr float kWaterClearness = 0.12f; // light lost a block of depth
constexpr float kShadeSteepness = 0.8f;  // of one block up a block
constexpr float kShadeLeast = 0.45f, kShadeMost = 1.45f;

MapColor operator*(MapColor a, float k) {
    return {a.r * k, a.g * k, a.b * k};
}
MapColor operator*(MapColor a, MapColor b) {
    return {a.r * b.r, a.g * b.g, a.b * b.b};
}
MapColor operator+(MapColor a, MapColor b) {
    return {a.r + b.r, a.g + b.g, a.b + b.b};
}
MapColor mixed(MapColor a, MapColor b, float t) {
    return a * (1 - t) + b * t;
}

u8 srgb_of(float v) {
    const float c = v <= 0.0031308f ? v * 12.92f : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
    return u8(std::clamp(c * 255 + 0.5f, 0.0f, 255.0f));
}

// What one place adds to its pixel.
struct Place {
    MapColor color;
    float height = 0; // of what is seen, the water's surface included
};

struct Sum {
    MapColor color;
    float height = 0, count = 0;
    void add(const Place& p) {
        color = color + p.color;
        height += p.height;
        count += 1;
    }
    void add(const Sum& s) {
        color = color + s.color;
        height += s.height;
        count += s.count;
    }
};

MapColor look_of(const MapPalette& palette, Block block, u32 biome) {
    const auto& look = palette.blocks[block];
    return look.tint == 0 ? look.color : look.color * palette.biomes[biome].tints[look.tint - 1];
}

// Under water the ground shows through less and less.
MapColor under_water(const MapPalette& palette, MapColor ground, float depth, u32 biome) {
    const float clear = std::exp(-kWaterClearness * depth);
    return mixed(look_of(palette, kWater, biome) * (0.75f + 0.25f * clear), ground, 0.75f * clear);
}

Place place_of_blocks(const MapPalette& palette, const BlockTile& tile, i32 index, u32 biome) {
    Place out;
    float shows = 1; // of what lies below
    bool high = false;
    i32 water = 0;
    MapColor over{};
    for (i32 y = std::min(tile.top, kTerrainHeight) - 1; y >= 0; --y) {
        const Block block = tile.block[u32(index) | u32(y) << 8];
        if (block == kAir) continue;
        if (!high) out.height = float(y + 1), high = true;
        if (block == kWater) {
            ++water;
            continue;
        }
        const float cover = palette.blocks[block].cover;
        over = over + look_of(palette, block, biome) * (shows * cover);
        shows *= 1 - cover;
        if (shows < 0.05f) break;
    }
    out.color = over * (1 / std::max(1 - shows, 0.05f));
    if (water > 0) out.color = under_water(palette, out.color, float(water), biome);
    return out;
}

// Of a block column, from a tile's attributes.
u32 strongest_at(const TerrainTables& t, const float (&attributes)[kAttributesMost][kColumnCells], i32 index) {
    float here[kAttributesMost];
    for (u32 a = 0; a < kAttributesMost; ++a) here[a] = attributes[a][index];
    return strongest_biome<ScalarLanes>(t, here);
}

// The block that a biome's ground mostly shows: its last rule for the top block, else its strongest loose layer.
std::vector<Block> top_blocks(const TerrainTables& t) {
    std::vector<Block> out(t.biomes, t.remainder);
    for (u32 b = 0; b < t.biomes; ++b) {
        float most = 0;
        for (u32 l = 0; l < t.loose; ++l)
            if (const float amount = t.biome[b].loose[l] * t.loose_layer[l].thickness; amount > most)
                most = amount, out[b] = t.loose_layer[l].block;
        for (u32 r = 0; r < t.surface_rules; ++r) {
            const auto& rule = t.surface_rule[r];
            if (rule.biome == b && rule.chance >= 0.5f && rule.from.has(out[b]) && (rule.depth == 1 || rule.depth == 0))
                out[b] = rule.to[0];
        }
    }
    return out;
}

class Drawing {
public:
    Drawing(const TerrainGenerator& generator, const MapPalette& palette, const LandMapOptions& options)
        : generator_(generator)
        , palette_(palette)
        , options_(options)
        , side_(options.size / options.scale)
        , tops_(top_blocks(generator.tables()))
        , sums_(std::size_t(side_) * std::size_t(side_)) {
        counts_.resize(generator.tables().biomes);
    }

    Result<LandMap> draw() {
        const i64 a_side = i64(options_.size) / 16 + 1;
        LandMap map;
        map.side = u32(side_);
        map.every_block =
            options_.mode == MapMode::blocks && options_.scale <= 16 && a_side * a_side <= kMapColumnsMost;
        ThreadPool pool(std::max(options_.threads, 1u) - 1);
        if (map.every_block)
            all_columns(pool);
        else
            places(pool);
        if (options_.stop && *options_.stop) return fail(ErrorCode::denied, "interrupted");
        map.biome_counts = counts_;
        shade(map);
        return map;
    }

private:
    bool stopped() const { return options_.stop && *options_.stop; }

    // Every block column of the square, a chunk column at a time, in zones.
    void all_columns(ThreadPool& pool) {
        const i32 x0 = options_.first_x >> 4, z0 = options_.first_z >> 4;
        const i32 x1 = i32((i64(options_.first_x) + options_.size - 1) >> 4),
                  z1 = i32((i64(options_.first_z) + options_.size - 1) >> 4);
        std::vector<ColumnPos> columns;
        constexpr i32 band = 4 * kZoneColumns; // as wide as the generator's caches keep
        for (i32 bx = x0; bx <= x1; bx += band)
            for (i32 z = z0; z <= z1; ++z)
                for (i32 x = bx; x <= std::min(x1, bx + band - 1); ++x)
                    columns.push_back({x, z});
        pool.parallel_for(u32((columns.size() + 7) / 8), [&](u32 strip) {
            for (u32 i = strip * 8; i < std::min<u32>(u32(columns.size()), strip * 8 + 8) && !stopped(); ++i)
                one_column(columns[i]);
        });
    }

    void one_column(ColumnPos at) {
        const auto tile = generator_.blocks(at);
        const auto ground = generator_.ground(at);
        std::map<std::pair<i32, i32>, Sum> mine;
        std::vector<u64> counts(counts_.size());
        u32 biome = 0;
        for (i32 i = 0; i < kColumnCells; ++i) {
            if ((i & 3) == 0) // biomes are wide: one answer for 4 blocks in a row
                biome = strongest_at(generator_.tables(), ground->attribute, i);
            const i64 dx = i64(at.x) * 16 + (i & 15) - options_.first_x,
                      dz = i64(at.z) * 16 + (i >> 4) - options_.first_z;
            if (dx < 0 || dz < 0 || dx >= i64(side_) * options_.scale || dz >= i64(side_) * options_.scale) continue;
            ++counts[biome];
            mine[{i32(dx / options_.scale), i32(dz / options_.scale)}].add(place_of_blocks(palette_, *tile, i, biome));
        }
        std::lock_guard lock(mutex_);
        for (const auto& [pixel, sum] : mine)
            sums_[std::size_t(pixel.second) * std::size_t(side_) + std::size_t(pixel.first)].add(sum);
        for (u32 b = 0; b < counts.size(); ++b)
            counts_[b] += counts[b];
    }

    // One place in the middle of each pixel, from the land before erosion.
    void places(ThreadPool& pool) {
        pool.parallel_for(u32(side_), [&](u32 row) {
            if (stopped()) return;
            std::vector<u64> counts(counts_.size());
            const i64 z = i64(options_.first_z) + i64(row) * options_.scale + options_.scale / 2;
            std::shared_ptr<const LandTile> land;
            ColumnPos held{};
            for (i32 column = 0; column < side_; ++column) {
                const i64 x = i64(options_.first_x) + i64(column) * options_.scale + options_.scale / 2;
                const ColumnPos at{i32(x >> 4), i32(z >> 4)};
                if (!land || !(held == at)) land = generator_.land(at), held = at;
                const i32 index = i32(x & 15) | i32(z & 15) << 4;
                const u32 biome = strongest_at(generator_.tables(), land->attribute, index);
                ++counts[biome];
                sums_[std::size_t(row) * std::size_t(side_) + std::size_t(column)].add(
                    place_of_land(land->height[index], biome));
            }
            std::lock_guard lock(mutex_);
            for (u32 b = 0; b < counts.size(); ++b)
                counts_[b] += counts[b];
        });
    }

    Place place_of_land(float height, u32 biome) const {
        const float depth = float(kTerrainSeaLevel) - std::ceil(height);
        if (options_.mode == MapMode::biomes) return {palette_.biomes[biome].color, height};
        const MapColor color = look_of(palette_, tops_[biome], biome);
        if (depth > 0) return {under_water(palette_, color, depth, biome), float(kTerrainSeaLevel)};
        return {color, std::ceil(height)};
    }

    // Light from the north-west, by how the land falls.
    void shade(LandMap& map) const {
        map.pixels.resize(sums_.size() * 3);
        const auto height = [&](i32 x, i32 z) {
            const Sum& s = sums_[std::size_t(std::clamp(z, 0, side_ - 1)) * std::size_t(side_) +
                                 std::size_t(std::clamp(x, 0, side_ - 1))];
            return s.count > 0 ? s.height / s.count : 0.0f;
        };
        const float steepness =
            kShadeSteepness / (2 * std::sqrt(float(options_.scale))) * (options_.mode == MapMode::biomes ? 0.5f : 1.0f);
        for (i32 z = 0; z < side_; ++z)
            for (i32 x = 0; x < side_; ++x) {
                const Sum& s = sums_[std::size_t(z) * std::size_t(side_) + std::size_t(x)];
                const float dx = (height(x + 1, z) - height(x - 1, z)) * steepness,
                            dz = (height(x, z + 1) - height(x, z - 1)) * steepness;
                const float light = (1 + 0.6f * (dx + dz)) / std::sqrt(1 + dx * dx + dz * dz);
                const MapColor c = s.color * (std::clamp(light, kShadeLeast, kShadeMost) / std::max(s.count, 1.0f));
                u8* p = &map.pixels[(std::size_t(z) * std::size_t(side_) + std::size_t(x)) * 3];
                p[0] = srgb_of(c.r), p[1] = srgb_of(c.g), p[2] = srgb_of(c.b);
            }
    }

    const TerrainGenerator& generator_;
    const MapPalette& palette_;
    const LandMapOptions& options_;
    const i32 side_;
    std::vector<Block> tops_;
    std::mutex mutex_;
    std::vector<Sum> sums_;
    std::vector<u64> counts_;
};

} // namespace

Result<LandMap> draw_land_map(const TerrainGenerator& generator, const MapPalette& palette,
                              const LandMapOptions& options) {
    const i64 side = options.size / std::max(options.scale, 1);
    if (side < 1 || side * side > 64'000'000) return fail(ErrorCode::limit, "a map has 1 to 64 million pixels");
    return Drawing(generator, palette, options).draw();
}

} // namespace vitrail
