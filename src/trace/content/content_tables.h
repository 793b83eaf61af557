// The tables that say what block states are to rays (SceneView: states, quads, media, textures), made of the same
// models and pictures that the raster renderer draws. Grows as states do; entries never change unless the models or
// the pictures are others.
//
//     ContentTables content;
//     VX_TRY(content.update(models, states, &pictures));   // then after new states: update(models, states, nullptr)
//     content.fill(scene);                                 // pointers, valid until the next update
#pragma once

#include "base/result.h"
#include "scene/block_model.h"
#include "scene/block_pictures.h"
#include "trace/content/texture_store.h"

#include <map>
#include <tuple>
#include <vector>

namespace vitrail::trace {

class ContentTables {
public:
    ContentTables();

    // models.ensure(states) first. pictures null: those of the last call. Other models than before, or pictures, make
    // everything anew. Errors: invalid_argument (pictures were never given), limit (more than 2^32 quads).
    Result<> update(const scene::BlockModels& models, const StateTable& states, const scene::BlockPictures* pictures);

    // The fields of this part. Texels of `animate` are seen through the same pointers.
    void fill(SceneView& scene) const;
    // Frames of animations; appends layers whose texels changed.
    void animate(double seconds, std::vector<u32>& changed_layers) { textures_.animate(seconds, changed_layers); }

    // For copies on a device: what has grown since, or all where `generation` differs.
    u32 generation() const { return generation_; }
    // Layers get emission that they did not have when a lamp of theirs comes; counts such changes.
    u32 texture_generation() const { return texture_generation_; }
    const std::vector<StateRecord>& states() const { return states_; }
    const std::vector<TraceQuad>& quads() const { return quads_; }
    const std::vector<MediumRecord>& media() const { return media_; }
    const std::vector<u32>& fixed_tints() const { return tints_; }
    const TextureStore& textures() const { return textures_; }

    static constexpr u32 kWater = 1; // of media()

private:
    void add_state(const scene::BlockModels& models, const StateTable& states, StateId id);
    u8 medium_for(const StateInfo& info, u32 layer);
    u8 fluid_medium(const scene::LiquidLook& liquid, const StateInfo& info, bool opaque);
    void set_liquid_tops();
    void set_emission(StateRecord& record, const StateInfo& info);

    const scene::BlockModels* models_ = nullptr;
    u32 generation_ = 0, texture_generation_ = 0;
    bool pictures_given_ = false;
    std::vector<StateRecord> states_;
    std::vector<TraceQuad> quads_;
    std::vector<MediumRecord> media_;
    std::size_t topped_ = 0; // of them have their liquid_top
    std::vector<u32> tints_;
    std::map<std::tuple<BlockId, u32>, u8> medium_of_block_; // by block and layer
    std::map<u16, u8> medium_of_fluid_;
    TextureStore textures_;
    std::vector<scene::ModelQuad> model_quads_;
};

} // namespace vitrail::trace
