#include "meshing/reference_mesher.h"

#include <cstdlib>

namespace vitrail::test {

using namespace render;
using scene::LiquidLook;
using scene::ModelKind;

namespace {

constexpr u64 kLookBits = 7ull << 20 | 0xffffffffull << 32;

struct View {
    const MeshInput& in;

    bool absent(i32 x, i32 y, i32 z) const { return !in.chunks[MeshInput::index(x >> 4, y >> 4, z >> 4)]; }
    StateId state(i32 x, i32 y, i32 z) const {
        const Chunk* c = in.chunks[MeshInput::index(x >> 4, y >> 4, z >> 4)];
        return c ? c->blocks.get({x & 15, y & 15, z & 15}) : StateId::air;
    }
    ModelKind kind(i32 x, i32 y, i32 z) const { return in.models->kinds()[u32(state(x, y, z))]; }
    bool opaque(i32 x, i32 y, i32 z) const {
        return absent(x, y, z) ? in.absent_is_opaque : kind(x, y, z) == ModelKind::opaque;
    }
    u16 group(i32 x, i32 y, i32 z) const { return in.models->cull_groups()[u32(state(x, y, z))]; }
    bool occludes(i32 x, i32 y, i32 z) const {
        return !absent(x, y, z) && (kind(x, y, z) == ModelKind::opaque || group(x, y, z) == 1);
    }
    const LiquidLook* liquid(i32 x, i32 y, i32 z) const { return in.models->liquid(state(x, y, z)); }
    u16 fluid(i32 x, i32 y, i32 z) const {
        const LiquidLook* l = liquid(x, y, z);
        return l ? l->fluid : u16(0);
    }
    bool known_opaque(i32 x, i32 y, i32 z) const {
        return !absent(x, y, z) && state(x, y, z) != StateId::hidden && kind(x, y, z) == ModelKind::opaque;
    }

    // What an exposed opaque cell looks like: a hidden one as its nearest known neighbor.
    StateId shown(i32 x, i32 y, i32 z) const {
        if (state(x, y, z) != StateId::hidden) return state(x, y, z);
        StateId best = StateId::hidden;
        i32 best_distance = 1000;
        for (i32 dy = -4; dy <= 4; ++dy)
            for (i32 dz = -4; dz <= 4; ++dz)
                for (i32 dx = -4; dx <= 4; ++dx) {
                    const i32 d = dx * dx + dy * dy + dz * dz;
                    if (d >= best_distance || !known_opaque(x + dx, y + dy, z + dz)) continue;
                    best = state(x + dx, y + dy, z + dz);
                    best_distance = d;
                }
        for (u32 i = 0; i < kChunkVolume && best == StateId::hidden; ++i) {
            const LocalPos p(i);
            if (known_opaque(p.x(), p.y(), p.z())) best = state(p.x(), p.y(), p.z());
        }
        return best;
    }

