// Chunk: one 16^3 cube of the world as an immutable snapshot. Who wants a change copies it, changes the copy and
// publishes that whole (copy-on-write); readers on other threads keep what they hold. A chunk that was never made is
// absent (a null ChunkPtr), which differs from one that is all air.
#pragma once

#include "base/bytes.h"
#include "voxel/block_storage.h"
#include "voxel/light_volume.h"

#include <array>
#include <memory>
#include <vector>

namespace vitrail {

// An id in the world's own biome table; 0 is "vitrail:none" and drawn with plain tints.
enum class BiomeId : u16 { none = 0 };

// 4^3 biomes of a chunk, each for 4^3 blocks: index = x | z << 2 | y << 4 in units of 4 blocks.
struct BiomeGrid {
    std::array<BiomeId, 64> cells{};
    BiomeId at(LocalPos p) const { return cells[std::size_t((p.x() >> 2) | (p.z() >> 2) << 2 | (p.y() >> 2) << 4)]; }
    friend bool operator==(const BiomeGrid&, const BiomeGrid&) = default;
};

// What a block keeps beside its state (a chest's items, a sign's text): uncompressed NBT of one compound, kept as it
// came.
struct BlockEntity {
    LocalPos at;
    Bytes nbt;
    friend bool operator==(const BlockEntity&, const BlockEntity&) = default;
};

struct ScheduledTick {
    LocalPos at;
    u64 due = 0; // server tick
    i32 priority = 0;
    StateId state = StateId::air; // runs only while the block still is this
    friend bool operator==(const ScheduledTick&, const ScheduledTick&) = default;
};

struct Chunk {
    BlockStorage blocks;
    std::shared_ptr<const LightVolume> light; // null: not lit yet
    BiomeGrid biomes;
    std::vector<BlockEntity> block_entities;
    std::vector<ScheduledTick> ticks;
    std::vector<Bytes> entities; // uncompressed NBT compounds of imported creatures and items that stand in this chunk
    u64 revision = 0;            // grows with every published change; a client names the one it holds
};

using ChunkPtr = std::shared_ptr<const Chunk>;

} // namespace vitrail
