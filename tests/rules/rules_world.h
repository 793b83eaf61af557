// A small world for the tests of rules: blocks of every kind by hand, chunks made as blocks are set.
#pragma once

#include "base/rng.h"
#include "voxel/edit.h"
#include "world/dimension.h"

#include <gtest/gtest.h>
#include <map>

namespace vitrail {

inline std::shared_ptr<const BlockRegistry> rules_registry() {
    static const std::shared_ptr<const BlockRegistry> registry = [] {
        auto out = std::make_shared<BlockRegistry>();
        const std::vector<std::string> bools{"true", "false"}, facing{"north", "south", "west", "east"};
        const auto add = [&](const char* name, ShapeKind shape, std::vector<PropertyDef> properties, auto change) {
            BlockDef def;
            def.name = std::string("minecraft:") + name;
            def.look.shape = shape;
            def.look.opacity = shape == ShapeKind::cube ? 15 : 0;
            def.properties = std::move(properties);
            def.look.textures = {"x"};
            change(def.look);
            out->add_block(std::move(def));
        };
        const auto plain = [](BlockLook&) {};
        const auto open = [](BlockLook& look) { look.collision = false; };
        const PropertyDef face{"facing", facing, "north"}, logged{"waterlogged", bools, "false"};
        const auto no = [&](const char* name) { return PropertyDef{name, bools, "false"}; };
        const auto sides = [&] {
            return std::vector<PropertyDef>{no("east"), no("north"), no("south"), logged, no("west")};
        };
        add("stone", ShapeKind::cube, {}, plain);
        add("dirt", ShapeKind::cube, {}, plain);
        add("grass_block", ShapeKind::cube, {}, plain);
        add("bedrock", ShapeKind::cube, {}, [](BlockLook& look) { look.hardness = -1; });
        add("oak_log", ShapeKind::pillar, {{"axis", {"x", "y", "z"}, "y"}}, plain);
        add("slab", ShapeKind::slab, {{"type", {"bottom", "top", "double"}, "bottom"}, logged}, plain);
        add("stairs", ShapeKind::stairs,
            {face,
             {"half", {"top", "bottom"}, "bottom"},
             {"shape", {"straight", "inner_left", "inner_right", "outer_left", "outer_right"}, "straight"},
             logged},
            plain);
        add("fence", ShapeKind::fence, sides(), [](BlockLook& look) { look.material = "wood"; });
        add("fence_gate", ShapeKind::fence_gate, {face, no("in_wall"), no("open"), no("powered")}, plain);
        add("glass_pane", ShapeKind::pane, sides(), plain);
        const auto wall_side = [](const char* name) { return PropertyDef{name, {"none", "low", "tall"}, "none"}; };
        add("wall", ShapeKind::wall,
            {wall_side("east"),
             wall_side("north"),
             wall_side("south"),
             {"up", bools, "true"},
             wall_side("west"),
             logged},
            plain);
        add("torch", ShapeKind::torch, {}, open);
        add("wall_torch", ShapeKind::wall_torch, {face}, open);
        add("kelp", ShapeKind::cross, {}, open);
        add("short_grass", ShapeKind::cross, {}, [](BlockLook& look) {
            look.collision = false;
            look.replaceable = true;
            look.material = "plant";
        });
        add("poppy", ShapeKind::cross, {}, [](BlockLook& look) {
            look.collision = false;
            look.material = "plant";
        });
        add("door", ShapeKind::door,
            {face,
             {"half", {"upper", "lower"}, "lower"},
             {"hinge", {"left", "right"}, "left"},
             no("open"),
             no("powered")},
            plain);
        add("trapdoor", ShapeKind::trapdoor,
            {face, {"half", {"top", "bottom"}, "bottom"}, no("open"), no("powered"), logged}, plain);
        add("ladder", ShapeKind::ladder, {face, logged}, [](BlockLook& look) { look.climbable = true; });
        add("rail", ShapeKind::rail,
            {{"shape",
              {"north_south", "east_west", "ascending_east", "ascending_west", "ascending_north", "ascending_south",
               "south_east", "south_west", "north_west", "north_east"},
              "north_south"},
             logged},
            open);
        add("carpet", ShapeKind::carpet, {}, plain);
        add("bed", ShapeKind::bed, {face, no("occupied"), {"part", {"foot", "head"}, "foot"}}, plain);
        add("chest", ShapeKind::chest, {face, {"type", {"single", "left", "right"}, "single"}, logged}, plain);
        add("lantern", ShapeKind::lantern, {no("hanging"), logged}, plain);
        add("button", ShapeKind::button, {{"face", {"floor", "wall", "ceiling"}, "wall"}, face, no("powered")}, open);
        add("snow", ShapeKind::layers, {{"layers", {"1", "2", "3", "4", "5", "6", "7", "8"}, "1"}},
            [](BlockLook& look) { look.replaceable = true; });
        add("sunflower", ShapeKind::cross, {{"half", {"upper", "lower"}, "lower"}}, [](BlockLook& look) {
            look.collision = false;
            look.material = "plant";
        });
        add("vine", ShapeKind::faces, {no("east"), no("north"), no("south"), no("up"), no("west")},
            [](BlockLook& look) {
                look.collision = false;
                look.climbable = true;
                look.replaceable = true;
            });
        std::vector<std::string> levels;
        for (int i = 0; i < 16; ++i)
            levels.push_back(std::to_string(i));
        add("water", ShapeKind::liquid, {{"level", levels, "0"}}, [](BlockLook& look) {
            look.collision = false;
            look.viscosity = 0.2f;
            look.replaceable = true;
            look.hardness = 100;
            look.material = "water";
        });
        add("cobweb", ShapeKind::cross, {}, [](BlockLook& look) {
            look.collision = false;
            look.viscosity = 0.9f;
        });
        return out;
    }();
    return registry;
}

class RulesWorld {
public:
    explicit RulesWorld(BlockPos origin = {0, 0, 0})
        : origin_(origin)
        , dimension_(info(), std::make_shared<StateTable>(rules_registry())) {}

