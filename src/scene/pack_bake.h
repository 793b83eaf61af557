// A pack's model, turned as a variant says, to quads in block space; and whether it is a full cube that the mesher can
// merge.
#pragma once

#include "formats/block_model_json.h"
#include "scene/block_model.h"

#include <optional>

namespace vitrail::scene {

struct PackQuad {
    ModelQuad geometry;
    TextureId texture{};
    u8 cull = StateQuad::kNoCull;
    Face facing = Face::up;
    i32 tint = -1;           // the face's tint index, -1 none
    bool fills_face = false; // lies in its cell's face and fills it
    bool outside = false;    // some of it lies beyond the cell
};

// A face of a full cube: one picture or several over each other, from below.
struct PackFace {
    struct Layer {
        TextureId texture{};
        std::array<float, 4> uv{
            0, 0, 16, 16}; // 1/16 texture: left, top, right, bottom of the unturned picture; left > right mirrors
        u8 turns = 0;      // quarter turns clockwise
        i32 tint = -1;
        // The whole picture as it is: a FaceLook can say it.
        bool plain() const { return uv == std::array<float, 4>{0, 0, 16, 16}; }
        friend bool operator==(const Layer&, const Layer&) = default;
    };
    std::vector<Layer> layers;
};

struct BakedModel {
    std::vector<PackQuad> quads;
    std::optional<std::array<PackFace, 6>> cube; // where the quads that fill faces leave none open
    bool only_cube = false;                      // and there are no others
    // What to pack as FaceLook, set by the looks' loader: one texture a face, its turns and whether it is tinted.
    struct Look {
        TextureId texture{};
        u8 turns = 0;
        bool tinted = false, mask = false; // mask: the texture's alpha is its tint mask
    };
    std::array<Look, 6> looks{};
};

// `texture` gives the id of a name, "namespace:path"; it is asked for every face, also with "" where the model names
// none.
BakedModel bake_model(const ResolvedModel& model, const ModelVariantJson& variant,
                      const std::function<TextureId(const std::string&)>& texture);

} // namespace vitrail::scene
