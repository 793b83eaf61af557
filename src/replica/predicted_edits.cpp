// The player's own edits, shown before the server answers (replica.h tells how they are reconciled).
#include "light/relight.h"
#include "replica/replica.h"

#include <algorithm>

namespace vitrail::replica {

namespace {

// Cells that differ between two chunks, as the box around them.
struct CellBounds {
    i32 min[3] = {16, 16, 16}, max[3] = {-1, -1, -1};
    bool empty() const { return max[0] < 0; }
    void add(LocalPos p) {
        const i32 at[3] = {p.x(), p.y(), p.z()};
        for (int a = 0; a < 3; ++a)
            min[a] = std::min(min[a], at[a]), max[a] = std::max(max[a], at[a]);
    }
};

constexpr CellBounds kWhole{{0, 0, 0}, {15, 15, 15}};

CellBounds block_difference(const Chunk& a, const Chunk& b) {
    CellBounds bounds;
    if (a.blocks == b.blocks) return bounds;
    for (u32 i = 0; i < u32(kChunkVolume); ++i)
        if (a.blocks.get(LocalPos(i)) != b.blocks.get(LocalPos(i))) bounds.add(LocalPos(i));
    return bounds;
}

CellBounds light_difference(const Chunk& a, const Chunk& b) {
    CellBounds bounds;
    if (a.light == b.light) return bounds;
    for (u32 i = 0; i < u32(kChunkVolume); ++i)
        if (!(a.light->get(LocalPos(i)) == b.light->get(LocalPos(i)))) bounds.add(LocalPos(i));
    return bounds;
}

// Whether changes within these bounds touch the neighbor in this direction, -1 to 1 an axis.
bool touches(const CellBounds& bounds, i32 dx, i32 dy, i32 dz) {
    const i32 way[3] = {dx, dy, dz};
    for (int a = 0; a < 3; ++a)
        if ((way[a] < 0 && bounds.min[a] != 0) || (way[a] > 0 && bounds.max[a] != 15)) return false;
    return !bounds.empty();
}

} // namespace

void Replica::mark(ChunkPos at, u8 what) {
    dirty_[at] |= what;
    if (what & (kBlocksChanged | kGone)) asks_.changed(at);
}

void Replica::mark_difference(ChunkPos at, const Chunk* before, const Chunk* now) {
    if (!now || before == now) return;
    const CellBounds blocks = before ? block_difference(*before, *now) : kWhole;
    const CellBounds light = before ? light_difference(*before, *now) : kWhole;
    if (blocks.empty() && light.empty()) return;
    mark(at, u8((blocks.empty() ? 0 : kBlocksChanged) | (light.empty() ? 0 : kLightChanged)));
    for (i32 dy = -1; dy <= 1; ++dy)
        for (i32 dz = -1; dz <= 1; ++dz)
            for (i32 dx = -1; dx <= 1; ++dx) {
                const u8 border = u8((touches(blocks, dx, dy, dz) ? kBorderBlocks : 0) |
                                     (touches(light, dx, dy, dz) ? kBorderLight : 0));
                const ChunkPos p{at.x + dx, at.y + dy, at.z + dz};
                if (border && !(p == at) && dimension_->find(p)) mark(p, border);
            }
}

ChunkPtr Replica::server_chunk(ChunkPos at) const {
    const auto kept = server_chunks_.find(at);
    return kept != server_chunks_.end() ? kept->second : dimension_->find(at);
}

void Replica::put_server_chunk(ChunkPos at, ChunkPtr chunk) {
    const auto kept = server_chunks_.find(at);
    if (kept != server_chunks_.end()) {
        kept->second = std::move(chunk);
        unsettled_ = true; // shown, with what is still predicted on top, when this poll ends
        return;
    }
    const ChunkPtr before = dimension_->find(at);
    dimension_->put(at, chunk);
    mark_difference(at, before.get(), chunk.get());
}

void Replica::predict(const std::vector<Edit>& edits, std::unordered_map<ChunkPos, ChunkPtr>& shown) {
    // Light may change up to the top and bottom of the columns around; what stood there is the server's version, unless
    // an earlier prediction kept an older one.
    std::unordered_map<ChunkPos, ChunkPtr> before;
    const DimensionInfo& info = dimension_->info();
    for (const Edit& e : edits) {
        const ChunkPos c = chunk_of(e.at);
        if (before.contains({c.x, info.min_y >> 4, c.z})) continue;
        for (i32 y = info.min_y >> 4; y < info.max_y >> 4; ++y)
            for (i32 dz = -1; dz <= 1; ++dz)
                for (i32 dx = -1; dx <= 1; ++dx) {
                    const ChunkPos p{c.x + dx, y, c.z + dz};
                    before.try_emplace(p, dimension_->find(p));
                }
        if (const ColumnHeights* heights = dimension_->heights(column_of(c)))
            server_heights_.try_emplace(column_of(c), *heights);
    }
    ChangeSet changes = apply(*dimension_, EditBatch{edits});
    relight(*dimension_, changes);
    auto keep = [&](ChunkPos at) {
        const auto stood = before.find(at);
        if (stood == before.end() || !stood->second) return;
        server_chunks_.try_emplace(at, stood->second);
        shown.try_emplace(at, stood->second);
    };
    for (ChunkPos at : changes.block_chunks)
        keep(at);
    for (ChunkPos at : changes.light_chunks)
        keep(at);
}

void Replica::settle() {
    unsettled_ = false;
    std::unordered_map<ChunkPos, ChunkPtr> shown;
    for (const auto& [at, chunk] : server_chunks_) {
        shown.emplace(at, dimension_->find(at));
        dimension_->put(at, chunk);
    }
    for (const auto& [at, heights] : server_heights_)
        dimension_->put_heights(at, heights);
    server_chunks_.clear();
    server_heights_.clear();
    for (const PendingEdit& pending : pending_)
        predict(pending.edits, shown);
    for (const auto& [at, before] : shown)
        mark_difference(at, before.get(), dimension_->find(at).get());
}

bool Replica::is_guess(BlockPos at) const {
    for (const PendingEdit& pending : pending_)
        for (const Edit& e : pending.edits)
            if (e.at == at) return true;
    return false;
}

std::vector<Edit> Replica::guess_laid_bare(const std::vector<Edit>& edits) const {
    std::vector<Edit> guesses;
    auto opaque = [&](StateId id) { return (states_->flags(id) & kOpaqueCube) != 0; };
    for (const Edit& e : edits) {
        const StateId before = dimension_->state_at(e.at);
        if (opaque(e.state) || !opaque(before)) continue;
        for (u32 f = 0; f < 6; ++f) {
            const BlockPos n = neighbor(e.at, Face(f));
            if (dimension_->state_at(n) != StateId::hidden) continue;
            StateId guess = before;
            for (u32 g = 0; g < 6 && guess == StateId::hidden; ++g) {
                const StateId near = dimension_->state_at(neighbor(n, Face(g)));
                if (opaque(near)) guess = near;
            }
            if (guess != StateId::hidden) guesses.push_back({n, guess});
        }
    }
    return guesses;
}

Result<u32> Replica::request(net::EditRequest message, std::vector<Edit> edits) {
    const u32 sequence = message.sequence = next_sequence_++;
    message.yaw = body_.yaw, message.pitch = body_.pitch;
    message.after_command = next_command_ - 1;
    // What is predicted itself has no state that the server must agree to.
    const BlockPos at = net::from_wire(message.at);
    if (!is_guess(at)) message.target = states_->info(dimension_->state_at(at)).state.to_string();
    send_commands(); // the server judges from where the player stands now
    send(net::Channel::control, message);
    const std::vector<Edit> guesses = guess_laid_bare(edits);
    edits.insert(edits.end(), guesses.begin(), guesses.end());
    pending_.push_back({sequence, std::move(edits)});
    std::unordered_map<ChunkPos, ChunkPtr> shown;
    predict(pending_.back().edits, shown);
    for (const auto& [p, before] : shown)
        mark_difference(p, before.get(), dimension_->find(p).get());
    return sequence;
}

} // namespace vitrail::replica
