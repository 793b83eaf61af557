// Bits by block (LegacyBits), as legacy_connect.cpp and block entities fill them:
//   fence, pane, bars, wall, tripwire, fire, chorus plant: north 1, east 2, south 4, west 8, up 16, down 32
//   stairs: shape 0 straight, 1 inner_left, 2 inner_right, 3 outer_left, 4 outer_right
//   redstone wire: two bits each for north, east, south, west: 0 none, 1 side, 2 up
//   door, lower half: 1 known, 2 hinge right, 4 powered; upper half: 1 known, facing meta << 1, 8 open
//   double plant, upper half: 1 + kind;  grass, podzol, mycelium: 1 snowy;  fence gate: 1 in a wall
//   chest: 1 left, 2 right, (1 + direction from north) << 2 where its meta does not say where it looks;  repeater: 1
//   locked;  vine: 1 up;  stem: 1 + direction of its fruit;  portal: 1 x, 2 z bed, banner: 1 + color;  head: kind |
//   rotation << 3 | 128;  flower pot: 1 + plant;  note block: 1 | note << 1 | 64 powered
#include "formats/legacy_ids.h"

#include <array>
#include <fmt/format.h>
#include <span>

namespace vitrail {

namespace {

using Name = const char*;

constexpr std::array<Name, 16> kColors = {"white", "orange", "magenta",    "light_blue", "yellow", "lime",
                                          "pink",  "gray",   "light_gray", "cyan",       "purple", "blue",
                                          "brown", "green",  "red",        "black"};
constexpr std::array<Name, 6> kWoods = {"oak", "spruce", "birch", "jungle", "acacia", "dark_oak"};
constexpr std::array<Name, 8> kFacing6 = {"down", "up", "north", "south", "west", "east", "down", "down"};
constexpr std::array<Name, 4> kCompass = {"north", "east", "south", "west"};
constexpr std::array<Name, 4> kHorizontal = {"south", "west", "north", "east"};
constexpr std::array<Name, 4> kStairsFacing = {"east", "west", "south", "north"};
constexpr std::array<Name, 4> kDoorFacing = {"east", "south", "west", "north"};
constexpr std::array<Name, 4> kTrapdoorFacing = {"north", "south", "west", "east"};
constexpr std::array<Name, 4> kAxis = {"y", "x", "z", "y"};
constexpr std::array<Name, 5> kStairsShape = {"straight", "inner_left", "inner_right", "outer_left", "outer_right"};
constexpr std::array<Name, 10> kRailShape = {"north_south",     "east_west",       "ascending_east", "ascending_west",
                                             "ascending_north", "ascending_south", "south_east",     "south_west",
                                             "north_west",      "north_east"};
constexpr std::array<Name, 6> kHeads = {"skeleton_skull", "wither_skeleton_skull", "zombie_head",
                                        "player_head",    "creeper_head",          "dragon_head"};
// Plants of flower pots: the numbers that pots themselves had before 1.7 are the first 14.
constexpr std::array<Name, 22> kPotted = {
    nullptr,         "poppy",          "dandelion",      "oak_sapling",      "spruce_sapling",
    "birch_sapling", "jungle_sapling", "red_mushroom",   "brown_mushroom",   "cactus",
    "dead_bush",     "fern",           "acacia_sapling", "dark_oak_sapling", "blue_orchid",
    "allium",        "azure_bluet",    "red_tulip",      "orange_tulip",     "white_tulip",
    "pink_tulip",    "oxeye_daisy"};
constexpr std::array<Name, 9> kRedFlowers = {"poppy",        "blue_orchid", "allium",     "azure_bluet", "red_tulip",
                                             "orange_tulip", "white_tulip", "pink_tulip", "oxeye_daisy"};

// Names that need nothing but the number, and the materials of families; the others are made by rules below.
struct Named {
    u8 id;
    Name name;
};
constexpr Named kPlain[] = {{0, "air"},
                            {4, "cobblestone"},
                            {7, "bedrock"},
                            {13, "gravel"},
                            {14, "gold_ore"},
                            {15, "iron_ore"},
                            {16, "coal_ore"},
                            {20, "glass"},
                            {21, "lapis_ore"},
                            {22, "lapis_block"},
                            {30, "cobweb"},
                            {32, "dead_bush"},
                            {37, "dandelion"},
                            {39, "brown_mushroom"},
                            {40, "red_mushroom"},
                            {41, "gold_block"},
                            {42, "iron_block"},
                            {45, "bricks"},
                            {47, "bookshelf"},
                            {48, "mossy_cobblestone"},
                            {49, "obsidian"},
                            {52, "spawner"},
                            {56, "diamond_ore"},
                            {57, "diamond_block"},
                            {58, "crafting_table"},
                            {79, "ice"},
                            {80, "snow_block"},
                            {82, "clay"},
                            {87, "netherrack"},
                            {88, "soul_sand"},
                            {89, "glowstone"},
                            {103, "melon"},
                            {111, "lily_pad"},
                            {112, "nether_bricks"},
                            {116, "enchanting_table"},
                            {119, "end_portal"},
                            {121, "end_stone"},
                            {122, "dragon_egg"},
                            {129, "emerald_ore"},
                            {133, "emerald_block"},
                            {138, "beacon"},
                            {152, "redstone_block"},
                            {153, "nether_quartz_ore"},
                            {165, "slime_block"},
                            {166, "barrier"},
                            {169, "sea_lantern"},
                            {172, "terracotta"},
                            {173, "coal_block"},
                            {174, "packed_ice"},
                            {201, "purpur_block"},
                            {206, "end_stone_bricks"},
                            {208, "dirt_path"},
                            {209, "end_gateway"},
                            {213, "magma_block"},
                            {214, "nether_wart_block"},
                            {215, "red_nether_bricks"},
                            {217, "structure_void"}};
constexpr Named kStairs[] = {
    {53, "oak"},        {67, "cobblestone"}, {108, "brick"},         {109, "stone_brick"}, {114, "nether_brick"},
    {128, "sandstone"}, {134, "spruce"},     {135, "birch"},         {136, "jungle"},      {156, "quartz"},
    {163, "acacia"},    {164, "dark_oak"},   {180, "red_sandstone"}, {203, "purpur"}};
constexpr Named kDoors[] = {{64, "oak"},     {71, "iron"},    {193, "spruce"},  {194, "birch"},
                            {195, "jungle"}, {196, "acacia"}, {197, "dark_oak"}};
constexpr Named kFences[] = {{85, "oak"},     {113, "nether_brick"}, {188, "spruce"}, {189, "birch"},
                             {190, "jungle"}, {191, "dark_oak"},     {192, "acacia"}};
constexpr Named kGates[] = {{107, "oak"},    {183, "spruce"},   {184, "birch"},
                            {185, "jungle"}, {186, "dark_oak"}, {187, "acacia"}};

Name find(std::span<const Named> table, u32 id) {
    for (const Named& entry : table)
        if (entry.id == id) return entry.name;
    return nullptr;
}

// Collects a state; properties may come in any order.
struct Maker {
    BlockState state;
    u32 id, meta;
    LegacyBits bits;

