#include "world/block_registry.h"

#include "base/assert.h"

namespace vitrail {

BlockRegistry::BlockRegistry() {
    add_texture({"unknown", 1});
    BlockDef unknown;
    unknown.name = "vitrail:unknown";
    add_block(unknown);
    BlockDef air;
    air.name = "minecraft:air";
    air.look.shape = ShapeKind::none;
    air.look.opacity = 0;
    air.look.transparency = 1;
    air.look.collision = false;
    air.look.replaceable = true;
    add_block(air);
    BiomeDef none;
    none.name = "vitrail:none";
    add_biome(none);
}

BlockId BlockRegistry::add_block(BlockDef def) {
    const auto [it, added] = block_index_.emplace(def.name, u32(blocks_.size()));
    auto note = [&](const BlockLook& look) {
        for (const auto& name : look.textures)
            texture_id(name);
        for (const auto& box : look.boxes)
            if (!box.texture.empty()) texture_id(box.texture);
    };
    note(def.look);
    for (const auto& variant : def.variants)
        note(variant.look);
    if (added)
        blocks_.push_back(std::move(def));
    else
        blocks_[it->second] = std::move(def);
    return BlockId(it->second);
}

TextureId BlockRegistry::texture_id(std::string_view name) {
    const auto [it, added] = texture_index_.emplace(std::string(name), u32(textures_.size()));
    if (added) {
        VX_ASSERT(textures_.size() < 65535);
        textures_.push_back({std::string(name), 1});
    }
    return TextureId(it->second);
}

void BlockRegistry::add_texture(TextureDef def) {
    const TextureId id = texture_id(def.name);
    textures_[std::size_t(id)] = std::move(def);
}

void BlockRegistry::add_biome(BiomeDef def) {
    const auto [it, added] = biome_index_.emplace(def.name, u32(biomes_.size()));
    if (added)
        biomes_.push_back(std::move(def));
    else
        biomes_[it->second] = std::move(def);
}

BlockId BlockRegistry::find_block(std::string_view name) const {
    const auto it = block_index_.find(std::string(name));
    return it == block_index_.end() ? BlockId::unknown : BlockId(it->second);
}

std::optional<TextureId> BlockRegistry::find_texture(std::string_view name) const {
    const auto it = texture_index_.find(std::string(name));
    if (it == texture_index_.end()) return std::nullopt;
    return TextureId(it->second);
}

const BiomeDef& BlockRegistry::biome_named(std::string_view name) const {
    const auto it = biome_index_.find(std::string(name));
    return biomes_[it == biome_index_.end() ? 0 : it->second];
}

} // namespace vitrail
