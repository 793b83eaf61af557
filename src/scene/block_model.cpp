#include "scene/block_model.h"

#include "base/assert.h"
#include "base/hash.h"
#include "scene/model_builder.h"

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
        const Dye dye = dye_of(info, flags);
        out.still = pack(info.face_textures[u32(Face::up)], dye, Face::up, kLiquidFlag);
        out.flow = pack(info.face_textures[u32(Face::north)], dye, Face::up, kLiquidFlag);
        out.pass = pass_of(info.look->layer);
        return out;
    }
};

BlockModels::BlockModels()
    : impl_(std::make_unique<Impl>()) {
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

void BlockModels::compile(const StateTable& states, u32 id) {
    const StateInfo& info = states.info(StateId(id));
    const u8 flags = states.flags(StateId(id));
    const BlockLook& look = *info.look;
    const BlockDef& def = states.registry().blocks()[u32(info.block)];
    const Impl::Dye dye = impl_->dye_of(info, flags);
    const u64 look_flags = (look.sway ? kSways : 0) | (look.layer == RenderLayer::cutout ? kNeverMipped : 0);
    const auto as_cube = [&](ModelKind kind) {
        const IVec3 axis = picture_axis(info, def);
        for (u32 f = 0; f < 6; ++f)
            looks_[u64(id) * 6 + f] = u64(f) << 20 | Impl::pack(info.face_textures[f], dye, Face(f), look_flags) |
                                      u64(axis == IVec3{0, 1, 0} ? 0 : turns_towards(Face(f), axis)) << 62;
        kinds_[id] = kind;
        if (kind != ModelKind::opaque)
            groups_[id] = look.material == "leaves" ? u16(1) : u16(2 + u32(info.block) % 65533);
    };
    if (flags & kAirLike) return;
    if (flags & kOpaqueCube) return as_cube(ModelKind::opaque);
    if (look.shape == ShapeKind::cube || look.shape == ShapeKind::pillar)
        return as_cube(pass_of(look.layer) == ModelPass::translucent ? ModelKind::translucent : ModelKind::cutout);

    StateModel model;
    if (look.shape == ShapeKind::liquid) {
        model.liquid = impl_->liquid_of(info, flags);
        kinds_[id] = ModelKind::liquid;
    } else {
        for (const BuiltQuad& q : build_shape(info, states.registry())) {
            const u32 at = impl_->intern(q.geometry);
            if (at == kMaxModelQuads) return as_cube(ModelKind::cutout);
            model.quads.push_back({u64(at & 2047) << 12 | 1ull << 23 | u64(at >> 11) << 24 |
                                       Impl::pack(q.texture, dye, q.facing, look_flags),
                                   q.cull, pass_of(look.layer)});
        }
        if (info.in_water) {
            const BlockId water = states.registry().find_block("minecraft:water");
            if (water != BlockId::unknown) {
                StateInfo source;
                source.state.name = "minecraft:water";
                source.block = water;
                source.look = &states.registry().blocks()[u32(water)].look;
                const auto texture = [&](std::size_t i) {
                    const auto& names = source.look->textures;
                    if (names.empty()) return TextureId::unknown;
                    return states.registry()
                        .find_texture(names[std::min(i, names.size() - 1)])
                        .value_or(TextureId::unknown);
                };
                source.face_textures = {texture(0), texture(0), texture(1), texture(1), texture(0), texture(0)};
                model.liquid = impl_->liquid_of(source, kLiquid);
            }
        }
        kinds_[id] = ModelKind::model;
    }
    impl_->owned.push_back(std::move(model));
    impl_->models[id] = &impl_->owned.back();
}

std::span<const StateQuad> BlockModels::quads(StateId id) const {
    const StateModel* m = impl_->models[u32(id)];
    return m ? std::span<const StateQuad>(m->quads) : std::span<const StateQuad>();
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
