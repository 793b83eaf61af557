// Surfaces: what a client may know of the blocks. A block is hidden when all six neighbors are opaque full cubes,
// whatever it is itself; a client is sent StateId::hidden in its place, so that no changed client can look for ore
// through rock. `flags` is StateTable::flags_data() and `opaque_bit` kOpaqueCube: passed plainly because voxel lies
// below world.
#pragma once

#include "voxel/chunk.h"
#include "voxel/coords.h"
#include "voxel/edit.h"

#include <array>
#include <functional>
#include <vector>

namespace vitrail {

struct OpaqueStates {
    const u8* flags = nullptr; // indexed by StateId
    u8 bit = 1;
    bool operator()(StateId id) const { return flags[u32(id)] & bit; }
};

// `around` in Face order; a null neighbor counts as opaque everywhere or nowhere, as `absent_opaque` says. The server
// says opaque below and beside what it has made (nothing can look in from there) and tells again when the neighbor
// comes.
BlockStorage make_surface(const BlockStorage& blocks, const std::array<const BlockStorage*, 6>& around,
                          OpaqueStates opaque, bool absent_opaque);

// The same for a whole chunk: block entities and scheduled ticks of hidden blocks go, and so do entities' records,
// which travel on their own; light, biomes and revision stay.
Chunk make_surface_chunk(const Chunk& chunk, const std::array<const Chunk*, 6>& around, OpaqueStates opaque,
                         bool absent_opaque);

using StateLookup = std::function<StateId(BlockPos)>;

// True where all six neighbors of this block are opaque full cubes.
bool is_hidden(BlockPos at, const StateLookup& state_at, OpaqueStates opaque);

// The edits that keep a client's surface equal to make_surface after these changes: changed blocks as far as they may
// be known, blocks revealed beside them, and `hidden` for blocks that are walled in now. state_at gives the world after
// the changes, with the same answer for absent chunks that make_surface was given. Each block once.
std::vector<Edit> surface_edits(const ChangeSet& changes, const StateLookup& state_at, OpaqueStates opaque);

} // namespace vitrail
