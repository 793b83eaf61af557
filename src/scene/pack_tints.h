// Minecraft's colors of blocks and biomes, for pictures that packs leave gray. Facts after "Block colors" and "Biome"
// of https://minecraft.wiki.
#pragma once

#include "formats/image.h"
#include "world/state_table.h"

#include <optional>

namespace vitrail::scene {

struct BlockTint {
    TintKind kind = TintKind::none;
    std::array<u8, 3> fixed{255, 255, 255}; // sRGB, for TintKind::fixed
    bool top_only = false;                  // on content's own shape, whose other faces are painted
};

// What Minecraft multiplies the tinted faces of this state with; none for blocks it does not tint. Nothing: it does not
// know the block.
std::optional<BlockTint> minecraft_tint(const StateInfo& info);

// The color of a map (colormap/grass.png) at a climate, temperature and downfall both held to 0..1. `map` is not empty.
std::array<u8, 3> map_color(const Image& map, float temperature, float downfall);

// Whether a biome has grass and foliage of its own that no color map knows.
bool biome_has_own_colors(std::string_view name);

} // namespace vitrail::scene
