// The parents that packs lean on without holding them. Only what packs commonly name as a parent of their own models is here;
// for blocks a pack says nothing of, content's own shapes stand (scene/pack_looks.h).
#include "formats/block_model_json.h"

namespace vitrail {

namespace {

struct Builtin {
    std::string_view name, text;
};

#define VX_ALL6(t)                                                                                                     \
    R"("down":{"texture":")" t R"("},"up":{"texture":")" t R"("},"north":{"texture":")" t R"("},"south":{"texture":")" t \
    R"("},"west":{"texture":")" t R"("},"east":{"texture":")" t R"("})"

// Faces on the cell's border are culled; c3 is the cube's list.
#define VX_CUBE_FACES                                                                                                  \
    R"("down":{"texture":"#down","cullface":"down"},"up":{"texture":"#up","cullface":"up"},)"                          \
    R"("north":{"texture":"#north","cullface":"north"},"south":{"texture":"#south","cullface":"south"},)"              \
    R"("west":{"texture":"#west","cullface":"west"},"east":{"texture":"#east","cullface":"east"})"

// Bottom, top and sides of a slab or stair; which faces are culled follows from where the box lies.
#define VX_SLAB_FACES(down, up)                                                                                        \
    R"("down":{"texture":"#bottom")" down R"(},"up":{"texture":"#top")" up                                             \
    R"(},"north":{"texture":"#side","cullface":"north"},"south":{"texture":"#side","cullface":"south"},)"              \
    R"("west":{"texture":"#side","cullface":"west"},"east":{"texture":"#side","cullface":"east"})"
#define VX_STAIR_BASE                                                                                                  \
    R"({"from":[0,0,0],"to":[16,8,16],"faces":{)" VX_SLAB_FACES(R"(,"cullface":"down")", "") "}}"

#define VX_CROSS_PLANE(from, to, a, b, tint)                                                                           \
    R"({"from":)" from R"(,"to":)" to                                                                                  \
    R"(,"rotation":{"origin":[8,8,8],"axis":"y","angle":45,"rescale":true},"shade":false,"faces":{")" a                \
    R"(":{"uv":[0,0,16,16],"texture":"#cross")" tint R"(},")" b R"(":{"uv":[0,0,16,16],"texture":"#cross")" tint "}}}"
#define VX_CROSS(tint)                                                                                                 \
    R"({"ambientocclusion":false,"elements":[)" VX_CROSS_PLANE("[0.8,0,8]", "[15.2,16,8]", "north", "south", tint) "," \
    VX_CROSS_PLANE("[8,0,0.8]", "[8,16,15.2]", "west", "east", tint) "]}"

#define VX_CROP_PLANE(from, to, a, b)                                                                                  \
    R"({"from":)" from R"(,"to":)" to R"(,"shade":false,"faces":{")" a R"(":{"uv":[0,0,16,16],"texture":"#crop"},")" b \
    R"(":{"uv":[0,0,16,16],"texture":"#crop"}}})"

constexpr std::string_view kEmpty = "{}";

