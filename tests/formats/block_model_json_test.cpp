#include "formats/block_model_json.h"

#include "formats/json_bounds.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace vitrail {

namespace {

ByteView view(std::string_view text) {
    return {reinterpret_cast<const u8*>(text.data()), text.size()};
}

ModelLibrary library(std::map<std::string, std::string> files) {
    return ModelLibrary([files = std::move(files)](const std::string& name) -> std::optional<Bytes> {
        const auto it = files.find(name);
        if (it == files.end()) return std::nullopt;
        return Bytes(it->second.begin(), it->second.end());
    });
}

} // namespace

TEST(BlockModelJson, ReadsWhatAnElementSays) {
    const auto model = parse_block_model(view(R"({ "parent": "block/p", "ambientocclusion": false, // a remark
        "textures": {"a": "block/x", "b": {"sprite": "mod:y"}},
        "elements": [{"from": [0, -99, 1.5], "to": [16, 8, 99], "shade": false,
            "rotation": {"origin": [1, 2, 3], "axis": "z", "angle": -22.5, "rescale": true},
            "faces": {"up": {"texture": "#a", "uv": [1, 2, 3, 4], "rotation": 270, "cullface": "bottom", "tintindex": 3},
                      "sideways": {}, "west": {"texture": "#b"}}}]})"));
    ASSERT_TRUE(model) << model.error().message;
    EXPECT_EQ(model->parent, "minecraft:block/p");
    EXPECT_EQ(model->ambient_occlusion, false);
    EXPECT_EQ(model->textures.at("b"), "mod:y");
    const ModelElementJson& e = model->elements->at(0);
    EXPECT_EQ(e.from, (std::array<float, 3>{0, -16, 1.5f}));
    EXPECT_EQ(e.to, (std::array<float, 3>{16, 8, 32}));
    EXPECT_FALSE(e.shade);
    EXPECT_EQ(e.rotation->axis, 2);
    EXPECT_EQ(e.rotation->degrees, -22.5f);
    EXPECT_TRUE(e.rotation->rescale);
    ASSERT_TRUE(e.faces[3]);
    EXPECT_EQ(*e.faces[3]->uv, (std::array<float, 4>{1, 2, 3, 4}));
    EXPECT_EQ(e.faces[3]->turns, 3);
    EXPECT_EQ(e.faces[3]->cull, 2);
    EXPECT_EQ(e.faces[3]->tint, 3);
    EXPECT_EQ(e.faces[0]->cull, 6);
    EXPECT_EQ(e.faces[0]->tint, -1);
    EXPECT_FALSE(e.faces[5]);
}

TEST(BlockModelJson, BlockstatesInAllTheirForms) {
    const auto plain = parse_blockstates(view(R"({"variants": {"": {"model": "block/a"},
        "facing=east,half=top": [{"model": "block/b", "x": 90, "y": 450, "uvlock": true, "weight": 7}, {"model": "m:c", "y": -90}]}})"));
    ASSERT_TRUE(plain) << plain.error().message;
    EXPECT_FALSE(plain->multipart);
    ASSERT_EQ(plain->cases.size(), 2u);
    EXPECT_TRUE(plain->cases[0].when.empty());
    const auto& second = plain->cases[1];
    ASSERT_EQ(second.when.size(), 1u);
    EXPECT_EQ(second.when[0][1].property, "half");
    EXPECT_EQ(second.when[0][1].values, std::vector<std::string>{"top"});
    EXPECT_EQ(second.apply[0].y, 90);
    EXPECT_EQ(second.apply[0].weight, 7u);
    EXPECT_TRUE(second.apply[0].uv_lock);
    EXPECT_EQ(second.apply[1].y, 270);
    EXPECT_EQ(second.apply[1].model, "m:c");

    const auto parts = parse_blockstates(view(R"({"multipart": [{"apply": {"model": "block/post"}},
        {"when": {"north": "low|tall", "up": "!true"}, "apply": {"model": "block/side"}},
        {"when": {"OR": [{"a": "1"}, {"AND": [{"b": true}, {"OR": [{"c": 2}, {"d": "x"}]}]}]}, "apply": {"model": "block/odd"}}]})"));
    ASSERT_TRUE(parts) << parts.error().message;
    EXPECT_TRUE(parts->multipart);
    EXPECT_TRUE(parts->cases[0].when.empty());
    EXPECT_EQ(parts->cases[1].when[0][0].values, (std::vector<std::string>{"low", "tall"}));
    EXPECT_TRUE(parts->cases[1].when[0][1].negated);
    ASSERT_EQ(parts->cases[2].when.size(), 3u); // a; b and c; b and d
    EXPECT_EQ(parts->cases[2].when[1].size(), 2u);
    EXPECT_EQ(parts->cases[2].when[1][0].values[0], "true");
}

