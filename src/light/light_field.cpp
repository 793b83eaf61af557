#include "light/light_field.h"

#include "voxel/cell_mask.h"

#include <cstring>

namespace vitrail {

void LightField::start(Dimension& dimension) {
    dimension_ = &dimension;
    lights_ = dimension.states().light_data();
    slots_.clear();
    index_.clear();
    withdrawn.clear();
    rising.clear();
    costs_used_ = 0;
}

i32 LightField::add_slot(ChunkPos at, ChunkPtr chunk) {
    const i32 i = i32(slots_.size());
    Slot& s = slots_.emplace_back();
    s.at = at;
    s.chunk = std::move(chunk);
    s.now = s.chunk->light.get();
    index_[at] = i;
    return i;
}

i32 LightField::slot_at(ChunkPos at) {
    const auto it = index_.find(at);
    if (it != index_.end()) return it->second;
    ChunkPtr chunk = dimension_->find(at);
    if (!chunk || !chunk->light) {
        index_[at] = kNone;
        return kNone;
    }
    return add_slot(at, std::move(chunk));
}

i32 LightField::pending_slot_at(ChunkPos at) {
    const auto it = index_.find(at);
    i32 i = it == index_.end() ? kNone : it->second;
    if (i == kNone) {
        ChunkPtr chunk = dimension_->find(at);
        if (!chunk) return kNone;
        i = add_slot(at, std::move(chunk));
    }
    slots_[std::size_t(i)].pending = true;
    return i;
}

i32 LightField::find_beside(i32 slot, u32 face) {
    const ChunkPos at = neighbor(slots_[std::size_t(slot)].at, Face(face));
    const i32 found = in_world(at) ? slot_at(at) : kNone;
    slots_[std::size_t(slot)].beside[face] = found;
    return found;
}

void LightField::open(i32 i) {
    Slot& s = slots_[std::size_t(i)];
    if (!s.next) {
        s.next = s.now ? std::make_shared<LightVolume>(*s.now) : std::make_shared<LightVolume>();
        s.now = s.next.get();
    }
    s.cells = s.next->writable().data();
    s.sky_only = false; // whatever is written
    if (s.costs) return;
    if (costs_used_ == cost_pool_.size()) cost_pool_.push_back(std::make_unique<u8[]>(kChunkVolume));
    s.costs = cost_pool_[costs_used_++].get();
    const auto palette = s.chunk->blocks.palette();
    u8 few[256];
    std::vector<u8> many(palette.size() > 256 ? palette.size() : 0);
    u8* values = many.empty() ? few : many.data();
    for (std::size_t p = 0; p < palette.size(); ++p) {
        const StateLight l = lights_[u32(palette[p])];
        const u32 cost = l.opacity == 0 ? 1 : l.opacity > 15 ? 15 : l.opacity;
        values[p] = u8(cost | (emission(l) ? kEmits : 0));
    }
    map_cells(s.chunk->blocks, values, s.costs);
}

void LightField::light_up(i32 i, std::shared_ptr<LightVolume> volume) {
    Slot& s = slots_[std::size_t(i)];
    s.next = std::move(volume);
    s.now = s.next.get();
    s.cells = nullptr; // opened again when written
    s.pending = false;
    s.fresh = true;
}

void LightField::finish(std::vector<ChunkPos>& light_chunks) {
    for (Slot& s : slots_) {
        if (!s.next) continue;
        s.next->compact();
        const LightVolume* before = s.chunk->light.get();
        if (before) {
            const auto *a = before->cells(), *b = s.next->cells();
            const bool same = a && b ? std::memcmp(a, b, sizeof *a) == 0
                                     : !a && !b && before->get(LocalPos()) == s.next->get(LocalPos());
            if (same) continue;
        }
        auto chunk = std::make_shared<Chunk>(*s.chunk);
        chunk->light = std::move(s.next);
        if (before) ++chunk->revision;
        dimension_->put(s.at, std::move(chunk));
        light_chunks.push_back(s.at);
    }
    slots_.clear(); // lets go of the snapshots
    index_.clear();
}

} // namespace vitrail
