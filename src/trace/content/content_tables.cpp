#include "trace/content/content_tables.h"

#include "scene/liquid_surface.h"

#include "trace/content/emission.h"
#include "trace/content/model_quads.h"
#include "trace/kernel/surface.h"

#include <algorithm>
#include <cmath>

namespace vitrail::trace {

using scene::ModelKind;

namespace {

constexpr u32 kMediaMost = 255; // u8

static_assert(kTintNone == u32(TintKind::none) && kTintFixed == u32(TintKind::fixed) && u32(TintKind::grass) == 1 &&
              u32(TintKind::foliage) == 2 && u32(TintKind::water) == 3);

u32 model_index(u64 bits) {
    return u32(bits >> 12 & 2047) | u32(bits >> 24 & 255) << 11;
}

} // namespace

ContentTables::ContentTables()
    : states_(1) {
    MediumRecord water;
    water.ior = 1.333f, water.tinted = true, water.kind = 1;
    media_ = {MediumRecord{}, water};
}

Result<> ContentTables::update(const scene::BlockModels& models, const StateTable& states,
                               const scene::BlockPictures* pictures) {
    if (!pictures && !pictures_given_) return fail(ErrorCode::invalid_argument, "no pictures of blocks were given");
    if (pictures || &models != models_) {
        if (pictures) textures_.load(*pictures);
        pictures_given_ = true;
        models_ = &models;
        ++generation_;
        states_.clear();
        quads_.clear();
        model_quads_.clear();
        media_.resize(2);
        topped_ = 0;
        medium_of_block_.clear();
        medium_of_fluid_.clear();
    }
    const u32 count = std::min(models.size(), states.size());
    const std::vector<scene::ModelQuad> more = models.model_quads(u32(model_quads_.size()));
    model_quads_.insert(model_quads_.end(), more.begin(), more.end());
    tints_.clear();
    for (const auto& t : models.fixed_tints())
        tints_.push_back(u32(t[0]) | u32(t[1]) << 8 | u32(t[2]) << 16 | 0xff000000u);
    tints_.resize(256, 0xffffffffu); // states compiled meanwhile may have newer ones
    for (u32 id = u32(states_.size()); id < count; ++id)
        add_state(models, states, StateId(id));
    if (states_.empty()) states_.resize(1);
    set_liquid_tops();
    return {};
}

// Corners are means of the levels around them, in steps of 4 (scene/liquid_surface.h).
void ContentTables::set_liquid_tops() {
    std::vector<u16> tops(media_.size(), u16(scene::kLiquidLevel));
    for (const StateRecord& r : states_)
        if (r.kind == CellKind::liquid || r.kind == CellKind::model)
            tops[r.medium] = std::max<u16>(tops[r.medium], u16((r.liquid_height + 1 + 2) & ~3));
    for (std::size_t i = 0; i < media_.size(); ++i) {
        if (media_[i].liquid_top == tops[i]) continue;
        media_[i].liquid_top = tops[i];
        if (i < topped_) ++generation_; // copies of the table have the old one
    }
    topped_ = media_.size();
}

void ContentTables::fill(SceneView& scene) const {
    scene.states = states_.data();
    scene.state_count = u32(states_.size());
    scene.quads = quads_.data();
    scene.media = media_.data();
    scene.textures = textures_.view();
    scene.fixed_tints = tints_.data();
}

// The inside of a clear cube or body.
u8 ContentTables::medium_for(const StateInfo& info, u32 layer) {
    const auto [it, added] = medium_of_block_.emplace(std::tuple(info.block, layer), u8(0));
    if (!added) return it->second;
    const MediumRecord m = medium_of(*info.look, textures_.mean(layer));
    if (media_.size() > kMediaMost) { // the most alike of its optics
        std::size_t best = 2;
        const auto unlike = [&](const MediumRecord& o) {
            const Vec3 d = o.absorption - m.absorption;
            return dot(d, d) + 100 * std::fabs(o.ior - m.ior);
        };
        for (std::size_t i = 2; i < media_.size(); ++i)
            if (unlike(media_[i]) < unlike(media_[best])) best = i;
        return it->second = u8(best);
    }
    media_.push_back(m);
    return it->second = u8(media_.size() - 1);
}

u8 ContentTables::fluid_medium(const scene::LiquidLook& liquid, const StateInfo& info, bool opaque) {
    const auto found = medium_of_fluid_.find(liquid.fluid);
    if (found != medium_of_fluid_.end()) return found->second;
    u8 medium = kWater;
    if (opaque || info.look->material != "water") {
        if (info.in_water) return kWater; // a plant's own material says nothing of the water around it
        if (media_.size() > kMediaMost) return kWater;
        media_.push_back(medium_of(*info.look, textures_.mean(u32(info.face_textures[u32(Face::up)]))));
        medium = u8(media_.size() - 1);
    }
    medium_of_fluid_.emplace(liquid.fluid, medium);
    return medium;
}

void ContentTables::add_state(const scene::BlockModels& models, const StateTable& states, StateId id) {
    StateRecord r;
    const StateInfo& info = states.info(id);
    const ModelKind kind = models.kinds()[u32(id)];
    const Optics optics = optics_of(*info.look, kind);
    r.optics = u8(optics);
    r.first_quad = u32(quads_.size());

    const auto add_quads = [&] {
        const bool clear = optics == Optics::dielectric || optics == Optics::water;
        for (const scene::StateQuad& q : models.quads(id)) {
            const u32 at = model_index(q.bits);
            if (at >= model_quads_.size() || quads_.size() - r.first_quad >= 0xfffe) continue;
            const u8 medium = clear ? medium_for(info, u32(q.bits >> 32 & 0xffff)) : u8(0);
            // In the opaque pass nothing is clear, whatever the block is.
            const Optics own =
                q.pass == scene::ModelPass::opaque && (clear || optics == Optics::thin) ? Optics::matte : optics;
            add_trace_quads(model_quads_[at], q, own, own == optics ? medium : 0, quads_);
        }
        r.quads = u16(quads_.size() - r.first_quad);
    };
    const auto faces = models.faces(id);

    switch (kind) {
    case ModelKind::nothing:
        break;
    case ModelKind::opaque:
    case ModelKind::detailed:
        std::copy(faces.begin(), faces.end(), r.faces);
        r.kind = kind == ModelKind::opaque ? CellKind::cube : CellKind::detailed;
        if (kind == ModelKind::detailed) add_quads();
        break;
    case ModelKind::cutout:
    case ModelKind::translucent:
        std::copy(faces.begin(), faces.end(), r.faces);
        r.kind = CellKind::cutout;
        if (optics == Optics::thin || optics == Optics::dielectric || optics == Optics::water) {
            r.kind = CellKind::medium; // of thin glass: 0, air within sheets
            if (optics != Optics::thin) r.medium = medium_for(info, u32(faces[0] >> 32 & 0xffff));
        }
        break;
    case ModelKind::liquid: {
        const scene::LiquidLook* liquid = models.liquid(id);
        if (!liquid) break;
        r.kind = CellKind::liquid;
        for (u32 f = 0; f < 6; ++f)
            r.faces[f] = (f == 2 || f == 3 ? liquid->still : liquid->flow) | u64(f) << 20;
        r.medium = fluid_medium(*liquid, info, optics != Optics::water && optics != Optics::dielectric);
        r.liquid_height = u8(std::clamp<u32>(liquid->height, 1, 256) - 1);
        break;
    }
    case ModelKind::model:
        r.kind = CellKind::model;
        add_quads();
        if (const scene::LiquidLook* liquid = models.liquid(id)) {
            r.medium = kWater;
            r.liquid_height = u8(std::clamp<u32>(liquid->height, 1, 256) - 1);
        }
        break;
    }
    set_emission(r, info);
    states_.push_back(r);
}

void ContentTables::set_emission(StateRecord& r, const StateInfo& info) {
    if (r.kind == CellKind::empty) return;
    std::vector<TraceQuad> pieces(quads_.begin() + r.first_quad, quads_.begin() + r.first_quad + r.quads);
    if (r.kind != CellKind::model)
        for (const u64 face : r.faces)
            pieces.push_back(quad_of_face(face));
    const auto& light = info.look->light;
    const bool lamp = light[0] || light[1] || light[2];
    const auto shines = [&](const TraceQuad& q) { return textures_.painted_emission(q.texture); };
    const bool painted = std::any_of(pieces.begin(), pieces.end(), shines);
    if (!lamp && !painted) return;
    if (painted) // other parts may have got emission for another lamp's sake
        for (u32 i = r.first_quad; i < r.first_quad + r.quads; ++i)
            if (!shines(quads_[i])) quads_[i].emission_scale = pieces[i - r.first_quad].emission_scale = 0;
    Vec3 emission{kGlow, kGlow, kGlow};
    if (lamp) {
        if (!painted) {
            const Vec3 hue{float(light[0]), float(light[1]), float(light[2])};
            for (const TraceQuad& q : pieces)
                textures_.derive_emission(q.texture, hue);
            ++texture_generation_;
        }
        const bool alike = r.kind == CellKind::liquid || r.kind == CellKind::medium;
        emission = lamp_emission(light, pieces, textures_.view(), tints_.data(), alike);
    }
    for (u32 i = r.first_quad; i < r.first_quad + r.quads; ++i)
        set_shining_part(quads_[i], textures_.view(), tints_.data(), textures_.animated(quads_[i].texture));
    const float parts[3] = {emission.x, emission.y, emission.z};
    for (u32 c = 0; c < 3; ++c)
        r.emission[c] = u16(std::clamp(parts[c] / StateRecord::kEmissionUnit + 0.5f, 0.0f, 65535.0f));
}

} // namespace vitrail::trace
