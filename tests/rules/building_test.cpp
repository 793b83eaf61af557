// Placement and breaking.
#include "rules/breaking.h"
#include "rules/collision.h"
#include "rules/neighbors.h"
#include "rules/placement.h"
#include "rules_world.h"

#include <cmath>
#include <gtest/gtest.h>

namespace vitrail {
namespace {

constexpr float kPi = 3.14159265f;
constexpr float kSouth = 0, kWest = kPi / 2, kNorth = kPi, kEast = -kPi / 2;

class Building : public testing::Test {
protected:
    Building() {
        world.open(-16, -16, -16, 15, 15, 15);
        world.fill(-8, -1, -8, 8, -1, 8, "stone");
    }
    // Places and applies; the error's code, or nothing.
    std::optional<ErrorCode> place(const char* block, i32 x, i32 y, i32 z, Face face, float yaw = kNorth,
                                   Vec3 point = {0.5f, 0.5f, 0.5f}, float pitch = 0) {
        PlaceRequest request;
        request.block = std::string("minecraft:") + block;
        request.against = world.at(x, y, z);
        request.face = face;
        request.yaw = yaw;
        request.pitch = pitch;
        request.point = point;
        const auto batch = place_block(world.dimension(), request, bodies);
        if (!batch) return batch.error().code;
        apply(world.dimension(), *batch);
        return std::nullopt;
    }
    std::optional<ErrorCode> take(i32 x, i32 y, i32 z) {
        const auto batch = break_block(world.dimension(), world.at(x, y, z));
        if (!batch) return batch.error().code;
        apply(world.dimension(), *batch);
        return std::nullopt;
    }
    std::string s(i32 x, i32 y, i32 z) {
        std::string text = world.state(x, y, z);
        return text.substr(text.find(':') + 1);
    }
    // One property of a block.
    std::string get(i32 x, i32 y, i32 z, const char* property) {
        return std::string(
            world.dimension().states().info(world.dimension().state_at(world.at(x, y, z))).state.get(property));
    }
    RulesWorld world;
    std::vector<BodyState> bodies;
};

TEST_F(Building, PlantsOfTheSeaLeaveTheirWater) {
    world.set(0, 0, 0, "kelp");
    EXPECT_FALSE(take(0, 0, 0));
    EXPECT_EQ(s(0, 0, 0).substr(0, 5), "water");
}

TEST_F(Building, PlainBlocksAndAxes) {
    EXPECT_FALSE(place("stone", 0, -1, 0, Face::up));
    EXPECT_EQ(s(0, 0, 0), "stone");
    EXPECT_FALSE(place("oak_log", 0, 0, 0, Face::east));
    EXPECT_EQ(s(1, 0, 0), "oak_log[axis=x]");
    EXPECT_FALSE(place("oak_log", 0, 0, 0, Face::up));
    EXPECT_EQ(s(0, 1, 0), "oak_log[axis=y]");
    EXPECT_FALSE(place("oak_log", 0, 0, 0, Face::north));
    EXPECT_EQ(s(0, 0, -1), "oak_log[axis=z]");
    EXPECT_EQ(place("stone", 0, 0, 0, Face::up), ErrorCode::denied); // taken
    EXPECT_EQ(place("nothing", 0, 0, 0, Face::up), ErrorCode::not_found);
    EXPECT_EQ(place("air", 0, 1, 0, Face::up), ErrorCode::denied);
    EXPECT_EQ(place("stone", 100, 0, 0, Face::up), ErrorCode::not_found);
    EXPECT_EQ(place("stone", 0, 1, 0, Face::up, NAN), ErrorCode::invalid_argument);
}

TEST_F(Building, BodiesAreNotBuiltInto) {
    BodyState body;
    body.feet.at = world.position(0.5, 0, 0.5);
    bodies.push_back(body);
    EXPECT_EQ(place("stone", 0, -1, 0, Face::up), ErrorCode::denied);
    EXPECT_EQ(place("door", 0, -1, 1, Face::up, kSouth), std::nullopt);
    EXPECT_FALSE(place("torch", 0, -1, 0, Face::up)); // no box, no harm
    EXPECT_FALSE(place("stone", 1, -1, 0, Face::up));
}

TEST_F(Building, SlabsStairsAndTrapdoors) {
    place("slab", 0, -1, 0, Face::up);
    EXPECT_EQ(get(0, 0, 0, "type"), "bottom");
    place("slab", 0, 0, 0, Face::up);
    EXPECT_EQ(get(0, 0, 0, "type"), "double");
    place("stone", 3, -1, 0, Face::up);
    place("slab", 3, 0, 0, Face::east, kWest, {1, 0.8f, 0.5f});
    EXPECT_EQ(get(4, 0, 0, "type"), "top");
    place("slab", 3, 0, 0, Face::east, kWest, {1, 0.2f, 0.5f}); // the free half of the same cell
    EXPECT_EQ(get(4, 0, 0, "type"), "double");
    place("stairs", -3, -1, 0, Face::up, kEast);
    EXPECT_EQ(get(-3, 0, 0, "facing"), "east");
    EXPECT_EQ(get(-3, 0, 0, "half"), "bottom");
    place("stairs", 3, 0, 0, Face::south, kNorth, {0.5f, 0.9f, 1});
    EXPECT_EQ(get(3, 0, 1, "half"), "top");
    place("trapdoor", 3, 0, 0, Face::north, kSouth, {0.5f, 0.1f, 0});
    EXPECT_EQ(get(3, 0, -1, "facing"), "north");
    EXPECT_EQ(get(3, 0, -1, "half"), "bottom");
}

TEST_F(Building, StairsTurnCorners) {
    place("stairs", 0, -1, 0, Face::up, kNorth);
    place("stairs", 0, -1, -1, Face::up, kEast); // in front of the first
    EXPECT_EQ(get(0, 0, 0, "shape"), "outer_right");
    take(0, 0, -1);
    EXPECT_EQ(get(0, 0, 0, "shape"), "straight");
    place("stairs", 0, -1, 1, Face::up, kWest); // behind it
    EXPECT_EQ(get(0, 0, 0, "shape"), "inner_left");
    EXPECT_EQ(get(0, 0, 1, "shape"), "straight");
}

TEST_F(Building, FencesPanesWallsAndGatesJoin) {
    place("fence", 0, -1, 0, Face::up);
    place("fence", 1, -1, 0, Face::up);
    EXPECT_EQ(get(0, 0, 0, "east"), "true");
    EXPECT_EQ(get(1, 0, 0, "west"), "true");
    EXPECT_EQ(get(1, 0, 0, "east"), "false");
    place("stone", 2, -1, 0, Face::up);
    EXPECT_EQ(get(1, 0, 0, "east"), "true");
    place("fence_gate", 0, -1, 1, Face::up, kEast); // runs north to south
    EXPECT_EQ(get(0, 0, 0, "south"), "true");
    place("fence_gate", 0, -1, -1, Face::up, kNorth);
    EXPECT_EQ(get(0, 0, 0, "north"), "false");
    take(1, 0, 0);
    EXPECT_EQ(get(0, 0, 0, "east"), "false");
    place("glass_pane", 2, 0, 0, Face::south);
    EXPECT_EQ(get(2, 0, 1, "north"), "true");
    place("wall", 5, -1, 0, Face::up);
    place("wall", 6, -1, 0, Face::up);
    place("wall", 7, -1, 0, Face::up);
    EXPECT_EQ(get(6, 0, 0, "east"), "low");
    EXPECT_EQ(get(6, 0, 0, "up"), "false"); // straight through
    EXPECT_EQ(get(5, 0, 0, "up"), "true");
    place("stone", 6, 0, 0, Face::up);
    EXPECT_EQ(get(6, 0, 0, "east"), "tall");
    place("fence_gate", 5, -1, 1, Face::up, kEast);
    EXPECT_EQ(get(5, 0, 1, "in_wall"), "true");
}

TEST_F(Building, TorchesFindTheirHold) {
    place("torch", 0, -1, 0, Face::up);
    EXPECT_EQ(s(0, 0, 0), "torch");
    place("stone", 3, -1, 0, Face::up);
    place("torch", 3, 0, 0, Face::west);
    EXPECT_EQ(s(2, 0, 0), "wall_torch[facing=west]");
    EXPECT_EQ(place("torch", 3, 0, 0, Face::down), ErrorCode::denied);
    take(3, 0, 0);
    EXPECT_EQ(s(2, 0, 0), "air"); // fell with its wall
    place("fence", 5, -1, 0, Face::up);
    EXPECT_FALSE(place("torch", 5, 0, 0, Face::up)); // a post is enough
    EXPECT_EQ(place("torch", 5, 0, 0, Face::east), ErrorCode::denied);
    place("stone", -3, -1, 0, Face::up);
    place("lantern", -3, 0, 0, Face::up);
    EXPECT_EQ(get(-3, 1, 0, "hanging"), "false");
    place("button", -3, 0, 0, Face::south);
    EXPECT_EQ(get(-3, 0, 1, "face"), "wall");
    EXPECT_EQ(get(-3, 0, 1, "facing"), "south");
}

TEST_F(Building, DoorsBedsAndTallPlantsAreTwo) {
    EXPECT_FALSE(place("door", 0, -1, 0, Face::up, kNorth));
    EXPECT_EQ(get(0, 0, 0, "half"), "lower");
    EXPECT_EQ(get(0, 1, 0, "half"), "upper");
    EXPECT_EQ(get(0, 1, 0, "facing"), "north");
    place("door", 1, -1, 0, Face::up, kNorth);
    EXPECT_EQ(get(1, 0, 0, "hinge"), "right"); // double doors
    take(0, 1, 0);
    EXPECT_EQ(s(0, 0, 0), "air");
    take(1, -1, 0);
    EXPECT_EQ(s(1, 0, 0), "air"); // the floor went
    EXPECT_EQ(s(1, 1, 0), "air");
    place("stone", 3, -1, 0, Face::up);
    place("stone", 3, 0, 0, Face::up);
    place("stone", 3, 1, 0, Face::south);
    EXPECT_EQ(place("door", 3, -1, 1, Face::up), ErrorCode::denied); // no room for its top
    EXPECT_EQ(place("stone", 7, 5, 7, Face::up), ErrorCode::denied); // nothing to build on
    EXPECT_FALSE(place("bed", -3, -1, 0, Face::up, kEast));
    EXPECT_EQ(get(-3, 0, 0, "part"), "foot");
    EXPECT_EQ(get(-2, 0, 0, "part"), "head");
    EXPECT_EQ(place("bed", -1, -1, 0, Face::up, kWest), ErrorCode::denied);
    take(-2, 0, 0);
    EXPECT_EQ(s(-3, 0, 0), "air");
    EXPECT_FALSE(place("sunflower", 6, -1, 6, Face::up));
    EXPECT_EQ(get(6, 1, 6, "half"), "upper");
    take(6, 0, 6);
    EXPECT_EQ(s(6, 1, 6), "air");
}

TEST_F(Building, ReplaceableBlocksGiveWay) {
    place("short_grass", 0, -1, 0, Face::up);
    place("stone", 0, 0, 0, Face::north);
    EXPECT_EQ(s(0, 0, 0), "stone");
    place("water", 2, -1, 0, Face::up);
    EXPECT_EQ(s(2, 0, 0), "water[level=0]");
    place("slab", 2, -1, 0, Face::up);
    EXPECT_EQ(get(2, 0, 0, "waterlogged"), "true");
    take(2, 0, 0);
    EXPECT_EQ(s(2, 0, 0), "water[level=0]");
    EXPECT_EQ(take(2, 0, 0), ErrorCode::denied);
    place("poppy", 4, -1, 0, Face::up);
    take(4, -1, 0);
    EXPECT_EQ(s(4, 0, 0), "air");
    place("snow", 5, -1, 0, Face::up);
    place("snow", 5, 0, 0, Face::up);
    EXPECT_EQ(get(5, 0, 0, "layers"), "2");
}

TEST_F(Building, ChestsJoinAndPart) {
    place("chest", 0, -1, 0, Face::up, kSouth);
    EXPECT_EQ(get(0, 0, 0, "facing"), "north");
    place("chest", 1, -1, 0, Face::up, kSouth);
    EXPECT_EQ(get(1, 0, 0, "type"), "right");
    EXPECT_EQ(get(0, 0, 0, "type"), "left");
    take(1, 0, 0);
    EXPECT_EQ(get(0, 0, 0, "type"), "single");
}

TEST_F(Building, RailsCurveAndClimb) {
    place("rail", 0, -1, 0, Face::up, kNorth);
    EXPECT_EQ(get(0, 0, 0, "shape"), "north_south");
    place("rail", 1, -1, 0, Face::up, kNorth);
    EXPECT_EQ(get(0, 0, 0, "shape"), "east_west");
    place("rail", 1, -1, 1, Face::up, kNorth);
    EXPECT_EQ(get(1, 0, 0, "shape"), "south_west");
    place("stone", -1, -1, 0, Face::up);
    place("rail", -1, 0, 0, Face::up, kEast);
    EXPECT_EQ(get(0, 0, 0, "shape"), "ascending_west");
}

TEST_F(Building, LaddersAndVines) {
    place("stone", 0, -1, 0, Face::up);
    EXPECT_FALSE(place("ladder", 0, 0, 0, Face::south));
    EXPECT_EQ(get(0, 0, 1, "facing"), "south");
    place("vine", 0, 0, 0, Face::east);
    EXPECT_EQ(get(1, 0, 0, "west"), "true");
    take(0, 0, 0);
    EXPECT_EQ(s(0, 0, 1), "air");
    EXPECT_EQ(s(1, 0, 0), "air");
}

TEST_F(Building, OpenSkyCanBeBuiltInto) {
    world.fill(0, 15, 0, 0, 15, 0, "stone"); // the topmost cell that has a chunk
    PlaceRequest request;
    request.block = "minecraft:stone";
    request.against = world.at(0, 15, 0);
    EXPECT_EQ(place_block(world.dimension(), request, {}).error().code, ErrorCode::not_found);
    ColumnHeights heights;
    heights.above.fill(16);
    world.dimension().put_heights({0, 0}, heights);
    const auto batch = place_block(world.dimension(), request, {});
    ASSERT_TRUE(batch);
    EXPECT_EQ(batch->edits.at(0).at, world.at(0, 16, 0));
}

TEST_F(Building, UnbreakableAndUnknown) {
    world.set(0, 0, 0, "bedrock");
    EXPECT_EQ(take(0, 0, 0), ErrorCode::denied);
    EXPECT_EQ(take(1, 0, 0), ErrorCode::denied); // air
    EXPECT_EQ(take(1000, 0, 0), ErrorCode::not_found);
    world.set(0, 1, 0, "vitrail:hidden");
    EXPECT_EQ(take(0, 1, 0), ErrorCode::denied);
    world.set(3, 0, 0, "mod:machine[on=true]");
    EXPECT_FALSE(take(3, 0, 0));
    BlockLook look;
    EXPECT_EQ(break_seconds(look, true), 0);
    EXPECT_FLOAT_EQ(break_seconds(look, false), 1.5f);
    look.hardness = -1;
    EXPECT_TRUE(std::isinf(break_seconds(look, true)));
}

// Whatever is asked, rules answer; what they accept leaves everything supported and joined, and the way back is the
// same: what the neighbors' joints say equals what they would be if computed anew.
TEST_F(Building, RandomBuildingStaysSound) {
    const char* names[] = {"stone",  "oak_log", "slab",   "stairs",     "fence",    "fence_gate", "glass_pane",
                           "wall",   "torch",   "poppy",  "door",       "trapdoor", "ladder",     "rail",
                           "carpet", "bed",     "chest",  "lantern",    "button",   "snow",       "sunflower",
                           "vine",   "water",   "cobweb", "grass_block"};
    Rng rng(21);
    int placed = 0, broken = 0;
    for (int i = 0; i < 8000; ++i) {
        const i32 x = i32(rng.below(9)) - 4, y = i32(rng.below(6)) - 1, z = i32(rng.below(9)) - 4;
        if (rng.below(3) == 0)
            broken += !take(x, std::max(y, 0), z); // the floor stays
        else
            placed += !place(names[rng.below(std::size(names))], x, y, z, Face(rng.below(6)), rng.unit() * 8 - 4,
                             {rng.unit(), rng.unit(), rng.unit()}, rng.unit() * 3 - 1.5f);
        if (i % 200 != 0) continue;
        const EditView view(world.dimension());
        for (i32 by = -1; by < 8; ++by)
            for (i32 bz = -8; bz <= 8; ++bz)
                for (i32 bx = -8; bx <= 8; ++bx) {
                    const BlockPos at = world.at(bx, by, bz);
                    ASSERT_TRUE(is_supported(view, at)) << world.state(bx, by, bz);
                    const StateInfo& info = view.info_at(at);
                    if (info.look->shape != ShapeKind::rail) { // a rail keeps its way where nothing says otherwise
                        ASSERT_EQ(connected(view, at, info.state).to_string(), info.state.to_string());
                    }
                }
    }
    EXPECT_GT(placed, 250);
    EXPECT_GT(broken, 150);
}

} // namespace
} // namespace vitrail
