#include "render/meshing/mesher.h"

#include "base/assert.h"
#include "render/meshing/mesh_scratch.h"
#include "voxel/connectivity.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace vitrail::render {

using scene::BlockModels;
using scene::hides;
using scene::ModelKind;
using scene::ModelPass;

static_assert(u32(ModelPass::cutout) == u32(QuadPass::cutout) &&
              u32(ModelPass::translucent) == u32(QuadPass::translucent));
static_assert(u32(scene::kLiquidDropUnits) == kLiquidDrop);

namespace {

constexpr u16 kLeaves = 1; // BlockModels::cull_groups

struct Contents {
    bool opaque = false, other = false, grouped = false, liquid = false, model = false, hidden = false;
};

Contents contents_of(std::span<const StateId> palette, const BlockModels& models) {
    Contents out;
    for (const StateId id : palette) {
        switch (models.kinds()[u32(id)]) {
        case ModelKind::opaque:
            out.opaque = true;
            break;
        case ModelKind::detailed:
            out.opaque = out.model = true;
            break;
        case ModelKind::cutout:
        case ModelKind::translucent:
            out.grouped = true;
            break;
        case ModelKind::liquid:
            out.liquid = true;
            break;
        case ModelKind::model:
            out.model = true;
            out.liquid |= models.liquid(id) != nullptr;
            break;
        case ModelKind::nothing:
            break;
        }
        out.other |= !hides(models.kinds()[u32(id)]);
        out.hidden |= id == StateId::hidden;
    }
    return out;
}

bool all_opaque(const Chunk* chunk, const MeshInput& input) {
    if (!chunk) return input.absent_is_opaque;
    for (const StateId id : chunk->blocks.palette())
        if (!hides(input.models->kinds()[u32(id)])) return false;
    return true;
}

constexpr std::array<u32, 6> kFaceNeighbors{MeshInput::index(-1, 0, 0), MeshInput::index(1, 0, 0),
                                            MeshInput::index(0, -1, 0), MeshInput::index(0, 1, 0),
                                            MeshInput::index(0, 0, -1), MeshInput::index(0, 0, 1)};

bool buried(const MeshInput& input) {
    return std::all_of(kFaceNeighbors.begin(), kFaceNeighbors.end(),
                       [&](u32 i) { return all_opaque(input.chunks[i], input); });
}

// Looks of the palette by direction, and which directions tell the same entries apart.
void read_looks(const MeshInput& input, MeshScratch::Impl& s) {
    const std::size_t n = s.cells.palette.size();
    s.equalities_used = 0;
    static thread_local std::vector<u32> order;
    std::vector<u16> same(n);
    for (u32 f = 0; f < 6; ++f) {
        std::vector<u64>& looks = s.looks[f];
        looks.resize(std::max<std::size_t>(n, 16));
        for (std::size_t i = 0; i < n; ++i)
            looks[i] = input.models->face_looks()[u64(s.cells.palette[i]) * 6 + f];
        bool identity = true;
        if (n <= 24) {
            for (std::size_t i = 0; i < n; ++i) {
                std::size_t j = looks[i] ? 0 : i;
                while (looks[j] != looks[i])
                    ++j;
                same[i] = u16(j);
                identity &= j == i;
            }
        } else {
            order.resize(n);
            std::iota(order.begin(), order.end(), 0u);
            std::sort(order.begin(), order.end(),
                      [&](u32 a, u32 b) { return looks[a] != looks[b] ? looks[a] < looks[b] : a < b; });
            for (std::size_t i = 0, first = 0; i < n; ++i) {
                if (looks[order[i]] != looks[order[first]] || looks[order[i]] == 0) first = i;
                same[order[i]] = u16(order[first]);
                identity &= first == i;
            }
        }
        u32 e = 0;
        while (e < s.equalities_used && s.equalities[e].same_as != same)
            ++e;
        if (e == s.equalities_used) {
            if (e == s.equalities.size()) s.equalities.emplace_back();
            s.equalities[e].same_as = same;
            s.equalities[e].identity = identity;
            s.equalities[e].have = 0;
            ++s.equalities_used;
        }
        s.equality_of[f] = e;
    }
}

// Mask `which`: 0..2 axis x, y, z; 3, 4: y, z transposed.
const RowMask* equality(MeshScratch::Impl& s, u32 face, u32 which) {
    if (s.cells.palette.size() == 1) return nullptr;
    EqualityMasks& e = s.equalities[s.equality_of[face]];
    if (e.have >> which & 1) return &e.masks[which];
    e.have |= 1u << which;
    if (which >= 3) {
        const RowMask* straight = equality(s, face, which - 2);
        mesh_kernels().transpose_rows(*straight, e.masks[which]);
        return &e.masks[which];
    }
    if (s.cells.is_wide) {
        s.translated_wide.resize(4096 + 256);
        for (u32 i = 0; i < 4096; ++i)
            s.translated_wide[i] = e.same_as[s.cells.wide[i]];
        mesh_kernels().equal_next_wide(s.translated_wide.data(), which, e.masks[which]);
    } else if (e.identity) {
        mesh_kernels().equal_next(s.cells.narrow.data(), which, e.masks[which]);
    } else {
        alignas(64) u8 table[256] = {};
        for (std::size_t i = 0; i < e.same_as.size(); ++i)
            table[i] = u8(e.same_as[i]);
        mesh_kernels().translate(s.cells.narrow.data(), u32(e.same_as.size()), table, s.translated.data());
        mesh_kernels().equal_next(s.translated.data(), which, e.masks[which]);
    }
    return &e.masks[which];
}

void mesh_layer(const MeshLayer& layer, u32 face, bool occlusion, MeshScratch::Impl& s) {
    DirectionJob job;
    job.face = face;
    const bool turned = face < 2;
    job.cells = turned ? layer.side_turned : face == 2 ? layer.down : face == 3 ? layer.up : layer.side;
    job.blockers = turned ? layer.blockers_turned : layer.blockers;
    if (layer.fluid) {
        job.looks = &layer.fluid_looks[face];
    } else {
        if (occlusion) {
            if (s.opaque.differ)
                job.occluders = turned ? &s.occluders_turned : &s.opaque.second;
            else
                job.occluders = turned ? &s.opaque_turned : &s.opaque.first;
        }
        s.cells.expand(*s.blocks);
        job.equal_u = equality(s, face, turned ? 4 : 0);
        job.equal_v = equality(s, face, turned ? 3 : face < 4 ? 2 : 1);
        job.looks = s.looks[face].data();
        job.narrow = s.cells.is_wide ? nullptr : s.cells.narrow.data();
        job.wide = s.cells.is_wide ? s.cells.wide.data() : nullptr;
    }
    if (s.quads.size() < s.end + 4096) s.quads.resize(s.end + 8192);
    s.end = std::size_t(mesh_kernels().mesh_direction(job, s.quads.data() + s.end) - s.quads.data());
}

// Layers of see-through cubes: one for each group in the palette.
void add_groups(const MeshInput& input, MeshScratch::Impl& s) {
    const BlockModels& models = *input.models;
    u16 done[64];
    u32 count = 0;
    std::vector<u16> many; // beyond 64 groups, which no world has in one section but a test may
    for (const StateId id : s.cells.palette) {
        const u16 group = models.cull_groups()[u32(id)];
        if (group == 0 || std::find(done, done + count, group) != done + count ||
            std::find(many.begin(), many.end(), group) != many.end())
            continue;
        if (count < 64)
            done[count++] = group;
        else
            many.push_back(group);
        LayerMasks& m = next_layer_masks(s);
        gather_classes(
            input, s.cells, [&](StateId state) { return u8(models.cull_groups()[u32(state)] == group); }, 0, false,
            false, s.class_table, m.cells);
        for (u32 y = 0; y < 18; ++y)
            for (u32 z = 0; z < 18; ++z)
                m.blockers.rows[y][z] = m.cells.first.rows[y][z] | s.opaque.first.rows[y][z];
        MeshLayer layer;
        layer.pass = models.kinds()[u32(id)] == ModelKind::translucent ? ModelPass::translucent : ModelPass::cutout;
        layer.exposed = mesh_kernels().exposed(m.cells.first, m.blockers);
        layer.down = layer.up = layer.side = &m.cells.first;
        layer.blockers = &m.blockers;
        if (layer.exposed & 3) {
            mesh_kernels().transpose(m.cells.first, m.side_turned);
            mesh_kernels().transpose(m.blockers, m.blockers_turned);
            layer.side_turned = &m.side_turned;
            layer.blockers_turned = &m.blockers_turned;
        }
        if (layer.exposed) s.layers.push_back(layer);
    }
}

} // namespace

