#include "world/shape.h"

#include "base/rng.h"

#include <gtest/gtest.h>

namespace vitrail {
namespace {

BlockState state(const char* text) {
    return *parse_block_state(text);
}

BlockShape shape_of(ShapeKind kind, const char* properties = "", bool collision = true) {
    BlockLook look;
    look.shape = kind;
    look.collision = collision;
    return make_shape(look, state((std::string("test:block") + properties).c_str()));
}

ShapeBox box64(int x0, int y0, int z0, int x1, int y1, int z1) {
    return {{i16(x0), i16(y0), i16(z0)}, {i16(x1), i16(y1), i16(z1)}};
}

// Whether a point of the cell, in 1/64 block plus half a unit, lies in any box.
bool covers(const std::vector<ShapeBox>& boxes, int x, int y, int z) {
    const int p[3] = {x, y, z};
    for (const ShapeBox& b : boxes) {
        bool in = true;
        for (int a = 0; a < 3; ++a)
            in &= p[a] >= b.min[a] && p[a] < b.max[a];
        if (in) return true;
    }
    return false;
}

TEST(Shape, CubesAndSlabs) {
    EXPECT_TRUE(shape_of(ShapeKind::cube).full_cube);
    EXPECT_TRUE(shape_of(ShapeKind::pillar, "[axis=x]").full_cube);
    EXPECT_TRUE(shape_of(ShapeKind::slab, "[type=double]").full_cube);
    EXPECT_FALSE(shape_of(ShapeKind::slab, "[type=top]").full_cube);
    EXPECT_EQ(shape_of(ShapeKind::slab).collision, std::vector{box64(0, 0, 0, 64, 32, 64)});
    EXPECT_EQ(shape_of(ShapeKind::slab, "[type=top]").pick, std::vector{box64(0, 32, 0, 64, 64, 64)});
    EXPECT_TRUE(shape_of(ShapeKind::cube, "", false).collision.empty());
    EXPECT_FALSE(shape_of(ShapeKind::cube, "", false).full_cube);
    EXPECT_TRUE(shape_of(ShapeKind::none, "", false).pick.empty());
    EXPECT_TRUE(shape_of(ShapeKind::none).full_cube); // barrier
}

TEST(Shape, StairsAreHighWhereTheyFace) {
    const struct {
        const char* properties;
        bool high[4];
    } cases[] = {
        // quarters of the upper half: north-west, north-east, south-west, south-east
        {"[facing=north]", {true, true, false, false}},
        {"[facing=south]", {false, false, true, true}},
        {"[facing=west]", {true, false, true, false}},
        {"[facing=east]", {false, true, false, true}},
        {"[facing=north,shape=outer_left]", {true, false, false, false}},
        {"[facing=north,shape=outer_right]", {false, true, false, false}},
        {"[facing=north,shape=inner_left]", {true, true, true, false}},
        {"[facing=north,shape=inner_right]", {true, true, false, true}},
        {"[facing=east,shape=inner_left]", {true, true, false, true}},
        {"[facing=west,shape=outer_right]", {true, false, false, false}},
    };
    for (const auto& c : cases) {
        const BlockShape s = shape_of(ShapeKind::stairs, c.properties);
        EXPECT_EQ(s.collision, s.pick);
        for (int q = 0; q < 4; ++q) {
            const int x = q % 2 ? 48 : 16, z = q / 2 ? 48 : 16;
            EXPECT_EQ(covers(s.collision, x, 48, z), c.high[q]) << c.properties << " quarter " << q;
            EXPECT_TRUE(covers(s.collision, x, 16, z));
        }
        std::string top = c.properties;
        top.insert(top.size() - 1, ",half=top");
        const BlockShape t = shape_of(ShapeKind::stairs, top.c_str());
        for (int q = 0; q < 4; ++q) {
            const int x = q % 2 ? 48 : 16, z = q / 2 ? 48 : 16;
            EXPECT_EQ(covers(t.collision, x, 16, z), c.high[q]) << top << " quarter " << q;
            EXPECT_TRUE(covers(t.collision, x, 48, z));
        }
    }
}

TEST(Shape, FencesStopJumpsAndArePickedAsDrawn) {
    const BlockShape fence = shape_of(ShapeKind::fence, "[east=true,north=false,south=false,west=true]");
    ASSERT_EQ(fence.collision.size(), 3u);
    for (const ShapeBox& b : fence.collision)
        EXPECT_EQ(b.max[1], 96);
    for (const ShapeBox& b : fence.pick)
        EXPECT_EQ(b.max[1], 64);
    EXPECT_TRUE(covers(fence.pick, 0, 10, 32));
    EXPECT_TRUE(covers(fence.pick, 63, 10, 32));
    EXPECT_FALSE(covers(fence.pick, 32, 10, 0));
    const BlockShape wall = shape_of(ShapeKind::wall, "[east=none,north=low,south=tall,up=false,west=none]");
    EXPECT_EQ(wall.pick, (std::vector{box64(20, 0, 0, 44, 56, 32), box64(20, 0, 32, 44, 64, 64)}));
    EXPECT_EQ(shape_of(ShapeKind::pane).collision, std::vector{box64(28, 0, 28, 36, 64, 36)});
    EXPECT_EQ(shape_of(ShapeKind::fence_gate, "[facing=east]").collision, std::vector{box64(24, 0, 0, 40, 96, 64)});
    EXPECT_TRUE(shape_of(ShapeKind::fence_gate, "[facing=east,open=true]").collision.empty());
}

TEST(Shape, DoorsSwingAboutTheirHinge) {
    const auto door = [](const char* p) { return shape_of(ShapeKind::door, p).collision.at(0); };
    EXPECT_EQ(door("[facing=north]"), box64(0, 0, 52, 64, 64, 64));
    EXPECT_EQ(door("[facing=east]"), box64(0, 0, 0, 12, 64, 64));
    EXPECT_EQ(door("[facing=north,hinge=left,open=true]"), box64(0, 0, 0, 12, 64, 64));
    EXPECT_EQ(door("[facing=north,hinge=right,open=true]"), box64(52, 0, 0, 64, 64, 64));
    EXPECT_EQ(door("[facing=south,hinge=left,open=true]"), box64(52, 0, 0, 64, 64, 64));
    EXPECT_EQ(shape_of(ShapeKind::trapdoor, "[facing=south,open=true]").collision.at(0), box64(0, 0, 0, 64, 64, 12));
    EXPECT_EQ(shape_of(ShapeKind::trapdoor, "[half=top]").collision.at(0), box64(0, 52, 0, 64, 64, 64));
}

TEST(Shape, PlantsTorchesAndLiquidsStopNobody) {
    for (const ShapeKind kind :
         {ShapeKind::cross, ShapeKind::crop, ShapeKind::torch, ShapeKind::wall_torch, ShapeKind::faces, ShapeKind::rail,
          ShapeKind::button, ShapeKind::lever, ShapeKind::pressure_plate, ShapeKind::sign, ShapeKind::wall_sign}) {
        const BlockShape s = shape_of(kind);
        EXPECT_TRUE(s.collision.empty()) << kShapeKindNames[std::size_t(kind)];
        EXPECT_FALSE(s.pick.empty()) << kShapeKindNames[std::size_t(kind)];
    }
    EXPECT_EQ(shape_of(ShapeKind::liquid), BlockShape{});
    EXPECT_EQ(shape_of(ShapeKind::torch).pick.at(0), box64(24, 0, 24, 40, 40, 40));
    EXPECT_EQ(shape_of(ShapeKind::wall_torch, "[facing=east]").pick.at(0), box64(0, 12, 22, 20, 52, 42));
}

TEST(Shape, LayersAndLiquidHeights) {
    EXPECT_TRUE(shape_of(ShapeKind::layers, "[layers=1]").collision.empty());
    EXPECT_EQ(shape_of(ShapeKind::layers, "[layers=3]").collision.at(0).max[1], 16);
    EXPECT_EQ(shape_of(ShapeKind::layers, "[layers=3]").pick.at(0).max[1], 24);
    EXPECT_TRUE(shape_of(ShapeKind::layers, "[layers=8]").full_cube);
    EXPECT_EQ(shape_of(ShapeKind::layers, "[layers=nonsense]"), shape_of(ShapeKind::layers, "[layers=1]"));
    EXPECT_EQ(liquid_height(8), 64);
    for (int level = 1; level < 8; ++level)
        EXPECT_LT(liquid_height(level), liquid_height(level - 1));
    EXPECT_GT(liquid_height(7), 0);
    EXPECT_EQ(liquid_height(0), 57);
}

TEST(Shape, BoxesOfContent) {
    BlockLook look;
    look.shape = ShapeKind::boxes;
    look.boxes = {
        {1, 0, 1, 15, 16, 15, ""}, {0, 0, 8, 16, 16, 8, "leaf"}, {6, 6, 4, 10, 10, 20, ""}, {20, 0, 0, 30, 1, 1, ""}};
    const BlockShape s = make_shape(look, state("test:block"));
    EXPECT_EQ(s.collision, (std::vector{box64(4, 0, 4, 60, 64, 60), box64(24, 24, 16, 40, 40, 64)}));
    ASSERT_EQ(s.pick.size(), 3u);
    EXPECT_EQ(s.pick[1], box64(0, 0, 32, 64, 64, 33));
}

// Whatever the kind and the properties, boxes are proper and stay where bodies and rays look for them.
TEST(Shape, EveryBoxIsProper) {
    const char* names[] = {"facing", "half", "shape",  "type", "north", "east", "south",   "west",    "up",   "open",
                           "hinge",  "face", "layers", "age",  "axis",  "part", "powered", "hanging", "level"};
    const char* values[] = {
        "north", "east",   "south",      "west",        "up",      "down", "top",  "bottom",         "true", "false",
        "left",  "right",  "floor",      "wall",        "ceiling", "0",    "7",    "99999999999",    "-3",   "x",
        "z",     "double", "inner_left", "outer_right", "low",     "tall", "none", "ascending_east", "head", "upper"};
    Rng rng(7);
    for (int i = 0; i < 40000; ++i) {
        BlockLook look;
        look.shape = ShapeKind(rng.below(u32(ShapeKind::count)));
        look.collision = rng.below(4) != 0;
        const auto number = [&] { return float(int(rng.below(160)) - 40) * 0.25f; };
        for (u32 n = rng.below(4); n > 0; --n)
            look.boxes.push_back({number(), number(), number(), number(), number(), number(), ""});
        BlockState s{"test:block", {}};
        for (u32 n = rng.below(6); n > 0; --n)
            s.set(names[rng.below(std::size(names))], values[rng.below(std::size(values))]);
        const BlockShape shape = make_shape(look, s);
        if (!look.collision) {
            EXPECT_TRUE(shape.collision.empty());
        }
        for (const auto* boxes : {&shape.collision, &shape.pick})
            for (const ShapeBox& b : *boxes)
                for (int a = 0; a < 3; ++a) {
                    ASSERT_LT(b.min[a], b.max[a]) << s.to_string();
                    ASSERT_GE(b.min[a], 0);
                    ASSERT_LE(b.max[a], a == 1 && boxes == &shape.collision ? 96 : 64);
                }
    }
}

} // namespace
} // namespace vitrail
