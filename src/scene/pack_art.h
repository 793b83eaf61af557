// Block pictures of resource packs: albedo with its animation and material, cut into square frames, and pictures made
// of them.
#pragma once

#include "formats/image.h"
#include "formats/resource_pack.h"

#include <optional>
#include <string>
#include <vector>

namespace vitrail::scene {

enum class AlphaKind : u8 { full, holes, partial }; // all 255; 0 and 255; anything else too

struct TextureArt {
    std::string name; // for reports
    // RGBA, square frames from the top. The others are empty, or strips of their own size: normal x and y in red and
    // green, and roughness and emission in red.
    Image albedo, normal, roughness, emission;
    struct Step {
        u16 frame = 0, ticks = 1; // 1/20 s
    };
    std::vector<Step> steps; // empty: still
    bool interpolate = false;
    AlphaKind alpha = AlphaKind::full;
    bool tint_mask = false; // alpha says how much of its tint a texel takes, and nothing of holes
    u64 decoded_bytes = 0;  // what reading it took, before pictures were brought to their size
    bool old_names = false; // of a pack before 1.13, which paints water blue
    u32 side() const { return albedo.width; }
    u32 frames() const { return albedo.width ? albedo.height / albedo.width : 0; }
};

struct ArtLimits {
    static constexpr std::size_t kMaxPictureBytes = 16u << 20;
    static constexpr u32 kMaxSteps = 256;
    u32 side_most = 256;   // larger pictures are halved until they fit
    u32 frames_most = 128; // frames beyond are not shown
};

// "minecraft/textures/block/stone" without .png, of this pack, with .mcmeta and maps from the same. Nothing where it is
// not there or broken (reported). `glow_suffix` as OptiFine's emissive.properties has it.
std::optional<TextureArt> load_art(const ResourcePack& pack, const std::string& path, const std::string& glow_suffix,
                                   const ArtLimits& limits, PackReport& report);

// Of OptiFine's or MCPatcher's emissive.properties, "_e" where there is none.
std::string glow_suffix(const ResourcePack& pack);

AlphaKind alpha_kind(const Image& rgba);

// One layer of a cube's face: the part of a picture that it shows, in 1/16 (left > right mirrors), and its quarter
// turns clockwise.
struct FaceLayer {
    const TextureArt* art = nullptr;
    std::array<float, 4> uv{0, 0, 16, 16}; // left, top, right, bottom
    u8 turns = 0;
    bool tinted = false;
};

// The picture that the layers give over each other, upright; with several layers alpha becomes the tint mask where some
// are tinted. Frames are those of the first animated layer.
TextureArt compose_art(const std::vector<FaceLayer>& layers, std::string name);

} // namespace vitrail::scene
