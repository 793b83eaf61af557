// BlockCanvas: a world being drawn block by block, before it is a Dimension. Chunks of one state cost nothing, so deep
// rock is cheap; everything is counted before it is done, so that no call can ask for more than the limits give.
#pragma once

#include "base/result.h"
#include "world/dimension.h"

#include <array>
#include <functional>
#include <memory>
#include <unordered_map>

namespace vitrail {

struct CanvasLimits {
    i32 reach = 4096;                         // |x| and |z| of every block are below it
    std::size_t chunks_most = 1u << 16;       // touched at all
    std::size_t mixed_chunks_most = 1u << 14; // of more than one state: 16 KiB each while drawing
    u64 cells_most = u64(1) << 29;            // looked at, over all calls
};

// Blocks from `least` to `most`, both in it.
struct BlockBox {
    BlockPos least, most;
};

// Which blocks a brush may replace. A state's text without properties stands for all states of its block.
struct BrushOver {
    enum { anything, block, state } kind = anything;
    BlockId block_id{};
    StateId state_id{};
};

class BlockCanvas {
public:
    BlockCanvas(DimensionInfo info, std::shared_ptr<StateTable> states, CanvasLimits limits = {});

    const DimensionInfo& info() const { return info_; }
    StateTable& states() const { return *states_; }

    // Each: Errors: invalid_argument (outside the reach or the dimension's height), limit; a limit once passed stays
    // so.
    Result<> fill(const BlockBox& box, StateId state, BrushOver over = {});
    // A convex body: `row` gives the part of each row (y, z) along x that belongs to it, as first and last block; none
    // where first > last. Only rows of `box` are asked for, and only blocks in it are set.
    struct Span {
        i32 first, last;
    };
    using RowOf = std::function<Span(i32 y, i32 z)>;
    Result<> fill_rows(const BlockBox& box, const RowOf& row, StateId state, BrushOver over = {});
    Result<> set(BlockPos at, StateId state, BrushOver over = {}) { return fill({at, at}, state, over); }
    // The 4096 cells of a chunk, by LocalPos::index, to be changed until the next call of anything here.
    Result<std::array<StateId, kChunkVolume>*> cells(ChunkPos at);

    StateId get(BlockPos at) const; // air where nothing was drawn
    // The y above the highest block of a column that is not air; the dimension's lowest where there is none.
    i32 top(i32 x, i32 z) const;

    Result<> check(const BlockBox& box) const; // whether it lies within reach and height
    // Counts work as if so many blocks were looked at. Errors: limit.
    Result<> charge(u64 cells);
    u64 cells_used() const { return cells_used_; }
    const std::optional<Error>& exceeded() const { return exceeded_; } // the limit that was passed

    // What was drawn as a dimension without light; the canvas is empty afterwards. Shapes that join their neighbors
    // (fences, walls, panes, stairs, rails, grass under snow) are joined. biome: which one lies at a place of 4^3
    // blocks. Errors: limit (of states).
    Result<Dimension> take(const std::function<BiomeId(i32 x, i32 y, i32 z)>& biome);

private:
    struct Drawn {
        StateId uniform = StateId::air;
        std::unique_ptr<std::array<StateId, kChunkVolume>> cells; // null: all `uniform`
    };
    tl::unexpected<Error> over_limit(std::string message);
    Result<Drawn*> chunk(ChunkPos at);
    Result<> mix(Drawn& drawn);
    bool may_replace(StateId old, BrushOver over) const;

    DimensionInfo info_;
    std::shared_ptr<StateTable> states_;
    CanvasLimits limits_;
    std::unordered_map<ChunkPos, Drawn> chunks_;
    std::size_t mixed_ = 0;
    u64 cells_used_ = 0;
    std::optional<Error> exceeded_;
};

} // namespace vitrail
