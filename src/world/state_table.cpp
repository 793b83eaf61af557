#include "world/state_table.h"

#include "base/assert.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <fmt/format.h>
#include <sys/mman.h>

namespace vitrail {

namespace {

template <class T>
T* reserve_zero_pages() {
    void* p = mmap(nullptr, StateTable::kCapacity * sizeof(T), PROT_READ | PROT_WRITE,
                   MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    VX_ASSERT(p != MAP_FAILED);
    return static_cast<T*>(p);
}

bool matches(const BlockVariant& variant, const BlockState& state) {
    return std::all_of(variant.when.begin(), variant.when.end(),
                       [&](const auto& condition) { return state.get(condition.first) == condition.second; });
}

// Turns a texture list of 1 to 6 names (block_def.h) into six faces, by the state's axis and facing.
std::array<TextureId, 6> resolve_faces(const BlockLook& look, const BlockState& state, const BlockRegistry& registry) {
    std::array<TextureId, 6> faces{};
    const std::size_t n = look.textures.size();
    if (n == 0) return faces;
    std::array<TextureId, 6> t{};
    for (std::size_t i = 0; i < n && i < 6; ++i)
        t[i] = registry.find_texture(look.textures[i]).value_or(TextureId::unknown);
    constexpr int west = 0, east = 1, down = 2, up = 3, north = 4, south = 5;
    switch (n) {
    case 1:
        faces.fill(t[0]);
        break;
    case 2:
        faces = {t[0], t[0], t[1], t[1], t[0], t[0]};
        break;
    case 3:
        faces = {t[0], t[0], t[2], t[1], t[0], t[0]};
        break;
    case 4:
        faces = {t[1], t[1], t[3], t[2], t[0], t[1]};
        break; // front looks north until turned
    case 5:
        faces = {t[2], t[2], t[4], t[3], t[0], t[1]};
        break;
    default:
        faces = t;
        break;
    }
    if (const auto axis = state.get("axis"); !axis.empty() && n == 2) {
        if (axis == "x") faces = {t[1], t[1], t[0], t[0], t[0], t[0]};
        if (axis == "z") faces = {t[0], t[0], t[0], t[0], t[1], t[1]};
    }
    if (const auto facing = state.get("facing"); !facing.empty() && (n == 4 || n == 5)) {
        const TextureId front = t[0], back = n == 5 ? t[1] : t[1], side = n == 5 ? t[2] : t[1];
        const TextureId top = n == 5 ? t[3] : t[2], bottom = n == 5 ? t[4] : t[3];
        if (facing == "up")
            faces = {side, side, back, front, side, side};
        else if (facing == "down")
            faces = {side, side, front, back, side, side};
        else {
            faces = {side, side, bottom, top, side, side};
            const int f = facing == "west" ? west : facing == "east" ? east : facing == "south" ? south : north;
            faces[std::size_t(f)] = front;
            faces[std::size_t(f ^ 1)] = back;
        }
    } else if (!facing.empty() && n == 2) { // side and end: the ends lie along the facing
        if (facing == "west" || facing == "east")
            faces = {t[1], t[1], t[0], t[0], t[0], t[0]};
        else if (facing == "north" || facing == "south")
            faces = {t[0], t[0], t[0], t[0], t[1], t[1]};
    }
    (void)down;
    (void)up;
    return faces;
}

const BlockLook& unknown_look() {
    static const BlockLook look = [] {
        BlockLook l;
        l.material = "stone";
        l.tint = TintKind::fixed;
        return l;
    }();
    return look;
}

} // namespace

static bool stands_in_water(const BlockState& state) {
    if (state.get("waterlogged") == "true") return true;
    const std::string_view n = state.name;
    return n == "minecraft:kelp" || n == "minecraft:kelp_plant" || n == "minecraft:seagrass" || n == "minecraft:tall_seagrass";
}

StateTable::StateTable(std::shared_ptr<const BlockRegistry> registry)
    : registry_(std::move(registry)) {
    infos_ = reserve_zero_pages<std::unique_ptr<StateInfo>>();
    flags_ = reserve_zero_pages<u8>();
    lights_ = reserve_zero_pages<StateLight>();
    VX_ASSERT(*intern(BlockState{"minecraft:air", {}}) == StateId::air);
    VX_ASSERT(*intern(BlockState{"vitrail:hidden", {}}) == StateId::hidden);
}

StateTable::~StateTable() {
    for (u32 i = 0; i < size(); ++i)
        infos_[i].reset();
    munmap(infos_, kCapacity * sizeof(*infos_));
    munmap(flags_, kCapacity * sizeof(*flags_));
    munmap(lights_, kCapacity * sizeof(*lights_));
}

Result<StateId> StateTable::intern(const BlockState& state) {
    const std::string text = state.to_string();
    std::lock_guard lock(mutex_);
    const auto [it, added] = index_.emplace(text, count_.load(std::memory_order_relaxed));
    if (!added) return StateId(it->second);
    if (it->second >= kCapacity) {
        index_.erase(it);
        return fail(ErrorCode::limit, fmt::format("a world holds at most {} different block states", kCapacity));
    }
    resolve(it->second, state);
    count_.store(it->second + 1, std::memory_order_release);
    return StateId(it->second);
}

Result<StateId> StateTable::intern_with_defaults(BlockState state) {
    const BlockId block = registry_->find_block(state.name);
    if (block != BlockId::unknown)
        for (const PropertyDef& property : registry_->blocks()[std::size_t(block)].properties)
            if (state.get(property.name).empty()) state.set(property.name, property.default_value);
    return intern(state);
}

std::optional<StateId> StateTable::find(const std::string& text) const {
    std::lock_guard lock(mutex_);
    const auto it = index_.find(text);
    if (it == index_.end()) return std::nullopt;
    return StateId(it->second);
}

void StateTable::resolve(u32 id, const BlockState& state) {
    auto info = std::make_unique<StateInfo>();
    info->state = state;
    info->in_water = stands_in_water(state);
    u8 flags = 0;
    if (state.name == "vitrail:hidden") {
        info->look = &unknown_look();
        info->shape = make_shape(*info->look, state);
        flags = kOpaqueCube | kSolid;
        lights_[id] = {15, 0, 0, 0};
    } else {
        info->block = registry_->find_block(state.name);
        const BlockDef& def = registry_->blocks()[std::size_t(info->block)];
        info->look = info->block == BlockId::unknown ? &unknown_look() : &def.look;
        // Later entries are more specific (block_def.h), so the last match decides.
        for (const BlockVariant& variant : def.variants)
            if (matches(variant, state)) info->look = &variant.look;
        const BlockLook& look = *info->look;
        info->shape = make_shape(look, state);
        info->face_textures = resolve_faces(look, state, *registry_);
        const bool full = info->shape.full_cube;
        if (full && look.layer == RenderLayer::solid && look.transparency == 0 && look.opacity >= 15)
            flags |= kOpaqueCube;
        if (!info->shape.collision.empty()) flags |= kSolid;
        if (look.shape == ShapeKind::none) flags |= kAirLike;
        if (look.shape == ShapeKind::liquid) {
            flags |= kLiquid;
            const auto level = state.get("level", "0");
            unsigned value = 0;
            std::from_chars(level.data(), level.data() + level.size(), value);
            info->liquid_level = u8(std::min(value, 15u));
        }
        if (look.replaceable) flags |= kReplaceable;
        if (look.climbable) flags |= kClimbable;
        if (look.light[0] | look.light[1] | look.light[2]) flags |= kEmitsLight;
        if (info->block == BlockId::unknown) flags |= kUnknownState;
        lights_[id] = {std::min<u8>(look.opacity, 15), std::min<u8>(look.light[0], 15), std::min<u8>(look.light[1], 15),
                       std::min<u8>(look.light[2], 15)};
    }
    flags_[id] = flags;
    infos_[id] = std::move(info);
}

} // namespace vitrail
