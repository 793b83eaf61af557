// Which faces of a section (a chunk's 16^3 cube) open space joins, and the walk over sections that finds what can be
// seen from one: the server sends no section that the walk does not reach, the client draws none. After "Advanced cave
// culling" (T. Checchi, 2014), but exact: no section is lost to the order of the walk.
#pragma once

#include "voxel/block_storage.h"
#include "voxel/coords.h"
#include "voxel/surface.h"

#include <array>
#include <functional>
#include <vector>

namespace vitrail {

// Bit a * 6 + b: an open path inside the section joins face a to face b (both orders; a * 6 + a: face a is open at
// all).
inline constexpr u64 kAllConnected = (u64(1) << 36) - 1;
constexpr bool connected(u64 connections, Face a, Face b) {
    return connections >> (u32(a) * 6 + u32(b)) & 1;
}

u64 face_connections(const BlockStorage& blocks, OpaqueStates opaque);

// The least square of cells that holds all open ones of a face: its axes are those after the face's, counted round (of
// an x face y and z, of a y face z and x); least and most of the first in bits 0-3 and 4-7, of the second in 8-11 and
// 12-15.
using FaceOpening = u16;
inline constexpr FaceOpening kWholeFace = 0xf0f0;
using FaceOpenings = std::array<FaceOpening, 6>; // by Face
inline constexpr FaceOpenings kWholeFaces{kWholeFace, kWholeFace, kWholeFace, kWholeFace, kWholeFace, kWholeFace};

// What sight needs to know of a section. A face that is closed counts as whole: nothing is joined to it.
struct SectionSight {
    u64 connections = kAllConnected;
    FaceOpenings openings = kWholeFaces;
    friend bool operator==(const SectionSight&, const SectionSight&) = default;
};
SectionSight section_sight(const BlockStorage& blocks, OpaqueStates opaque);

// The connections of a section; kAllConnected where it is absent but may be looked through, 0 where it stops sight.
using ConnectionsLookup = std::function<u64(ChunkPos)>;

struct SectionBounds {
    ChunkPos min, max; // both inside
    bool contains(ChunkPos p) const {
        return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z && p.z <= max.z;
    }
};

// Sections that a straight line from somewhere in `start` may reach through open faces, nearest (in steps) first, start
// itself first of all. A path never turns back on an axis. Empty where start lies outside the bounds; looks each
// section up once. Sections found are entered; whether there is anything in them to draw the caller knows.
std::vector<ChunkPos> reachable_sections(ChunkPos start, const ConnectionsLookup& connections_at, SectionBounds bounds);

} // namespace vitrail
