// BlockDef: what content says of a block, as data. Lua fills it on the server (script/); clients receive it by message.
#pragma once

#include "base/fields.h"
#include "base/types.h"

#include <array>
#include <string>
#include <vector>

namespace vitrail {

enum class RenderLayer : u8 { solid, cutout, cutout_mipped, translucent };

// How a state's boxes (world/shape.h) and its drawn model (scene/block_model.h) follow from its properties.
enum class ShapeKind : u8 {
    none, cube, pillar, slab, stairs, fence, wall, fence_gate, pane, cross, crop, torch, wall_torch, door, trapdoor,
    liquid, layers, carpet, ladder, faces, rail, button, lever, pressure_plate, sign, wall_sign, chest, bed, lantern,
    chain, lily_pad, boxes, count
};
// Names as content writes them, in enum order.
extern const std::array<const char*, std::size_t(ShapeKind::count)> kShapeKindNames;

// How a block treats light where paths are traced; automatic: as layer, shape and material say (docs/content.md).
enum class OpticsKind : u8 { automatic, matte, metal, leaf, thin, dielectric, water, count };
// Names as content writes them, in enum order.
extern const std::array<const char*, std::size_t(OpticsKind::count)> kOpticsKindNames;

enum class TintKind : u8 { none, grass, foliage, water, fixed };
enum class TintFaces : u8 { all, top };

struct PropertyDef {
    std::string name;
    std::vector<std::string> values;
    std::string default_value;
    static constexpr auto fields = std::tuple{field<1>("name", &PropertyDef::name, {.most = 64}),
                                              field<2>("values", &PropertyDef::values, {.most = 64}),
                                              field<3>("default", &PropertyDef::default_value, {.most = 64})};
};

// A box in 1/16 block, with its own texture or the block's where empty.
struct BoxDef {
    float x0 = 0, y0 = 0, z0 = 0, x1 = 16, y1 = 16, z1 = 16;
    std::string texture;
    static constexpr auto fields =
        std::tuple{field<1>("x0", &BoxDef::x0), field<2>("y0", &BoxDef::y0), field<3>("z0", &BoxDef::z0),
                   field<4>("x1", &BoxDef::x1), field<5>("y1", &BoxDef::y1), field<6>("z1", &BoxDef::z1),
                   field<7>("texture", &BoxDef::texture, {.most = 64})};
};

// The part of a definition that a variant may override for some states.
struct BlockLook {
    ShapeKind shape = ShapeKind::cube;
    RenderLayer layer = RenderLayer::solid;
    // 1: all faces; 2: side, end; 3: side, top, bottom; 4: front, side, top, bottom; 5: front, back, side, top, bottom;
    // 6: west, east, down, up, north, south. Empty: drawn as the plain unknown block.
    std::vector<std::string> textures;
    std::vector<BoxDef> boxes;      // for ShapeKind::boxes
    float transparency = 0;         // 0 opaque .. 1 clear
    u8 opacity = 15;                // light lost a cell, 0..15
    std::array<u8, 3> light{};      // emitted r, g, b, 0..15
    float hardness = 1;             // Minecraft's scale; negative: cannot be broken
    float viscosity = 0;            // 0 air .. 1 immovable
    bool collision = true;
    TintKind tint = TintKind::none;
    TintFaces tint_faces = TintFaces::all;
    std::array<u8, 3> tint_color{255, 255, 255}; // sRGB, for TintKind::fixed
    std::string material;           // stone, wood, ...: sound and feel
    bool replaceable = false;       // a block can be placed into it
    bool climbable = false;
    bool sway = false;              // moves in the wind
    OpticsKind optics = OpticsKind::automatic;
    float ior = 0;                  // index of refraction; 0: as the optics have it
    std::array<float, 3> absorption{}; // r, g, b a block, base e, in dielectrics; all 0: as the picture's color says
};

struct BlockVariant {
    std::vector<std::pair<std::string, std::string>> when; // all must match
    BlockLook look;                                        // the definition's look with this variant's fields laid over
};

struct BlockDef {
    std::string name;
    std::vector<PropertyDef> properties;
    BlockLook look;
    // Full looks a state can have: fully resolved for matching states, most specific match last.
    std::vector<BlockVariant> variants;
    bool in_hotbar_list = true;
};

} // namespace vitrail
