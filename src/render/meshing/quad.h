// The 8-byte quad that the mesher writes and the vertex shader reads (layout repeated in content-independent GLSL,
// render/passes/terrain). Small because software OpenGL and GPUs alike are bound by vertices and memory here; light is
// not in it (it is a volume a section), so that a light change meshes nothing again.
//
// bits   0..3 x, 4..7 y, 8..11 z   cell of the quad's least corner, in the section
//       12..15 w - 1, 16..19 h - 1 cells along the face's u and v axis       (cube quads)
//       20..22 face                Face order: west, east, down, up, north, south
//       23     0 cube, 1 model
//       24..31 ambient occlusion   2 bits a corner, 0 darkest .. 3 open; corner order (u0,v0) (u1,v0) (u1,v1) (u0,v1)
//       32..47 texture             TextureId
//       48..50 tint                TintKind
//       51..58 fixed tint          index into the table of fixed tints, 0 white
//       59     sways   60 liquid surface (moves, animated normal)   61 never mipped
//       62..63 texture turns       quarter turns of the picture, clockwise seen from outside (cube quads;
//       scene/block_model.h)
// A model quad keeps x, y, z, texture, tint and flags; bits 12..22 and 24..31 together are its index into the table of
// model quads (scene/block_model.h): low 11 bits in 12..22, high 8 in 24..31.
//
// Axes of a cube face: u, v run with the growing coordinates: x faces u = z, v = y; y faces u = x, v = z; z faces u =
// x, v = y.
#pragma once

#include "base/types.h"
#include "voxel/connectivity.h"
#include "voxel/coords.h"
#include "world/block_def.h"
#include "world/block_registry.h"

#include <array>
#include <vector>

namespace vitrail::render {

enum QuadFlag : u64 { kQuadSways = 1ull << 59, kQuadLiquid = 1ull << 60, kQuadNeverMipped = 1ull << 61 };

// A cube quad with kQuadLiquid and face up is a level liquid surface: drawn this much lower, in 1/256 block (8/9 high).
inline constexpr u32 kLiquidDrop = 28;

struct Quad {
    u64 bits = 0;

    static constexpr Quad cube(LocalPos at, u32 w, u32 h, Face face, u8 ao, TextureId texture, TintKind tint,
                               u8 fixed_tint, u64 flags = 0) {
        return {position(at) | u64(w - 1) << 12 | u64(h - 1) << 16 | u64(face) << 20 | u64(ao) << 24 |
                look(texture, tint, fixed_tint) | flags};
    }
    static constexpr Quad model(LocalPos at, u32 model_quad, TextureId texture, TintKind tint, u8 fixed_tint,
                                u64 flags = 0) {
        return {position(at) | u64(model_quad & 2047) << 12 | 1ull << 23 | u64(model_quad >> 11 & 255) << 24 |
                look(texture, tint, fixed_tint) | flags};
    }
    constexpr bool is_model() const { return bits >> 23 & 1; }
    constexpr u32 x() const { return bits & 15; }
    constexpr u32 y() const { return bits >> 4 & 15; }
    constexpr u32 z() const { return bits >> 8 & 15; }
    constexpr u32 w() const { return (bits >> 12 & 15) + 1; }
    constexpr u32 h() const { return (bits >> 16 & 15) + 1; }
    constexpr Face face() const { return Face(bits >> 20 & 7); }
    constexpr u8 ao() const { return u8(bits >> 24); }
    constexpr u32 model_quad() const { return u32(bits >> 12 & 2047) | u32(bits >> 24 & 255) << 11; }
    constexpr TextureId texture() const { return TextureId(bits >> 32 & 0xffff); }
    constexpr TintKind tint() const { return TintKind(bits >> 48 & 7); }
    constexpr u8 fixed_tint() const { return u8(bits >> 51); }
    constexpr u32 turns() const { return u32(bits >> 62); }
    friend constexpr bool operator==(const Quad&, const Quad&) = default;

private:
    static constexpr u64 position(LocalPos at) { return u64(at.x()) | u64(at.y()) << 4 | u64(at.z()) << 8; }
    static constexpr u64 look(TextureId texture, TintKind tint, u8 fixed_tint) {
        return u64(texture) << 32 | u64(tint) << 48 | u64(fixed_tint) << 51;
    }
};
static_assert(sizeof(Quad) == 8);

enum class QuadPass : u8 { opaque, cutout, translucent };

// The quads of a section, grouped by pass and direction so that the renderer can leave out faces that look away.
// Direction 0..5 is the face; 6 holds model quads, which look anywhere.
struct SectionMesh {
    static constexpr u32 kDirections = 7;
    static constexpr u32 kGroups = 3 * kDirections;
    static constexpr u32 group(QuadPass pass, u32 direction) { return u32(pass) * kDirections + direction; }
    std::vector<Quad> quads;
    std::array<u32, kGroups + 1> first{}; // group g is quads[first[g] .. first[g + 1])
    // For culling: through which faces, and where in them, sight passes the section (voxel/connectivity.h).
    u64 connections = 0;
    FaceOpenings openings = kWholeFaces;
    bool empty() const { return quads.empty(); }
};

} // namespace vitrail::render
