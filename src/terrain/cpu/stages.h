// The stages on a CPU, compiled three times from cpu/*_stage.h (stages_portable.cpp, _avx2, _avx512); the bits are the same.
#pragma once

#include "terrain/tiles.h"

namespace vitrail {

struct PackedSection; // cpu/pack_stage.h

enum class Isa : u8 { portable, avx2, avx512 };

struct TerrainStages {
    Isa isa = Isa::portable;
    void (*land)(const TerrainTables&, ColumnPos at, LandTile& out) = nullptr;
    // `lands`: (columns_x + 12) * (columns_z + 12) tiles, row by row, the reach around `first` included; out:
    // columns_x * columns_z tiles.
    void (*ground)(const TerrainTables&, ColumnPos first, i32 columns_x, i32 columns_z, const LandTile* const* lands,
                   GroundTile* out) = nullptr;
    void (*lattice)(const TerrainTables&, ColumnPos at, LatticeTile& out) = nullptr;
    // lattices: of the column, its +x, its +z and its +x+z neighbor.
    void (*caves)(const TerrainTables&, ColumnPos at, const GroundTile& ground, const LatticeTile* const lattices[4],
                  CaveTile& out) = nullptr;
    void (*features)(const TerrainTables&, ColumnPos at, const GroundTile&, const CaveTile&, FeatureTile& out) = nullptr;
    // Layers, surface and cave rules, water, lava, bedrock.
    void (*fill)(const TerrainTables&, ColumnPos at, const GroundTile&, const CaveTile&, BlockTile& out) = nullptr;
    // features: of the 7 x 7 columns around, row by row (-z first, then -x).
    void (*draw)(const TerrainTables&, ColumnPos at, const FeatureTile* const features[49], BlockTile& blocks) = nullptr;
    void (*decorate)(const TerrainTables&, ColumnPos at, const GroundTile&, const CaveTile&, BlockTile& blocks) = nullptr;
    // 16^3 blocks to a palette.
    void (*pack)(const Block* blocks, PackedSection& out) = nullptr;
    void (*biomes)(const TerrainTables&, const GroundTile&, const CaveTile&, BiomeTile& out) = nullptr;
};

const TerrainStages& terrain_stages(Isa isa); // the CPU must have it: best_isa() or lower
Isa best_isa();

} // namespace vitrail
