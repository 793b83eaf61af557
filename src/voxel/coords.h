// Strong coordinates (docs/decisions/0006-coordinates.md). No float ever holds an absolute position; only the named
// functions below convert. Kernel-safe. y is up, x east, z south, as in Minecraft; chunks are cubes of 16^3 blocks.
#pragma once

#include "base/hash.h"
#include "base/types.h"
#include "math/vec.h"

#include <cstddef>
#include <functional>

namespace vitrail {

inline constexpr i32 kChunkSize = 16;
inline constexpr i32 kChunkVolume = 4096;

// The world ends here: blocks exist for -kWorldEdge <= x, y, z < kWorldEdge; a multiple of 512, so that regions end
// with it.
inline constexpr i32 kWorldEdge = 2147483136; // 2^31 - 512

struct BlockPos {
    i32 x = 0, y = 0, z = 0;
    friend constexpr bool operator==(const BlockPos&, const BlockPos&) = default;
};

struct ChunkPos {
    i32 x = 0, y = 0, z = 0; // block coordinate divided by 16, rounded down
    friend constexpr bool operator==(const ChunkPos&, const ChunkPos&) = default;
};

struct ColumnPos {
    i32 x = 0, z = 0; // chunk units
    friend constexpr bool operator==(const ColumnPos&, const ColumnPos&) = default;
};

// A cell of a chunk: index = x | z << 4 | y << 8, Minecraft's order.
struct LocalPos {
    u16 index = 0;
    constexpr LocalPos() = default;
    constexpr explicit LocalPos(u32 i)
        : index(u16(i)) {}
    constexpr LocalPos(i32 x, i32 y, i32 z)
        : index(u16(x | z << 4 | y << 8)) {}
    constexpr i32 x() const { return index & 15; }
    constexpr i32 z() const { return index >> 4 & 15; }
    constexpr i32 y() const { return index >> 8; }
    friend constexpr bool operator==(const LocalPos&, const LocalPos&) = default;
};

// Block and fraction of an axis in one signed 32.32 fixed-point number: unit 2^-32 block.
inline constexpr i64 kFixedOne = i64(1) << 32;

struct WorldPos {
    i64 x = 0, y = 0, z = 0;
    friend constexpr bool operator==(const WorldPos&, const WorldPos&) = default;
};

// Relative to the camera (or another stated anchor), in blocks.
struct ViewPos {
    Vec3 v;
};

enum class DimensionId : u32 { overworld = 0 };

// A position in a dimension.
template <class T>
struct Located {
    DimensionId dimension{};
    T at{};
    friend constexpr bool operator==(const Located&, const Located&) = default;
};

constexpr bool in_world(BlockPos p) {
    return p.x >= -kWorldEdge && p.x < kWorldEdge && p.y >= -kWorldEdge && p.y < kWorldEdge && p.z >= -kWorldEdge &&
           p.z < kWorldEdge;
}
constexpr bool in_world(ChunkPos p) {
    constexpr i32 e = kWorldEdge / kChunkSize;
    return p.x >= -e && p.x < e && p.y >= -e && p.y < e && p.z >= -e && p.z < e;
}

constexpr ChunkPos chunk_of(BlockPos p) {
    return {p.x >> 4, p.y >> 4, p.z >> 4};
}
constexpr LocalPos local_of(BlockPos p) {
    return {p.x & 15, p.y & 15, p.z & 15};
}
constexpr BlockPos block_at(ChunkPos c, LocalPos l) {
    return {c.x * 16 + l.x(), c.y * 16 + l.y(), c.z * 16 + l.z()};
}
constexpr BlockPos origin_of(ChunkPos c) {
    return {c.x * 16, c.y * 16, c.z * 16};
}
constexpr ColumnPos column_of(ChunkPos c) {
    return {c.x, c.z};
}

constexpr BlockPos block_of(WorldPos p) {
    return {i32(p.x >> 32), i32(p.y >> 32), i32(p.z >> 32)};
}
constexpr WorldPos corner_of(BlockPos p) {
    return {i64(p.x) * kFixedOne, i64(p.y) * kFixedOne, i64(p.z) * kFixedOne};
}
// p moved by an offset in blocks; |offset| < 2^31.
WorldPos offset_by(WorldPos p, Vec3 offset);
// p seen from anchor, in blocks. Exact to float rounding where both lie within 2^31 blocks of each other.
ViewPos view_from(WorldPos anchor, WorldPos p);
ViewPos view_from(WorldPos anchor, BlockPos p);
// p held inside the edge of the world.
WorldPos clamp_to_world(WorldPos p);
// Nearest WorldPos of an absolute coordinate in blocks, as users type them; not for computing.
WorldPos world_pos_from_numbers(double x, double y, double z);

// The six faces in the order used everywhere: -x, +x, -y, +y, -z, +z (west, east, down, up, north, south).
enum class Face : u8 { west, east, down, up, north, south };
inline constexpr IVec3 kFaceNormal[6] = {{-1, 0, 0}, {1, 0, 0}, {0, -1, 0}, {0, 1, 0}, {0, 0, -1}, {0, 0, 1}};
constexpr Face opposite(Face f) {
    return Face(u8(f) ^ 1);
}
constexpr BlockPos neighbor(BlockPos p, Face f) {
    const IVec3 n = kFaceNormal[u8(f)];
    return {p.x + n.x, p.y + n.y, p.z + n.z};
}
constexpr ChunkPos neighbor(ChunkPos p, Face f) {
    const IVec3 n = kFaceNormal[u8(f)];
    return {p.x + n.x, p.y + n.y, p.z + n.z};
}

} // namespace vitrail

template <>
struct std::hash<vitrail::BlockPos> {
    std::size_t operator()(const vitrail::BlockPos& p) const {
        return vitrail::mix64(vitrail::mix64(vitrail::u64(vitrail::u32(p.x)) << 32 | vitrail::u32(p.z)) +
                              vitrail::u32(p.y));
    }
};
template <>
struct std::hash<vitrail::ChunkPos> {
    std::size_t operator()(const vitrail::ChunkPos& p) const {
        return vitrail::mix64(vitrail::mix64(vitrail::u64(vitrail::u32(p.x)) << 32 | vitrail::u32(p.z)) +
                              vitrail::u32(p.y));
    }
};
template <>
struct std::hash<vitrail::ColumnPos> {
    std::size_t operator()(const vitrail::ColumnPos& p) const {
        return vitrail::mix64(vitrail::u64(vitrail::u32(p.x)) << 32 | vitrail::u32(p.z));
    }
};
