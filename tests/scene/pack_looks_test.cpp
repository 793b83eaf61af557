#include "scene/pack_looks.h"

#include "scene/pack_fixture.h"

#include <cmath>
#include <fmt/format.h>
#include <set>

namespace vitrail::scene {
namespace {

constexpr std::array<u8, 4> kRed{255, 0, 0, 255}, kGray{128, 128, 128, 255};
constexpr std::string_view kCubeAll = R"({"variants": {"": {"model": "block/m"}}})";

// Without a word about it a block takes pictures of its names, with the pack's animation and size.
TEST(PackLooks, PicturesReplaceContentsByName) {
    PackWorld w;
    w.block("stone", ShapeKind::cube, {"stone"});
    w.block("short_grass", ShapeKind::cross, {"short_grass"}, RenderLayer::cutout);
    w.block("dirt", ShapeKind::cube, {"dirt"});
    w.texture("stone", kRed, 64);
    w.texture("grass", kGray); // its name before 1.20.3
    ASSERT_NO_FATAL_FAILURE(w.load());
    EXPECT_TRUE(w.packs->replaces(w.texture_id("stone")));
    EXPECT_TRUE(w.packs->replaces(w.texture_id("short_grass")));
    EXPECT_FALSE(w.packs->replaces(w.texture_id("dirt")));
    EXPECT_EQ(w.packs->largest_side(), 64u);
    EXPECT_EQ(w.packs->art(w.texture_id("stone"))->albedo.at(5, 5)[0], 255);
    EXPECT_EQ(w.kind(w.id("stone")), ModelKind::opaque);
    // Content left it untinted; Minecraft's picture is gray.
    EXPECT_EQ(PackWorld::tint_of(w.models->quads(w.id("short_grass"))[0].bits), TintKind::grass);
    EXPECT_EQ(w.packs->counts().replaced_textures, 2u);
}

TEST(PackLooks, AFullCubeMergesAsBefore) {
    PackWorld w;
    w.block("stone", ShapeKind::cube, {"stone"});
    w.states_of("stone",
                R"({"variants": {"": [{"model": "block/a", "weight": 3}, {"model": "block/b", "weight": 5}]}})");
    w.model("a", R"({"parent": "block/cube_all", "textures": {"all": "block/stone"}})");
    w.model("b", R"({"parent": "block/cube_column", "textures": {"end": "block/top", "side": "block/stone"}})");
    w.texture("stone", kGray), w.texture("top", kRed);
    ASSERT_NO_FATAL_FAILURE(w.load());
    const StateId stone = w.id("stone");
    EXPECT_EQ(w.kind(stone), ModelKind::opaque);
    EXPECT_TRUE(w.models->quads(stone).empty());
    // The heaviest look; the pack's own picture has a layer after content's.
    const TextureId top = PackWorld::texture_of(w.face(stone, Face::up));
    EXPECT_GE(u32(top), w.registry->textures().size());
    EXPECT_EQ(w.packs->art(top)->albedo.at(0, 0)[0], 255);
    EXPECT_EQ(PackWorld::texture_of(w.face(stone, Face::west)), w.texture_id("stone"));
    for (u32 f = 0; f < 6; ++f)
        EXPECT_EQ(w.face(stone, Face(f)) >> 20 & 7, f);
    EXPECT_TRUE(w.packs->missing().empty());
}

// A FaceLook's coordinates at a point of its face (the vertex shader's formula) against those of the quad that was
// baked, for every turn of a block, with and without uvlock, each face with a turned and cut picture.
TEST(PackLooks, FaceLooksShowWhatTheQuadsWould) {
    for (u32 turn = 0; turn < 32; ++turn) {
        PackWorld w;
        w.block("box", ShapeKind::cube, {"box"});
        const u32 x = turn % 4 * 90, y = turn / 4 % 4 * 90;
        const bool lock = turn >= 16;
        w.states_of("box",
                    fmt::format(R"({{"variants": {{"": {{"model": "block/m", "x": {}, "y": {}, "uvlock": {}}}}}}})", x,
                                y, lock));
        std::string faces;
        const char* sides[6] = {"west", "east", "down", "up", "north", "south"};
        for (u32 f = 0; f < 6; ++f) {
            // Cut, mirrored, turned: one of a kind on each face.
            const char* uv = f == 1   ? "[16, 0, 0, 16]"
                             : f == 2 ? "[4, 8, 12, 16]"
                             : f == 3 ? "[0, 16, 16, 0]"
                                      : "[0, 0, 16, 16]";
            faces += fmt::format(
                "{}\"{}\": {{\"texture\": \"block/p{}\", \"uv\": {}, \"rotation\": {}, \"cullface\": \"{}\"}}",
                f ? "," : "", sides[f], f, uv, f * 90, sides[f]);
        }
        w.model(
            "m", R"({"textures": {)" +
                     [] {
                         std::string names;
                         for (u32 f = 0; f < 6; ++f)
                             names += fmt::format("{}\"block/p{}\": \"block/p{}\"", f ? "," : "", f, f);
                         return names;
                     }() +
                     R"(}, "elements": [{"from": [0,0,0], "to": [16,16,16], "faces": {)" + faces + "}}]}");
        for (u32 f = 0; f < 6; ++f) // texels that say where they are
            w.file(fmt::format("textures/block/p{}.png", f), test::png_of(test::picture(16, 16, [&](u32 px, u32 py) {
                       return std::array<u8, 4>{u8(px * 16), u8(py * 16), u8(f), 255};
                   })));
        ASSERT_NO_FATAL_FAILURE(w.load());
        const StateId box = w.id("box");
        ASSERT_EQ(w.kind(box), ModelKind::opaque);
        const BakedModel* baked = w.packs->look(w.states->info(box)).heaviest();
        ASSERT_TRUE(baked && baked->cube) << turn;
        for (const PackQuad& q : baked->quads) {
            const TextureArt* from = w.packs->art(q.texture);
            const FaceLook look = w.face(box, q.facing);
            const TextureArt* shown = w.packs->art(PackWorld::texture_of(look));
            ASSERT_TRUE(from && shown);
            // Corner 0 and the two sides from it span the face.
            const auto& c = q.geometry.corners;
            const auto& t = q.geometry.t;
            for (u32 i = 0; i < 64; ++i) {
                const float a = (float(i % 8) + 0.45f) / 8,
                            b = (float(i / 8) + 0.45f) / 8; // between the borders of texels
                const auto between = [&](float at0, float at1, float at3) {
                    return at0 + (at1 - at0) * a + (at3 - at0) * b;
                };
                const float px = between(c[0].x, c[1].x, c[3].x) / 256, py = between(c[0].y, c[1].y, c[3].y) / 256,
                            pz = between(c[0].z, c[1].z, c[3].z) / 256;
                const float s = between(c[0].s, c[1].s, c[3].s) / 256, tt = between(t[0], t[1], t[3]) / 256;
                const u8* wanted = from->albedo.at(u32(s * 16) & 15, u32(tt * 16) & 15);
                // As terrain.vert.glsl has it.
                const u32 axis = u32(q.facing) >> 1;
                const float side = u32(q.facing) & 1 ? 1.0f : -1.0f;
                const float fs = axis == 0 ? -side * pz : axis == 1 ? px : side * px, ft = axis == 1 ? side * pz : -py;
                const u32 k = PackWorld::turns_of(look);
                float u = k == 0   ? fs
                          : k == 1 ? ft
                          : k == 2 ? -fs
                                   : -ft,
                      v = k == 0   ? ft
                          : k == 1 ? -fs
                          : k == 2 ? -ft
                                   : fs;
                u -= std::floor(u), v -= std::floor(v);
                const u32 n = shown->side();
                const u8* got = shown->albedo.at(u32(u * float(n)), u32(v * float(n)));
                ASSERT_TRUE(got[0] == wanted[0] && got[1] == wanted[1] && got[2] == wanted[2])
                    << "x " << x << " y " << y << " lock " << lock << " face " << u32(q.facing) << " texel " << i;
            }
        }
    }
}

// Facts of the format: y turns north to east, x turns up over north; locked pictures stay with the world.
TEST(PackLooks, BlocksTurnAsInMinecraft) {
    PackWorld w;
    w.block("box", ShapeKind::cube, {"box"});
    w.states_of("box",
                R"({"variants": {"facing=a": {"model": "block/m", "y": 90}, "facing=b": {"model": "block/m", "x": 90},
        "facing=c": {"model": "block/m", "x": 90, "y": 90}, "facing=d": {"model": "block/m", "y": 90, "uvlock": true}}})");
    w.model(
        "m",
        R"({"parent": "block/cube", "textures": {"west": "block/t0", "east": "block/t1", "down": "block/t2", "up": "block/t3", "north": "block/t4", "south": "block/t5"}})");
    for (u32 f = 0; f < 6; ++f)
        w.texture(fmt::format("t{}", f), {u8(f), 0, 0, 255});
    ASSERT_NO_FATAL_FAILURE(w.load());
    const auto shows = [&](const char* facing, Face f) {
        return Face(w.packs->art(PackWorld::texture_of(w.face(w.id(fmt::format("box[facing={}]", facing)), f)))
                        ->albedo.at(0, 0)[0]);
    };
    EXPECT_EQ(shows("a", Face::east), Face::north);
    EXPECT_EQ(shows("a", Face::south), Face::east);
    EXPECT_EQ(shows("a", Face::up), Face::up);
    EXPECT_EQ(shows("b", Face::north), Face::up);
    EXPECT_EQ(shows("b", Face::down), Face::north);
    EXPECT_EQ(shows("b", Face::west), Face::west);
    EXPECT_EQ(shows("c", Face::east), Face::up); // a log along x
    EXPECT_EQ(PackWorld::turns_of(w.face(w.id("box[facing=a]"), Face::up)),
              1u); // its north went to the east: clockwise
    EXPECT_EQ(PackWorld::turns_of(w.face(w.id("box[facing=d]"), Face::up)), 0u);
}