    Maker& name(std::string_view n) {
        state.name = "minecraft:";
        state.name += n;
        return *this;
    }
    Maker& name(Name first, std::string_view rest) { return name(std::string(first).append(rest)); }
    Maker& set(Name property, std::string_view value) {
        state.set(property, value);
        return *this;
    }
    Maker& flag(Name property, bool value) { return set(property, value ? "true" : "false"); }
    Maker& number(Name property, u32 value) { return set(property, std::to_string(value)); }
    bool bit(u32 mask) const { return meta & mask; }
    template <std::size_t N>
    Name of(const std::array<Name, N>& list, u32 index) const {
        return list[index < N ? index : 0];
    }
    Maker& sides(bool up_too, bool down_too) {
        flag("north", bits & 1).flag("east", bits & 2).flag("south", bits & 4).flag("west", bits & 8);
        if (up_too) flag("up", bits & 16);
        if (down_too) flag("down", bits & 32);
        return *this;
    }
    Maker& facing(Name value) { return set("facing", value); }
    // Chests, furnaces, ladders, wall signs, ...: 2 north to 5 east; 0 and 1 never occur and look north.
    Maker& facing_2to5() { return facing(meta % 8 >= 2 && meta % 8 <= 5 ? kFacing6[meta % 8] : "north"); }

