// BlockRegistry: the content of a world, read once: blocks, textures, biomes, hotbar. Immutable after loading.
#pragma once

#include "base/types.h"
#include "voxel/chunk.h"
#include "world/block_def.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace vitrail {

// Index into BlockRegistry::blocks; 0 is the unknown block.
enum class BlockId : u32 { unknown = 0 };
// Index into BlockRegistry::textures and layer of the texture arrays' first frame table; 0 is the plain unknown texture.
enum class TextureId : u16 { unknown = 0 };

struct TextureDef {
    std::string name;   // file stem below content/*/textures
    u32 frame_time = 1; // server ticks an animation frame stays
};

struct BiomeDef {
    std::string name;
    float temperature = 0.8f, downfall = 0.4f;
    // sRGB 0..255
    std::array<u8, 3> grass{127, 178, 89}, foliage{104, 158, 70}, water{63, 118, 228}, sky{120, 167, 255},
        fog{192, 216, 255};
};

class BlockRegistry {
public:
    BlockRegistry(); // holds vitrail:unknown and minecraft:air, biome vitrail:none, texture "unknown"

    // Adds or replaces (same name: the later wins, ids stay).
    BlockId add_block(BlockDef def);
    void add_texture(TextureDef def);
    void add_biome(BiomeDef def);
    TextureId texture_id(std::string_view name); // adds a name not seen yet

    const std::vector<BlockDef>& blocks() const { return blocks_; }
    const std::vector<TextureDef>& textures() const { return textures_; }
    const std::vector<BiomeDef>& biomes() const { return biomes_; }
    BlockId find_block(std::string_view name) const;                   // unknown where there is none
    std::optional<TextureId> find_texture(std::string_view name) const;
    const BiomeDef& biome_named(std::string_view name) const;          // the plain one where there is none
    std::vector<std::string> hotbar;                                   // block names
    std::vector<std::string> content_roots;                            // folders that hold textures/, first wins
    u64 content_hash = 0;                                              // XXH3 of the scripts all this was read from

private:
    std::vector<BlockDef> blocks_;
    std::vector<TextureDef> textures_;
    std::vector<BiomeDef> biomes_;
    std::unordered_map<std::string, u32> block_index_, texture_index_, biome_index_;
};

} // namespace vitrail
