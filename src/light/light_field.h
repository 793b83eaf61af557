// LightField: the chunks one relighting works on. A chunk gets a slot when light first reaches it; a slot is opened (a
// new volume to write into, the cost of each cell in a flat array) when it is first written. Cells are named by slot <<
// 12 | LocalPos::index, so that the queues hold 4 bytes a cell and need no hash. One field a thread is kept and reused.
#pragma once

#include "light/packed.h"
#include "voxel/chunk.h"
#include "voxel/edit.h"
#include "world/dimension.h"

#include <memory>
#include <unordered_map>
#include <vector>

namespace vitrail {

class LightField {
public:
    using Cell = u32;
    static constexpr i32 kNone = -1, kUnknown = -2;
    static constexpr u8 kCostBits = 15, kEmits = 128;

    struct Slot {
        ChunkPos at;
        ChunkPtr chunk;
        std::shared_ptr<LightVolume> next; // what will be published, null until opened
        const LightVolume* now = nullptr;  // next, or the chunk's
        Light* cells = nullptr;            // of next
        u8* costs = nullptr;               // of each cell, kEmits where the state emits
        i32 beside[6] = {kUnknown, kUnknown, kUnknown, kUnknown, kUnknown, kUnknown};
        bool pending = false;  // to be lit from nothing later: has no cells yet
        bool sky_only = false; // known to hold no block light
        bool fresh = false;    // lit from nothing in this work
    };

    // Starts work on a dimension; finish() or abandon() ends it.
    void start(Dimension& dimension);
    // Publishes the chunks whose light changed and adds them to light_chunks.
    void finish(std::vector<ChunkPos>& light_chunks);

    // The slot of a lit chunk, kNone where it is absent or unlit.
    i32 slot_at(ChunkPos at);
    // A slot for a loaded chunk that may be unlit, marked pending; kNone where it is absent.
    i32 pending_slot_at(ChunkPos at);
    Slot& slot(i32 i) { return slots_[std::size_t(i)]; }
    i32 beside(i32 slot, u32 face) {
        const i32 known = slots_[std::size_t(slot)].beside[face];
        return known != kUnknown ? known : find_beside(slot, face);
    }
    void open(i32 slot);
    // Gives a pending slot its finished light.
    void light_up(i32 slot, std::shared_ptr<LightVolume> volume);

    u32 cost_of(const Slot& s, u32 index) const {
        const u32 opacity = lights_[u32(s.chunk->blocks.get(LocalPos(index)))].opacity;
        return opacity == 0 ? 1 : opacity > 15 ? 15 : opacity;
    }
    u32 emission_of(const Slot& s, u32 index) const {
        return emission(lights_[u32(s.chunk->blocks.get(LocalPos(index)))]);
    }
    static u32 emission(StateLight l) { return spread_light(Light(0, l.red & 15, l.green & 15, l.blue & 15)); }
    const StateLight* lights() const { return lights_; }
    Dimension& dimension() { return *dimension_; }

    // Cells whose light was taken, with the light they had in the channels it was taken from.
    struct Withdrawn {
        Cell cell;
        u32 light;
    };
    std::vector<Withdrawn> withdrawn;
    // Cells whose light may flow on into neighbors.
    std::vector<Cell> rising;
    // Takes all light that came from withdrawn cells only, and adds to `rising` the cells that can fill the dark.
    void run_withdrawal();
    void run_spread();
    // The most that its neighbors let into a cell, and no less than `least`.
    u32 inflow(i32 slot, u32 index, u32 cost, u32 least);
    // Raises an (opened) cell to what its neighbors let in.
    void gather(i32 slot, u32 index);
    // Withdraws light of a chunk along a face that nothing holds up any more.
    void withdraw_unsupported(i32 slot, u32 face);

private:
    i32 find_beside(i32 slot, u32 face);
    i32 add_slot(ChunkPos at, ChunkPtr chunk);

    Dimension* dimension_ = nullptr;
    const StateLight* lights_ = nullptr;
    std::vector<Slot> slots_;
    std::unordered_map<ChunkPos, i32> index_; // kNone: looked up, nothing there
    std::vector<std::unique_ptr<u8[]>> cost_pool_;
    std::size_t costs_used_ = 0;
};

// The cell beside an index across a face of the same chunk, or of the next one where `crosses`.
inline u32 step_index(u32 index, u32 face, bool& crosses) {
    switch (face) {
    case 0:
        crosses = (index & 15) == 0;
        return crosses ? index + 15 : index - 1;
    case 1:
        crosses = (index & 15) == 15;
        return crosses ? index - 15 : index + 1;
    case 2:
        crosses = index < 256;
        return crosses ? index + 3840 : index - 256;
    case 3:
        crosses = index >= 3840;
        return crosses ? index - 3840 : index + 256;
    case 4:
        crosses = (index & 240) == 0;
        return crosses ? index + 240 : index - 16;
    default:
        crosses = (index & 240) == 240;
        return crosses ? index - 240 : index + 16;
    }
}

} // namespace vitrail
