#include "script/block_canvas.h"

#include "rules/neighbors.h"

#include <algorithm>
#include <fmt/format.h>

namespace vitrail {

BlockCanvas::BlockCanvas(DimensionInfo info, std::shared_ptr<StateTable> states, CanvasLimits limits)
    : info_(std::move(info))
    , states_(std::move(states))
    , limits_(limits) {}

tl::unexpected<Error> BlockCanvas::over_limit(std::string message) {
    if (!exceeded_) exceeded_ = Error{ErrorCode::limit, std::move(message)};
    return tl::unexpected(*exceeded_);
}

Result<> BlockCanvas::charge(u64 cells) {
    if (exceeded_) return tl::unexpected(*exceeded_);
    cells_used_ += cells;
    if (cells_used_ > limits_.cells_most)
        return over_limit(fmt::format("more than {} blocks are drawn in all", limits_.cells_most));
    return {};
}

Result<> BlockCanvas::check(const BlockBox& box) const {
    const i32 r = limits_.reach;
    for (const i32 v : {box.least.x, box.least.z, box.most.x, box.most.z})
        if (v < -r || v >= r)
            return fail(ErrorCode::invalid_argument, fmt::format("x and z are from {} to {}, not {}", -r, r - 1, v));
    for (const i32 y : {box.least.y, box.most.y})
        if (y < info_.min_y || y >= info_.max_y)
            return fail(ErrorCode::invalid_argument,
                        fmt::format("y is from {} to {}, not {}", info_.min_y, info_.max_y - 1, y));
    return {};
}

Result<BlockCanvas::Drawn*> BlockCanvas::chunk(ChunkPos at) {
    if (exceeded_) return tl::unexpected(*exceeded_);
    const auto found = chunks_.find(at);
    if (found != chunks_.end()) return &found->second;
    if (chunks_.size() >= limits_.chunks_most)
        return over_limit(fmt::format("more than {} chunks of 16 blocks a side are drawn in", limits_.chunks_most));
    return &chunks_[at];
}

Result<> BlockCanvas::mix(Drawn& drawn) {
    if (drawn.cells) return {};
    if (mixed_ >= limits_.mixed_chunks_most)
        return over_limit(
            fmt::format("more than {} chunks of 16 blocks a side hold different blocks", limits_.mixed_chunks_most));
    ++mixed_;
    drawn.cells = std::make_unique<std::array<StateId, kChunkVolume>>();
    drawn.cells->fill(drawn.uniform);
    return {};
}

bool BlockCanvas::may_replace(StateId old, BrushOver over) const {
    return over.kind == BrushOver::anything || (over.kind == BrushOver::state && old == over.state_id) ||
           (over.kind == BrushOver::block && states_->info(old).block == over.block_id);
}

Result<> BlockCanvas::fill(const BlockBox& box, StateId state, BrushOver over) {
    return fill_rows(box, nullptr, state, over);
}

Result<> BlockCanvas::fill_rows(const BlockBox& box, const RowOf& row, StateId state, BrushOver over) {
    if (box.least.x > box.most.x || box.least.y > box.most.y || box.least.z > box.most.z) return {};
    VX_TRY(check(box));
    VX_TRY(charge((u64(box.most.x - box.least.x) + 1) * (u64(box.most.y - box.least.y) + 1) *
                  (u64(box.most.z - box.least.z) + 1)));
    const ChunkPos from = chunk_of(box.least), to = chunk_of(box.most);
    for (i32 cz = from.z; cz <= to.z; ++cz)
        for (i32 cy = from.y; cy <= to.y; ++cy)
            for (i32 cx = from.x; cx <= to.x; ++cx) {
                VX_TRY_ASSIGN(Drawn * drawn, chunk({cx, cy, cz}));
                const BlockPos corner{cx * 16, cy * 16, cz * 16};
                const BlockPos a{std::max(box.least.x, corner.x), std::max(box.least.y, corner.y),
                                 std::max(box.least.z, corner.z)};
                const BlockPos b{std::min(box.most.x, corner.x + 15), std::min(box.most.y, corner.y + 15),
                                 std::min(box.most.z, corner.z + 15)};
                if (!drawn->cells && (drawn->uniform == state || !may_replace(drawn->uniform, over))) continue;
                const bool whole = !row && b.x - a.x == 15 && b.y - a.y == 15 && b.z - a.z == 15;
                if (whole && (over.kind == BrushOver::anything || !drawn->cells)) {
                    if (drawn->cells) --mixed_;
                    drawn->cells.reset();
                    drawn->uniform = state;
                    continue;
                }
                for (i32 y = a.y; y <= b.y; ++y)
                    for (i32 z = a.z; z <= b.z; ++z) {
                        const Span asked = row ? row(y, z) : Span{a.x, b.x};
                        const i32 x0 = std::max(asked.first, a.x), x1 = std::min(asked.last, b.x);
                        if (x0 > x1) continue;
                        VX_TRY(mix(*drawn));
                        StateId* cell = drawn->cells->data() + local_of({x0, y, z}).index;
                        for (i32 x = x0; x <= x1; ++x, ++cell)
                            if (may_replace(*cell, over)) *cell = state;
                    }
            }
    return {};
}

Result<std::array<StateId, kChunkVolume>*> BlockCanvas::cells(ChunkPos at) {
    VX_TRY(check({origin_of(at), {at.x * 16 + 15, at.y * 16 + 15, at.z * 16 + 15}}));
    VX_TRY(charge(kChunkVolume));
    VX_TRY_ASSIGN(Drawn * drawn, chunk(at));
    VX_TRY(mix(*drawn));
    return drawn->cells.get();
}

StateId BlockCanvas::get(BlockPos at) const {
    const auto found = chunks_.find(chunk_of(at));
    if (found == chunks_.end()) return StateId::air;
    return found->second.cells ? (*found->second.cells)[local_of(at).index] : found->second.uniform;
}

i32 BlockCanvas::top(i32 x, i32 z) const {
    for (i32 cy = (info_.max_y >> 4) - 1; cy >= info_.min_y >> 4; --cy) {
        const auto found = chunks_.find({x >> 4, cy, z >> 4});
        if (found == chunks_.end() || (!found->second.cells && found->second.uniform == StateId::air)) continue;
        for (i32 y = 15; y >= 0; --y)
            if (get({x, cy * 16 + y, z}) != StateId::air) return cy * 16 + y + 1;
    }
    return info_.min_y;
}

namespace {

enum class Joining : u8 { unknown, never, always, under_snow };

Joining joining_of(const StateInfo& info) {
    switch (info.look->shape) {
    case ShapeKind::fence:
    case ShapeKind::wall:
    case ShapeKind::pane:
    case ShapeKind::stairs:
    case ShapeKind::rail:
    case ShapeKind::fence_gate:
        return Joining::always;
    default:
        return has_property(info, "snowy") ? Joining::under_snow : Joining::never;
    }
}

// Every block is joined to what was drawn, not to what an earlier one became: the order makes no difference.
Result<> join_shapes(Dimension& dimension) {
    StateTable& states = dimension.states();
    const EditView view(dimension);
    std::vector<Joining> joining;
    std::vector<std::pair<ChunkPos, ChunkPtr>> joined;
    std::array<StateId, kChunkVolume> cells;
    const auto how = [&](StateId id) {
        if (joining.size() <= u32(id)) joining.resize(u32(id) + 1, Joining::unknown);
        Joining& known = joining[u32(id)];
        if (known == Joining::unknown) known = joining_of(states.info(id));
        return known;
    };
    for (const auto& [at, chunk] : dimension.chunks()) {
        const auto palette = chunk->blocks.palette();
        if (std::all_of(palette.begin(), palette.end(), [&](StateId id) { return how(id) == Joining::never; }))
            continue;
        chunk->blocks.unpack(cells);
        bool changed = false;
        for (u32 i = 0; i < kChunkVolume; ++i) {
            const Joining needed = how(cells[i]);
            if (needed == Joining::never) continue;
            const BlockPos p = block_at(at, LocalPos(i));
            if (needed == Joining::under_snow && view.id_at(neighbor(p, Face::up)) == StateId::air) continue;
            VX_TRY_ASSIGN(const StateId now, states.intern(connected(view, p, states.info(cells[i]).state)));
            changed |= now != cells[i];
            cells[i] = now;
        }
        if (!changed) continue;
        auto copy = std::make_shared<Chunk>(*chunk);
        copy->blocks = BlockStorage::from_states(cells);
        joined.emplace_back(at, std::move(copy));
    }
    for (auto& [at, chunk] : joined)
        dimension.put(at, std::move(chunk));
    return {};
}

} // namespace

Result<Dimension> BlockCanvas::take(const std::function<BiomeId(i32 x, i32 y, i32 z)>& biome) {
    if (exceeded_) return tl::unexpected(*exceeded_);
    Dimension dimension(info_, states_);
    for (auto& [at, drawn] : chunks_) {
        auto chunk = std::make_shared<Chunk>();
        chunk->blocks = drawn.cells ? BlockStorage::from_states(*drawn.cells) : BlockStorage(drawn.uniform);
        drawn.cells.reset();
        const BlockPos corner = origin_of(at);
        for (i32 i = 0; i < 64; ++i)
            chunk->biomes.cells[std::size_t(i)] =
                biome(corner.x + (i & 3) * 4, corner.y + (i >> 4) * 4, corner.z + (i >> 2 & 3) * 4);
        dimension.put(at, std::move(chunk));
    }
    chunks_.clear();
    mixed_ = 0;
    VX_TRY(join_shapes(dimension));
    return dimension;
}

} // namespace vitrail