TEST(PackLooks, AnOverlayIsLaidIntoThePictureWithItsTint) {
    PackWorld w;
    w.block("grass_block", ShapeKind::cube, {"grass_block_side", "grass_block_top", "dirt"});
    w.states_of("grass_block", R"({"variants": {"snowy=false": {"model": "block/grass_block"}}})");
    w.texture("dirt", {100, 50, 25, 255}), w.texture("grass_block_side", {100, 50, 25, 255}),
        w.texture("grass_block_top", kGray);
    w.file("textures/block/grass_block_side_overlay.png", test::png_of(test::picture(16, 16, [](u32, u32 y) {
               return std::array<u8, 4>{200, 200, 200, y < 4 ? u8(255) : y == 4 ? u8(128) : u8(0)};
           })));
    ASSERT_NO_FATAL_FAILURE(w.load());
    const StateId grass = w.id("grass_block[snowy=false]");
    ASSERT_EQ(w.kind(grass), ModelKind::opaque);
    EXPECT_TRUE(w.models->quads(grass).empty());
    EXPECT_EQ(PackWorld::tint_of(w.face(grass, Face::up)), TintKind::grass);
    EXPECT_EQ(PackWorld::tint_of(w.face(grass, Face::down)), TintKind::none);
    const FaceLook side = w.face(grass, Face::north);
    EXPECT_EQ(PackWorld::tint_of(side), TintKind::grass);
    const TextureArt* art = w.packs->art(PackWorld::texture_of(side));
    ASSERT_TRUE(art && art->tint_mask);
    EXPECT_EQ(std::vector<u8>(art->albedo.at(3, 0), art->albedo.at(3, 0) + 4), (std::vector<u8>{200, 200, 200, 255}));
    EXPECT_EQ(std::vector<u8>(art->albedo.at(3, 9), art->albedo.at(3, 9) + 4), (std::vector<u8>{100, 50, 25, 0}));
    EXPECT_EQ(art->albedo.at(3, 4)[3], 128);
    EXPECT_NEAR(art->albedo.at(3, 4)[0], 150, 1);
    // One picture for the four sides.
    EXPECT_EQ(w.packs->counts().made_textures, 1u);
}

