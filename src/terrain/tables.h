// TerrainTables: everything the generator knows, flat, as kernels read it (kernel-safe): plain numbers, no pointers, the same bytes on a
// GPU. Made from a TerrainDescription and a world seed by compile/compile.h. Indices are into the arrays of this struct.
#pragma once

#include "terrain/kernel/noise_kernel.h"

namespace vitrail {

inline constexpr i32 kTerrainMinY = 0, kTerrainMaxY = 384; // blocks are made for min <= y < max
inline constexpr i32 kTerrainHeight = kTerrainMaxY - kTerrainMinY;
inline constexpr i32 kTerrainSections = kTerrainHeight / 16;
inline constexpr i32 kTerrainSeaLevel = 128; // the highest water of the sea lies at 127
inline constexpr i32 kTerrainLavaLevel = 8;  // open caves hold lava below
inline constexpr i32 kColumnCells = 256;     // x | z << 4

inline constexpr u32 kAttributesMost = 8, kBiomesMost = 48, kCaveBiomesMost = 16, kStrataMost = 16, kLooseMost = 8;
inline constexpr u32 kBlocksMost = 256, kFeaturesMost = 96, kDecoratorsMost = 192, kRulesMost = 96;
inline constexpr u32 kInstructionsMost = 4096, kNoisesMost = 1024, kOctavesMost = 4096, kProgramRegisters = 12;

// A block the generator places, by index into the description's list; these four are always the same.
using Block = u8;
inline constexpr Block kAir = 0, kBedrock = 1, kWater = 2, kLava = 3;

// Programs compute numbers of a block column from noise (compile/expression.h says the language they are written in).
enum class Op : u8 {
    constant,  // k
    input,     // a: which (ProgramInput)
    add, subtract, multiply, divide, // a, b; division by 0 gives 0
    least, greatest,                 // a, b
    absolute, square_root, negate,   // a (root of what is below 0: 0)
    power,                           // a to the b, a >= 0, |result| < 2^63 (kernel/power_kernel.h)
    smoothstep,                      // a, b, c: edges a and b, place c; a == b gives 0 or 1
    fractal2, fractal3,              // noise
    cell_distance, cell_edge, cell_random, // W = F1, E = (F2 - F1) / 2, R = random in [0, 1) of the nearest cell; noise
    warp,   // moves the place by registers a (x) and b (z), in blocks, until unwarp
    unwarp,
};
struct Instruction {
    Op op = Op::constant;
    u8 to = 0, a = 0, b = 0, c = 0, padding = 0;
    u16 noise = 0;
    float k = 0;
};
// The result is in register 0. count 0: always 0.
struct Program {
    u16 first = 0, count = 0;
};
struct Noise {
    u16 first = 0; // octave
    u16 octaves = 0;
};
// What programs may read beside noise: the attributes in their order, then
inline constexpr u32 kInputHeight = kAttributesMost, kInputs = kAttributesMost + 1;

struct AttributeRow {
    u8 field = 0; // which of `fields` it reads
    float low = 0, high = 1; // its value is smoothstep(low, high, field), descending where low > high
};

struct SurfaceBiomeRow {
    i8 wants[kAttributesMost] = {}; // +1 the attribute, -1 its complement, 0 any
    Program height;
    float strata[kStrataMost] = {}; // weights of materials
    float loose[kLooseMost] = {};
};

// Depth below the surface decides first: value = smoothstep(low, high, depth * with_depth + offset).
struct CaveAttributeRow {
    Program offset;
    float with_depth = 0, low = 0, high = 1;
};
struct CaveBiomeRow {
    i8 wants[kAttributesMost] = {};
};

struct StratumRow {
    u16 noise = 0;
    Block block = kAir;
    u8 hung = 0; // hangs under the loose layers instead of lying on the stratum below
    float thickness = 0, amplitude = 0;
};
struct LooseRow {
    Block block = kAir;
    float thickness = 0;
    float repose = 1;   // tangent of the angle of repose
    float steepest = 1; // no material where the slope is steeper, blocks a block
};

// Sets of blocks.
struct BlockSet {
    u32 words[kBlocksMost / 32] = {};
    VX_HD constexpr bool has(u32 b) const { return (words[b >> 5] >> (b & 31) & 1) != 0; }
    constexpr void add(u32 b) { words[b >> 5] |= 1u << (b & 31); }
};

// Changes blocks of the ground of one surface biome, in the order of rows, after layers and before features.
struct SurfaceRuleRow {
    u8 biome = 0;
    u8 bands = 0;      // length of `to` as repeating bands counted from `above`; 0: `to[0]` alone
    i16 depth = 0;     // only so many blocks from the surface down; 0: any
    BlockSet from;
    Program above, below; // y >= above, y < below; programs of count 0 do not limit
    float chance = 1;     // of each block
    RandomKey key;
    Block to[32] = {};
};

inline constexpr const char* kCavePlaces[] = {"floor", "ceiling", "rock"}; // as content names them
inline constexpr i32 kCaveRuleDepthMost = 24; // of floors and ceilings, blocks
enum class CavePlace : u8 { floor, ceiling, rock }; // the `depth` blocks under a floor, over a ceiling; all of the biome's rock
struct CaveRuleRow {
    u8 biome = 0;
    CavePlace place = CavePlace::floor;
    u8 depth = 1;
    Block to = kAir;
    BlockSet from;
    float chance = 1;        // of each block
    u16 vein = 0, veins = 0; // noise (3-D); where veins > 0: only where |noise| < vein_width
    float vein_width = 0;
    RandomKey key;
};

inline constexpr const char* kFeaturePlaces[] = {"surface", "sea_floor", "sea_surface", "cave_floor", "cave_ceiling"};
enum class FeaturePlace : u8 { surface, sea_floor, sea_surface, cave_floor, cave_ceiling };
enum class Shape : u8 {
    coral, kelp, iceberg, acacia, redwood, cypress, birch, pine, shrub, rafflesia, jungle_tree, small_jungle_tree,
    mushroom, medium_mushroom, crystal, palm, cactus, stormlight, crystal_pillar, glowstone_cluster, cave_vine, fungus,
    count
};
inline constexpr u32 kFeatureNumbers = 8, kFeatureBlocks = 8;

// One candidate place in each cell of a grid.
struct FeatureRow {
    Shape shape = Shape::coral;
    FeaturePlace place = FeaturePlace::surface;
    u8 biome = 0;          // surface biome, or cave biome where the place is in a cave
    u16 cell = 16, padding = 0; // blocks
    float chance = 1;      // times the biome's weight
    u32 layers = 0;        // which loose layers (bits) may be the topmost one at the place; 0: any ground
    float least_thickness = 0;
    i16 lowest_y = -32768, highest_y = 32767; // of the place
    i16 bound_low = 0, bound_high = 0;        // of the shape, from the place
    i16 reach = 0;                            // of the shape sideways, blocks, at most 47
    u16 least_height = 0;                     // of the cave layer
    u16 water_depth = 0;                      // least, of a sea floor
    RandomKey key;
    float numbers[kFeatureNumbers] = {}; // what they mean: the shape's builder (kernel/shapes/)
    Block blocks[kFeatureBlocks] = {};
};

inline constexpr const char* kDecoratorPlaces[] = {"surface", "sea_floor", "cave_floor", "cave_ceiling"};
enum class DecoratorPlace : u8 { surface, sea_floor, cave_floor, cave_ceiling };
struct DecoratorRow {
    u8 biome = 0;
    DecoratorPlace place = DecoratorPlace::surface;
    Block block = kAir, upper = kAir; // upper: second block of tall ones, else air
    float chance = 0;                 // a column (a cave layer), times the biome's share
    BlockSet on;
    RandomKey key;
};

// What a block is to the generator.
enum BlockTrait : u8 {
    trait_open = 1,   // air or what features and decorators may replace (plants)
    trait_liquid = 2,
    trait_ground = 4, // of layers and rules
};

struct TerrainTables {
    u64 seed = 0;
    u32 attributes = 0, fields = 0, biomes = 0, cave_attributes = 0, cave_biomes = 0, strata = 0, loose = 0;
    u32 surface_rules = 0, cave_rules = 0, features = 0, decorators = 0, blocks = 0;
    u32 erosion_passes = 11; // Jacobi passes a loose layer; passes * loose layers + 1 <= kGroundReach * 16
    i32 ocean = -1;          // which attribute is the ocean, that caves keep away from
    Block deepest_stone = kAir, remainder = kAir; // `remainder` takes what the strata leave
    Program warp_x, warp_z;                 // of the place where fields are read, blocks
    Program field[kAttributesMost];
    AttributeRow attribute[kAttributesMost];
    SurfaceBiomeRow biome[kBiomesMost];
    CaveAttributeRow cave_attribute[kAttributesMost];
    CaveBiomeRow cave_biome[kCaveBiomesMost];
    StratumRow stratum[kStrataMost]; // bottom up, the hung ones after the others, bottom up too
    LooseRow loose_layer[kLooseMost];
    SurfaceRuleRow surface_rule[kRulesMost];
    CaveRuleRow cave_rule[kRulesMost];
    FeatureRow feature[kFeaturesMost];
    DecoratorRow decorator[kDecoratorsMost];
    u8 traits[kBlocksMost] = {};
    // Caves (kernel/cave_kernel.h)
    Noise cave_cells, cave_warp_x, cave_warp_y, cave_warp_z, cave_width, cave_gate, ravine_warp, ravine_cells, ravine_depth, ravine_gate;
    u16 shape_noise[2] = {}; // wobble of features' solids, 3-D: fine F3(.13), coarse F3(.035); kernel/shapes/builder.h
    RandomKey pick_key, cave_pick_key; // of the biome that a column's (a block's) materials come from
    Instruction instruction[kInstructionsMost];
    Noise noise[kNoisesMost];
    NoiseOctave octave[kOctavesMost];
};

} // namespace vitrail
