// Maps of generated land seen from above, with height shading; for `vitrail biome-map` and the documentation.
#pragma once

#include "terrain/generator.h"

#include <array>
#include <atomic>
#include <vector>

namespace vitrail {

// Linear light, 0..1.
struct MapColor {
    float r = 0, g = 0, b = 0;
};

// What the map shows of blocks and biomes, by the generator's indices.
struct MapPalette {
    struct BlockLook {
        MapColor color;
        float cover = 1; // how much of the ground it hides: plants less than 1
        u8 tint = 0;     // 0 none, 1 grass, 2 foliage, 3 water of the biome
    };
    std::vector<BlockLook> blocks;
    struct BiomeLook {
        std::array<MapColor, 3> tints; // grass, foliage, water
        MapColor color;                // of the map of biomes
    };
    std::vector<BiomeLook> biomes; // surface biomes
};

enum class MapMode : u8 { blocks, biomes };

struct LandMapOptions {
    i32 first_x = 0, first_z = 0; // least block
    i32 size = 1024;              // blocks a side
    i32 scale = 1;                // blocks a pixel a side
    MapMode mode = MapMode::blocks;
    unsigned threads = 1;
    const std::atomic<bool>* stop = nullptr;
};

struct LandMap {
    u32 side = 0;                  // pixels
    std::vector<u8> pixels;        // sRGB, rows from the north, west first
    bool every_block = false;      // all blocks were made, trees included; else the surface alone, one place a pixel
    std::vector<u64> biome_counts; // places by their strongest surface biome
};

// Beyond this many columns a map of blocks is drawn from the surface alone.
inline constexpr i64 kMapColumnsMost = 300'000;

// Errors: limit (more than 64 million pixels), denied (stopped).
Result<LandMap> draw_land_map(const TerrainGenerator& generator, const MapPalette& palette,
                              const LandMapOptions& options);

} // namespace vitrail