    void make();
    void slab(Name material, bool top) { name(material, "_slab").set("type", top ? "top" : "bottom"); }
    void stone_slab(bool is_double);
    void wooden(u32 first_wood, u32 count, bool leaves);
    void mushroom(Name cap);
    void lever();
    void button(Name material);
    void torch(Name standing, Name on_wall);
    void door(Name material);
    bool make_rest();
};

void Maker::stone_slab(bool is_double) {
    static constexpr std::array<Name, 8> kStone = {"smooth_stone", "sandstone",   "petrified_oak", "cobblestone",
                                                   "brick",        "stone_brick", "nether_brick",  "quartz"};
    const Name material = kStone[meta & 7];
    if (!is_double) return slab(material, bit(8));
    // Three double slabs had a seamless form, which is a block of its own now.
    if (meta == 8)
        name("smooth_stone");
    else if (meta == 9)
        name("smooth_sandstone");
    else if (meta == 15)
        name("smooth_quartz");
    else
        name(material, "_slab").set("type", "double");
}

// Logs and leaves: two bits of wood, two of axis or decay.
void Maker::wooden(u32 first_wood, u32 count, bool leaves) {
    const u32 kind = meta & 3;
    const Name wood = kWoods[first_wood + (kind < count ? kind : 0)];
    if (leaves) {
        // Decay did not count distances; 7 is "not known", persistent leaves stay.
        name(wood, "_leaves").number("distance", bit(4) ? 7 : 1).flag("persistent", bit(4));
        return;
    }
    const u32 axis = meta >> 2;
    name(wood, axis == 3 ? "_wood" : "_log").set("axis", kAxis[axis]);
}

void Maker::mushroom(Name cap) {
    // Faces that show the cap, as compass letters and u; stems show theirs on the four sides.
    static constexpr std::array<Name, 16> kFaces = {"",   "wnu", "nu",   "neu", "wu", "u", "eu",     "swu",
                                                    "su", "seu", "nesw", "",    "",   "",  "neswud", "neswud"};
    const std::string_view faces = kFaces[meta];
    name(meta == 10 || meta == 15 ? "mushroom_stem" : cap);
    auto on = [&](char face) { return faces.find(face) != faces.npos; };
    flag("north", on('n')).flag("east", on('e')).flag("south", on('s')).flag("west", on('w')).flag("up", on('u'));
    flag("down", on('d'));
}

void Maker::lever() {
    static constexpr std::array<Name, 8> kFace = {"ceiling", "wall",  "wall",  "wall",
                                                  "wall",    "floor", "floor", "ceiling"};
    static constexpr std::array<Name, 8> kFacing = {"west", "east", "west", "south", "north", "north", "west", "north"};
    name("lever").set("face", kFace[meta & 7]).facing(kFacing[meta & 7]).flag("powered", bit(8));
}

void Maker::button(Name material) {
    static constexpr std::array<Name, 8> kFace = {"ceiling", "wall", "wall", "wall", "wall", "floor", "wall", "wall"};
    static constexpr std::array<Name, 8> kFacing = {"north", "east",  "west",  "south",
                                                    "north", "north", "north", "north"};
    name(material, "_button").set("face", kFace[meta & 7]).facing(kFacing[meta & 7]).flag("powered", bit(8));
}

void Maker::torch(Name standing, Name on_wall) {
    static constexpr std::array<Name, 5> kFacing = {nullptr, "east", "west", "south", "north"};
    if (meta >= 1 && meta <= 4)
        name(on_wall).facing(kFacing[meta]);
    else
        name(standing);
}

void Maker::door(Name material) {
    name(material, "_door");
    const bool upper = bit(8);
    set("half", upper ? "upper" : "lower");
    const u32 facing_meta = upper ? bits >> 1 & 3 : meta & 3;
    const bool open = upper ? bits & 8 : bit(4);
    const bool hinge_right = upper ? bit(1) : bits & 2, powered = upper ? bit(2) : bits & 4;
    facing(kDoorFacing[facing_meta])
        .flag("open", open)
        .set("hinge", hinge_right ? "right" : "left")
        .flag("powered", powered);
}

void Maker::make() {
    if (const Name plain = find(kPlain, id))
        name(plain);
    else if (const Name stairs = find(kStairs, id))
        name(stairs, "_stairs")
            .facing(kStairsFacing[meta & 3])
            .set("half", bit(4) ? "top" : "bottom")
            .set("shape", of(kStairsShape, bits));
    else if (const Name wood = find(kDoors, id))
        door(wood);
    else if (const Name fence = find(kFences, id))
        name(fence, "_fence").sides(false, false);
    else if (const Name gate = find(kGates, id))
        name(gate, "_fence_gate")
            .facing(kHorizontal[meta & 3])
            .flag("open", bit(4))
            .flag("powered", bit(8))
            .flag("in_wall", bits & 1);
    else if (id >= 219 && id <= 234)
        name(kColors[id - 219], "_shulker_box").facing(kFacing6[meta & 7]);
    else if (id >= 235 && id <= 250)
        name(kColors[id - 235], "_glazed_terracotta").facing(kHorizontal[meta & 3]);
    else if (!make_rest()) {
        state.name = fmt::format("legacy:{}", id);
        number("meta", meta);
    }
}

// A table in the shape of a switch.
// clang-format off
bool Maker::make_rest() {
    const u32 low3 = meta & 7, low2 = meta & 3;
    switch (id) {
    case 1: {
        static constexpr std::array<Name, 7> kStones = {
            "stone", "granite", "polished_granite", "diorite", "polished_diorite", "andesite", "polished_andesite"};
        name(of(kStones, meta));
        break;
    }
    case 2: name("grass_block").flag("snowy", bits & 1); break;
    case 3:
        if (meta == 2) name("podzol").flag("snowy", bits & 1);
        else name(meta == 1 ? "coarse_dirt" : "dirt");
        break;
    case 5: name(of(kWoods, meta), "_planks"); break;
    case 6: name(of(kWoods, low3), "_sapling").number("stage", meta >> 3); break;
    case 8: case 9: name("water").number("level", meta); break;
    case 10: case 11: name("lava").number("level", meta); break;
    case 12: name(meta == 1 ? "red_sand" : "sand"); break;
    case 17: wooden(0, 4, false); break;
    case 18: wooden(0, 4, true); break;
    case 161: wooden(4, 2, true); break;
    case 162: wooden(4, 2, false); break;
    case 19: name(meta == 1 ? "wet_sponge" : "sponge"); break;
    case 23: case 158: name(id == 23 ? "dispenser" : "dropper").facing(kFacing6[low3]).flag("triggered", bit(8)); break;
    case 24: name(meta == 1 ? "chiseled_sandstone" : meta == 2 ? "cut_sandstone" : "sandstone"); break;
    case 25: name("note_block").set("instrument", "harp").number("note", bits >> 1 & 31).flag("powered", bits & 64); break;
    case 26:
        name(bits ? of(kColors, bits - 1u) : "red", "_bed").facing(kHorizontal[low2]).flag("occupied", bit(4));
        set("part", bit(8) ? "head" : "foot");
        break;
    case 27: case 28:
    case 157:
        name(id == 27 ? "powered_rail" : id == 28 ? "detector_rail" : "activator_rail");
        set("shape", low3 < 6 ? kRailShape[low3] : kRailShape[0]).flag("powered", bit(8));
        break;
    case 66: name("rail").set("shape", of(kRailShape, meta)); break;
    case 29: case 33: name(id == 29 ? "sticky_piston" : "piston").facing(kFacing6[low3]).flag("extended", bit(8)); break;
    case 34: case 36:
        name(id == 34 ? "piston_head" : "moving_piston").facing(kFacing6[low3]).set("type", bit(8) ? "sticky" : "normal");
        if (id == 34) flag("short", false);
        break;
    case 31: name(meta == 1 ? "short_grass" : meta == 2 ? "fern" : "dead_bush"); break;
    case 35: name(kColors[meta], "_wool"); break;
    case 38: name(of(kRedFlowers, meta)); break;
    case 43: stone_slab(true); break;
    case 44: stone_slab(false); break;
    case 46: name("tnt").flag("unstable", bit(1)); break;
    case 50: torch("torch", "wall_torch"); break;
    case 75: case 76: torch("redstone_torch", "redstone_wall_torch"), flag("lit", id == 76); break;
    case 51: name("fire").number("age", meta).sides(true, false); break;
    case 54: case 146:
        name(id == 54 ? "chest" : "trapped_chest").facing_2to5();
        if (bits >> 2) facing(of(kCompass, (bits >> 2) - 1u));
        set("type", (bits & 3) == 1 ? "left" : (bits & 3) == 2 ? "right" : "single");
        break;
    case 55: {
        static constexpr std::array<Name, 4> kWire = {"none", "side", "up", "none"};
        name("redstone_wire").number("power", meta).set("north", kWire[bits & 3]).set("east", kWire[bits >> 2 & 3]);
        set("south", kWire[bits >> 4 & 3]).set("west", kWire[bits >> 6 & 3]);
        break;
    }
    case 59: name("wheat").number("age", low3); break;
    case 60: name("farmland").number("moisture", low3); break;
    case 61: case 62: name("furnace").facing_2to5().flag("lit", id == 62); break;
    case 63: name("oak_sign").number("rotation", meta); break;
    case 65: name("ladder").facing_2to5(); break;
    case 68: name("oak_wall_sign").facing_2to5(); break;
    case 69: lever(); break;
    case 70: case 72: name(id == 70 ? "stone_pressure_plate" : "oak_pressure_plate").flag("powered", bit(1)); break;
    case 73: case 74: name("redstone_ore").flag("lit", id == 74); break;
    case 77: button("stone"); break;
    case 143: button("oak"); break;
    case 78: name("snow").number("layers", low3 + 1); break;
    case 81: name("cactus").number("age", meta); break;
    case 83: name("sugar_cane").number("age", meta); break;
    case 84: name("jukebox").flag("has_record", bit(1)); break;
    case 86: name("carved_pumpkin").facing(kHorizontal[low2]); break;
    case 91: name("jack_o_lantern").facing(kHorizontal[low2]); break;
    case 90: name("nether_portal").set("axis", low2 == 2 || (low2 == 0 && bits == 2) ? "z" : "x"); break;
    case 92: name("cake").number("bites", low3 < 7 ? low3 : 0); break;
    case 93: case 94: name("repeater").facing(kHorizontal[low2]).number("delay", (meta >> 2) + 1).flag("locked", bits & 1).flag("powered", id == 94); break;
    case 149: case 150:
        name("comparator").facing(kHorizontal[low2]).set("mode", bit(4) ? "subtract" : "compare");
        flag("powered", bit(8) || id == 150);
        break;
    case 95: name(kColors[meta], "_stained_glass"); break;
    case 96: case 167:
        name(id == 96 ? "oak_trapdoor" : "iron_trapdoor").facing(kTrapdoorFacing[low2]).flag("open", bit(4));
        set("half", bit(8) ? "top" : "bottom");
        break;
    case 97: {
        static constexpr std::array<Name, 6> kEggs = {"stone",
                                                      "cobblestone",
                                                      "stone_bricks",
                                                      "mossy_stone_bricks",
                                                      "cracked_stone_bricks",
                                                      "chiseled_stone_bricks"};
        name("infested_", of(kEggs, meta));
        break;
    }
    case 98: {
        static constexpr std::array<Name, 4> kBricks = {"", "mossy_", "cracked_", "chiseled_"};
        name(of(kBricks, meta), "stone_bricks");
        break;
    }
    case 99: mushroom("brown_mushroom_block"); break;
    case 100: mushroom("red_mushroom_block"); break;
    case 101: name("iron_bars").sides(false, false); break;
    case 102: name("glass_pane").sides(false, false); break;
    case 160: name(kColors[meta], "_stained_glass_pane").sides(false, false); break;
    case 104: case 105: {
        const Name fruit = id == 104 ? "pumpkin" : "melon";
        if (bits) name("attached_", std::string(fruit) + "_stem").facing(kHorizontal[(bits - 1) & 3]);
        else name(fruit, "_stem").number("age", low3);
        break;
    }
    case 106: name("vine").flag("south", bit(1)).flag("west", bit(2)).flag("north", bit(4)).flag("east", bit(8)).flag("up", bits & 1); break;
    case 110: name("mycelium").flag("snowy", bits & 1); break;
    case 115: name("nether_wart").number("age", low2); break;
    case 117: name("brewing_stand").flag("has_bottle_0", bit(1)).flag("has_bottle_1", bit(2)).flag("has_bottle_2", bit(4)); break;
    case 118:
        if (low2 == 0) name("cauldron");
        else name("water_cauldron").number("level", low2);
        break;
    case 120: name("end_portal_frame").facing(kHorizontal[low2]).flag("eye", bit(4)); break;
    case 123: case 124: name("redstone_lamp").flag("lit", id == 124); break;
    case 125: name(of(kWoods, low3), "_slab").set("type", "double"); break;
    case 126: slab(of(kWoods, low3), bit(8)); break;
    case 127: name("cocoa").facing(kHorizontal[low2]).number("age", meta >> 2 < 3 ? meta >> 2 : 2); break;
    case 130: name("ender_chest").facing_2to5(); break;
    case 131: name("tripwire_hook").facing(kHorizontal[low2]).flag("attached", bit(4)).flag("powered", bit(8)); break;
    case 132: name("tripwire").flag("powered", bit(1)).flag("attached", bit(4)).flag("disarmed", bit(8)).sides(false, false); break;
    case 137: case 210:
    case 211:
        name(id == 137 ? "command_block" : id == 210 ? "repeating_command_block" : "chain_command_block");
        facing(kFacing6[low3]).flag("conditional", bit(8));
        break;
    case 139: {
        name(meta == 1 ? "mossy_cobblestone_wall" : "cobblestone_wall");
        auto side = [&](Name n, u32 mask) { set(n, bits & mask ? "low" : "none"); };
        side("north", 1), side("east", 2), side("south", 4), side("west", 8);
        flag("up", bits == 0 || bits & 16);
        break;
    }
    case 140: {
        const u32 plant = bits ? bits - 1u : meta;
        if (plant == 0 || plant >= kPotted.size()) name("flower_pot");
        else name("potted_", kPotted[plant]);
        break;
    }
    case 141: name("carrots").number("age", low3); break;
    case 142: name("potatoes").number("age", low3); break;
    case 144: {
        const std::string head = kHeads[bits & 7 ? ((bits & 7) < 6 ? bits & 7 : 0) : 0];
        if (low3 >= 2 && low3 <= 5) {
            const std::size_t cut = head.rfind('_');
            name(head.substr(0, cut) + "_wall" + head.substr(cut)).facing(kFacing6[low3]);
        } else {
            name(head).number("rotation", bits >> 3 & 15);
        }
        break;
    }
    case 145: {
        const u32 wear = meta >> 2;
        name(wear == 0 ? "anvil" : wear == 1 ? "chipped_anvil" : "damaged_anvil").facing(kHorizontal[low2]);
        break;
    }
    case 147: name("light_weighted_pressure_plate").number("power", meta); break;
    case 148: name("heavy_weighted_pressure_plate").number("power", meta); break;
    case 151: case 178: name("daylight_detector").number("power", meta).flag("inverted", id == 178); break;
    case 154: name("hopper").facing(low3 == 1 ? "down" : kFacing6[low3]).flag("enabled", !bit(8)); break;
    case 155:
        if (meta == 1)
            name("chiseled_quartz_block");
        else if (meta >= 2 && meta <= 4)
            name("quartz_pillar").set("axis", kAxis[meta - 2]);
        else
            name("quartz_block");
        break;
    case 159: name(kColors[meta], "_terracotta"); break;
    case 168: name(meta == 1 ? "prismarine_bricks" : meta == 2 ? "dark_prismarine" : "prismarine"); break;
    case 170: case 202:
    case 216: name(id == 170 ? "hay_block" : id == 202 ? "purpur_pillar" : "bone_block").set("axis", kAxis[meta >> 2]); break;
    case 171: name(kColors[meta], "_carpet"); break;
    case 175: {
        static constexpr std::array<Name, 6> kPlants = {"sunflower",  "lilac",     "tall_grass",
                                                        "large_fern", "rose_bush", "peony"};
        const bool upper = bit(8);
        name(of(kPlants, upper ? (bits ? bits - 1u : 2) : low3)).set("half", upper ? "upper" : "lower");
        break;
    }
    case 176: name(bits ? of(kColors, bits - 1u) : "white", "_banner").number("rotation", meta); break;
    case 177: name(bits ? of(kColors, bits - 1u) : "white", "_wall_banner").facing_2to5(); break;
    case 179: name(meta == 1 ? "chiseled_red_sandstone" : meta == 2 ? "cut_red_sandstone" : "red_sandstone"); break;
    case 181:
        if (bit(8)) name("smooth_red_sandstone");
        else name("red_sandstone_slab").set("type", "double");
        break;
    case 182: slab("red_sandstone", bit(8)); break;
    case 204: name("purpur_slab").set("type", "double"); break;
    case 205: slab("purpur", bit(8)); break;
    case 198: name("end_rod").facing(kFacing6[low3]); break;
    case 199: name("chorus_plant").sides(true, true); break;
    case 200: name("chorus_flower").number("age", meta < 6 ? meta : 5); break;
    case 207: name("beetroots").number("age", low2); break;
    case 212: name("frosted_ice").number("age", low2); break;
    case 218: name("observer").facing(kFacing6[low3]).flag("powered", bit(8)); break;
    case 251: name(kColors[meta], "_concrete"); break;
    case 252: name(kColors[meta], "_concrete_powder"); break;
    case 255: {
        static constexpr std::array<Name, 4> kMode = {"save", "load", "corner", "data"};
        name("structure_block").set("mode", of(kMode, meta));
        break;
    }
    default:
        return false;
    }
    return true;
}
// clang-format on

} // namespace

BlockState legacy_state(LegacyCode code, LegacyBits bits) {
    Maker maker{{}, u32(code) >> 4, u32(code) & 15, bits};
    maker.make();
    return std::move(maker.state);
}

std::string legacy_count_name(LegacyCode code) {
    return fmt::format("id:{}:{}", code >> 4, code & 15);
}

// Pots name their plant by item: a number and a data value to 1.7, then a name and a data value.
static LegacyBits pot_bits(const nbt::Tag& pot) {
    const u32 data = u32(pot["Data"].integer()) & 15;
    const std::string_view text = pot["Item"].text();
    const i64 number = pot["Item"].integer(-1);
    auto is = [&](i64 id, std::string_view item) {
        return number == id || (text.size() >= item.size() && text.ends_with(item));
    };
    static constexpr std::array<u8, 6> kSaplings = {3, 4, 5, 6, 12, 13};
    static constexpr std::array<u8, 9> kFlowers = {1, 14, 15, 16, 17, 18, 19, 20, 21};
    u32 plant = 0;
    if (text == "minecraft:air" || number == 0 || (text.empty() && number < 0))
        plant = 0;
    else if (is(6, ":sapling"))
        plant = kSaplings[data < 6 ? data : 0];
    else if (is(38, ":red_flower"))
        plant = kFlowers[data < 9 ? data : 0];
    else if (is(37, ":yellow_flower"))
        plant = 2;
    else if (is(40, ":red_mushroom"))
        plant = 7;
    else if (is(39, ":brown_mushroom"))
        plant = 8;
    else if (is(81, ":cactus"))
        plant = 9;
    else if (is(32, ":deadbush"))
        plant = 10;
    else if (is(31, ":tallgrass"))
        plant = data == 0 ? 10 : 11;
    return LegacyBits(1 + plant);
}

LegacyBits legacy_bits_of_block_entity(const nbt::Tag& e) {
    std::string_view id = e["id"].text();
    if (id.starts_with("minecraft:")) id.remove_prefix(10);
    if (id == "Bed" || id == "bed") return e.has("color") ? LegacyBits(1 + (e["color"].integer() & 15)) : LegacyBits(0);
    // Banners count colors from black.
    if (id == "Banner" || id == "banner") return LegacyBits(1 + (15 - (e["Base"].integer() & 15)));
    if (id == "Skull" || id == "skull")
        return LegacyBits(128 | (e["SkullType"].integer() & 7) | (e["Rot"].integer() & 15) << 3);
    if (id == "FlowerPot" || id == "flower_pot") return pot_bits(e);
    if (id == "Music" || id == "noteblock")
        return LegacyBits(1 | (u32(e["note"].integer()) & 31) % 25 << 1 | (e["powered"].integer() ? 64 : 0));
    return 0;
}

} // namespace vitrail
