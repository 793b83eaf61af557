#include "scene/block_model.h"

#include "base/assert.h"
#include "base/hash.h"
#include "scene/model_builder.h"
#include "scene/pack_looks.h"

#include <algorithm>
#include <atomic>
#include <charconv>
#include <cstring>
#include <deque>
#include <mutex>
#include <string>
#include <sys/mman.h>
#include <unordered_map>

namespace vitrail::scene {

namespace {

constexpr u64 kSways = 1ull << 59, kLiquidFlag = 1ull << 60, kNeverMipped = 1ull << 61;
// A pack's state of more quads, all its looks together, is drawn in content's shape: a section of them must be drawn at
// all.
constexpr std::size_t kMaxPackQuads = 4096;
constexpr u32 kUnknownTints = 48; // hues for blocks that content does not know

template <class T>
T* reserve_zero_pages(std::size_t count) {
    void* p =
        mmap(nullptr, count * sizeof(T), PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    VX_ASSERT(p != MAP_FAILED);
    return static_cast<T*>(p);
}

// What one state needs beyond the flat arrays.
struct StateModel {
    std::vector<StateQuad> quads;
    LiquidLook liquid;
    // Where packs give several looks: ranges of quads, each for random numbers below `end`, the last 2^32. The
    // likeliest is first in quads.
    struct Choice {
        u64 end;
        u32 first, count;
    };
    std::vector<Choice> choices;
};

struct QuadHash {
    std::size_t operator()(const ModelQuad& q) const {
        u64 words[6], h = 0;
        std::memcpy(words, &q, sizeof words);
        for (u64 w : words)
            h = hash_combine(h, w);
        return std::size_t(h);
    }
};

u64 hash_text(std::string_view text) {
    u64 h = text.size();
    for (char c : text)
        h = hash_combine(h, u8(c));
    return h;
}

// A muted hue of the wheel, sRGB.
std::array<u8, 3> hue(u32 i, u32 of) {
    const float h = 6.0f * float(i) / float(of);
    const auto channel = [&](float shift) {
        float d = h + shift;
        while (d >= 6)
            d -= 6;
        const float v = std::clamp(d < 3 ? 2 - d : d - 4, 0.0f, 1.0f);
        return u8(150 + 95 * v);
    };
    return {channel(0), channel(4), channel(2)};
}

ModelPass pass_of(RenderLayer layer) {
    switch (layer) {
    case RenderLayer::solid:
        return ModelPass::opaque;
    case RenderLayer::cutout:
    case RenderLayer::cutout_mipped:
        return ModelPass::cutout;
    case RenderLayer::translucent:
        break;
    }
    return ModelPass::translucent;
}

// Whether this block's facing may point up or down: its side pictures then turn with it (pistons, observers, barrels).
bool six_facings(const BlockDef& def) {
    for (const PropertyDef& p : def.properties)
        if (p.name == "facing") return std::find(p.values.begin(), p.values.end(), "up") != p.values.end();
    return false;
}

// The direction that the pictures' tops point to on the sides, or none.
IVec3 picture_axis(const StateInfo& info, const BlockDef& def) {
    const std::string_view axis = info.state.get("axis");
    const std::size_t n = info.look->textures.size();
    if (n == 2 && axis == "x") return {1, 0, 0};
    if (n == 2 && axis == "z") return {0, 0, 1};
    const std::string_view facing = info.state.get("facing");
    if (facing.empty() || !(n == 2 || ((n == 4 || n == 5) && six_facings(def)))) return {0, 1, 0};
    if (facing == "west") return {-1, 0, 0};
    if (facing == "east") return {1, 0, 0};
    if (facing == "north") return {0, 0, -1};
    if (facing == "south") return {0, 0, 1};
    return facing == "down" ? IVec3{0, -1, 0} : IVec3{0, 1, 0};
}

} // namespace

struct BlockModels::Impl {
    std::shared_ptr<const PackLooks> packs;
    mutable std::mutex mutex;
    std::atomic<u32> size{0};
    StateModel** models = nullptr; // zero pages; null for plain cubes and air
    std::deque<StateModel> owned;
    mutable std::deque<ModelQuad> table;
    mutable std::unordered_map<ModelQuad, u32, QuadHash> index;
    std::vector<std::array<u8, 3>> tints{{255, 255, 255}};
    std::unordered_map<std::string, u16> fluids;

