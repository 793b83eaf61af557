// What the mesher keeps between calls.
#pragma once

#include "render/meshing/mesh_gather.h"

#include <memory>
#include <vector>

namespace vitrail::render {

// Cells that draw alike: all opaque cubes, a group of see-through cubes, or the level and full cells of one fluid.
struct MeshLayer {
    scene::ModelPass pass = scene::ModelPass::opaque;
    u32 exposed = 0; // bit a face: some cell draws it
    u32 fluid = 0;   // for fluids; then all cells look the same and cast no occlusion
    u64 fluid_looks[6] = {};
    const PaddedMask* down = nullptr; // cells that draw downwards, upwards, sideways
    const PaddedMask* up = nullptr;
    const PaddedMask* side = nullptr;
    const PaddedMask* blockers = nullptr;
    const PaddedMask* side_turned = nullptr; // transposed, for west and east
    const PaddedMask* blockers_turned = nullptr;
};

// Equality masks of neighboring cells' looks. Directions whose looks are equal for the same palette entries share them.
struct EqualityMasks {
    std::vector<u16> same_as; // palette entry -> first entry of the same look
    bool identity = true;
    u32 have = 0; // bit 0..2: axis x, y, z; 3, 4: y, z transposed
    std::array<RowMask, 5> masks;
};

// Masks that layers own.
struct LayerMasks {
    ClassMasks cells;
    PaddedMask blockers, side, up, side_turned, blockers_turned;
};

struct MeshScratch::Impl {
    CellIndices cells;
    const BlockStorage* blocks = nullptr; // of the section
    std::vector<u8> class_table;
    ClassMasks opaque; // first: hides faces; second: casts occlusion
    PaddedMask opaque_turned, occluders_turned;
    std::vector<MeshLayer> layers;
    std::vector<std::unique_ptr<LayerMasks>> owned; // reused, `owned_used` of them
    std::size_t owned_used = 0;
    std::array<std::vector<u64>, 6> looks; // by palette index
    std::vector<EqualityMasks> equalities;
    std::array<u32, 6> equality_of{};
    u32 equalities_used = 0;
    alignas(64) std::array<u8, 4096 + 64> translated;
    std::vector<u16> translated_wide;
    std::vector<u64> quads; // raw; `end` of them
    std::size_t end = 0;
    std::array<std::vector<u64>, 3> models; // by pass
};

// mesh_models.cpp: quads of models and of sloping liquids.
void mesh_models(const MeshInput& input, MeshScratch::Impl& s, const RowMask& cells);
// Adds layers for level and full cells of each fluid in the section, and writes the rest of it to s.models.
void mesh_liquids(const MeshInput& input, MeshScratch::Impl& s);
// mesh_hidden.cpp: gives exposed hidden cells the palette entry of their nearest known opaque neighbor.
void reveal_hidden(const MeshInput& input, MeshScratch::Impl& s);

inline LayerMasks& next_layer_masks(MeshScratch::Impl& s) {
    if (s.owned_used == s.owned.size()) s.owned.push_back(std::make_unique<LayerMasks>());
    return *s.owned[s.owned_used++];
}

} // namespace vitrail::render