// Whatever a pack says, what hides on the server hides here, and what does not hide there does not here.
TEST(PackLooks, WhatHidesIsContentsToSay) {
    PackWorld w;
    for (const char* name : {"stone", "holes", "post"})
        w.block(name, ShapeKind::cube, {name});
    w.block("leaves", ShapeKind::cube, {"leaves"}, RenderLayer::cutout_mipped).material = "leaves";
    w.block("glass", ShapeKind::cube, {"glass"}, RenderLayer::translucent);
    w.block("flower", ShapeKind::cross, {"flower"}, RenderLayer::cutout);
    w.states_of("stone", R"({"variants": {"": {"model": "block/tufts"}}})"), w.states_of("holes", kCubeAll);
    w.states_of("post", R"({"variants": {"": {"model": "block/fence_post"}}})");
    for (const char* name : {"leaves", "glass", "flower"})
        w.states_of(name, kCubeAll);
    w.model("m", R"({"parent": "block/cube_all", "textures": {"all": "block/leaves"}})");
    w.model("tufts", R"({"textures": {"t": "block/stone"}, "elements": [
        {"from": [0,0,0], "to": [16,16,16], "faces": {"up": {"texture": "#t"}, "down": {"texture": "#t"}, "north": {"texture": "#t"}, "south": {"texture": "#t"}, "west": {"texture": "#t"}, "east": {"texture": "#t"}}},
        {"from": [4,4,4], "to": [12,12,12], "faces": {"up": {"texture": "#t"}}},
        {"from": [0,16,8], "to": [16,20,8], "faces": {"north": {"texture": "#t"}, "south": {"texture": "#t"}}}]})");
    w.texture("stone", kGray), w.texture("post", kGray), w.texture("glass", {200, 200, 255, 90});
    w.file("textures/block/leaves.png", test::png_of(test::picture(16, 16, [](u32 x, u32 y) {
               return std::array<u8, 4>{90, 90, 90, u8((x + y) % 2 ? 255 : 0)};
           })));
    ASSERT_NO_FATAL_FAILURE(w.load());
    const StateId stone = w.id("stone"), holes = w.id("holes"), post = w.id("post"), leaves = w.id("leaves");
    EXPECT_EQ(w.kind(stone), ModelKind::detailed);
    EXPECT_EQ(w.models->quads(stone).size(), 2u); // what stands out of the top, not what is inside
    EXPECT_EQ(w.kind(holes), ModelKind::opaque);
    EXPECT_EQ(w.kind(post), ModelKind::opaque); // a post by the pack, a cube all the same
    EXPECT_EQ(PackWorld::texture_of(w.face(post, Face::north)), w.texture_id("post"));
    EXPECT_EQ(w.kind(leaves), ModelKind::cutout);
    EXPECT_EQ(w.models->cull_groups()[u32(leaves)], 1);
    EXPECT_EQ(w.kind(w.id("glass")), ModelKind::cutout); // its picture has holes, nothing between
    EXPECT_EQ(w.kind(w.id("flower")), ModelKind::model);
    EXPECT_EQ(w.models->quads(w.id("flower")).size(), 6u);
    EXPECT_EQ(w.models->quads(w.id("flower"))[0].pass, ModelPass::cutout);
    for (const char* name : {"stone", "holes", "post", "leaves", "glass", "flower"}) {
        const StateId id = w.id(name);
        EXPECT_EQ(hides(w.kind(id)), (w.states->flags(id) & kOpaqueCube) != 0) << name;
    }
}