MeshScratch::MeshScratch()
    : impl_(std::make_unique<Impl>()) {}
MeshScratch::~MeshScratch() = default;

bool draws_nothing(const MeshInput& input) {
    const Chunk* center = input.chunks[MeshInput::kCenter];
    const Contents c = contents_of(center->blocks.palette(), *input.models);
    if (!c.opaque && !c.grouped && !c.liquid && !c.model) return true;
    return !c.other && buried(input);
}

void mesh_section(const MeshInput& input, SectionMesh& out, MeshScratch& scratch) {
    VX_ASSERT(input.chunks[MeshInput::kCenter] && input.models);
    const Chunk& center = *input.chunks[MeshInput::kCenter];
    const BlockModels& models = *input.models;
    MeshScratch::Impl& s = scratch.impl();
    out.quads.clear();
    out.first.fill(0);
    SectionSight sight{0, kWholeFaces};
    if (input.connections)
        sight = section_sight(center.blocks, {reinterpret_cast<const u8*>(models.kinds()), u8(ModelKind::opaque)});
    out.connections = sight.connections, out.openings = sight.openings;

    const Contents has = contents_of(center.blocks.palette(), models);
    if (!has.opaque && !has.grouped && !has.liquid && !has.model) return;
    if (!has.other && buried(input)) return;

    s.cells.start(center.blocks);
    s.blocks = &center.blocks;
    s.layers.clear();
    s.owned_used = 0;
    s.end = 0;
    for (auto& m : s.models)
        m.clear();
    const auto* kinds = models.kinds();
    const u16* groups = models.cull_groups();
    gather_classes(
        input, s.cells,
        [&](StateId id) {
            const bool opaque = hides(kinds[u32(id)]);
            return u8(u8(opaque) | u8(opaque || groups[u32(id)] == kLeaves) << 1);
        },
        input.absent_is_opaque ? 1 : 0, input.ambient_occlusion, input.ambient_occlusion, s.class_table, s.opaque);

    if (has.opaque) {
        MeshLayer layer;
        layer.down = layer.up = layer.side = layer.blockers = &s.opaque.first;
        layer.side_turned = layer.blockers_turned = &s.opaque_turned;
        layer.exposed = mesh_kernels().exposed(s.opaque.first, s.opaque.first);
        if (layer.exposed) {
            if (has.hidden) reveal_hidden(input, s);
            s.layers.push_back(layer);
        }
    }
    if (has.grouped) add_groups(input, s);
    if (has.liquid) mesh_liquids(input, s);
    if (has.model) {
        for (std::size_t i = 0; i < s.cells.palette.size(); ++i)
            s.class_table[i] = kinds[u32(s.cells.palette[i])] == ModelKind::model || kinds[u32(s.cells.palette[i])] == ModelKind::detailed;
        RowMask cells;
        if (s.cells.palette.size() == 1)
            cells.fill(s.class_table[0] ? 0xffff : 0);
        else
            s.cells.classify(center.blocks, s.class_table.data(), 1, cells);
        mesh_models(input, s, cells);
    }

    u32 exposed = 0;
    bool cubes = false;
    for (const MeshLayer& layer : s.layers) {
        exposed |= layer.exposed;
        cubes |= layer.fluid == 0;
    }
    if (cubes) read_looks(input, s);
    if (exposed & 3) {
        mesh_kernels().transpose(s.opaque.first, s.opaque_turned);
        if (s.opaque.differ) mesh_kernels().transpose(s.opaque.second, s.occluders_turned);
    }
    for (u32 pass = 0; pass < 3; ++pass) {
        for (u32 f = 0; f < 6; ++f) {
            out.first[pass * SectionMesh::kDirections + f] = u32(s.end);
            for (const MeshLayer& layer : s.layers)
                if (u32(layer.pass) == pass && layer.exposed >> f & 1) mesh_layer(layer, f, input.ambient_occlusion, s);
        }
        out.first[pass * SectionMesh::kDirections + 6] = u32(s.end);
        const std::vector<u64>& m = s.models[pass];
        if (!m.empty()) {
            if (s.quads.size() < s.end + m.size()) s.quads.resize(s.end + m.size() + 4096);
            std::memcpy(s.quads.data() + s.end, m.data(), m.size() * sizeof(u64));
            s.end += m.size();
        }
    }
    out.first[SectionMesh::kGroups] = u32(s.end);
    static_assert(sizeof(Quad) == sizeof(u64));
    const Quad* begin = reinterpret_cast<const Quad*>(s.quads.data());
    out.quads.assign(begin, begin + s.end);
}

} // namespace vitrail::render
