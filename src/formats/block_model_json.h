// Minecraft's blockstates and block models, from JSON to plain data: what a file says, then a model with its parents
// laid over each other and its textures named. Everything is held to the bounds below; what is beyond is an error with
// its place.
//
// Facts after the pages "Model", "Blockstates definition" and "Resource pack" of https://minecraft.wiki.
#pragma once

#include "base/bytes.h"
#include "base/result.h"

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

namespace vitrail {

// Directions count as voxel/coords.h's Face: west, east, down, up, north, south.
struct ModelFaceJson {
    std::string texture; // "#key" in a file; in a resolved model "namespace:path", or empty where nothing names it
    std::optional<std::array<float, 4>>
        uv;        // 1/16 texture: left, top, right, bottom; none: as the element lies in its block
    u8 turns = 0;  // quarter turns of the picture, clockwise
    u8 cull = 6;   // left out where the neighbor on this side is a full cube; 6 never
    i32 tint = -1; // tint index, -1 none
};

struct ModelElementJson {
    std::array<float, 3> from{}, to{16, 16, 16}; // 1/16 block, -16..32
    struct Rotation {
        std::array<float, 3> origin{8, 8, 8};
        u8 axis = 1; // 0 x, 1 y, 2 z
        float degrees = 0;
        bool rescale = false;
    };
    std::optional<Rotation> rotation;
    bool shade = true;
    std::array<std::optional<ModelFaceJson>, 6> faces;
};

struct BlockModelJson {
    static constexpr std::size_t kMaxElements = 1024, kMaxTextures = 256;
    std::string parent; // empty: none
    std::map<std::string, std::string, std::less<>> textures;
    std::optional<std::vector<ModelElementJson>> elements;
    std::optional<bool> ambient_occlusion;
};

// Errors: damaged, limit.
Result<BlockModelJson> parse_block_model(ByteView text);

// A model to draw, and how it is turned.
struct ModelVariantJson {
    std::string model; // "namespace:path"
    u16 x = 0, y = 0;  // degrees, 0 90 180 270: about the x axis first, then y
    bool uv_lock = false;
    u32 weight = 1; // 1..65535
};
using ModelChoice = std::vector<ModelVariantJson>; // one of them, by weight

// property -> values, any of which matches; `negated`: any but these.
struct StateTerm {
    std::string property;
    std::vector<std::string> values;
    bool negated = false;
};

// All terms of one of the lists must match; no list at all matches every state.
using StateCondition = std::vector<std::vector<StateTerm>>;

struct BlockstatesJson {
    static constexpr std::size_t kMaxCases = 16384, kMaxChoices = 256, kMaxTerms = 256;
    struct Case {
        StateCondition when;
        ModelChoice apply;
    };
    bool multipart = false; // every case that matches is drawn; else the first
    std::vector<Case> cases;
};

// Errors: damaged, limit.
Result<BlockstatesJson> parse_blockstates(ByteView text);

// A model with all that its parents say.
struct ResolvedModel {
    std::vector<ModelElementJson> elements; // none: drawn by other means than this model (chests, signs, ...)
    bool ambient_occlusion = true;
    std::vector<std::string> missing; // texture keys that nothing names
};

// Models by name, each read and resolved once. Not thread-safe.
class ModelLibrary {
public:
    static constexpr u32 kMaxParents = 32;
    // Gives the bytes of a model's file, or nothing where there is none. `name` is "namespace:path".
    using Source = std::function<std::optional<Bytes>(const std::string& name)>;
    explicit ModelLibrary(Source source);
    // Errors: not_found (this model or a parent, which the message names), damaged, limit (a circle of parents).
    Result<std::shared_ptr<const ResolvedModel>> resolve(const std::string& name);
    std::size_t size() const { return resolved_.size(); }

private:
    Result<std::shared_ptr<const BlockModelJson>> file(const std::string& name);
    Source source_;
    std::unordered_map<std::string, Result<std::shared_ptr<const BlockModelJson>>> files_;
    std::unordered_map<std::string, Result<std::shared_ptr<const ResolvedModel>>> resolved_;
};

// The model that every pack may take as parent although no pack holds it ("minecraft:block/cube_all", ...), as JSON;
// empty for others. Geometry is fact; these texts are ours.
std::string_view builtin_block_model(std::string_view name);

} // namespace vitrail