TEST(PackLooks, ModelsAreChosenByWeightAndPosition) {
    PackWorld w;
    w.block("flower", ShapeKind::cross, {"flower"}, RenderLayer::cutout);
    w.states_of(
        "flower",
        R"({"variants": {"": [{"model": "block/one"}, {"model": "block/nowhere", "weight": 2}, {"model": "block/two", "weight": 5}]}})");
    w.model("one", R"({"parent": "block/cross", "textures": {"cross": "block/flower"}})");
    w.model("two", R"({"parent": "block/crop", "textures": {"crop": "block/flower"}})");
    w.texture("flower", kRed);
    ASSERT_NO_FATAL_FAILURE(w.load());
    const StateId flower = w.id("flower");
    EXPECT_EQ(w.models->quads(flower).size(), 8u); // the likeliest: a crop
    std::map<std::size_t, u32> seen;
    for (u64 i = 0; i < 8000; ++i) {
        const auto quads = w.models->quads(flower, u32((i << 32) / 8000));
        ASSERT_FALSE(quads.empty());
        // Content's own cross has two-sided quads, a pack's has four.
        ++seen[quads.size()];
    }
    EXPECT_NEAR(seen[8], 5000, 2);
    EXPECT_NEAR(seen[2], 2000, 2);
    EXPECT_NEAR(seen[4], 1000, 2);
    EXPECT_FALSE(w.models->quads(flower, ~0u).empty());
}

