#include "scene/pack_names.h"

#include <algorithm>
#include <iterator>
#include <utility>

namespace vitrail::scene {

namespace {

using Pair = std::pair<std::string_view, std::string_view>;

// Content's or the newest name, and what else versions from 1.13 on call the picture.
constexpr Pair kModern[] = {
    {"short_grass", "grass"},
    {"dirt_path_top", "grass_path_top"},
    {"dirt_path_side", "grass_path_side"},
    {"fire", "fire_0"},
    {"soul_fire", "soul_fire_0"},
    {"magma_block", "magma"},
    {"smooth_quartz", "quartz_block_bottom"},
    {"respawn_anchor_side", "respawn_anchor_side0"},
    {"lectern_side", "lectern_sides"},
    {"cartography_table_front", "cartography_table_side3"},
    {"cartography_table_side", "cartography_table_side2"},
    {"honey_block", "honey_block_side"},
    {"hopper_side", "hopper_outside"},
    {"azalea_plant", "azalea_top"},
    {"bamboo_sapling", "bamboo_stage0"},
    {"fletching_table_side", "fletching_table_front"},
};

// Names before 1.13, where no rule below makes them.
constexpr Pair kOld[] = {
    {"grass_block_top", "grass_top"},
    {"grass_block_side", "grass_side"},
    {"grass_block_side_overlay", "grass_side_overlay"},
    {"grass_block_snow", "grass_side_snowed"},
    {"podzol_top", "dirt_podzol_top"},
    {"podzol_side", "dirt_podzol_side"},
    {"granite", "stone_granite"},
    {"polished_granite", "stone_granite_smooth"},
    {"diorite", "stone_diorite"},
    {"polished_diorite", "stone_diorite_smooth"},
    {"andesite", "stone_andesite"},
    {"polished_andesite", "stone_andesite_smooth"},
    {"stone_bricks", "stonebrick"},
    {"cracked_stone_bricks", "stonebrick_cracked"},
    {"mossy_stone_bricks", "stonebrick_mossy"},
    {"chiseled_stone_bricks", "stonebrick_carved"},
    {"mossy_cobblestone", "cobblestone_mossy"},
    {"bricks", "brick"},
    {"smooth_stone", "stone_slab_top"},
    {"smooth_stone_slab_side", "stone_slab_side"},
    {"sandstone", "sandstone_normal"},
    {"cut_sandstone", "sandstone_smooth"},
    {"chiseled_sandstone", "sandstone_carved"},
    {"red_sandstone", "red_sandstone_normal"},
    {"cut_red_sandstone", "red_sandstone_smooth"},
    {"chiseled_red_sandstone", "red_sandstone_carved"},
    {"nether_bricks", "nether_brick"},
    {"red_nether_bricks", "red_nether_brick"},
    {"end_stone_bricks", "end_bricks"},
    {"nether_quartz_ore", "quartz_ore"},
    {"chiseled_quartz_block", "quartz_block_chiseled"},
    {"chiseled_quartz_block_top", "quartz_block_chiseled_top"},
    {"quartz_pillar", "quartz_block_lines"},
    {"quartz_pillar_top", "quartz_block_lines_top"},
    {"smooth_quartz", "quartz_block_bottom"},
    {"terracotta", "hardened_clay"},
    {"packed_ice", "ice_packed"},
    {"sugar_cane", "reeds"},
    {"dead_bush", "deadbush"},
    {"cobweb", "web"},
    {"dandelion", "flower_dandelion"},
    {"poppy", "flower_rose"},
    {"blue_orchid", "flower_blue_orchid"},
    {"allium", "flower_allium"},
    {"azure_bluet", "flower_houstonia"},
    {"red_tulip", "flower_tulip_red"},
    {"orange_tulip", "flower_tulip_orange"},
    {"white_tulip", "flower_tulip_white"},
    {"pink_tulip", "flower_tulip_pink"},
    {"oxeye_daisy", "flower_oxeye_daisy"},
    {"red_mushroom", "mushroom_red"},
    {"brown_mushroom", "mushroom_brown"},
    {"red_mushroom_block", "mushroom_block_skin_red"},
    {"brown_mushroom_block", "mushroom_block_skin_brown"},
    {"mushroom_stem", "mushroom_block_skin_stem"},
    {"short_grass", "tallgrass"},
    {"grass", "tallgrass"},
    {"tall_grass_top", "double_plant_grass_top"},
    {"tall_grass_bottom", "double_plant_grass_bottom"},
    {"large_fern_top", "double_plant_fern_top"},
    {"large_fern_bottom", "double_plant_fern_bottom"},
    {"sunflower_top", "double_plant_sunflower_top"},
    {"sunflower_bottom", "double_plant_sunflower_bottom"},
    {"sunflower_front", "double_plant_sunflower_front"},
    {"sunflower_back", "double_plant_sunflower_back"},
    {"lilac_top", "double_plant_syringa_top"},
    {"lilac_bottom", "double_plant_syringa_bottom"},
    {"rose_bush_top", "double_plant_rose_top"},
    {"rose_bush_bottom", "double_plant_rose_bottom"},
    {"peony_top", "double_plant_paeonia_top"},
    {"peony_bottom", "double_plant_paeonia_bottom"},
    {"lily_pad", "waterlily"},
    {"farmland", "farmland_dry"},
    {"farmland_moist", "farmland_wet"},
    {"dirt_path_top", "grass_path_top"},
    {"dirt_path_side", "grass_path_side"},
    {"rail", "rail_normal"},
    {"rail_corner", "rail_normal_turned"},
    {"powered_rail", "rail_golden"},
    {"powered_rail_on", "rail_golden_powered"},
    {"detector_rail", "rail_detector"},
    {"detector_rail_on", "rail_detector_powered"},
    {"activator_rail", "rail_activator"},
    {"activator_rail_on", "rail_activator_powered"},
    {"torch", "torch_on"},
    {"redstone_torch", "redstone_torch_on"},
    {"repeater", "repeater_off"},
    {"comparator", "comparator_off"},
    {"redstone_lamp", "redstone_lamp_off"},
    {"furnace_front", "furnace_front_off"},
    {"dispenser_front", "dispenser_front_horizontal"},
    {"dropper_front", "dropper_front_horizontal"},
    {"spawner", "mob_spawner"},
    {"note_block", "noteblock"},
    {"carved_pumpkin", "pumpkin_face_off"},
    {"jack_o_lantern", "pumpkin_face_on"},
    {"oak_trapdoor", "trapdoor"},
    {"tripwire", "trip_wire"},
    {"tripwire_hook", "trip_wire_source"},
    {"slime_block", "slime"},
    {"wet_sponge", "sponge_wet"},
    {"prismarine", "prismarine_rough"},
    {"dark_prismarine", "prismarine_dark"},
    {"piston_top", "piston_top_normal"},
    {"end_portal_frame_top", "endframe_top"},
    {"end_portal_frame_side", "endframe_side"},
    {"end_portal_frame_eye", "endframe_eye"},
    {"anvil", "anvil_base"},
    {"anvil_top", "anvil_top_damaged_0"},
    {"chipped_anvil_top", "anvil_top_damaged_1"},
    {"damaged_anvil_top", "anvil_top_damaged_2"},
    {"fire", "fire_layer_0"},
    {"fire_0", "fire_layer_0"},
    {"fire_1", "fire_layer_1"},
    {"nether_portal", "portal"},
    {"magma_block", "magma"},
    {"oak_door_top", "door_wood_upper"},
    {"oak_door_bottom", "door_wood_lower"},
    {"dark_oak_sapling", "sapling_roofed_oak"},
    {"dark_oak_planks", "planks_big_oak"},
    {"dark_oak_log", "log_big_oak"},
    {"dark_oak_log_top", "log_big_oak_top"},
    {"dark_oak_leaves", "leaves_big_oak"},
    {"observer_back_on", "observer_back_lit"},
};

// Ending of a modern name -> beginning of the old one.
constexpr Pair kMoved[] = {
    {"_planks", "planks_"},
    {"_log_top", "log_"},
    {"_log", "log_"},
    {"_leaves", "leaves_"},
    {"_sapling", "sapling_"},
    {"_door_top", "door_"},
    {"_door_bottom", "door_"},
    {"_wool", "wool_colored_"},
    {"_stained_glass_pane_top", "glass_pane_top_"},
    {"_stained_glass", "glass_"},
    {"_glazed_terracotta", "glazed_terracotta_"},
    {"_terracotta", "hardened_clay_stained_"},
    {"_concrete_powder", "concrete_powder_"},
    {"_concrete", "concrete_"},
};

constexpr std::string_view kStaged[] = {"wheat", "carrots", "potatoes", "beetroots", "nether_wart", "cocoa"};

constexpr Pair kBlocks[] = {{"short_grass", "grass"},
                            {"dirt_path", "grass_path"},
                            {"grass", "short_grass"},
                            {"grass_path", "dirt_path"},
                            {"iron_chain", "chain"}};

constexpr std::string_view kSheets[] = {"lantern",    "soul_lantern",   "chain",      "iron_chain",   "end_rod",
                                        "sea_pickle", "brewing_stand",  "conduit",    "cocoa_stage0", "cocoa_stage1",
                                        "bell",       "cocoa_stage2",   "turtle_egg", "sniffer_egg",  "candle",
                                        "campfire",   "stonecutter_saw"};

std::string old_name(std::string_view name) {
    for (const Pair& p : kOld)
        if (p.first == name) return std::string(p.second);
    for (const std::string_view plant : kStaged)
        if (name.starts_with(plant) && name.substr(plant.size()).starts_with("_stage"))
            return std::string(plant) + "_stage_" + std::string(name.substr(plant.size() + 6));
    for (const Pair& p : kMoved) {
        if (!name.ends_with(p.first) || name.size() == p.first.size()) continue;
        std::string kind(name.substr(0, name.size() - p.first.size()));
        if (kind == "light_gray") kind = "silver";
        std::string out = std::string(p.second) + kind;
        if (p.first == "_log_top") out += "_top";
        if (p.first == "_door_top") out += "_upper";
        if (p.first == "_door_bottom") out += "_lower";
        return out;
    }
    return std::string(name);
}

} // namespace

std::vector<std::string> picture_files(std::string_view name, bool old_names) {
    if (old_names) {
        std::vector<std::string> out{"blocks/" + old_name(name)};
        if (old_name(name) != name) out.push_back("blocks/" + std::string(name));
        return out;
    }
    std::vector<std::string> out{"block/" + std::string(name)};
    for (const Pair& p : kModern)
        if (p.first == name) out.push_back("block/" + std::string(p.second));
    return out;
}

std::vector<std::string> content_names(std::string_view picture) {
    std::vector<std::string> out{std::string(picture)};
    for (const Pair& p : kModern)
        if (p.second == picture) out.emplace_back(p.first);
    return out;
}

std::vector<std::string> block_names(std::string_view block) {
    std::vector<std::string> out{std::string(block)};
    for (const Pair& p : kBlocks)
        if (p.first == block) out.emplace_back(p.second);
    return out;
}

bool is_sheet(std::string_view name) {
    return std::find(std::begin(kSheets), std::end(kSheets), name) != std::end(kSheets);
}

} // namespace vitrail::scene