    Dimension& dimension() { return dimension_; }
    BlockPos at(i32 x, i32 y, i32 z) const { return {origin_.x + x, origin_.y + y, origin_.z + z}; }
    WorldPos position(double x, double y, double z) const {
        const WorldPos corner = corner_of(origin_);
        return {corner.x + i64(x * 4294967296.0), corner.y + i64(y * 4294967296.0), corner.z + i64(z * 4294967296.0)};
    }
    // From the origin, in blocks.
    double x_of(WorldPos p) const { return double(p.x - corner_of(origin_).x) * 0x1p-32; }
    double y_of(WorldPos p) const { return double(p.y - corner_of(origin_).y) * 0x1p-32; }
    double z_of(WorldPos p) const { return double(p.z - corner_of(origin_).z) * 0x1p-32; }

    StateId id(const char* text) {
        const auto parsed = parse_block_state(text);
        EXPECT_TRUE(parsed) << text;
        const auto made = dimension_.states().intern_with_defaults(*parsed);
        EXPECT_TRUE(made);
        return *made;
    }
    // Chunks of air over these blocks.
    void open(i32 x0, i32 y0, i32 z0, i32 x1, i32 y1, i32 z1) {
        const ChunkPos a = chunk_of(at(x0, y0, z0)), b = chunk_of(at(x1, y1, z1));
        for (i32 y = a.y; y <= b.y; ++y)
            for (i32 z = a.z; z <= b.z; ++z)
                for (i32 x = a.x; x <= b.x; ++x)
                    if (!dimension_.find({x, y, z})) dimension_.put({x, y, z}, std::make_shared<Chunk>());
    }
    void set(i32 x, i32 y, i32 z, const char* state) { fill(x, y, z, x, y, z, state); }
    void fill(i32 x0, i32 y0, i32 z0, i32 x1, i32 y1, i32 z1, const char* state) {
        open(x0, y0, z0, x1, y1, z1);
        EditBatch batch;
        for (i32 y = y0; y <= y1; ++y)
            for (i32 z = z0; z <= z1; ++z)
                for (i32 x = x0; x <= x1; ++x)
                    batch.edits.push_back({at(x, y, z), id(state)});
        apply(dimension_, batch);
    }
    std::string state(i32 x, i32 y, i32 z) {
        return dimension_.states().info(dimension_.state_at(at(x, y, z))).state.to_string();
    }

private:
    static DimensionInfo info() {
        DimensionInfo out;
        out.min_y = -kWorldEdge;
        out.max_y = kWorldEdge;
        return out;
    }
    BlockPos origin_;
    Dimension dimension_;
};

} // namespace vitrail
