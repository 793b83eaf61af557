// A small world of states in a Grid, and rays through it by brute force: which cells a ray passes follows from the
// entry and exit planes of every single cell, not from walking.
#pragma once

#include "base/rng.h"
#include "trace/boxes.h"
#include "trace/grid/grid.h"
#include "trace/kernel/traverse.h"

#include <algorithm>
#include <limits>
#include <memory>

namespace vitrail::trace {

enum TestState : u32 {
    t_air,
    t_hidden,
    t_stone,
    t_glass,
    t_water,
    t_leaves,
    t_thin,
    t_plant,
    t_sunken,
    t_flow, // water of half the height
    t_states
};

// Media: 1 water, 2 glass.
struct TestContent {
    std::vector<StateRecord> states{t_states};
    std::vector<MediumRecord> media{MediumRecord{}, MediumRecord{1.33f, {}, {}, true, 1, 228},
                                    MediumRecord{1.5f, {}, {}, false, 2}};
    std::vector<TraceQuad> quads;
    std::vector<u32> texels;

    TestContent() {
        states[t_hidden].kind = states[t_stone].kind = CellKind::cube;
        states[t_glass].kind = CellKind::medium, states[t_glass].medium = 2;
        states[t_glass].optics = u8(Optics::dielectric);
        states[t_water].kind = CellKind::liquid, states[t_water].medium = 1;
        states[t_water].liquid_height = 227, states[t_water].optics = u8(Optics::water);
        states[t_leaves].kind = CellKind::cutout, states[t_leaves].optics = u8(Optics::leaf);
        states[t_thin].kind = CellKind::medium, states[t_thin].optics = u8(Optics::thin);
        states[t_plant].kind = CellKind::model, states[t_plant].first_quad = 0, states[t_plant].quads = 2;
        states[t_sunken] = states[t_plant], states[t_sunken].medium = 1;
        states[t_sunken].liquid_height = 227;
        states[t_flow] = states[t_water], states[t_flow].liquid_height = 113;
        for (u32 s = 0; s < t_states; ++s)
            for (u64 f = 0; f < 6; ++f)
                states[s].faces[f] = f << 20;
        // Two crossed sheets.
        for (u32 i = 0; i < 2; ++i) {
            TraceQuad q{};
            q.corner = {0, 1, i ? 1.0f : 0.0f};
            q.edge_a = {1, 0, i ? -1.0f : 1.0f};
            q.edge_b = {0, -1, 0};
            q.normal = normalized(cross(q.edge_b, q.edge_a));
            q.ua = 1, q.vb = 1;
            q.look = TraceQuad::kTwoSided | TraceQuad::kCutout | u32(Optics::leaf) << 16;
            quads.push_back(q);
        }
        // One layer of 4 x 4: a checkerboard of holes.
        for (u32 i = 0; i < 16; ++i)
            texels.push_back((i + i / 4) % 2 ? 0xffffffffu : 0x00ffffffu);
    }
    void fill(SceneView& s) const {
        s.states = states.data(), s.state_count = u32(states.size());
        s.quads = quads.data(), s.media = media.data();
        s.textures.albedo = s.textures.material = texels.data();
        s.textures.size_bits = 2, s.textures.levels = 1, s.textures.layers = 1, s.textures.layer_words = 16;
    }
};

class GridWorld {
public:
    static constexpr i32 kChunks = 4, kSize = kChunks * 16; // side of the window
    explicit GridWorld(ChunkPos first = {-4, -4, -4})
        : first_(first)
        , cells_(std::size_t(kSize) * kSize * kSize) {
        grid.set_states(content.states, content.media);
        grid.center_on({first.x + 2, first.y + 2, first.z + 2});
    }