constexpr Builtin kBuiltins[] = {
    {"minecraft:block/block", kEmpty},
    {"minecraft:block/thin_block", kEmpty},
    {"minecraft:block/air", kEmpty},
    {"minecraft:block/cube",
     R"({"elements":[{"from":[0,0,0],"to":[16,16,16],"faces":{)" VX_CUBE_FACES "}}]}"},
    {"minecraft:block/cube_all",
     R"({"parent":"block/cube","textures":{"down":"#all","up":"#all","north":"#all","south":"#all","west":"#all","east":"#all"}})"},
    {"minecraft:block/cube_mirrored",
     R"({"elements":[{"from":[0,0,0],"to":[16,16,16],"faces":{"down":{"uv":[16,0,0,16],"texture":"#down","cullface":"down"},)"
     R"("up":{"uv":[16,0,0,16],"texture":"#up","cullface":"up"},"north":{"uv":[16,0,0,16],"texture":"#north","cullface":"north"},)"
     R"("south":{"uv":[16,0,0,16],"texture":"#south","cullface":"south"},"west":{"uv":[16,0,0,16],"texture":"#west","cullface":"west"},)"
     R"("east":{"uv":[16,0,0,16],"texture":"#east","cullface":"east"}}}]})"},
    {"minecraft:block/cube_mirrored_all",
     R"({"parent":"block/cube_mirrored","textures":{"down":"#all","up":"#all","north":"#all","south":"#all","west":"#all","east":"#all"}})"},
    {"minecraft:block/cube_column",
     R"({"parent":"block/cube","textures":{"down":"#end","up":"#end","north":"#side","south":"#side","west":"#side","east":"#side"}})"},
    {"minecraft:block/cube_column_horizontal",
     R"({"elements":[{"from":[0,0,0],"to":[16,16,16],"faces":{"down":{"texture":"#end","cullface":"down"},)"
     R"("up":{"texture":"#end","rotation":180,"cullface":"up"},"north":{"texture":"#side","cullface":"north"},)"
     R"("south":{"texture":"#side","cullface":"south"},"west":{"texture":"#side","cullface":"west"},)"
     R"("east":{"texture":"#side","cullface":"east"}}}]})"},
    {"minecraft:block/cube_top",
     R"({"parent":"block/cube","textures":{"down":"#side","up":"#top","north":"#side","south":"#side","west":"#side","east":"#side"}})"},
    {"minecraft:block/cube_bottom_top",
     R"({"parent":"block/cube","textures":{"down":"#bottom","up":"#top","north":"#side","south":"#side","west":"#side","east":"#side"}})"},
    {"minecraft:block/orientable",
     R"({"parent":"block/orientable_with_bottom","textures":{"bottom":"#top"}})"},
    {"minecraft:block/orientable_with_bottom",
     R"({"parent":"block/cube","textures":{"down":"#bottom","up":"#top","north":"#front","south":"#side","west":"#side","east":"#side"}})"},
    {"minecraft:block/leaves",
     R"({"elements":[{"from":[0,0,0],"to":[16,16,16],"faces":{"down":{"texture":"#all","tintindex":0,"cullface":"down"},)"
     R"("up":{"texture":"#all","tintindex":0,"cullface":"up"},"north":{"texture":"#all","tintindex":0,"cullface":"north"},)"
     R"("south":{"texture":"#all","tintindex":0,"cullface":"south"},"west":{"texture":"#all","tintindex":0,"cullface":"west"},)"
     R"("east":{"texture":"#all","tintindex":0,"cullface":"east"}}}]})"},
    {"minecraft:block/grass_block",
     R"({"textures":{"bottom":"block/dirt","top":"block/grass_block_top","side":"block/grass_block_side",)"
     R"("overlay":"block/grass_block_side_overlay"},"elements":[{"from":[0,0,0],"to":[16,16,16],"faces":{)"
     R"("down":{"texture":"#bottom","cullface":"down"},"up":{"texture":"#top","cullface":"up","tintindex":0},)"
     R"("north":{"texture":"#side","cullface":"north"},"south":{"texture":"#side","cullface":"south"},)"
     R"("west":{"texture":"#side","cullface":"west"},"east":{"texture":"#side","cullface":"east"}}},)"
     R"({"from":[0,0,0],"to":[16,16,16],"faces":{"north":{"texture":"#overlay","tintindex":0,"cullface":"north"},)"
     R"("south":{"texture":"#overlay","tintindex":0,"cullface":"south"},"west":{"texture":"#overlay","tintindex":0,"cullface":"west"},)"
     R"("east":{"texture":"#overlay","tintindex":0,"cullface":"east"}}}]})"},
    {"minecraft:block/cross", VX_CROSS("")},
    {"minecraft:block/tinted_cross", VX_CROSS(R"(,"tintindex":0)")},
    {"minecraft:block/crop",
     R"({"ambientocclusion":false,"elements":[)" VX_CROP_PLANE("[4,-1,0]", "[4,15,16]", "west", "east") ","
     VX_CROP_PLANE("[12,-1,0]", "[12,15,16]", "west", "east") "," VX_CROP_PLANE("[0,-1,4]", "[16,15,4]", "north", "south") ","
     VX_CROP_PLANE("[0,-1,12]", "[16,15,12]", "north", "south") "]}"},
    {"minecraft:block/slab",
     R"({"elements":[{"from":[0,0,0],"to":[16,8,16],"faces":{)" VX_SLAB_FACES(R"(,"cullface":"down")", "") "}}]}"},
    {"minecraft:block/slab_top",
     R"({"elements":[{"from":[0,8,0],"to":[16,16,16],"faces":{)" VX_SLAB_FACES("", R"(,"cullface":"up")") "}}]}"},
    {"minecraft:block/half_slab", R"({"parent":"block/slab"})"},
    {"minecraft:block/upper_slab", R"({"parent":"block/slab_top"})"},
    {"minecraft:block/stairs",
     R"({"elements":[)" VX_STAIR_BASE R"(,{"from":[8,8,0],"to":[16,16,16],"faces":{"up":{"texture":"#top","cullface":"up"},)"
     R"("north":{"texture":"#side","cullface":"north"},"south":{"texture":"#side","cullface":"south"},)"
     R"("west":{"texture":"#side"},"east":{"texture":"#side","cullface":"east"}}}]})"},
    {"minecraft:block/outer_stairs",
     R"({"elements":[)" VX_STAIR_BASE R"(,{"from":[8,8,8],"to":[16,16,16],"faces":{"up":{"texture":"#top","cullface":"up"},)"
     R"("north":{"texture":"#side"},"south":{"texture":"#side","cullface":"south"},)"
     R"("west":{"texture":"#side"},"east":{"texture":"#side","cullface":"east"}}}]})"},
    {"minecraft:block/inner_stairs",
     R"({"elements":[)" VX_STAIR_BASE R"(,{"from":[8,8,0],"to":[16,16,16],"faces":{"up":{"texture":"#top","cullface":"up"},)"
     R"("north":{"texture":"#side","cullface":"north"},"south":{"texture":"#side","cullface":"south"},)"
     R"("west":{"texture":"#side"},"east":{"texture":"#side","cullface":"east"}}},)"
     R"({"from":[0,8,8],"to":[8,16,16],"faces":{"up":{"texture":"#top","cullface":"up"},"north":{"texture":"#side"},)"
     R"("south":{"texture":"#side","cullface":"south"},"west":{"texture":"#side","cullface":"west"}}}]})"},
    {"minecraft:block/carpet",
     R"({"elements":[{"from":[0,0,0],"to":[16,1,16],"faces":{"down":{"texture":"#wool","cullface":"down"},"up":{"texture":"#wool"},)"
     R"("north":{"texture":"#wool","cullface":"north"},"south":{"texture":"#wool","cullface":"south"},)"
     R"("west":{"texture":"#wool","cullface":"west"},"east":{"texture":"#wool","cullface":"east"}}}]})"},
    {"minecraft:block/fence_post",
     R"({"elements":[{"from":[6,0,6],"to":[10,16,10],"faces":{)" VX_ALL6("#texture") "}}]}"},
    {"minecraft:block/fence_side",
     R"({"elements":[{"from":[7,12,0],"to":[9,15,9],"faces":{)" VX_ALL6("#texture") R"(}},{"from":[7,6,0],"to":[9,9,9],"faces":{)"
     VX_ALL6("#texture") "}}]}"},
    {"minecraft:block/template_wall_post",
     R"({"elements":[{"from":[4,0,4],"to":[12,16,12],"faces":{)" VX_ALL6("#wall") "}}]}"},
    {"minecraft:block/template_wall_side",
     R"({"elements":[{"from":[5,0,0],"to":[11,14,8],"faces":{)" VX_ALL6("#wall") "}}]}"},
    {"minecraft:block/template_wall_side_tall",
     R"({"elements":[{"from":[5,0,0],"to":[11,16,8],"faces":{)" VX_ALL6("#wall") "}}]}"},
    {"minecraft:block/pressure_plate_up",
     R"({"elements":[{"from":[1,0,1],"to":[15,1,15],"faces":{)" VX_ALL6("#texture") "}}]}"},
    {"minecraft:block/pressure_plate_down",
     R"({"elements":[{"from":[1,0,1],"to":[15,0.5,15],"faces":{)" VX_ALL6("#texture") "}}]}"},
};

} // namespace

std::string_view builtin_block_model(std::string_view name) {
    for (const Builtin& b : kBuiltins)
        if (b.name == name) return b.text;
    return {};
}

} // namespace vitrail