TEST(PackLooks, PartsOfWallsAndFences) {
    PackWorld w;
    w.block("wall", ShapeKind::wall, {"stone"});
    w.states_of("wall", R"({"multipart": [{"when": {"up": "true"}, "apply": {"model": "block/post"}},
        {"when": {"north": "true"}, "apply": {"model": "block/side", "uvlock": true}},
        {"when": {"OR": [{"east": "low"}, {"west": "tall"}]}, "apply": {"model": "block/side", "y": 90, "uvlock": true}}]})");
    w.model("post", R"({"parent": "block/template_wall_post", "textures": {"wall": "block/stone"}})");
    w.model("side", R"({"parent": "block/template_wall_side", "textures": {"wall": "block/stone"}})");
    w.texture("stone", kGray);
    ASSERT_NO_FATAL_FAILURE(w.load());
    EXPECT_EQ(w.models->quads(w.id("wall[up=true,north=none,east=none,west=none]")).size(), 6u);
    EXPECT_EQ(w.models->quads(w.id("wall[up=true,north=low,east=none,west=none]")).size(),
              12u); // low is true to older packs
    EXPECT_EQ(w.models->quads(w.id("wall[up=false,north=tall,east=low,west=tall]")).size(), 12u);
    const auto side = w.models->quads(w.id("wall[up=false,north=none,east=low,west=none]"));
    ASSERT_EQ(side.size(), 6u);
    i32 most = 0;
    for (const StateQuad& q : side)
        for (const auto& c : w.quad(q).corners)
            most = std::max<i32>(most, c.x);
    EXPECT_EQ(most, 256); // turned to the east
}

TEST(PackLooks, TurnedElementsLieWhereMinecraftHasThem) {
    PackWorld w;
    w.block("flower", ShapeKind::cross, {"flower"}, RenderLayer::cutout);
    w.states_of("flower", kCubeAll);
    w.model("m", R"({"parent": "block/cross", "textures": {"cross": "block/flower"}})");
    w.texture("flower", {0, 255, 0, 0});
    ASSERT_NO_FATAL_FAILURE(w.load());
    const auto quads = w.models->quads(w.id("flower"));
    ASSERT_EQ(quads.size(), 4u);
    std::set<std::array<i32, 2>> ends;
    for (const StateQuad& q : quads) {
        const ModelQuad m = w.quad(q);
        EXPECT_EQ(q.cull, StateQuad::kNoCull);
        EXPECT_EQ(m.flags, ModelQuad::kUnshaded);
        EXPECT_NEAR(std::abs(m.normal[0]), 90, 1);
        EXPECT_NEAR(std::abs(m.normal[2]), 90, 1);
        for (const auto& c : m.corners)
            ends.insert({c.x, c.z});
    }
    // 14.4 wide, turned by 45 degrees and scaled by sqrt 2: the cell's corners less 0.8.
    EXPECT_EQ(ends, (std::set<std::array<i32, 2>>{{13, 13}, {13, 243}, {243, 13}, {243, 243}}));
}