    u32& at(i32 x, i32 y, i32 z) {
        return cells_[std::size_t((y * kSize + z) * kSize + x)];
    } // from the window's corner
    IVec3 corner() const { return {i32(u32(first_.x) * 16), i32(u32(first_.y) * 16), i32(u32(first_.z) * 16)}; }
    // 0 outside. cell: of the world.
    u32 state(IVec3 cell) const {
        const IVec3 o = corner();
        const u32 x = u32(cell.x) - u32(o.x), y = u32(cell.y) - u32(o.y), z = u32(cell.z) - u32(o.z);
        if (x >= u32(kSize) || y >= u32(kSize) || z >= u32(kSize)) return 0;
        return cells_[(y * kSize + z) * kSize + x];
    }
    BlockStorage chunk(i32 cx, i32 cy, i32 cz) const {
        std::vector<StateId> states(kChunkVolume);
        for (u32 i = 0; i < u32(kChunkVolume); ++i) {
            const LocalPos l(i);
            states[i] =
                StateId(cells_[std::size_t(((cy * 16 + l.y()) * kSize + cz * 16 + l.z()) * kSize + cx * 16 + l.x())]);
        }
        return BlockStorage::from_states(std::span<const StateId, kChunkVolume>(states));
    }
    ChunkPos chunk_pos(i32 cx, i32 cy, i32 cz) const { return {first_.x + cx, first_.y + cy, first_.z + cz}; }
    void upload(ThreadPool* pool = nullptr) {
        std::vector<BlockStorage> blocks;
        std::vector<Grid::Item> items;
        for (i32 i = 0; i < kChunks * kChunks * kChunks; ++i)
            blocks.push_back(chunk(i % 4, i / 16, i / 4 % 4));
        for (i32 i = 0; i < kChunks * kChunks * kChunks; ++i)
            items.push_back({chunk_pos(i % 4, i / 16, i / 4 % 4), &blocks[std::size_t(i)]});
        grid.set_chunks(items, pool);
    }
    SceneView scene() {
        SceneView s;
        content.fill(s);
        s.grid = grid.view();
        boxes.fill(s);
        return s;
    }
    // The same, but each cell of water has to be looked into.
    SceneView slow_scene() {
        SceneView s = scene();
        s.grid.water = 0;
        return s;
    }
    // Every cell `state` with this chance; in boxes of this side.
    void scatter(Rng& rng, u32 state, double chance, i32 side = 1) {
        for (i32 y = 0; y < kSize; y += side)
            for (i32 z = 0; z < kSize; z += side)
                for (i32 x = 0; x < kSize; x += side) {
                    if (rng.unit() >= chance) continue;
                    for (i32 i = 0; i < side * side * side; ++i)
                        at(x + i % side, y + i / side / side, z + i / side % side) = state;
                }
    }
    struct Share {
        u32 state;
        double chance;
        i32 side = 1;
    };
    // Scatters all of them in turn and uploads.
    void fill(Rng& rng, std::initializer_list<Share> shares) {
        for (const Share& s : shares)
            scatter(rng, s.state, s.chance, s.side);
        upload();
    }

    // Boxes of stone anywhere in the window, 0.5 to 3.5 blocks a side.
    void scatter_boxes(Rng& rng, u32 count) {
        const IVec3 o = corner();
        const auto any = [&] { return float(rng.unit()); };
        const auto cell = [&](i32 from) { return i32(u32(from) + rng.below(kSize - 4)); };
        std::vector<scene::EntityBox> entities;
        for (u32 i = 0; i < count; ++i) {
            const WorldPos block = corner_of(BlockPos{cell(o.x), cell(o.y), cell(o.z)});
            entities.push_back({{DimensionId{}, offset_by(block, {any(), any(), any()})},
                                {0.5f + any() * 3, 0.5f + any() * 3, 0.5f + any() * 3},
                                StateId(t_stone)});
        }
        boxes.update(entities, DimensionId{}, {{o.x + kSize / 2, o.y + kSize / 2, o.z}, {}}, content.states);
    }

