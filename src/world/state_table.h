// StateTable: a world's own numbering of block states, and what the loaded content says of each. Ids are given in order of
// first use and never change or return; the store keeps the texts (docs/decisions/0001-state-identity.md).
// One thread at a time may intern; any thread may read infos of ids it was given, without a lock.
#pragma once

#include "base/result.h"
#include "voxel/block_storage.h"
#include "world/block_registry.h"
#include "world/block_state.h"
#include "world/shape.h"

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <unordered_map>

namespace vitrail {

// Bits of StateTable::flags().
enum StateFlag : u8 {
    kOpaqueCube = 1,   // full cube, hides what lies behind it, stops light
    kSolid = 2,        // has collision boxes
    kAirLike = 4,      // draws nothing, stops nothing
    kLiquid = 8,
    kReplaceable = 16,
    kClimbable = 32,
    kEmitsLight = 64,
    kUnknownState = 128, // content does not define it; drawn as a plain tinted block
};

struct StateInfo {
    BlockState state;
    BlockId block = BlockId::unknown;
    const BlockLook* look = nullptr; // in the registry, variant resolved; valid as long as the table
    BlockShape shape;
    std::array<TextureId, 6> face_textures{}; // west, east, down, up, north, south; turned by axis and facing
    u8 liquid_level = 0;
    bool in_water = false; // stands in a source of water: waterlogged, or a plant that grows only there
};

// What light/ needs of a state, 4 bytes.
struct StateLight {
    u8 opacity = 0, red = 0, green = 0, blue = 0;
};

class StateTable {
public:
    static constexpr u32 kCapacity = 1u << 20;
    // Ids 0 minecraft:air and 1 vitrail:hidden exist from the start.
    explicit StateTable(std::shared_ptr<const BlockRegistry> registry);
    ~StateTable();
    StateTable(const StateTable&) = delete;
    StateTable& operator=(const StateTable&) = delete;

    // The id of this state, given now where it is new; thread-safe. Errors: limit, beyond kCapacity.
    Result<StateId> intern(const BlockState& state);
    // Fills properties the definition has and the state lacks with their defaults, then interns.
    Result<StateId> intern_with_defaults(BlockState state);
    // Where the text is known already.
    std::optional<StateId> find(const std::string& text) const;
    u32 size() const { return count_.load(std::memory_order_acquire); }
    bool contains(StateId id) const { return u32(id) < size(); }

    const StateInfo& info(StateId id) const { return *infos_[u32(id)]; }
    u8 flags(StateId id) const { return flags_[u32(id)]; }
    // Flat arrays of kCapacity entries for hot loops; an entry is set before its id is given out.
    const u8* flags_data() const { return flags_; }
    const StateLight* light_data() const { return lights_; }
    const BlockRegistry& registry() const { return *registry_; }
    std::shared_ptr<const BlockRegistry> registry_ptr() const { return registry_; }

private:
    void resolve(u32 id, const BlockState& state);
    std::shared_ptr<const BlockRegistry> registry_;
    mutable std::mutex mutex_;
    std::unordered_map<std::string, u32> index_;
    std::atomic<u32> count_{0};
    // Zero pages of the operating system until touched: full capacity costs nothing.
    std::unique_ptr<StateInfo>* infos_ = nullptr;
    u8* flags_ = nullptr;
    StateLight* lights_ = nullptr;
};

} // namespace vitrail