TEST(BlockModelJson, WhatIsWrongIsAnErrorInWords) {
    for (const char* bad : {"", "[]", "{", R"({"elements": 3})", R"({"elements": [{"from": [0,0], "to": [1,1,1]}]})",
                            R"({"elements": [{"from": [0,0,"x"], "to": [1,1,1]}]})",
                            R"({"parent": "../../etc/passwd"})", R"({"textures": {"a": 3}})",
                            R"({"elements": [{"from": [0,0,0], "to": [1,1,1], "faces": {"up": {"uv": [1,2]}}}]})"}) {
        const auto model = parse_block_model(view(bad));
        EXPECT_FALSE(model) << bad;
        if (!model) EXPECT_FALSE(model.error().message.empty());
    }
    for (const char* bad :
         {"{}", R"({"variants": []})", R"({"variants": {"": []}})", R"({"variants": {"": {"x": 90}}})",
          R"({"multipart": {}})", R"({"multipart": [{"when": {"a": "b"}}]})",
          R"({"multipart": [{"when": 3, "apply": {"model": "a"}}]})"})
        EXPECT_FALSE(parse_blockstates(view(bad))) << bad;
    EXPECT_EQ(parse_block_model(view(std::string(100000, '['))).error().code, ErrorCode::limit);
    // A condition that would multiply out to millions.
    std::string ors = R"({"OR": [{"a":"1"},{"b":"1"},{"c":"1"},{"d":"1"},{"e":"1"},{"f":"1"},{"g":"1"},{"h":"1"}]})";
    std::string all = ors;
    for (int i = 0; i < 8; ++i)
        all += "," + ors;
    EXPECT_EQ(
        parse_blockstates(view(R"({"multipart": [{"when": {"AND": [)" + all + R"(]}, "apply": {"model": "a"}}]})"))
            .error()
            .code,
        ErrorCode::limit);
}

TEST(ModelLibrary, ChildrenCoverTheirParents) {
    ModelLibrary models = library({
        {"minecraft:block/box", R"({"ambientocclusion": false, "textures": {"side": "#all", "all": "block/parent"},
            "elements": [{"from": [0,0,0], "to": [16,16,16], "faces": {"up": {"texture": "#side"}, "down": {"texture": "#lost"}, "north": {"texture": "all"}}}]})"},
        {"minecraft:block/child", R"({"parent": "block/box", "textures": {"all": "mod:child"}})"},
        {"minecraft:block/stone2", R"({"parent": "block/cube_all", "textures": {"all": "block/stone"}})"},
    });
    const auto child = models.resolve("minecraft:block/child");
    ASSERT_TRUE(child) << child.error().message;
    EXPECT_FALSE((*child)->ambient_occlusion);
    ASSERT_EQ((*child)->elements.size(), 1u);
    EXPECT_EQ((*child)->elements[0].faces[3]->texture, "mod:child");
    EXPECT_EQ((*child)->elements[0].faces[4]->texture, "mod:child");
    EXPECT_EQ((*child)->elements[0].faces[2]->texture, "");
    EXPECT_EQ((*child)->missing, std::vector<std::string>{"#lost"});
    const auto stone = models.resolve("minecraft:block/stone2"); // by a parent that no pack holds
    ASSERT_TRUE(stone) << stone.error().message;
    for (const auto& face : (*stone)->elements.at(0).faces)
        EXPECT_EQ(face->texture, "minecraft:block/stone");
}

TEST(ModelLibrary, CirclesEnd) {
    ModelLibrary models = library(
        {{"m:a", R"({"parent": "m:b"})"},
         {"m:b", R"({"parent": "m:a"})"},
         {"m:self", R"({"parent": "m:self"})"},
         {"m:orphan", R"({"parent": "m:none"})"},
         {"m:keys",
          R"({"textures": {"x": "#y", "y": "#x"}, "elements": [{"from": [0,0,0], "to": [1,1,1], "faces": {"up": {"texture": "#x"}}}]})"}});
    EXPECT_EQ(models.resolve("m:a").error().code, ErrorCode::limit);
    EXPECT_EQ(models.resolve("m:self").error().code, ErrorCode::limit);
    const auto orphan = models.resolve("m:orphan");
    EXPECT_EQ(orphan.error().code, ErrorCode::not_found);
    EXPECT_NE(orphan.error().message.find("m:none"), std::string::npos);
    const auto keys = models.resolve("m:keys");
    ASSERT_TRUE(keys);
    EXPECT_EQ((*keys)->missing.size(), 1u);
}

// Every built-in parent parses, resolves, and lies in its block.
TEST(ModelLibrary, BuiltinsAreSound) {
    ModelLibrary models = library({});
    for (const char* name : {"cube",
                             "cube_all",
                             "cube_mirrored",
                             "cube_mirrored_all",
                             "cube_column",
                             "cube_column_horizontal",
                             "cube_top",
                             "cube_bottom_top",
                             "orientable",
                             "orientable_with_bottom",
                             "leaves",
                             "grass_block",
                             "cross",
                             "tinted_cross",
                             "crop",
                             "slab",
                             "slab_top",
                             "stairs",
                             "inner_stairs",
                             "outer_stairs",
                             "carpet",
                             "fence_post",
                             "fence_side",
                             "template_wall_post",
                             "template_wall_side",
                             "template_wall_side_tall",
                             "pressure_plate_up",
                             "pressure_plate_down"}) {
        const auto model = models.resolve(fmt::format("minecraft:block/{}", name));
        ASSERT_TRUE(model) << name << ": " << model.error().message;
        std::size_t faces = 0;
        for (const auto& element : (*model)->elements) {
            for (u32 axis = 0; axis < 3; ++axis)
                EXPECT_LE(element.from[axis], element.to[axis]) << name;
            for (const auto& face : element.faces)
                faces += face.has_value();
        }
        EXPECT_GE(faces, 4u) << name;
    }
    EXPECT_TRUE(builtin_block_model("minecraft:block/diamond_hoe").empty());
}

} // namespace vitrail
