// Biome numbers before 1.18 and their newest names. After https://minecraft.wiki/w/Biome/ID (Java Edition,
// before 1.18).
#include "formats/legacy_ids.h"

#include <array>
#include <fmt/format.h>

namespace vitrail {

static constexpr std::array<const char*, 51> kFirst = {"ocean",
                                                       "plains",
                                                       "desert",
                                                       "windswept_hills",
                                                       "forest",
                                                       "taiga",
                                                       "swamp",
                                                       "river",
                                                       "nether_wastes",
                                                       "the_end",
                                                       "frozen_ocean",
                                                       "frozen_river",
                                                       "snowy_plains",
                                                       "snowy_mountains",
                                                       "mushroom_fields",
                                                       "mushroom_field_shore",
                                                       "beach",
                                                       "desert_hills",
                                                       "wooded_hills",
                                                       "taiga_hills",
                                                       "mountain_edge",
                                                       "jungle",
                                                       "jungle_hills",
                                                       "sparse_jungle",
                                                       "deep_ocean",
                                                       "stony_shore",
                                                       "snowy_beach",
                                                       "birch_forest",
                                                       "birch_forest_hills",
                                                       "dark_forest",
                                                       "snowy_taiga",
                                                       "snowy_taiga_hills",
                                                       "old_growth_pine_taiga",
                                                       "giant_tree_taiga_hills",
                                                       "windswept_forest",
                                                       "savanna",
                                                       "savanna_plateau",
                                                       "badlands",
                                                       "wooded_badlands",
                                                       "badlands_plateau",
                                                       "small_end_islands",
                                                       "end_midlands",
                                                       "end_highlands",
                                                       "end_barrens",
                                                       "warm_ocean",
                                                       "lukewarm_ocean",
                                                       "cold_ocean",
                                                       "deep_warm_ocean",
                                                       "deep_lukewarm_ocean",
                                                       "deep_cold_ocean",
                                                       "deep_frozen_ocean"};

static const char* rare_biome(u32 id) {
    switch (id) {
    case 127:
        return "the_void";
    case 129:
        return "sunflower_plains";
    case 130:
        return "desert_lakes";
    case 131:
        return "windswept_gravelly_hills";
    case 132:
        return "flower_forest";
    case 133:
        return "taiga_mountains";
    case 134:
        return "swamp_hills";
    case 140:
        return "ice_spikes";
    case 149:
        return "modified_jungle";
    case 151:
        return "modified_jungle_edge";
    case 155:
        return "old_growth_birch_forest";
    case 156:
        return "tall_birch_hills";
    case 157:
        return "dark_forest_hills";
    case 158:
        return "snowy_taiga_mountains";
    case 160:
        return "old_growth_spruce_taiga";
    case 161:
        return "giant_spruce_taiga_hills";
    case 162:
        return "modified_gravelly_mountains";
    case 163:
        return "windswept_savanna";
    case 164:
        return "shattered_savanna_plateau";
    case 165:
        return "eroded_badlands";
    case 166:
        return "modified_wooded_badlands_plateau";
    case 167:
        return "modified_badlands_plateau";
    case 168:
        return "bamboo_jungle";
    case 169:
        return "bamboo_jungle_hills";
    case 170:
        return "soul_sand_valley";
    case 171:
        return "crimson_forest";
    case 172:
        return "warped_forest";
    case 173:
        return "basalt_deltas";
    case 174:
        return "dripstone_caves";
    case 175:
        return "lush_caves";
    default:
        return nullptr;
    }
}

// 1.18 merged the hilly and modified kinds into others; these are Minecraft's own choices.
static std::string_view merged_into(std::string_view name) {
    static constexpr std::array<std::pair<std::string_view, std::string_view>, 27> kMerged = {
        {{"snowy_mountains", "snowy_plains"},
         {"mushroom_field_shore", "mushroom_fields"},
         {"desert_hills", "desert"},
         {"wooded_hills", "forest"},
         {"taiga_hills", "taiga"},
         {"mountain_edge", "windswept_hills"},
         {"jungle_hills", "jungle"},
         {"birch_forest_hills", "birch_forest"},
         {"snowy_taiga_hills", "snowy_taiga"},
         {"giant_tree_taiga_hills", "old_growth_pine_taiga"},
         {"badlands_plateau", "badlands"},
         {"deep_warm_ocean", "warm_ocean"},
         {"desert_lakes", "desert"},
         {"taiga_mountains", "taiga"},
         {"swamp_hills", "swamp"},
         {"modified_jungle", "jungle"},
         {"modified_jungle_edge", "sparse_jungle"},
         {"tall_birch_hills", "old_growth_birch_forest"},
         {"dark_forest_hills", "dark_forest"},
         {"snowy_taiga_mountains", "snowy_taiga"},
         {"giant_spruce_taiga_hills", "old_growth_spruce_taiga"},
         {"modified_gravelly_mountains", "windswept_gravelly_hills"},
         {"shattered_savanna_plateau", "windswept_savanna"},
         {"modified_wooded_badlands_plateau", "wooded_badlands"},
         {"modified_badlands_plateau", "badlands"},
         {"bamboo_jungle_hills", "bamboo_jungle"},
         {"", ""}}};
    for (const auto& [old, now] : kMerged)
        if (old == name) return now;
    return name;
}

std::string legacy_biome_name(u32 id) {
    const char* name = id < kFirst.size() ? kFirst[id] : rare_biome(id);
    if (!name) return id == 255 ? "vitrail:none" : fmt::format("legacy:biome_{}", id);
    return "minecraft:" + std::string(merged_into(name));
}

} // namespace vitrail
