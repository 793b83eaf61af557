// Dimension: the loaded part of one dimension, chunks by position. One thread owns it; others get ChunkPtr snapshots.
#pragma once

#include "voxel/chunk.h"
#include "voxel/coords.h"
#include "voxel/edit.h"
#include "world/state_table.h"

#include <array>
#include <string>
#include <unordered_map>

namespace vitrail {

struct DimensionInfo {
    DimensionId id{};
    std::string name = "minecraft:overworld";
    i32 min_y = -64, max_y = 320; // blocks exist for min_y <= y < max_y; multiples of 16
    bool has_sky = true;
    i32 sea_level = 63; // the height of its lakes and seas, where mist lies
};

// For each of 256 block columns (index x | z << 4) the y above the highest block that takes sky light; the sky is open
// at and above it. min_y of the dimension where there is none.
struct ColumnHeights {
    std::array<i32, 256> above{};
};

class Dimension {
public:
    Dimension(DimensionInfo info, std::shared_ptr<StateTable> states);

    const DimensionInfo& info() const { return info_; }
    StateTable& states() const { return *states_; }
    const std::shared_ptr<StateTable>& states_ptr() const { return states_; }

    ChunkPtr find(ChunkPos at) const; // null: not loaded or never made
    void put(ChunkPos at, ChunkPtr chunk);
    void erase(ChunkPos at);
    bool contains(BlockPos at) const { return at.y >= info_.min_y && at.y < info_.max_y && in_world(at); }
    // Air where the chunk is absent.
    StateId state_at(BlockPos at) const;
    Light light_at(BlockPos at) const; // full sky above the heights, dark elsewhere, where the chunk is absent or unlit
    const std::unordered_map<ChunkPos, ChunkPtr>& chunks() const { return chunks_; }

    const ColumnHeights* heights(ColumnPos at) const;
    void put_heights(ColumnPos at, const ColumnHeights& heights);
    void erase_heights(ColumnPos at) { heights_.erase(at); }

private:
    DimensionInfo info_;
    std::shared_ptr<StateTable> states_;
    std::unordered_map<ChunkPos, ChunkPtr> chunks_;
    std::unordered_map<ColumnPos, ColumnHeights> heights_;
};

// Applies the edits to loaded chunks (edits of absent chunks or outside the dimension are left out), publishes new
// snapshots with the next revision, keeps heights. Light is not touched: relight (light/relight.h) consumes the ChangeSet.
ChangeSet apply(Dimension& dimension, const EditBatch& batch);

// Recomputes the heights of a column from its loaded chunks.
ColumnHeights compute_heights(const Dimension& dimension, ColumnPos column);

} // namespace vitrail
