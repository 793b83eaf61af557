// PackLooks: what resource packs say of the blocks of a registry, read and baked once: pictures by TextureId, models by
// state, colors of biomes. BlockModels takes it to compile states, the renderer to fill its texture arrays. Immutable
// after loading and thread-safe. docs/formats/resource-packs.md says how what packs say becomes what is drawn.
//
//     PackStack stack = ...;                                  // formats/resource_pack.h
//     const auto packs = PackLooks::load(stack, registry);    // nothing fails: what is broken is in report()
//     BlockModels models(packs);
//     renderer.load_textures(registry, packs.get());
#pragma once

#include "formats/resource_pack.h"
#include "scene/pack_art.h"
#include "scene/pack_bake.h"
#include "scene/pack_tints.h"

#include <memory>
#include <span>
#include <unordered_map>

namespace vitrail::scene {

struct PackLimits {
    ArtLimits art;
    u32 textures_most = 2048;              // layers: registry's and packs' together
    u64 art_bytes_most = u64(1) << 30;     // of decoded pictures
    u64 decoded_bytes_most = u64(8) << 30; // of pictures before they are brought to their size: time, not memory
    u64 quads_most = 1u << 20;             // of baked models
    std::size_t blockstates_most = 8192;
};

// What packs draw of a state.
struct PackChoice {
    u32 weight = 1;
    const BakedModel* model = nullptr; // null: content's own shape, with the packs' pictures
};
struct PackStateLook {
    std::vector<PackChoice> choices;      // of variants: one is drawn
    std::vector<const BakedModel*> parts; // of multipart: all are drawn
    bool empty() const { return choices.empty() && parts.empty(); }
    const BakedModel* heaviest() const; // of choices; null: content's own, or there are none
};

class PackLooks {
public:
    static std::shared_ptr<const PackLooks> load(const PackStack& packs, const BlockRegistry& registry,
                                                 const PackLimits& limits = {});
    ~PackLooks();

    // The picture that a layer shows instead of content's, or nothing.
    const TextureArt* art(TextureId id) const {
        return u32(id) < art_.size() && art_[u32(id)] ? &*art_[u32(id)] : nullptr;
    }
    bool replaces(TextureId id) const { return art(id) != nullptr; }
    u32 texture_count() const { return u32(art_.size()); } // the registry's, then the packs' own
    AlphaKind alpha(TextureId id) const { return u32(id) < alpha_.size() ? alpha_[u32(id)] : AlphaKind::full; }
    u32 largest_side() const { return largest_side_; } // texels, of all pictures; 0 where there are none

    // Empty where the packs have no blockstates for it: content's own look stands.
    PackStateLook look(const StateInfo& info) const;
    // The tint of a pack's picture on this state: Minecraft's where that knows the block, else content's (empty).
    static std::optional<BlockTint> tint(const StateInfo& info) { return minecraft_tint(info); }

    std::optional<std::array<u8, 3>> grass(const BiomeDef& biome) const;
    std::optional<std::array<u8, 3>> foliage(const BiomeDef& biome) const;

    struct Counts {
        u32 packs = 0, replaced_textures = 0, own_textures = 0, made_textures = 0, blockstates = 0, models = 0,
            unresolved_models = 0;
        u64 quads = 0;
    };
    const Counts& counts() const { return counts_; }
    // Textures that models name and that neither packs nor content have; sorted.
    const std::vector<std::string>& missing() const { return missing_; }
    const PackReport& report() const { return report_; }

private:
    struct Loader;
    PackLooks() = default;
    struct Case {
        StateCondition when;
        std::vector<PackChoice> apply;
    };
    struct Block {
        bool multipart = false;
        std::vector<Case> cases;
    };
    std::vector<std::optional<TextureArt>> art_;
    std::vector<AlphaKind> alpha_;
    u32 largest_side_ = 0;
    std::vector<std::unique_ptr<BakedModel>> models_;
    std::unordered_map<std::string, Block> blocks_;
    Image grass_map_, foliage_map_;
    Counts counts_;
    std::vector<std::string> missing_;
    PackReport report_;
};

} // namespace vitrail::scene
