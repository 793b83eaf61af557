// EditBatch in, ChangeSet out: the currency between world, light, meshes, store, network and tracing grid.
#pragma once

#include "voxel/block_storage.h"
#include "voxel/coords.h"

#include <vector>

namespace vitrail {

struct Edit {
    BlockPos at;
    StateId state = StateId::air;
};

// Applied in order; a later edit of the same block wins.
struct EditBatch {
    std::vector<Edit> edits;
};

struct BlockChange {
    BlockPos at;
    StateId before = StateId::air, after = StateId::air;
};

struct ChangeSet {
    std::vector<BlockChange> blocks;    // only those that really changed
    std::vector<ChunkPos> block_chunks; // chunks whose blocks changed, each once
    std::vector<ChunkPos> light_chunks; // chunks whose light changed, each once; filled by light/
    bool empty() const { return blocks.empty() && light_chunks.empty(); }
};

} // namespace vitrail
