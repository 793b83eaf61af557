#include "render/meshing/mesh_scratch.h"

#include "base/hash.h"
#include "scene/liquid_surface.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace vitrail::render {

using scene::hides;
using scene::kModelUnit;
using scene::LiquidLook;
using scene::ModelQuad;

namespace {

// Bit f: the cell beside (border coordinates 1..16) at Face f is set.
u32 beside(const PaddedMask& m, u32 x, u32 y, u32 z) {
    return (m.rows[y][z] >> (x - 1) & 1) | (m.rows[y][z] >> (x + 1) & 1) << 1 | (m.rows[y - 1][z] >> x & 1) << 2 |
           (m.rows[y + 1][z] >> x & 1) << 3 | (m.rows[y][z - 1] >> x & 1) << 4 | (m.rows[y][z + 1] >> x & 1) << 5;
}

u64 position_bits(u32 x, u32 y, u32 z) {
    return u64(x) | u64(y) << 4 | u64(z) << 8;
}

// The same for a block in every mesh it is part of.
u32 position_random(ChunkPos chunk, u32 x, u32 y, u32 z) {
    const BlockPos at{chunk.x * kChunkSize + i32(x), chunk.y * kChunkSize + i32(y), chunk.z * kChunkSize + i32(z)};
    return u32(mix64(hash_combine(hash_combine(u64(u32(at.x)), u64(u32(at.y))), u64(u32(at.z)))) >> 32);
}

bool test(const PaddedMask& m, i32 x, i32 y, i32 z) { // section coordinates -1..16
    return m.rows[y + 1][z + 1] >> (x + 1) & 1;
}

// What scene/liquid_surface.h asks of a cell.
i32 liquid_in(const MeshInput& input, const PaddedMask& fluid, u16 fluid_id, i32 x, i32 y, i32 z) {
    if (!test(fluid, x, y, z)) return scene::kLiquidNone;
    if (test(fluid, x, y + 1, z)) return scene::kLiquidUnderLiquid;
    const LiquidLook* look = input.models->liquid(state_at(input, x, y, z, StateId::air));
    return look && look->fluid == fluid_id ? look->height : scene::kLiquidNone;
}

u64 model_bits(u32 index) {
    return u64(index & 2047) << 12 | 1ull << 23 | u64(index >> 11) << 24;
}

ModelQuad top_quad(const scene::LiquidSlope& s) {
    ModelQuad q;
    const i16 u = kModelUnit;
    q.corners = {{{0, i16(s.h01), u, 0}, {u, i16(s.h11), u, u}, {u, i16(s.h10), 0, u}, {0, i16(s.h00), 0, 0}}};
    q.t = {u, u, 0, 0};
    const float nx = float(s.h00 + s.h01 - s.h10 - s.h11) / 2, nz = float(s.h00 + s.h10 - s.h01 - s.h11) / 2,
                ny = kModelUnit;
    const float scale = 127 / std::sqrt(nx * nx + ny * ny + nz * nz);
    q.normal = {i8(std::lround(nx * scale)), i8(std::lround(ny * scale)), i8(std::lround(nz * scale))};
    q.flags = ModelQuad::kTwoSided;
    return q;
}

// A side from the cell's bottom to the surface.
ModelQuad side_quad(Face face, const scene::LiquidSlope& s) {
    const i16 u = kModelUnit;
    ModelQuad q;
    const auto put = [&](i32 x0, i32 z0, i32 h0, i32 x1, i32 z1, i32 h1) { // left and right as seen from outside
        q.corners = {{{i16(x0), 0, i16(z0), 0},
                      {i16(x1), 0, i16(z1), u},
                      {i16(x1), i16(h1), i16(z1), u},
                      {i16(x0), i16(h0), i16(z0), 0}}};
        q.t = {u, u, i16(u - h1), i16(u - h0)};
    };
    switch (face) {
    case Face::west:
        put(0, 0, s.h00, 0, u, s.h01);
        break;
    case Face::east:
        put(u, u, s.h11, u, 0, s.h10);
        break;
    case Face::north:
        put(u, 0, s.h10, 0, 0, s.h00);
        break;
    default:
        put(0, u, s.h01, u, u, s.h11);
        break;
    }
    const IVec3 n = kFaceNormal[u32(face)];
    q.normal = {i8(n.x * 127), 0, i8(n.z * 127)};
    return q;
}

void mesh_fluid(const MeshInput& input, MeshScratch::Impl& s, const LiquidLook& look) {
    const scene::BlockModels& models = *input.models;
    LayerMasks& m = next_layer_masks(s);
    gather_classes(
        input, s.cells,
        [&](StateId id) {
            const LiquidLook* l = models.kinds()[u32(id)] >= scene::ModelKind::liquid ? models.liquid(id) : nullptr;
            if (!l || l->fluid != look.fluid) return u8(0);
            return u8(1 | (l->height == kModelUnit - scene::kLiquidDropUnits ? 2 : 0)); // 2: a source
        },
        0, true, true, s.class_table, m.cells);
    const PaddedMask& fluid = m.cells.first;
    for (u32 y = 0; y < 18; ++y)
        for (u32 z = 0; z < 18; ++z)
            m.blockers.rows[y][z] = fluid.rows[y][z] | s.opaque.first.rows[y][z];
    const u32 exposed = mesh_kernels().exposed(fluid, m.blockers);
    if (!exposed) return;

    // Cells that bend the surface: no source, or with the fluid above.
    PaddedMask& bends = m.side_turned; // borrowed
    for (u32 y = 0; y < 18; ++y)
        for (u32 z = 0; z < 18; ++z) {
            const u32 above = y < 17 ? fluid.rows[y + 1][z] : 0;
            const u32 source = m.cells.differ ? m.cells.second.rows[y][z] : fluid.rows[y][z];
            const u32 b = fluid.rows[y][z] & (~source | above);
            bends.rows[y][z] = b | b << 1 | b >> 1;
        }
    bool full = false;
    for (u32 y = 0; y < 18; ++y)
        for (u32 z = 0; z < 18; ++z) {
            const bool inside = y >= 1 && y < 17 && z >= 1 && z < 17;
            const u32 f = inside ? fluid.rows[y][z] & 0x1fffe : 0;
            const u32 bent = inside ? bends.rows[y][z] | bends.rows[y][z - 1] | bends.rows[y][z + 1] : 0;
            m.up.rows[y][z] = f & ~bent;
            m.side.rows[y][z] = inside ? f & fluid.rows[y + 1][z] : 0;
            full |= m.side.rows[y][z] != 0;
        }

    MeshLayer layer;
    layer.pass = look.pass;
    layer.exposed = exposed;
    layer.fluid = look.fluid;
    for (u32 f = 0; f < 6; ++f)
        layer.fluid_looks[f] = (f == 2 || f == 3 ? look.still : look.flow) | u64(f) << 20;
    layer.down = &fluid;
    layer.up = &m.up;
    layer.side = &m.side;
    layer.blockers = &m.blockers;
    if (exposed & 3) {
        if (full) {
            mesh_kernels().transpose(m.side, m.side_turned);
            mesh_kernels().transpose(m.blockers, m.blockers_turned);
            layer.side_turned = &m.side_turned;
            layer.blockers_turned = &m.blockers_turned;
        } else
            layer.exposed &= ~3u;
    }
    s.layers.push_back(layer);

    // The rest: sloping tops, and sides below a surface.
    std::vector<u64>& quads = s.models[u32(look.pass)];
    for (u32 y = 1; y < 17; ++y)
        for (u32 z = 1; z < 17; ++z) {
            const u32 f = fluid.rows[y][z] & 0x1fffe & ~m.side.rows[y][z]; // no fluid above
            const u32 tops = f & ~m.blockers.rows[y + 1][z] & ~m.up.rows[y][z];
            const u32 open = ~m.blockers.rows[y][z];
            const u32 sides = f & (open << 1 | open >> 1 | ~m.blockers.rows[y][z - 1] | ~m.blockers.rows[y][z + 1]);
            for (u32 todo = tops | sides; todo; todo &= todo - 1) {
                const u32 x = u32(std::countr_zero(todo));
                const i32 bx = i32(x) - 1, by = i32(y) - 1, bz = i32(z) - 1;
                const scene::LiquidSlope slope = scene::liquid_slope(
                    [&](i32 dx, i32 dz) { return liquid_in(input, fluid, look.fluid, bx + dx, by, bz + dz); });
                const auto add = [&](const ModelQuad& q, u64 bits) {
                    const u32 index = models.intern_quad(q);
                    if (index < scene::BlockModels::kMaxModelQuads)
                        quads.push_back(model_bits(index) | bits | position_bits(x - 1, y - 1, z - 1));
                };
                if (tops >> x & 1) add(top_quad(slope), look.still);
                const u32 closed = beside(m.blockers, x, y, z);
                for (const Face face : {Face::west, Face::east, Face::north, Face::south})
                    if (!(closed >> u32(face) & 1)) add(side_quad(face, slope), look.flow);
            }
        }
}

} // namespace