    TestContent content;
    BoxTree boxes;
    Grid grid{GridShape{2, 2, 2}};

private:
    ChunkPos first_;
    std::vector<u32> cells_;
};

// A plane crossed: earlier by distance, of equal distances by axis.
struct Crossing {
    double t = -1;
    u32 axis = 3;
    bool before(const Crossing& o) const { return t != o.t ? t < o.t : axis < o.axis; }
};

// Whether the ray passes the cell at `r` (relative to where it starts), and how it comes in and goes out.
struct Passage {
    bool passed = false;
    Crossing in, out;
};
inline Passage passage(const Ray& ray, IVec3 r) {
    Passage p;
    p.in = {-1, 0};
    p.out = {std::numeric_limits<double>::infinity(), 3};
    const double at[3] = {ray.from.at.x, ray.from.at.y, ray.from.at.z}, dir[3] = {ray.dir.x, ray.dir.y, ray.dir.z};
    const i32 cell[3] = {r.x, r.y, r.z};
    for (u32 a = 0; a < 3; ++a) {
        if (std::abs(dir[a]) <= double(kDirLeast)) {
            if (cell[a] != 0) return p;
            continue;
        }
        const double inverse = 1 / dir[a];
        const bool up = dir[a] > 0;
        if (up ? cell[a] < 0 : cell[a] > 0) return p;
        const Crossing out{(double(cell[a] + (up ? 1 : 0)) - at[a]) * inverse, a};
        if (out.before(p.out)) p.out = out;
        if (cell[a] == 0) continue;
        const Crossing in{(double(cell[a] + (up ? 0 : 1)) - at[a]) * inverse, a};
        if (p.in.before(in)) p.in = in;
    }
    p.passed = p.in.before(p.out);
    return p;
}

// A ray's start and direction for tests: of many kinds.
inline Ray test_ray(Rng& rng, const GridWorld& world, u32 kind) {
    Ray ray;
    const IVec3 o = world.corner();
    const auto near = [&](i32 c) { return i32(u32(c) + rng.below(GridWorld::kSize)); };
    ray.from.cell = {near(o.x), near(o.y), near(o.z)};
    const auto any = [&] { return float(rng.unit()); };
    ray.from.at = {any(), any(), any()};
    ray.dir = normalized({any() * 2 - 1, any() * 2 - 1, any() * 2 - 1});
    const auto pick = [&](std::initializer_list<float> values) {
        return values.begin()[rng.below(u32(values.size()))];
    };
    switch (kind % 6) {
    case 1: // along an axis
        ray.dir = {};
        (rng.below(3) == 0 ? ray.dir.x : rng.below(2) == 0 ? ray.dir.y : ray.dir.z) = pick({-1, 1});
        break;
    case 2: // through edges and corners
        ray.from.at = {pick({0, 0.25f, 0.5f, 1}), pick({0, 0.25f, 0.5f, 1}), pick({0, 0.25f, 0.5f, 1})};
        ray.dir = {pick({-1, -0.5f, 0, 0.5f, 1}), pick({-1, -0.5f, 0, 0.5f, 1}), pick({-1, 0.5f, 1})};
        break;
    case 3: // grazing
        ray.dir = {pick({-1, 1}), pick({1e-7f, -1e-7f, 1e-4f, -3e-3f, 1e-30f}), pick({1e-6f, -1e-3f, 0, 1e-12f})};
        break;
    case 4: // from faces
        (rng.below(3) == 0 ? ray.from.at.x : rng.below(2) == 0 ? ray.from.at.y : ray.from.at.z) = pick({0, 1});
        break;
    case 5: // diagonals
        ray.from.at = {pick({0, 0.5f, 1}), pick({0, 0.5f, 1}), pick({0, 0.5f, 1})};
        ray.dir = normalized({pick({-1, 1}), pick({-1, 0, 1}), pick({-1, 0, 1})});
        break;
    default:
        break;
    }
    return ray;
}

} // namespace vitrail::trace
