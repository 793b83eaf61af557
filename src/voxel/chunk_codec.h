// The chunk record: one codec for store and network (docs/formats/chunk.md, docs/decisions/0002-chunk-record.md).
//
//     Bytes bytes = encode_chunk(chunk);
//     Result<Chunk> back = decode_chunk(bytes, {.state_count = states.size()});
//
// A record is numbered sections; a reader skips numbers it does not know, so the record can grow. Encoding the same
// chunk gives the same bytes on every machine.
#pragma once

#include "base/bytes.h"
#include "base/result.h"
#include "voxel/chunk.h"

namespace vitrail {

// Sections of a record, as bits for `encode_chunk`. The numbers in the record are the bits' positions plus one.
enum ChunkPart : u32 {
    kChunkBlocks = 1,
    kChunkLight = 2,
    kChunkBiomes = 4,
    kChunkBlockEntities = 8,
    kChunkTicks = 16,
    kChunkEntities = 32,
    kChunkRevision = 64,
    kChunkAll = 127,
};

// What a reader is ready to take. The defaults suit any chunk of our own.
struct DecodeLimits {
    u32 state_count = 0xffffffff; // state ids at or above are damage: pass StateTable::size()
    u32 biome_count = 65536;      // the same for biomes: pass BiomeTable::size()
    u32 bytes_most = 16u << 20;   // all sections together, decompressed
};

// Palettes of the record are compacted, so equal chunks give equal records. A part left out decodes to its default
// (air, not lit, biome none, nothing).
Bytes encode_chunk(const Chunk& chunk, u32 parts = kChunkAll);
// The same, appended to `out`.
void encode_chunk(const Chunk& chunk, u32 parts, Bytes& out);

// Errors: damaged (does not parse, an id or index out of range), unsupported (a newer format), limit (beyond
// bytes_most).
Result<Chunk> decode_chunk(ByteView bytes, const DecodeLimits& limits = {});

// Only what the record costs to look at: the revision, without decoding the rest. Errors as decode_chunk.
Result<u64> decode_chunk_revision(ByteView bytes);

} // namespace vitrail
