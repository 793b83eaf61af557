#include "scene/block_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <thread>

namespace vitrail::scene {
namespace {

struct Blocks {
    std::shared_ptr<BlockRegistry> registry = std::make_shared<BlockRegistry>();
    std::unique_ptr<StateTable> states;
    BlockModels models;

    void add(const std::string& name, ShapeKind shape, std::vector<std::string> textures,
             RenderLayer layer = RenderLayer::solid) {
        BlockDef def;
        def.name = "minecraft:" + name;
        def.look.shape = shape;
        def.look.textures = std::move(textures);
        def.look.layer = layer;
        if (shape != ShapeKind::cube && shape != ShapeKind::pillar) def.look.opacity = 0;
        if (shape == ShapeKind::boxes)
            def.look.boxes = {{0, 0, 0, 8, 8, 8, ""}, {0, 8, 4, 16, 16, 4, "other"}, {-4, 0, 0, 20, 99, 3, ""}};
        registry->add_block(def);
    }
    StateId id(const std::string& text) {
        if (!states) states = std::make_unique<StateTable>(registry);
        const StateId out = states->intern(parse_block_state(text).value()).value();
        models.ensure(*states);
        return out;
    }
    u32 table_index(const StateQuad& q) const { return u32(q.bits >> 12 & 2047) | u32(q.bits >> 24 & 255) << 11; }
    ModelQuad quad(const StateQuad& q) const { return models.model_quad(table_index(q)); }
};

// Every kind with values of the properties that Minecraft gives it, and with nonsense.
const std::vector<std::pair<ShapeKind, std::vector<std::string>>> kSamples = {
    {ShapeKind::slab, {"[type=bottom]", "[type=top]"}},
    {ShapeKind::stairs,
     {"[facing=north]", "[facing=east,half=top,shape=inner_left]", "[facing=west,shape=outer_right]",
      "[facing=nowhere]"}},
    {ShapeKind::fence, {"", "[north=true,west=true]", "[east=true,north=true,south=true,west=true]"}},
    {ShapeKind::wall, {"", "[up=false,north=low,south=tall]", "[up=true,east=tall]", "[up=false]"}},
    {ShapeKind::fence_gate, {"", "[open=true,facing=west]", "[in_wall=true,facing=south]"}},
    {ShapeKind::pane, {"", "[north=true]", "[east=true,west=true]", "[east=true,north=true,south=true,west=true]"}},
    {ShapeKind::cross, {""}},
    {ShapeKind::crop, {"[age=0]", "[age=x]"}},
    {ShapeKind::torch, {""}},
    {ShapeKind::wall_torch, {"[facing=north]", "[facing=east]", "[facing=south]", "[facing=west]"}},
    {ShapeKind::door,
     {"", "[facing=east,hinge=right]", "[facing=west,open=true]", "[facing=south,hinge=right,open=true]"}},
    {ShapeKind::trapdoor, {"", "[half=top]", "[open=true,facing=east]"}},
    {ShapeKind::layers, {"[layers=1]", "[layers=7]", "[layers=99]"}},
    {ShapeKind::carpet, {""}},
    {ShapeKind::ladder, {"", "[facing=west]"}},
    {ShapeKind::faces, {"[north=true]", "[down=true,east=true,south=true,up=true,west=true]"}},
    {ShapeKind::rail,
     {"", "[shape=east_west]", "[shape=ascending_north]", "[shape=ascending_west]", "[shape=south_east]"}},
    {ShapeKind::button, {"[face=floor]", "[face=wall,facing=east]", "[face=ceiling,powered=true]"}},
    {ShapeKind::lever, {"[face=floor]", "[face=wall,facing=east]", "[face=ceiling,powered=true]"}},
    {ShapeKind::pressure_plate, {"", "[powered=true]"}},
    {ShapeKind::sign, {"", "[rotation=3]", "[rotation=15]", "[rotation=-7]"}},
    {ShapeKind::wall_sign, {"", "[facing=west]"}},
    {ShapeKind::chest, {"", "[facing=east,type=left]", "[facing=south,type=right]"}},
    {ShapeKind::bed, {"[part=head]", "[facing=west,part=foot]"}},
    {ShapeKind::lantern, {"", "[hanging=true]"}},
    {ShapeKind::chain, {"", "[axis=x]", "[axis=z]"}},
    {ShapeKind::lily_pad, {""}},
    {ShapeKind::boxes, {"", "[facing=up]"}},
};

TEST(BlockModel, EveryShapeIsSound) {
    Blocks b;
    std::set<ShapeKind> seen{ShapeKind::none, ShapeKind::cube, ShapeKind::pillar, ShapeKind::liquid};
    for (const auto& [shape, texts] : kSamples) {
        b.add(kShapeKindNames[std::size_t(shape)], shape, {"a", "b", "c"});
        seen.insert(shape);
    }
    EXPECT_EQ(seen.size(), std::size_t(ShapeKind::count)) << "a kind has no sample here";
    for (const auto& [shape, texts] : kSamples)
        for (const std::string& text : texts) {
            const std::string name = kShapeKindNames[std::size_t(shape)] + text;
            const StateId id = b.id(name);
            if (b.states->flags(id) & kOpaqueCube) continue; // eight layers
            ASSERT_EQ(b.models.kinds()[u32(id)], ModelKind::model) << name;
            const auto quads = b.models.quads(id);
            ASSERT_FALSE(quads.empty()) << name;
            for (const StateQuad& sq : quads) {
                const ModelQuad q = b.quad(sq);
                const auto& c = q.corners;
                const auto edge = [&](u32 i) {
                    return Vec3{float(c[i].x - c[0].x), float(c[i].y - c[0].y), float(c[i].z - c[0].z)};
                };
                const Vec3 normal{float(q.normal[0]) / 127, float(q.normal[1]) / 127, float(q.normal[2]) / 127};
                EXPECT_NEAR(length(normal), 1, 0.02) << name;
                const Vec3 first = cross(edge(1), edge(2)), second = cross(edge(2), edge(3));
                EXPECT_GT(dot(first, normal), 0) << name; // counterclockwise from its front
                EXPECT_GT(dot(second, normal), 0) << name;
                if (sq.cull != StateQuad::kNoCull) {
                    const IVec3 f = kFaceNormal[sq.cull];
                    for (const auto& p : c) {
                        EXPECT_EQ(p.x * f.x + p.y * f.y + p.z * f.z, f.x + f.y + f.z > 0 ? kModelUnit : 0) << name;
                        EXPECT_TRUE(p.x >= 0 && p.x <= 256 && p.y >= 0 && p.y <= 256 && p.z >= 0 && p.z <= 256) << name;
                    }
                }
                if (shape == ShapeKind::boxes) continue;
                for (const auto& p : c)
                    EXPECT_TRUE(std::min({p.x, p.y, p.z}) >= -48 && std::max({p.x, p.y, p.z}) <= 304) << name;
                for (u32 i = 0; i < 4; ++i)
                    EXPECT_TRUE(c[i].s >= -32 && c[i].s <= 288 && q.t[i] >= -32 && q.t[i] <= 288)
                        << name << " " << c[i].s << " " << q.t[i];
            }
        }
}

// Area of a state's quads that look along a face, in blocks.
float area_towards(const Blocks& b, StateId id, Face face) {
    float sum = 0;
    for (const StateQuad& sq : b.models.quads(id)) {
        const ModelQuad q = b.quad(sq);
        const IVec3 f = kFaceNormal[u32(face)];
        if (q.normal[0] != f.x * 127 || q.normal[1] != f.y * 127 || q.normal[2] != f.z * 127) continue;
        const auto& c = q.corners;
        const Vec3 u{float(c[1].x - c[0].x), float(c[1].y - c[0].y), float(c[1].z - c[0].z)};
        const Vec3 v{float(c[3].x - c[0].x), float(c[3].y - c[0].y), float(c[3].z - c[0].z)};
        sum += length(cross(u, v)) / 65536;
    }
    return sum;
}

TEST(BlockModel, StairsHaveTheFacesOfTheirBody) {
    Blocks b;
    b.add("stairs", ShapeKind::stairs, {"planks"});
    for (const char* facing : {"north", "east", "south", "west"})
        for (const char* half : {"bottom", "top"}) {
            const StateId id = b.id(std::string("stairs[facing=") + facing + ",half=" + half + ",shape=straight]");
            // Two steps seen from above, whole from below and behind; three of four quarters from the side.
            EXPECT_FLOAT_EQ(area_towards(b, id, Face::up), 1) << facing << half;
            EXPECT_FLOAT_EQ(area_towards(b, id, Face::down), 1) << facing << half;
            const bool along_x = facing[0] == 'e' || facing[0] == 'w';
            EXPECT_FLOAT_EQ(area_towards(b, id, Face::west), along_x ? 1 : 0.75f) << facing << half;
            EXPECT_FLOAT_EQ(area_towards(b, id, Face::north), along_x ? 0.75f : 1) << facing << half;
        }
    for (const char* shape : {"inner_left", "inner_right"})
        EXPECT_FLOAT_EQ(area_towards(b, b.id(std::string("stairs[facing=north,shape=") + shape + "]"), Face::south), 1);
}

TEST(BlockModel, CubesPackTheirLooks) {
    Blocks b;
    b.add("log", ShapeKind::pillar, {"bark", "rings"});
    b.add("glass", ShapeKind::cube, {"glass"}, RenderLayer::cutout);
    b.add("ice", ShapeKind::cube, {"ice"}, RenderLayer::translucent);
    b.add("slab", ShapeKind::slab, {"planks"});
    const auto texture = [&](const char* name) { return u64(*b.registry->find_texture(name)); };
    const auto faces = b.models.faces(b.id("log[axis=x]"));
    EXPECT_EQ(b.models.kinds()[u32(b.id("log[axis=x]"))], ModelKind::opaque);
    for (u32 f = 0; f < 6; ++f) {
        EXPECT_EQ(faces[f] >> 20 & 7, f);
        EXPECT_EQ(faces[f] >> 32 & 0xffff, texture(f < 2 ? "rings" : "bark"));
        if (f >= 2) {
            EXPECT_EQ(faces[f] >> 62 & 1, 1u) << "bark runs along x";
        }
    }
    EXPECT_EQ(b.models.faces(b.id("log[axis=y]"))[4] >> 62, 0u);
    EXPECT_EQ(b.models.faces(b.id("log[axis=z]"))[0] >> 62 & 1, 1u);
    EXPECT_EQ(b.models.faces(b.id("log[axis=z]"))[3] >> 62 & 1, 0u);
    EXPECT_EQ(b.models.kinds()[u32(b.id("glass"))], ModelKind::cutout);
    EXPECT_EQ(b.models.kinds()[u32(b.id("ice"))], ModelKind::translucent);
    EXPECT_NE(b.models.cull_groups()[u32(b.id("ice"))], b.models.cull_groups()[u32(b.id("glass"))]);
    EXPECT_EQ(b.models.kinds()[u32(StateId::air)], ModelKind::nothing);
    EXPECT_EQ(b.models.kinds()[u32(StateId::hidden)], ModelKind::opaque);
}

TEST(BlockModel, UnknownBlocksDifferByTint) {
    Blocks b;
    std::set<u64> tints;
    for (int i = 0; i < 40; ++i) {
        const StateId id = b.id("mod:thing" + std::to_string(i));
        EXPECT_EQ(b.models.kinds()[u32(id)], ModelKind::opaque);
        EXPECT_EQ(TintKind(b.models.faces(id)[0] >> 48 & 7), TintKind::fixed);
        tints.insert(b.models.faces(id)[0] >> 51 & 255);
    }
    EXPECT_GT(tints.size(), 15u);
    EXPECT_EQ(b.models.fixed_tints()[0], (std::array<u8, 3>{255, 255, 255}));
    // One name, one tint, whatever the properties.
    EXPECT_EQ(b.models.faces(b.id("mod:thing1[a=b]"))[0], b.models.faces(b.id("mod:thing1"))[0]);
}

TEST(BlockModel, LiquidsAndWaterlogging) {
    Blocks b;
    b.add("water", ShapeKind::liquid, {"flow", "still"}, RenderLayer::translucent);
    b.add("lava", ShapeKind::liquid, {"lava"});
    b.add("slab", ShapeKind::slab, {"planks"});
    const LiquidLook* source = b.models.liquid(b.id("water[level=0]"));
    const LiquidLook* low = b.models.liquid(b.id("water[level=7]"));
    const LiquidLook* falling = b.models.liquid(b.id("water[level=9]"));
    const LiquidLook* lava = b.models.liquid(b.id("lava[level=0]"));
    const LiquidLook* logged = b.models.liquid(b.id("slab[type=bottom,waterlogged=true]"));
    ASSERT_TRUE(source && low && falling && lava && logged);
    EXPECT_EQ(source->height, kModelUnit - kLiquidDropUnits);
    EXPECT_LT(low->height, source->height);
    EXPECT_EQ(falling->height, kModelUnit);
    EXPECT_EQ(source->fluid, low->fluid);
    EXPECT_EQ(source->fluid, logged->fluid);
    EXPECT_NE(source->fluid, lava->fluid);
    EXPECT_EQ(source->still, logged->still);
    EXPECT_EQ(b.models.liquid(b.id("slab[type=bottom]")), nullptr);
    EXPECT_EQ(b.models.liquid(StateId::air), nullptr);
}

TEST(BlockModel, EqualGeometryIsStoredOnce) {
    Blocks b;
    b.add("oak_stairs", ShapeKind::stairs, {"oak"});
    b.add("stone_stairs", ShapeKind::stairs, {"stone"});
    const auto first = b.models.quads(b.id("oak_stairs[facing=east]"));
    const u32 count = b.models.model_quad_count();
    const auto second = b.models.quads(b.id("stone_stairs[facing=east]"));
    EXPECT_EQ(b.models.model_quad_count(), count);
    ASSERT_EQ(first.size(), second.size());
    for (std::size_t i = 0; i < first.size(); ++i)
        EXPECT_EQ(b.table_index(first[i]), b.table_index(second[i]));
    EXPECT_EQ(b.models.model_quads(0).size(), count);
    EXPECT_TRUE(b.models.model_quads(count + 5).empty());
    EXPECT_EQ(b.models.intern_quad(b.models.model_quad(0)), 0u);
}

TEST(BlockModel, ReadersNeedNoLockWhileStatesAppear) {
    Blocks b;
    b.add("stairs", ShapeKind::stairs, {"oak"});
    b.id("stone");
    std::atomic<bool> stop{false};
    std::thread reader([&] {
        u64 sum = 0;
        while (!stop)
            for (u32 i = 0; i < b.models.size(); ++i) {
                sum += u64(b.models.kinds()[i]) + b.models.faces(StateId(i))[0];
                for (const StateQuad& q : b.models.quads(StateId(i)))
                    sum += q.bits;
            }
        EXPECT_NE(sum, 1u);
    });
    for (int i = 0; i < 300; ++i)
        b.id("stairs[facing=" + std::string(i % 2 ? "north" : "west") + ",n=" + std::to_string(i) + "]");
    stop = true;
    reader.join();
    EXPECT_EQ(b.models.size(), b.states->size());
}

} // namespace
} // namespace vitrail::scene
