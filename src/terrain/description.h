// TerrainDescription: what the land is made of, as content describes it (content/base/terrain*.lua, docs/terrain.md). Plain
// data with names; compile/compile.h turns it into TerrainTables for a seed. Numbers that follow from noise are texts in a
// small language (compile/expression.h), so that a biome can be added without touching C++.
#pragma once

#include "base/types.h"

#include <map>
#include <string>
#include <vector>

namespace vitrail {

struct TerrainDescription {
    // Noise fields of the whole world, read at a place moved by warp_x, warp_z blocks.
    std::string warp_x, warp_z;
    struct Field {
        std::string name, noise;
    };
    std::vector<Field> fields;
    // value = smoothstep(low, high, field), descending where low > high
    struct Attribute {
        std::string name, field;
        float low = 0, high = 1;
    };
    std::vector<Attribute> attributes;

    struct Layer {
        std::string name, block; // block: a state's text
        float thickness = 0;
        bool loose = false;
        // strata: thickness + amplitude * F(frequency), at least 0
        float amplitude = 0, frequency = 0;
        bool hung = false;      // hangs under the loose layers
        bool remainder = false; // takes what the other strata leave
        // loose: least and greatest slopes that matter
        float repose_degrees = 45, steepest = 1;
    };
    std::vector<Layer> layers; // bottom up
    std::map<std::string, float> materials; // default weight by layer name; 1 where absent

    struct SurfaceRule {
        std::vector<std::string> from; // block texts, or "ground" (all layers), "rock" (strata), "loose", "water"
        std::string above, below;      // expressions of y; empty: no limit
        int depth = 0;                 // only the topmost blocks; 0: any
        float chance = 1;
        std::string to;
        std::vector<std::string> bands; // instead of `to`: repeating upwards from `above`
    };
    struct Biome {
        std::string name;  // "vitrail:savanna"
        std::string wants; // a sign an attribute, in their order: + - .
        std::string height;
        std::map<std::string, float> materials;
        std::vector<SurfaceRule> rules;
    };
    std::vector<Biome> biomes;

    // value = smoothstep(low, high, (depth below the surface if by_depth) + offset)
    struct CaveAttribute {
        std::string name, offset; // offset may read surface attributes by name
        bool by_depth = false;
        float low = 0, high = 1;
    };
    std::vector<CaveAttribute> cave_attributes;
    struct CaveRule {
        std::string place; // "floor", "ceiling", "rock"
        std::vector<std::string> from;
        std::string to;
        int depth = 1;
        float chance = 1;
        std::string vein; // "F3(.05)" and the like: only where its amount is below vein_width; empty: everywhere
        float vein_width = 0;
    };
    struct CaveBiome {
        std::string name, wants;
        std::vector<CaveRule> rules;
    };
    std::vector<CaveBiome> cave_biomes;

    struct Feature {
        std::string name;   // unique: its random numbers follow from it
        std::string shape;  // name of a Shape (tables.h)
        std::string place = "surface"; // name of a FeaturePlace
        std::string biome;
        int cell = 16, padding = 0;
        float chance = 1;
        std::vector<std::string> layers; // topmost loose layer: one of these; none: anything
        float least_thickness = 0;
        int lowest_y = 0, highest_y = 383;
        int least_height = 0; // of the cave layer
        int water_depth = 0;
        std::map<std::string, float> numbers;       // by the shape's parameter names
        std::map<std::string, std::string> blocks;  // by the shape's part names
    };
    std::vector<Feature> features;

    struct Decorator {
        std::string biome;
        std::string place = "surface"; // name of a DecoratorPlace
        std::string block, upper;
        float chance = 0;
        std::vector<std::string> on; // as SurfaceRule::from
    };
    std::vector<Decorator> decorators;
};

} // namespace vitrail
