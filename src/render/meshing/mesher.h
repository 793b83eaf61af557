// The mesher: one 16^3 section and its 26 neighbors in, quads grouped by pass and direction out.
//
// Cubes are merged greedily over bit masks (one 16-bit row a mask, rows compared by look); a merged quad draws exactly
// what its unit faces would: faces merge only with equal look and equal ambient occlusion, and along an axis only where
// the occlusion does not change along it (faces behind leaves, which occlude but hide nothing, stay single). Which
// diagonal splits a quad follows from its four occlusion values in the vertex shader: 0-2 where ao[0] + ao[2] > ao[1] +
// ao[3], else 1-3 (with values growing towards open).
//
// Leaves draw no faces between each other, whatever their kind: a crown is a shell with half the quads, and its holes
// show the inner side of the far leaves where the cutout pass is drawn two-sided. Glass and ice leave out faces between
// equal blocks. Ambient occlusion comes from opaque cubes and leaves; absent chunks cast none.
//
// T-junctions: merging leaves corners of small quads inside edges of large ones, where rounding can open cracks of less
// than a pixel. The vertex shader closes them: it moves the corners of a cube quad outwards, in its plane, by about
// half a pixel's size at their distance. Corners that meet at a convex edge then overlap by as little, which nobody
// sees.
//
// Liquids: a level surface is a merged cube quad (face up, kQuadLiquid) that the vertex shader lowers by kLiquidDrop;
// faces of full liquid cells are cube quads too; sloping surfaces and lowered sides are model quads that meshing may
// add to the table: upload BlockModels::model_quads from the last count on before drawing a new mesh.
#pragma once

#include "render/meshing/quad.h"
#include "scene/block_model.h"
#include "voxel/chunk.h"

#include <array>
#include <memory>

namespace vitrail::render {

struct MeshInput {
    // Index of the chunk at offset dx, dy, dz (each -1..1) in chunks.
    static constexpr u32 index(i32 dx, i32 dy, i32 dz) { return u32((dx + 1) + (dz + 1) * 3 + (dy + 1) * 9); }
    static constexpr u32 kCenter = 13;
    // The section to mesh at kCenter (must be there) and its neighbors; null: absent.
    std::array<const Chunk*, 27> chunks{};
    ChunkPos at{};                              // of the center: chooses among several looks of a model
    const scene::BlockModels* models = nullptr; // holds all states of the chunks
    bool absent_is_opaque = true;               // what absent chunks are: opaque (no faces towards the unknown) or air
    bool ambient_occlusion = true;              // off: every corner open (3)
    bool connections = true;                    // off: SectionMesh::connections stays 0
};

// Memory kept between calls, one a thread; about 600 KiB.
class MeshScratch {
public:
    MeshScratch();
    ~MeshScratch();
    struct Impl;
    Impl& impl() { return *impl_; }

private:
    std::unique_ptr<Impl> impl_;
};

// Replaces the content of `out`; its vectors keep their memory.
void mesh_section(const MeshInput& input, SectionMesh& out, MeshScratch& scratch);

// True where the section draws nothing, found without meshing: all air, or all opaque with opaque sides around.
bool draws_nothing(const MeshInput& input);

// The vector width in use: "avx512", "avx2" or "portable". `force` (tests, benchmarks) takes another one that the
// machine has, or "" for the best; false where it has not.
const char* mesher_path();
bool force_mesher_path(const char* path);

} // namespace vitrail::render
