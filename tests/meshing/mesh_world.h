// A small set of blocks of every kind, and chunks of them, for the mesher's tests and benchmarks.
#pragma once

#include "base/rng.h"
#include "render/meshing/mesher.h"
#include "world/state_table.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace vitrail::test {

inline BlockDef block_def(std::string name, std::vector<std::string> textures, ShapeKind shape = ShapeKind::cube,
                          RenderLayer layer = RenderLayer::solid) {
    BlockDef def;
    def.name = std::move(name);
    def.look.textures = std::move(textures);
    def.look.shape = shape;
    def.look.layer = layer;
    if (layer != RenderLayer::solid) def.look.opacity = 0;
    return def;
}

struct MeshWorld {
    std::shared_ptr<BlockRegistry> registry = std::make_shared<BlockRegistry>();
    std::shared_ptr<StateTable> states;
    scene::BlockModels models;

    MeshWorld() {
        const auto add = [&](BlockDef def) { registry->add_block(std::move(def)); };
        add(block_def("minecraft:stone", {"stone"}));
        add(block_def("minecraft:dirt", {"dirt"}));
        BlockDef grass = block_def("minecraft:grass_block", {"grass_side", "grass_top", "dirt"});
        grass.look.tint = TintKind::grass;
        grass.look.tint_faces = TintFaces::top;
        add(grass);
        add(block_def("minecraft:sand", {"sand"}));
        add(block_def("minecraft:coal_ore", {"coal_ore"}));
        add(block_def("minecraft:oak_log", {"oak_log", "oak_log_top"}, ShapeKind::pillar));
        for (const char* name : {"minecraft:oak_leaves", "minecraft:birch_leaves"}) {
            BlockDef leaves =
                block_def(name, {std::string(name).substr(10)}, ShapeKind::cube, RenderLayer::cutout_mipped);
            leaves.look.material = "leaves";
            leaves.look.tint = TintKind::foliage;
            add(leaves);
        }
        add(block_def("minecraft:glass", {"glass"}, ShapeKind::cube, RenderLayer::cutout));
        add(block_def("minecraft:red_stained_glass", {"red_glass"}, ShapeKind::cube, RenderLayer::translucent));
        add(block_def("minecraft:ice", {"ice"}, ShapeKind::cube, RenderLayer::translucent));
        BlockDef water =
            block_def("minecraft:water", {"water_flow", "water_still"}, ShapeKind::liquid, RenderLayer::translucent);
        water.look.tint = TintKind::water;
        add(water);
        add(block_def("minecraft:lava", {"lava_flow", "lava_still"}, ShapeKind::liquid));
        add(block_def("minecraft:oak_slab", {"planks"}, ShapeKind::slab));
        add(block_def("minecraft:oak_stairs", {"planks"}, ShapeKind::stairs));
        add(block_def("minecraft:oak_fence", {"planks"}, ShapeKind::fence));
        add(block_def("minecraft:torch", {"torch"}, ShapeKind::torch, RenderLayer::cutout));
        BlockDef fern = block_def("minecraft:fern", {"fern"}, ShapeKind::cross, RenderLayer::cutout);
        fern.look.sway = true;
        fern.look.collision = false;
        add(fern);
        states = std::make_shared<StateTable>(registry);
    }

    StateId operator()(const char* text) {
        const StateId id = states->intern(parse_block_state(text).value()).value();
        models.ensure(*states);
        return id;
    }
};

// A chunk from a function of the cell.
inline Chunk make_chunk(const std::function<StateId(LocalPos)>& state_of) {
    std::array<StateId, kChunkVolume> cells;
    for (u32 i = 0; i < kChunkVolume; ++i)
        cells[i] = state_of(LocalPos(i));
    Chunk chunk;
    chunk.blocks = BlockStorage::from_states(cells);
    return chunk;
}

// 27 chunks, owned.
struct Neighborhood {
    std::array<std::unique_ptr<Chunk>, 27> chunks;

    render::MeshInput input(const scene::BlockModels& models) const {
        render::MeshInput in;
        for (u32 i = 0; i < 27; ++i)
            in.chunks[i] = chunks[i].get();
        in.models = &models;
        return in;
    }
};

} // namespace vitrail::test