void mesh_models(const MeshInput& input, MeshScratch::Impl& s, const RowMask& cells) {
    for (u32 row = 0; row < 256; ++row)
        for (u32 bits = cells[row]; bits; bits &= bits - 1) {
            const u32 x = u32(std::countr_zero(bits)), y = row >> 4, z = row & 15;
            const StateId id =
                s.cells.palette.size() == 1 ? s.cells.palette[0] : s.cells.palette[s.cells.at(row * 16 + x)];
            const u32 closed = beside(s.opaque.first, x + 1, y + 1, z + 1);
            if (closed == 63 && hides(input.models->kinds()[u32(id)])) continue; // nobody sees what stands out of it
            const u64 at = position_bits(x, y, z);
            for (const scene::StateQuad& q : input.models->quads(id, position_random(input.at, x, y, z)))
                if (!(closed >> q.cull & 1)) s.models[u32(q.pass)].push_back(q.bits | at);
        }
}

void mesh_liquids(const MeshInput& input, MeshScratch::Impl& s) {
    u16 done[16];
    u32 count = 0;
    for (std::size_t i = 0; i < s.cells.palette.size() && count < 16; ++i) {
        const StateId id = s.cells.palette[i];
        if (input.models->kinds()[u32(id)] < scene::ModelKind::liquid) continue;
        const LiquidLook* look = input.models->liquid(id);
        if (!look || std::find(done, done + count, look->fluid) != done + count) continue;
        done[count++] = look->fluid;
        mesh_fluid(input, s, *look);
    }
}

} // namespace vitrail::render