    u8 tint_index(std::array<u8, 3> color) {
        const auto distance = [&](const std::array<u8, 3>& t) {
            int d = 0;
            for (u32 c = 0; c < 3; ++c)
                d += (int(t[c]) - int(color[c])) * (int(t[c]) - int(color[c]));
            return d;
        };
        const auto nearest = std::min_element(tints.begin(), tints.end(),
                                              [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
        if (*nearest == color || tints.size() >= 256) return u8(nearest - tints.begin());
        tints.push_back(color);
        return u8(tints.size() - 1);
    }

    u32 intern(const ModelQuad& quad) const {
        const auto [it, added] = index.emplace(quad, u32(table.size()));
        if (!added) return it->second;
        if (table.size() >= kMaxModelQuads) {
            index.erase(it);
            return kMaxModelQuads;
        }
        table.push_back(quad);
        return it->second;
    }

    struct Dye {
        TintKind kind;
        u8 fixed;
        bool top_only;
    };
    Dye dye_of(const StateInfo& info, u8 flags) {
        if (flags & kUnknownState)
            return {TintKind::fixed, tint_index(hue(u32(hash_text(info.state.name) % kUnknownTints), kUnknownTints)),
                    false};
        const BlockLook& look = *info.look;
        return {look.tint, look.tint == TintKind::fixed ? tint_index(look.tint_color) : u8(0),
                look.tint_faces == TintFaces::top};
    }
    // What content's own shape is dyed with: a pack's picture in it wants Minecraft's color, which may be none.
    struct Dyes {
        Dye content, pack;
    };
    Dyes dyes_of(const StateInfo& info, u8 flags) {
        const Dye content = dye_of(info, flags);
        const auto tint = packs ? PackLooks::tint(info) : std::nullopt;
        return {content, tint ? dye_of(*tint) : content};
    }
    Dye dye_of(const BlockTint& tint) {
        return {tint.kind, tint.kind == TintKind::fixed ? tint_index(tint.fixed) : u8(0), tint.top_only};
    }
    u64 pack(TextureId texture, const Dyes& dyes, Face facing, u64 look_flags) const {
        return pack(texture, packs && packs->replaces(texture) ? dyes.pack : dyes.content, facing, look_flags);
    }
    static u64 pack(TextureId texture, const Dye& dye, Face facing, u64 look_flags) {
        const bool dyed = !dye.top_only || facing == Face::up;
        return u64(texture) << 32 | u64(dyed ? dye.kind : TintKind::none) << 48 | u64(dyed ? dye.fixed : 0) << 51 |
               look_flags;
    }

    LiquidLook liquid_of(const StateInfo& info, u8 flags) {
        LiquidLook out;
        std::string fluid = info.state.name;
        if (fluid == "minecraft:bubble_column" || fluid == "minecraft:flowing_water") fluid = "minecraft:water";
        if (fluid == "minecraft:flowing_lava") fluid = "minecraft:lava";
        out.fluid = fluids.emplace(fluid, u16(fluids.size() + 1)).first->second;
        out.height = u16(liquid_height(info.liquid_level) * 4);
        if (info.liquid_level == 0) out.height = u16(kModelUnit - kLiquidDropUnits);
        Dyes dye = dyes_of(info, flags);
        // Packs before 1.13 paint water blue.
        if (const TextureArt* art = packs ? packs->art(info.face_textures[u32(Face::up)]) : nullptr;
            art && art->old_names)
            dye.pack = {TintKind::none, 0, false};
        out.still = pack(info.face_textures[u32(Face::up)], dye, Face::up, kLiquidFlag);
        out.flow = pack(info.face_textures[u32(Face::north)], dye, Face::up, kLiquidFlag);
        out.pass = pass_of(info.look->layer);
        return out;
    }

    // Of a state that stands in a source of water.
    LiquidLook water_of(const StateTable& states) {
        const BlockId water = states.registry().find_block("minecraft:water");
        if (water == BlockId::unknown) return {};
        StateInfo source;
        source.state.name = "minecraft:water";
        source.block = water;
        source.look = &states.registry().blocks()[u32(water)].look;
        const auto texture = [&](std::size_t i) {
            const auto& names = source.look->textures;
            if (names.empty()) return TextureId::unknown;
            return states.registry().find_texture(names[std::min(i, names.size() - 1)]).value_or(TextureId::unknown);
        };
        source.face_textures = {texture(0), texture(0), texture(1), texture(1), texture(0), texture(0)};
        return liquid_of(source, kLiquid);
    }
};

BlockModels::BlockModels(std::shared_ptr<const PackLooks> packs)
    : impl_(std::make_unique<Impl>()) {
    impl_->packs = std::move(packs);
    kinds_ = reserve_zero_pages<ModelKind>(StateTable::kCapacity);
    looks_ = reserve_zero_pages<FaceLook>(std::size_t(StateTable::kCapacity) * 6);
    groups_ = reserve_zero_pages<u16>(StateTable::kCapacity);
    impl_->models = reserve_zero_pages<StateModel*>(StateTable::kCapacity);
}

BlockModels::~BlockModels() {
    munmap(kinds_, StateTable::kCapacity * sizeof *kinds_);
    munmap(looks_, std::size_t(StateTable::kCapacity) * 6 * sizeof *looks_);
    munmap(groups_, StateTable::kCapacity * sizeof *groups_);
    munmap(impl_->models, StateTable::kCapacity * sizeof *impl_->models);
}

u32 BlockModels::size() const {
    return impl_->size.load(std::memory_order_acquire);
}

void BlockModels::ensure(const StateTable& states) {
    if (states.size() <= size()) return;
    std::lock_guard lock(impl_->mutex);
    const u32 wanted = states.size();
    for (u32 id = impl_->size.load(std::memory_order_relaxed); id < wanted; ++id) {
        compile(states, id);
        impl_->size.store(id + 1, std::memory_order_release);
    }
}

void BlockModels::set_kind(u32 id, const StateInfo& info, ModelKind kind) {
    kinds_[id] = kind;
    if (!hides(kind)) groups_[id] = info.look->material == "leaves" ? u16(1) : u16(2 + u32(info.block) % 65533);
}

// The pass of a picture on a state: what content calls translucent may be sorted, nothing else.
static ModelPass pass_of(AlphaKind alpha, RenderLayer layer) {
    if (alpha == AlphaKind::full) return ModelPass::opaque;
    return alpha == AlphaKind::partial && layer == RenderLayer::translucent ? ModelPass::translucent
                                                                            : ModelPass::cutout;
}

// False where content's own shape is to be drawn.
bool BlockModels::compile_from_packs(const StateTable& states, u32 id) {
    Impl& impl = *impl_;
    const StateInfo& info = states.info(StateId(id));
    const u8 flags = states.flags(StateId(id));
    const BlockLook& look = *info.look;
    const PackStateLook from_packs = impl.packs->look(info);
    if (from_packs.empty()) return false;
    const auto tint = PackLooks::tint(info);
    const bool unknown = flags & kUnknownState; // its hue says only that content does not know it
    Impl::Dye dye = tint      ? impl.dye_of(*tint)
                    : unknown ? Impl::Dye{TintKind::none, 0, false}
                              : impl.dye_of(info, flags);
    dye.top_only = false;
    constexpr Impl::Dye kPlain{TintKind::none, 0, false};
    const bool opaque = flags & kOpaqueCube;
    const bool cube_shape = opaque || look.shape == ShapeKind::cube || look.shape == ShapeKind::pillar;
    const bool sways = look.sway && !cube_shape;
    const auto flags_of = [&](ModelPass pass) {
        return (sways ? kSways : 0) |
               (pass == ModelPass::cutout && look.layer == RenderLayer::cutout ? kNeverMipped : 0);
    };

    StateModel model;
    const auto add = [&](const PackQuad& q) {
        if (model.quads.size() >= kMaxPackQuads) return false;
        const u32 at = impl.intern(q.geometry);
        if (at == kMaxModelQuads) return false;
        const ModelPass pass = pass_of(impl.packs->alpha(q.texture), look.layer);
        model.quads.push_back({u64(at & 2047) << 12 | 1ull << 23 | u64(at >> 11) << 24 |
                                   Impl::pack(q.texture, q.tint >= 0 ? dye : kPlain, q.facing, flags_of(pass)),
                               q.cull, pass});
        return true;
    };
    const auto keep = [&] {
        impl.owned.push_back(std::move(model));
        impl.models[id] = &impl.owned.back();
    };

    const BakedModel* heaviest = from_packs.heaviest();
    if (cube_shape) {
        // Cubes take one look, so that their faces merge.
        if (!heaviest && from_packs.parts.empty()) return false;
        if (!heaviest && from_packs.parts.size() == 1) heaviest = from_packs.parts[0];
        const bool as_cube = heaviest && heaviest->cube && (opaque || heaviest->only_cube);
        bool mask = false, translucent = false;
        if (as_cube) {
            for (const BakedModel::Look& l : heaviest->looks) {
                mask |= l.mask;
                translucent |= pass_of(impl.packs->alpha(l.texture), look.layer) == ModelPass::translucent;
            }
        }
        if (as_cube && (opaque || !mask)) { // a tint mask would be taken for holes
            const u64 look_flags = look.layer == RenderLayer::cutout ? kNeverMipped : 0;
            for (u32 f = 0; f < 6; ++f) {
                const BakedModel::Look& l = heaviest->looks[f];
                looks_[u64(id) * 6 + f] = u64(f) << 20 |
                                          Impl::pack(l.texture, l.tinted ? dye : kPlain, Face(f), look_flags) |
                                          u64(l.turns) << 62;
            }
            set_kind(id, info, opaque ? ModelKind::opaque : translucent ? ModelKind::translucent : ModelKind::cutout);
        } else if (opaque) {
            const Impl::Dyes dyes = impl.dyes_of(info, flags);
            for (u32 f = 0; f < 6; ++f)
                looks_[u64(id) * 6 + f] = u64(f) << 20 | impl.pack(info.face_textures[f], dyes, Face(f), 0);
            set_kind(id, info, ModelKind::opaque);
        }
        if (opaque) { // what stands out of the cube is drawn too
            const auto add_outside = [&](const BakedModel& from) {
                for (const PackQuad& q : from.quads)
                    if (q.outside && !q.fills_face && !add(q)) return;
            };
            if (heaviest)
                add_outside(*heaviest);
            else
                for (const BakedModel* part : from_packs.parts)
                    add_outside(*part);
            if (!model.quads.empty()) {
                kinds_[id] = ModelKind::detailed;
                keep();
            }
            return true;
        }
        if (kinds_[id] != ModelKind::nothing) return true;
    }

    // A model. Content's own shape may be one of its looks.
    if (!from_packs.parts.empty()) {
        for (const BakedModel* part : from_packs.parts)
            for (const PackQuad& q : part->quads)
                if (!add(q)) return false;
    } else {
        if (std::all_of(from_packs.choices.begin(), from_packs.choices.end(),
                        [](const PackChoice& c) { return !c.model; }))
            return false;
        std::vector<PackChoice> choices = from_packs.choices;
        std::iter_swap(choices.begin(),
                       std::max_element(choices.begin(), choices.end(),
                                        [](const PackChoice& a, const PackChoice& b) { return a.weight < b.weight; }));
        u64 total = 0, sum = 0;
        for (const PackChoice& c : choices)
            total += c.weight;
        for (const PackChoice& c : choices) {
            const u32 first = u32(model.quads.size());
            if (c.model) {
                for (const PackQuad& q : c.model->quads)
                    if (!add(q)) return false;
            } else if (!add_own_shape(states, id, model.quads)) {
                return false;
            }
            sum += c.weight;
            model.choices.push_back({(sum << 32) / total, first, u32(model.quads.size()) - first});
        }
        if (model.choices.size() == 1) model.choices.clear();
    }
    if (info.in_water) model.liquid = impl.water_of(states);
    kinds_[id] = ModelKind::model;
    keep();
    return true;
}

// Quads of content's own shape. False where the table is full.
bool BlockModels::add_own_shape(const StateTable& states, u32 id, std::vector<StateQuad>& quads) {
    const StateInfo& info = states.info(StateId(id));
    const BlockLook& look = *info.look;
    const Impl::Dyes dye = impl_->dyes_of(info, states.flags(StateId(id)));
    const u64 look_flags = (look.sway ? kSways : 0) | (look.layer == RenderLayer::cutout ? kNeverMipped : 0);
    for (const BuiltQuad& q : build_shape(info, states.registry())) {
        const u32 at = impl_->intern(q.geometry);
        if (at == kMaxModelQuads) return false;
        quads.push_back({u64(at & 2047) << 12 | 1ull << 23 | u64(at >> 11) << 24 |
                             impl_->pack(q.texture, dye, q.facing, look_flags),
                         q.cull, pass_of(look.layer)});
    }
    return true;
}

void BlockModels::compile(const StateTable& states, u32 id) {
    const StateInfo& info = states.info(StateId(id));
    const u8 flags = states.flags(StateId(id));
    const BlockLook& look = *info.look;
    const BlockDef& def = states.registry().blocks()[u32(info.block)];
    const Impl::Dyes dye = impl_->dyes_of(info, flags);
    const u64 look_flags = (look.sway ? kSways : 0) | (look.layer == RenderLayer::cutout ? kNeverMipped : 0);
    const auto as_cube = [&](ModelKind kind) {
        const IVec3 axis = picture_axis(info, def);
        for (u32 f = 0; f < 6; ++f)
            looks_[u64(id) * 6 + f] = u64(f) << 20 | impl_->pack(info.face_textures[f], dye, Face(f), look_flags) |
                                      u64(axis == IVec3{0, 1, 0} ? 0 : turns_towards(Face(f), axis)) << 62;
        set_kind(id, info, kind);
    };
    if (flags & kAirLike) return;
    if (impl_->packs && look.shape != ShapeKind::liquid && compile_from_packs(states, id)) return;
    if (flags & kOpaqueCube) return as_cube(ModelKind::opaque);
    if (look.shape == ShapeKind::cube || look.shape == ShapeKind::pillar)
        return as_cube(pass_of(look.layer) == ModelPass::translucent ? ModelKind::translucent : ModelKind::cutout);

    StateModel model;
    if (look.shape == ShapeKind::liquid) {
        model.liquid = impl_->liquid_of(info, flags);
        kinds_[id] = ModelKind::liquid;
    } else {
        if (!add_own_shape(states, id, model.quads)) return as_cube(ModelKind::cutout);
        if (info.in_water) model.liquid = impl_->water_of(states);
        kinds_[id] = ModelKind::model;
    }
    impl_->owned.push_back(std::move(model));
    impl_->models[id] = &impl_->owned.back();
}

std::span<const StateQuad> BlockModels::quads(StateId id) const {
    const StateModel* m = impl_->models[u32(id)];
    if (!m) return {};
    if (!m->choices.empty()) return std::span<const StateQuad>(m->quads).first(m->choices[0].count);
    return m->quads;
}

std::span<const StateQuad> BlockModels::quads(StateId id, u32 random) const {
    const StateModel* m = impl_->models[u32(id)];
    if (!m || m->choices.empty()) return quads(id);
    const auto it =
        std::find_if(m->choices.begin(), m->choices.end(), [&](const StateModel::Choice& c) { return random < c.end; });
    return std::span<const StateQuad>(m->quads).subspan(it->first, it->count);
}

const LiquidLook* BlockModels::liquid(StateId id) const {
    const StateModel* m = impl_->models[u32(id)];
    return m && m->liquid.fluid != 0 ? &m->liquid : nullptr;
}

u32 BlockModels::model_quad_count() const {
    std::lock_guard lock(impl_->mutex);
    return u32(impl_->table.size());
}

std::vector<ModelQuad> BlockModels::model_quads(u32 from) const {
    std::lock_guard lock(impl_->mutex);
    if (from >= impl_->table.size()) return {};
    return {impl_->table.begin() + from, impl_->table.end()};
}

ModelQuad BlockModels::model_quad(u32 at) const {
    std::lock_guard lock(impl_->mutex);
    VX_ASSERT(at < impl_->table.size());
    return impl_->table[at];
}

u32 BlockModels::intern_quad(const ModelQuad& quad) const {
    std::lock_guard lock(impl_->mutex);
    return impl_->intern(quad);
}

std::vector<std::array<u8, 3>> BlockModels::fixed_tints() const {
    std::lock_guard lock(impl_->mutex);
    return impl_->tints;
}

} // namespace vitrail::scene