TEST(PackLooks, WhatIsBrokenIsToldAndContentStands) {
    PackWorld w;
    for (const char* name : {"a", "b", "c", "d", "e", "f"})
        w.block(name, ShapeKind::cube, {name});
    w.states_of("a", "{ this is no JSON"), w.states_of("b", R"({"variants": {"": {"model": "block/circle"}}})");
    w.states_of("c", R"({"variants": {"": {"model": "block/unnamed"}}})"),
        w.states_of("d", R"({"variants": {"": {"model": "block/lost"}}})");
    w.model("circle", R"({"parent": "block/circle"})");
    w.model("unnamed", R"({"parent": "block/cube_all", "textures": {"all": "#nothing"}})");
    w.model("lost", R"({"parent": "block/cube_all", "textures": {"all": "block/nowhere"}})");
    w.file("textures/block/e.png", "this is no PNG");
    w.texture("f", kRed);
    w.file("textures/block/f.png.mcmeta", "[[[");
    ASSERT_NO_FATAL_FAILURE(w.load());
    for (const char* name : {"a", "b", "e"}) {
        const StateId id = w.id(name);
        EXPECT_EQ(w.kind(id), ModelKind::opaque);
        EXPECT_EQ(PackWorld::texture_of(w.face(id, Face::up)), w.texture_id(name)) << name;
    }
    EXPECT_EQ(PackWorld::texture_of(w.face(w.id("d"), Face::up)), TextureId::unknown);
    EXPECT_EQ(w.packs->missing(),
              (std::vector<std::string>{"#nothing of minecraft:block/unnamed", "minecraft:block/nowhere"}));
    EXPECT_EQ(w.packs->report().problems, 4u); // a, circle, e, f's animation
    for (const std::string& line : w.packs->report().lines)
        EXPECT_FALSE(line.empty());
    EXPECT_TRUE(w.packs->replaces(w.texture_id("f")));
}

TEST(PackLooks, BoundsHold) {
    PackWorld w;
    w.block("a", ShapeKind::cube, {"a"});
    w.block("b", ShapeKind::cube, {"b"});
    w.states_of("a", R"({"variants": {"": {"model": "block/ma"}}})"),
        w.states_of("b", R"({"variants": {"": {"model": "block/mb"}}})");
    for (const char* name : {"a", "b"})
        w.model(std::string("m") + name,
                fmt::format(R"({{"parent": "block/cube_all", "textures": {{"all": "block/own_{}"}}}})", name));
    w.texture("own_a", kRed), w.texture("own_b", kRed), w.texture("a", kGray, 512);
    PackLimits limits;
    limits.textures_most = u32(w.registry->textures().size()) + 1;
    limits.art.side_most = 64;
    ASSERT_NO_FATAL_FAILURE(w.load(limits));
    EXPECT_EQ(w.packs->texture_count(), limits.textures_most);
    EXPECT_EQ(w.packs->largest_side(), 64u);
    EXPECT_EQ(w.packs->report().problems, 1u);
    EXPECT_EQ(PackWorld::texture_of(w.face(w.id("b"), Face::up)), TextureId::unknown);

    PackWorld small;
    small.block("a", ShapeKind::cube, {"a"});
    small.texture("a", kGray, 64);
    limits.art_bytes_most = 1000;
    ASSERT_NO_FATAL_FAILURE(small.load(limits));
    EXPECT_FALSE(small.packs->replaces(small.texture_id("a")));
    EXPECT_EQ(small.packs->report().problems, 1u);
}

} // namespace
} // namespace vitrail::scene
