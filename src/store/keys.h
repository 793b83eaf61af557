// Keys of the world store: big-endian, signed numbers with the sign bit flipped, so that byte order is number order.
// A chunk's key is dimension, x, z, y: the chunks of a column lie together, bottom first.
#pragma once

#include "base/bytes.h"
#include "voxel/coords.h"

#include <optional>
#include <string_view>

namespace vitrail::keys {

Bytes number(u32 value);                           // states, biomes, dimensions: 4 bytes
Bytes big_number(u64 value);                       // entities: 8 bytes
Bytes text(std::string_view value);                // meta, players, scripts: the bytes themselves
Bytes chunk(DimensionId dimension, ChunkPos at);   // 16 bytes
Bytes column(DimensionId dimension, ColumnPos at); // 12 bytes, a prefix of its chunks' keys
Bytes after(Bytes prefix);                         // the first key beyond all that start with prefix; empty: none

std::optional<u32> read_number(ByteView key);
std::optional<Located<ChunkPos>> read_chunk(ByteView key);
std::optional<Located<ColumnPos>> read_column(ByteView key);

} // namespace vitrail::keys
