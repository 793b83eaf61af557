#include "world/dimension.h"

#include <algorithm>
#include <unordered_set>

namespace vitrail {

Dimension::Dimension(DimensionInfo info, std::shared_ptr<StateTable> states)
    : info_(std::move(info))
    , states_(std::move(states)) {}

ChunkPtr Dimension::find(ChunkPos at) const {
    const auto it = chunks_.find(at);
    return it == chunks_.end() ? nullptr : it->second;
}

void Dimension::put(ChunkPos at, ChunkPtr chunk) {
    chunks_[at] = std::move(chunk);
}
void Dimension::erase(ChunkPos at) {
    chunks_.erase(at);
}

StateId Dimension::state_at(BlockPos at) const {
    const auto it = chunks_.find(chunk_of(at));
    return it == chunks_.end() ? StateId::air : it->second->blocks.get(local_of(at));
}

Light Dimension::light_at(BlockPos at) const {
    const auto it = chunks_.find(chunk_of(at));
    if (it != chunks_.end() && it->second->light) return it->second->light->get(local_of(at));
    if (!info_.has_sky) return {};
    const ColumnHeights* column = heights(column_of(chunk_of(at)));
    const i32 above = column ? column->above[std::size_t((at.x & 15) | (at.z & 15) << 4)] : info_.min_y;
    return at.y >= above ? Light(15, 0, 0, 0) : Light{};
}

const ColumnHeights* Dimension::heights(ColumnPos at) const {
    const auto it = heights_.find(at);
    return it == heights_.end() ? nullptr : &it->second;
}

void Dimension::put_heights(ColumnPos at, const ColumnHeights& heights) {
    heights_[at] = heights;
}

ColumnHeights compute_heights(const Dimension& dimension, ColumnPos column) {
    ColumnHeights out;
    out.above.fill(dimension.info().min_y);
    const StateLight* lights = dimension.states().light_data();
    u32 open = 256;
    std::array<StateId, kChunkVolume> states;
    for (i32 cy = (dimension.info().max_y >> 4) - 1; cy >= dimension.info().min_y >> 4 && open > 0; --cy) {
        const ChunkPtr chunk = dimension.find({column.x, cy, column.z});
        if (!chunk) continue;
        const auto palette = chunk->blocks.palette();
        if (std::all_of(palette.begin(), palette.end(), [&](StateId id) { return lights[u32(id)].opacity == 0; }))
            continue;
        chunk->blocks.unpack(states);
        for (u32 c = 0; c < 256; ++c) {
            if (out.above[c] != dimension.info().min_y) continue;
            for (i32 y = 15; y >= 0; --y) {
                if (lights[u32(states[c | u32(y) << 8])].opacity == 0) continue;
                out.above[c] = cy * 16 + y + 1;
                --open;
                break;
            }
        }
    }
    return out;
}

// The height of one block column after a change at `at`.
static void update_height(Dimension& dimension, ColumnHeights& heights, BlockPos at) {
    const StateLight* lights = dimension.states().light_data();
    i32& above = heights.above[std::size_t((at.x & 15) | (at.z & 15) << 4)];
    if (lights[u32(dimension.state_at(at))].opacity > 0) {
        above = std::max(above, at.y + 1);
        return;
    }
    if (above != at.y + 1) return;
    i32 y = at.y - 1;
    while (y >= dimension.info().min_y) {
        const ChunkPtr chunk = dimension.find(chunk_of({at.x, y, at.z}));
        if (!chunk) {
            y = (y & ~15) - 1;
            continue;
        }
        if (lights[u32(chunk->blocks.get(local_of({at.x, y, at.z})))].opacity > 0) break;
        --y;
    }
    above = std::max(y + 1, dimension.info().min_y);
}

ChangeSet apply(Dimension& dimension, const EditBatch& batch) {
    ChangeSet changes;
    // One copy a chunk, however many of its blocks change.
    std::unordered_map<ChunkPos, std::shared_ptr<Chunk>> drafts;
    std::unordered_map<BlockPos, std::size_t> seen;
    for (const Edit& edit : batch.edits) {
        if (!dimension.contains(edit.at)) continue;
        const ChunkPos where = chunk_of(edit.at);
        auto& draft = drafts[where];
        if (!draft) {
            const ChunkPtr old = dimension.find(where);
            if (!old) continue;
            draft = std::make_shared<Chunk>(*old);
        }
        const LocalPos local = local_of(edit.at);
        const StateId before = draft->blocks.get(local);
        if (before == edit.state) continue;
        draft->blocks.set(local, edit.state);
        std::erase_if(draft->block_entities, [&](const BlockEntity& e) { return e.at == local; });
        const auto [it, added] = seen.emplace(edit.at, changes.blocks.size());
        if (added)
            changes.blocks.push_back({edit.at, before, edit.state});
        else
            changes.blocks[it->second].after = edit.state;
    }
    std::erase_if(changes.blocks, [](const BlockChange& c) { return c.before == c.after; });
    std::unordered_set<ChunkPos> changed;
    for (const BlockChange& change : changes.blocks)
        if (changed.insert(chunk_of(change.at)).second) changes.block_chunks.push_back(chunk_of(change.at));
    for (const ChunkPos& where : changes.block_chunks) {
        auto& draft = drafts[where];
        if (draft->blocks.palette().size() > 64)
            draft->blocks.compact(); // many edits must not grow the palette for ever
        ++draft->revision;
        dimension.put(where, draft);
    }
    for (const BlockChange& change : changes.blocks) {
        const ColumnPos column = column_of(chunk_of(change.at));
        if (const ColumnHeights* heights = dimension.heights(column)) {
            ColumnHeights next = *heights;
            update_height(dimension, next, change.at);
            dimension.put_heights(column, next);
        }
    }
    return changes;
}

} // namespace vitrail