    u32 occlusion(i32 x, i32 y, i32 z, u32 face) const {
        if (!in.ambient_occlusion) return 255;
        const IVec3 n = kFaceNormal[face];
        const IVec3 u = face < 2 ? IVec3{0, 0, 1} : IVec3{1, 0, 0};
        const IVec3 v = face == 2 || face == 3 ? IVec3{0, 0, 1} : IVec3{0, 1, 0};
        const auto at = [&](i32 a, i32 b) {
            return occludes(x + n.x + a * u.x + b * v.x, y + n.y + a * u.y + b * v.y, z + n.z + a * u.z + b * v.z);
        };
        const auto corner = [&](i32 a, i32 b) -> u32 {
            const bool s1 = at(a, 0), s2 = at(0, b);
            if (s1 && s2) return 0;
            return 3 - (u32(s1) + u32(s2) + u32(at(a, b)));
        };
        return corner(-1, -1) | corner(1, -1) << 2 | corner(1, 1) << 4 | corner(-1, 1) << 6;
    }
};

void add_liquid(const View& w, i32 x, i32 y, i32 z, u32 cell, UnitFaces& out) {
    const LiquidLook& look = *w.liquid(x, y, z);
    const u32 pass = u32(look.pass);
    const auto bends = [&](i32 dx, i32 dz) {
        const LiquidLook* l = w.liquid(x + dx, y, z + dz);
        if (!l || l->fluid != look.fluid) return false;
        return l->height != 228 || w.fluid(x + dx, y + 1, z + dz) == look.fluid;
    };
    bool level = true;
    for (i32 dz = -1; dz <= 1; ++dz)
        for (i32 dx = -1; dx <= 1; ++dx)
            level &= !bends(dx, dz);
    const bool full = w.fluid(x, y + 1, z) == look.fluid;
    for (u32 f = 0; f < 6; ++f) {
        const IVec3 n = kFaceNormal[f];
        if (w.opaque(x + n.x, y + n.y, z + n.z) || w.fluid(x + n.x, y + n.y, z + n.z) == look.fluid) continue;
        const bool cube = f == 2 || (f == 3 ? level : full);
        if (cube)
            out.cubes[{pass, f, cell}] = {(f == 2 || f == 3 ? look.still : look.flow) | u64(f) << 20, 255};
        else
            ++out.slopes[{pass, cell, f}];
    }
}

} // namespace

UnitFaces reference_mesh(const MeshInput& input) {
    UnitFaces out;
    const View w{input};
    for (u32 cell = 0; cell < kChunkVolume; ++cell) {
        const LocalPos p(cell);
        const i32 x = p.x(), y = p.y(), z = p.z();
        const ModelKind kind = w.kind(x, y, z);
        if (kind == ModelKind::nothing) continue;
        if (w.fluid(x, y, z) != 0) add_liquid(w, x, y, z, cell, out);
        if (kind == ModelKind::liquid) continue;
        if (kind == ModelKind::model) {
            for (const scene::StateQuad& q : input.models->quads(w.state(x, y, z))) {
                if (q.cull != scene::StateQuad::kNoCull) {
                    const IVec3 n = kFaceNormal[q.cull];
                    if (w.opaque(x + n.x, y + n.y, z + n.z)) continue;
                }
                ++out.models[{u32(q.pass), cell, q.bits}];
            }
            continue;
        }
        for (u32 f = 0; f < 6; ++f) {
            const IVec3 n = kFaceNormal[f];
            if (w.opaque(x + n.x, y + n.y, z + n.z)) continue;
            if (kind != ModelKind::opaque && w.group(x, y, z) == w.group(x + n.x, y + n.y, z + n.z)) continue;
            const u32 pass = kind == ModelKind::opaque ? 0 : kind == ModelKind::cutout ? 1 : 2;
            out.cubes[{pass, f, cell}] = {input.models->faces(w.shown(x, y, z))[f], w.occlusion(x, y, z, f)};
        }
    }
    return out;
}

UnitFaces unit_faces(const SectionMesh& mesh, const scene::BlockModels& models) {
    UnitFaces out;
    if (mesh.first[SectionMesh::kGroups] != mesh.quads.size()) out.error = "the groups do not cover the quads";
    for (u32 g = 0; g < SectionMesh::kGroups; ++g) {
        const u32 pass = g / SectionMesh::kDirections, direction = g % SectionMesh::kDirections;
        for (u32 i = mesh.first[g]; i < mesh.first[g + 1]; ++i) {
            const Quad q = mesh.quads[i];
            const u32 cell = LocalPos(i32(q.x()), i32(q.y()), i32(q.z())).index;
            if (q.is_model() != (direction == 6)) out.error = "a quad in a wrong group";
            if (q.is_model()) {
                const u64 bits = q.bits & ~0xfffull;
                if (bits & kQuadLiquid) {
                    const auto n = models.model_quad(q.model_quad()).normal;
                    u32 face = 3;
                    for (u32 f = 0; f < 6; ++f)
                        if (f != 3 && n[0] == kFaceNormal[f].x * 127 && n[1] == kFaceNormal[f].y * 127 &&
                            n[2] == kFaceNormal[f].z * 127)
                            face = f;
                    ++out.slopes[{pass, cell, face}];
                } else
                    ++out.models[{pass, cell, bits}];
                continue;
            }
            const u32 f = u32(q.face()), ao = q.ao();
            if (f != direction) out.error = "a face in a wrong group";
            // Merged quads may not change what the unit faces show.
            const u32 a = ao & 3, b = ao >> 2 & 3, c = ao >> 4 & 3, d = ao >> 6;
            if (q.w() > 1 && (a != b || d != c)) out.error = "merged along u over changing occlusion";
            if (q.h() > 1 && (a != d || b != c)) out.error = "merged along v over changing occlusion";
            for (u32 j = 0; j < q.h(); ++j)
                for (u32 k = 0; k < q.w(); ++k) {
                    const u32 x = q.x() + (f < 2 ? 0 : k),
                              z = q.z() + (f < 2   ? k
                                           : f < 4 ? j
                                                   : 0),
                              y = q.y() + (f == 2 || f == 3 ? 0 : j);
                    if (x > 15 || y > 15 || z > 15) {
                        out.error = "a quad leaves the section";
                        continue;
                    }
                    const u32 unit = LocalPos(i32(x), i32(y), i32(z)).index;
                    if (!out.cubes.emplace(UnitFaces::Key{pass, f, unit}, std::pair{q.bits & kLookBits, ao}).second)
                        out.error = "two quads cover one face";
                }
        }
    }
    return out;
}

} // namespace vitrail::test
