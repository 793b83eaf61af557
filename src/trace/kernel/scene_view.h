// All that a ray can ask of the world: the grid and the tables that say what its states are. Plain pointers, of one
// device. Kernel-safe. Filled by trace/content/ (states, quads, pictures), trace/grid/, trace/lights/.
#pragma once

#include "trace/kernel/grid_view.h"
#include "trace/kernel/light_view.h"

namespace vitrail::trace {

// How a surface treats light.
enum class Optics : u8 {
    matte = 0,      // diffuse under a rough dielectric coat (GGX) as the texel's roughness says
    metal = 1,      // GGX, albedo is the reflectance
    leaf = 2,       // diffuse on both sides: part of the light goes through
    thin = 3,       // a sheet of glass without thickness: mirrors a little, lets light through straight, tinted
    dielectric = 4, // border of a medium: refracts; smooth or rough as the texel says
    water = 5,      // dielectric with waves
};

enum class CellKind : u8 {
    empty = 0,
    cube = 1,    // every face opaque
    cutout = 2,  // full cube whose texels may have holes
    medium = 3,  // full cube of glass, ice, crystal: faces between equal media are not there
    liquid = 4,  // surface from the levels around (trace/kernel/liquid.h)
    model = 5,   // quads
    detailed = 6 // opaque cube, and quads that stand out of it
};

// One block state, 64 bytes. Index: StateId.
struct StateRecord {
    u64 faces[6] = {};  // scene::FaceLook of cubes and media; a liquid: [up] still, [north] flow
    u32 first_quad = 0; // into SceneView::quads
    u16 quads = 0;
    CellKind kind = CellKind::empty;
    u8 medium = 0; // of the cell's inside: index into SceneView::media; 0 air. Waterlogged models: water's
    // In kEmissionUnit: lamp radiance of a white emission texel of 1, already balanced for the emitting area
    // (trace/content/emission.h).
    static constexpr float kEmissionUnit = 1.0f / 16;
    u16 emission[3] = {0, 0, 0};
    u8 optics = 0;        // Optics of its cube faces
    u8 liquid_height = 0; // liquids: of the level surface, 1/256 block - 1
};
static_assert(sizeof(StateRecord) == 64);

// A quad of a model, in its cell. 96 bytes.
struct TraceQuad {
    Vec3 corner; // of texture coordinate (u0, v0): a point is corner + a edge_a + b edge_b, 0 <= a, b <= 1
    u32 texture; // layer
    Vec3 edge_a; // parallelogram; where a model's quad is none it is split into triangles (kTriangle: a + b <= 1)
    u32 look;    // tint kind 0..2, fixed tint 8..15, Optics 16..19, flags 24..
    Vec3 edge_b;
    u32 medium;                                           // dielectric: what lies behind its front, else 0
    Vec3 normal;                                          // unit, geometric, front
    float emission_scale = 1;                             // on StateRecord::emission
    float u0 = 0, v0 = 0, ua = 0, va = 0, ub = 0, vb = 0; // texture coordinates of corner, and along the edges
    // For sampling: mean of what its texels send of the state's emission, and the part of it that shines: a least, a
    // most, b least, b most, 0..255 each.
    float shine = 1;
    u32 shining_part = 0xff00ff00;
    static constexpr u32 kTriangle = 1u << 24, kTwoSided = 1u << 25, kCutout = 1u << 26, kUnshaded = 1u << 27;
};
static_assert(sizeof(TraceQuad) == 96);

struct MediumRecord {
    float ior = 1;
    Vec3 absorption{}, scattering{}; // a block, base e; water's follow from the biome's tint instead (tinted)
    bool tinted = false;
    u8 kind = 0; // 0 air, 1 water, 2 other
    // Of fluids: where the fluid does not lie above too, no surface is higher than so many 1/256 block.
    u16 liquid_top = 256;
};

// Square layers of RGBA8; level 0 only is `size` wide, further levels follow in each layer. Albedo sRGB-encoded; alpha
// as in render/texture_set.h. material: normal x, y, roughness, emission.
struct TextureView {
    const u32* albedo = nullptr;
    const u32* material = nullptr;
    u32 size_bits = 5, levels = 1, layers = 0;
    u32 layer_words = 0; // of all levels of a layer
};

struct EntityBox {
    Place least;
    Vec3 size;     // blocks
    u32 state = 0; // looks like this block's faces
};

// Nodes of a small tree of boxes, relative to `SceneView::boxes_from`; children follow each other.
struct BoxNode {
    Vec3 least, most;
    u32 first = 0, count = 0; // count 0: children first, first + 1; else boxes
};

struct SceneView {
    GridView grid;
    const StateRecord* states = nullptr;
    u32 state_count = 0;
    const TraceQuad* quads = nullptr;
    const MediumRecord* media = nullptr;
    TextureView textures;
    const u32* fixed_tints = nullptr; // sRGB RGBA8, 256
    LightView lights;
    const EntityBox* boxes = nullptr;
    const BoxNode* box_nodes = nullptr;
    u32 box_count = 0;
    Place boxes_from;
    float seconds = 0;     // of animation (waves)
    float wave_height = 0; // blocks
};

} // namespace vitrail::trace
