#include "voxel/surface.h"

#include "voxel/cell_mask.h"

#include <algorithm>
#include <unordered_map>
#include <unordered_set>

namespace vitrail {

static CellMask opaque_cells(const BlockStorage* blocks, OpaqueStates opaque, bool absent_opaque) {
    if (blocks) return cells_with_flag(*blocks, opaque.flags, opaque.bit);
    CellMask all;
    all.fill(absent_opaque ? ~u64(0) : 0);
    return all;
}

// The cells whose six neighbors are all set in the masks of the chunk and of the chunks around.
static CellMask enclosed_cells(const CellMask& own, const std::array<CellMask, 6>& around) {
    CellMask out;
    for (u32 w = 0; w < 64; ++w) {
        const u32 q = w & 3; // four rows of z in a word
        const u64 west = (own[w] & ~kRowHigh) << 1 | (around[0][w] & kRowHigh) >> 15;
        const u64 east = (own[w] & ~kRowLow) >> 1 | (around[1][w] & kRowLow) << 15;
        const u64 down = w < 4 ? around[2][60 + w] : own[w - 4];
        const u64 up = w >= 60 ? around[3][w - 60] : own[w + 4];
        const u64 north = own[w] << 16 | (q == 0 ? around[4][w + 3] : own[w - 1]) >> 48;
        const u64 south = own[w] >> 16 | (q == 3 ? around[5][w - 3] : own[w + 1]) << 48;
        out[w] = west & east & down & up & north & south;
    }
    return out;
}

static CellMask hidden_cells(const BlockStorage& blocks, const std::array<const BlockStorage*, 6>& around,
                             OpaqueStates opaque, bool absent_opaque) {
    const CellMask own = opaque_cells(&blocks, opaque, absent_opaque);
    if (!any_cell(own)) return own; // each cell of a chunk has a neighbor in it
    std::array<CellMask, 6> masks;
    for (u32 f = 0; f < 6; ++f)
        masks[f] = opaque_cells(around[f], opaque, absent_opaque);
    return enclosed_cells(own, masks);
}

static BlockStorage with_hidden(const BlockStorage& blocks, const CellMask& hidden) {
    if (!any_cell(hidden)) return blocks;
    if (std::all_of(hidden.begin(), hidden.end(), [](u64 w) { return w == ~u64(0); }))
        return BlockStorage(StateId::hidden);
    std::array<StateId, kChunkVolume> states;
    blocks.unpack(states);
    for (u32 w = 0; w < 64; ++w)
        for (u64 rest = hidden[w]; rest; rest &= rest - 1)
            states[w * 64 + u32(__builtin_ctzll(rest))] = StateId::hidden;
    return BlockStorage::from_states(states);
}

BlockStorage make_surface(const BlockStorage& blocks, const std::array<const BlockStorage*, 6>& around,
                          OpaqueStates opaque, bool absent_opaque) {
    return with_hidden(blocks, hidden_cells(blocks, around, opaque, absent_opaque));
}

Chunk make_surface_chunk(const Chunk& chunk, const std::array<const Chunk*, 6>& around, OpaqueStates opaque,
                         bool absent_opaque) {
    std::array<const BlockStorage*, 6> blocks{};
    for (u32 f = 0; f < 6; ++f)
        blocks[f] = around[f] ? &around[f]->blocks : nullptr;
    const CellMask hidden = hidden_cells(chunk.blocks, blocks, opaque, absent_opaque);
    Chunk out;
    out.blocks = with_hidden(chunk.blocks, hidden);
    out.light = chunk.light;
    out.biomes = chunk.biomes;
    out.revision = chunk.revision;
    for (const BlockEntity& e : chunk.block_entities)
        if (!test_cell(hidden, e.at)) out.block_entities.push_back(e);
    for (const ScheduledTick& t : chunk.ticks)
        if (!test_cell(hidden, t.at)) out.ticks.push_back(t);
    return out;
}

bool is_hidden(BlockPos at, const StateLookup& state_at, OpaqueStates opaque) {
    for (u32 f = 0; f < 6; ++f)
        if (!opaque(state_at(neighbor(at, Face(f))))) return false;
    return true;
}

std::vector<Edit> surface_edits(const ChangeSet& changes, const StateLookup& state_at, OpaqueStates opaque) {
    std::unordered_map<BlockPos, const BlockChange*> changed;
    for (const BlockChange& c : changes.blocks)
        changed[c.at] = &c;
    const auto state_before = [&](BlockPos p) {
        const auto it = changed.find(p);
        return it == changed.end() ? state_at(p) : it->second->before;
    };
    const StateLookup before = state_before;
    std::vector<Edit> out;
    std::unordered_set<BlockPos> seen;
    const auto consider = [&](BlockPos p) {
        if (!in_world(p) || !seen.insert(p).second) return;
        const StateId known_before = is_hidden(p, before, opaque) ? StateId::hidden : state_before(p);
        const StateId known_now = is_hidden(p, state_at, opaque) ? StateId::hidden : state_at(p);
        if (known_before != known_now) out.push_back({p, known_now});
    };
    for (const BlockChange& c : changes.blocks) {
        consider(c.at);
        if (opaque(c.before) == opaque(c.after)) continue;
        for (u32 f = 0; f < 6; ++f)
            consider(neighbor(c.at, Face(f)));
    }
    return out;
}

} // namespace vitrail
