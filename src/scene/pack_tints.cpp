#include "scene/pack_tints.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace vitrail::scene {

namespace {

int number(const StateInfo& info, std::string_view property, int most) {
    const std::string_view text = info.state.get(property);
    int value = 0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return std::clamp(value, 0, most);
}

BlockTint fixed(u32 rgb) {
    return {TintKind::fixed, {u8(rgb >> 16), u8(rgb >> 8), u8(rgb)}, false};
}

// Wire glows by its power.
BlockTint wire(int power) {
    const float f = float(power) / 15;
    const auto byte = [](float v) { return u8(std::clamp(v, 0.0f, 1.0f) * 255); };
    return {TintKind::fixed,
            {byte(f * 0.6f + (power > 0 ? 0.4f : 0.3f)), byte(f * f * 0.7f - 0.5f), byte(f * f * 0.6f - 0.7f)},
            false};
}

} // namespace

std::optional<BlockTint> minecraft_tint(const StateInfo& info) {
    std::string_view name = info.state.name;
    if (!name.starts_with("minecraft:")) return std::nullopt;
    name.remove_prefix(10);
    const auto is_one_of = [&](std::initializer_list<std::string_view> names) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    if (name == "grass_block") {
        if (info.state.get("snowy") == "true") return BlockTint{};
        return BlockTint{TintKind::grass, {255, 255, 255}, true};
    }
    if (is_one_of({"short_grass", "grass", "fern", "tall_grass", "large_fern", "potted_fern", "sugar_cane", "bush"}))
        return BlockTint{TintKind::grass, {255, 255, 255}, false};
    if (is_one_of({"oak_leaves", "jungle_leaves", "acacia_leaves", "dark_oak_leaves", "mangrove_leaves", "vine"}))
        return BlockTint{TintKind::foliage, {255, 255, 255}, false};
    if (name == "birch_leaves") return fixed(0x80a755);
    if (name == "spruce_leaves") return fixed(0x619961);
    if (name == "lily_pad") return fixed(0x208030);
    if (is_one_of({"attached_melon_stem", "attached_pumpkin_stem"})) return fixed(0xe0c71c);
    if (is_one_of({"melon_stem", "pumpkin_stem"})) {
        const u32 age = u32(number(info, "age", 7));
        return fixed(age * 32 << 16 | (255 - age * 8) << 8 | age * 4);
    }
    if (name == "redstone_wire") return wire(number(info, "power", 15));
    if (is_one_of({"water", "bubble_column", "water_cauldron"}))
        return BlockTint{TintKind::water, {255, 255, 255}, false};
    if (name.ends_with("_leaves")) return BlockTint{}; // azalea, cherry, ...: painted
    return std::nullopt;
}

std::array<u8, 3> map_color(const Image& map, float temperature, float downfall) {
    const float t = std::clamp(temperature, 0.0f, 1.0f), d = std::clamp(downfall, 0.0f, 1.0f) * t;
    // Warm to the left, wet to the top; the map is 256 x 256 but in odd packs.
    const u32 x = std::min(u32((1 - t) * float(map.width - 1)), map.width - 1);
    const u32 y = std::min(u32((1 - d) * float(map.height - 1)), map.height - 1);
    const u8* p = map.at(x, y);
    return {p[0], p[1], p[2]};
}

bool biome_has_own_colors(std::string_view name) {
    for (const std::string_view own : {"swamp", "badlands", "dark_forest", "cherry_grove", "pale_garden"})
        if (name.ends_with(own)) return true;
    return !name.starts_with("minecraft:");
}

} // namespace vitrail::scene
