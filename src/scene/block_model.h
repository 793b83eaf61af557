// What block states look like, compiled once a state from the content's BlockLook: full cubes as six packed face looks
// that the mesher compares and merges, everything else as a list of quads in one table shared by all states and
// uploaded to the GPU once. The raster renderer and the path tracer take the same.
//
//     BlockModels models;
//     models.ensure(states);                  // before meshing chunks whose states may be new; cheap when nothing is
//     models.kinds()[u32(id)]                 // ModelKind of a state, flat
//     models.faces(id)[u8(Face::up)]          // FaceLook of a cube
//     for (const StateQuad& q : models.quads(id)) ...
//
// Resource packs may replace looks (scene/pack_looks.h), never what a state is: an opaque full cube stays one. What
// packs lay around such a cube makes it `detailed`. Models that packs give several looks are chosen by position:
// quads(id, random).
//
// Thread-safe: `ensure` may run on any thread at any time; readers need no lock for ids below size().
//
// Textures: seen from outside a face, s runs to the right and t down, as in Minecraft: s = +z for west, -z for east, +x
// for down, up and south, -x for north; t = -y for the four sides, +z for up, -z for down. In block space, so that
// neighboring blocks' textures line up; FaceLook's quarter turns then turn the picture clockwise.
#pragma once

#include "world/state_table.h"

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace vitrail::scene {

class PackLooks;

// Only kinds that hide what is behind them are odd, so that kinds() serves as flags for voxel/surface.h and
// voxel/connectivity.h (bit 1).
enum class ModelKind : u8 {
    nothing = 0,     // draws nothing
    opaque = 1,      // full cube that hides what is behind it
    cutout = 2,      // full cube with holes (leaves, spawner)
    detailed = 3,    // opaque, and quads() that stand out of the cube
    translucent = 4, // full cube of glass or ice: faces between equal states are left out
    liquid = 6,      // model quads that follow from the neighbors (surface corners), made by the mesher
    model = 8,       // fixed model quads
};

constexpr bool hides(ModelKind kind) {
    return u8(kind) & 1;
}

// How a cube's face looks: the bits of render::Quad (render/meshing/quad.h) but position, size and ambient occlusion,
// so that equal bits merge: face 20..22, texture 32..47, tint 48..50, fixed tint 51..58, flags 59..61, quarter
// turns 62..63.
using FaceLook = u64;

// Which pass draws a quad; the values of render::QuadPass.
enum class ModelPass : u8 { opaque, cutout, translucent };

// A liquid source's surface lies this much below the top of its cell, 1/256 block (8/9 high; render::kLiquidDrop).
inline constexpr i32 kLiquidDropUnits = 28;
inline constexpr i32 kModelUnit = 256; // corner positions and texture coordinates are in 1/256 block

// One quad of a model, 48 bytes as the vertex shader reads them (12 little-endian 32-bit words).
struct ModelQuad {
    struct Corner {
        i16 x = 0, y = 0, z = 0; // 1/256 block from the cell's least corner, -32..288 in practice
        i16 s = 0;               // texture coordinate, 1/256 texture
        friend bool operator==(const Corner&, const Corner&) = default;
    };
    std::array<Corner, 4> corners{}; // counterclockwise seen from its front; drawn as triangles 0 1 2 and 0 2 3
    std::array<i16, 4> t{};          // texture coordinate of each corner, downwards, 1/256 texture
    std::array<i8, 3> normal{};      // unit length = 127
    u8 flags = 0;                    // kTwoSided, kUnshaded
    u32 reserved = 0;
    static constexpr u8 kTwoSided = 1; // seen from both sides: never cull; light it as if it faced the viewer
    static constexpr u8 kUnshaded = 2; // plants: lit without regard to the normal (use straight up)
    friend bool operator==(const ModelQuad&, const ModelQuad&) = default;
};
static_assert(sizeof(ModelQuad) == 48);

// A model quad as a state draws it.
struct StateQuad {
    u64 bits = 0;      // render::Quad::model(...) at the cell 0, 0, 0
    u8 cull = kNoCull; // left out where the neighbor at this Face is an opaque cube
    ModelPass pass = ModelPass::opaque;
    static constexpr u8 kNoCull = 6;
};

// What the mesher needs of a liquid state.
struct LiquidLook {
    u16 height = 0;               // of the surface in 1/256 block; 256 full (falling)
    u16 fluid = 0;                // equal for states of one fluid (water of all levels); 0: holds no fluid
    FaceLook still = 0, flow = 0; // surface (top and bottom); sides
    ModelPass pass = ModelPass::translucent;
};

class BlockModels {
public:
    static constexpr u32 kMaxModelQuads = 1u << 19; // the index bits of a render::Quad
    BlockModels()
        : BlockModels(nullptr) {}
    explicit BlockModels(std::shared_ptr<const PackLooks> packs); // packs: of the same registry as the states', or null
    ~BlockModels();
    BlockModels(const BlockModels&) = delete;
    BlockModels& operator=(const BlockModels&) = delete;

    // Compiles every state of the table that is not compiled yet. Always the same table. Once kMaxModelQuads is reached
    // further models are drawn as plain cubes.
    void ensure(const StateTable& states);
    // States compiled; ids below may be read.
    u32 size() const;

    // Flat arrays for hot loops, StateTable::kCapacity entries, zero beyond size().
    const ModelKind* kinds() const { return kinds_; }
    // Six looks a state, in Face order, index state * 6 + face; zero for states that are no cube.
    const FaceLook* face_looks() const { return looks_; }
    std::span<const FaceLook, 6> faces(StateId id) const {
        return std::span<const FaceLook, 6>(looks_ + u64(id) * 6, 6);
    }
    // Quads of states of kind `model` and `detailed`; empty for others. Of several looks the likeliest.
    std::span<const StateQuad> quads(StateId id) const;
    // Of several looks the one that belongs to a random number (32 bits, of the block's position).
    std::span<const StateQuad> quads(StateId id, u32 random) const;
    // Of states of kind `liquid`, and of waterlogged models (then `fluid` is set); null for others.
    const LiquidLook* liquid(StateId id) const;
    // Cubes that are not opaque leave out faces between states of one group (all leaves are one; else one a block).
    // 0 for other kinds.
    const u16* cull_groups() const { return groups_; }

    // The table of model quads; grows, entries never change. `from`: copies of entries from .. count-1, for uploading.
    u32 model_quad_count() const;
    std::vector<ModelQuad> model_quads(u32 from) const;
    ModelQuad model_quad(u32 index) const;
    // Adds a quad unless there is an equal one; its index, or kMaxModelQuads when full. For liquid surfaces (mesher).
    u32 intern_quad(const ModelQuad& quad) const;

    // Table of fixed tints, sRGB; 0 is white, 256 at most; grows, entries never change.
    std::vector<std::array<u8, 3>> fixed_tints() const;

private:
    struct Impl;
    void compile(const StateTable& states, u32 id);
    bool compile_from_packs(const StateTable& states, u32 id);
    bool add_own_shape(const StateTable& states, u32 id, std::vector<StateQuad>& quads);
    void set_kind(u32 id, const StateInfo& info, ModelKind kind);
    std::unique_ptr<Impl> impl_;
    ModelKind* kinds_ = nullptr;
    FaceLook* looks_ = nullptr;
    u16* groups_ = nullptr;
};

} // namespace vitrail::scene
