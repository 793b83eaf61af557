#include "render/meshing/light_brick.h"

#include "meshing/mesh_world.h"

#include <gtest/gtest.h>

#include <map>

namespace vitrail {
namespace {

using namespace render;
using test::MeshWorld;
using test::Neighborhood;

Neighborhood random_lit(MeshWorld& w, Rng& rng, u32 open_percent, bool some_absent) {
    const StateId solid[3] = {w("stone"), w("dirt"), StateId::hidden},
                  open[3] = {StateId::air, w("glass"), w("oak_leaves")};
    Neighborhood n;
    for (u32 i = 0; i < 27; ++i) {
        if (some_absent && i != MeshInput::kCenter && rng.below(4) == 0) continue;
        n.chunks[i] = std::make_unique<Chunk>();
        if (rng.below(4) == 0)
            n.chunks[i]->blocks = BlockStorage(rng.below(2) ? StateId::air : solid[0]);
        else
            *n.chunks[i] = test::make_chunk(
                [&](LocalPos) { return rng.below(100) < open_percent ? open[rng.below(3)] : solid[rng.below(3)]; });
        if (some_absent && rng.below(5) == 0) continue; // unlit
        LightVolume light(Light(u16(rng.next())));
        if (rng.below(3))
            for (Light& l : light.writable())
                l = Light(u16(rng.next()));
        n.chunks[i]->light = std::make_shared<LightVolume>(std::move(light));
    }
    return n;
}

// The rule of light_brick.h, cell by cell.
struct Plain {
    const MeshInput& in;

    const Chunk* chunk(i32 x, i32 y, i32 z) const { return in.chunks[MeshInput::index(x >> 4, y >> 4, z >> 4)]; }
    bool closed(i32 x, i32 y, i32 z) const {
        const Chunk* c = chunk(x, y, z);
        return !c || !c->light ||
               in.models->kinds()[u32(c->blocks.get({x & 15, y & 15, z & 15}))] == scene::ModelKind::opaque;
    }
    // Nibbles, or false where there is no light; after `passes` fillings.
    bool light(i32 x, i32 y, i32 z, int passes, std::array<u32, 4>& out) const {
        if (!closed(x, y, z)) {
            const u16 bits = chunk(x, y, z)->light->get({x & 15, y & 15, z & 15}).bits;
            for (u32 k = 0; k < 4; ++k)
                out[k] = bits >> (4 * k) & 15;
            return true;
        }
        if (passes == 0) return false;
        if (light_before(x, y, z, passes, out)) return true;
        std::array<u32, 4> sum{};
        u32 count = 0;
        for (u32 axis = 0; axis < 3; ++axis) {
            const i32 dx = axis == 0, dy = axis == 1, dz = axis == 2;
            std::array<u32, 4> a, b;
            const bool has_a = light(x - dx, y - dy, z - dz, passes - 1, a),
                       has_b = light(x + dx, y + dy, z + dz, passes - 1, b);
            if (!has_a && !has_b) continue;
            ++count;
            for (u32 k = 0; k < 4; ++k)
                sum[k] += has_a && has_b ? std::min(a[k], b[k]) : has_a ? a[k] : b[k];
        }
        if (count == 0) return false;
        for (u32 k = 0; k < 4; ++k)
            out[k] = (sum[k] + count / 2) / count;
        return true;
    }
    bool light_before(i32 x, i32 y, i32 z, int passes, std::array<u32, 4>& out) const {
        return passes > 1 && light(x, y, z, passes - 1, out);
    }
};

TEST(LightBrick, EqualsThePlainRule) {
    MeshWorld w;
    Rng rng(1);
    for (u32 round = 0; round < 12; ++round) {
        const Neighborhood n = random_lit(w, rng, round % 3 == 0 ? 8 : round % 3 == 1 ? 50 : 92, round % 2 == 1);
        const MeshInput input = n.input(w.models);
        const Plain plain{input};
        for (const char* path : {"portable", "avx2", "avx512"}) {
            if (!force_mesher_path(path)) continue;
            LightBrick brick;
            build_light_brick(input, brick);
            for (i32 y = -1; y <= 16; ++y)
                for (i32 z = -1; z <= 16; ++z)
                    for (i32 x = -1; x <= 16; ++x) {
                        std::array<u32, 4> l{};
                        const u32 expected = plain.light(x, y, z, 2, l) ? l[0] | l[1] << 4 | l[2] << 8 | l[3] << 12 : 0;
                        const u32 got = brick.uniform ? brick.value.bits : brick.cells[LightBrick::index(x, y, z)];
                        ASSERT_EQ(got, expected) << path << " round " << round << " at " << x << " " << y << " " << z;
                    }
        }
        force_mesher_path("");
    }
}

TEST(LightBrick, UniformWhereAllIsUniform) {
    MeshWorld w;
    Neighborhood n;
    const auto sky = std::make_shared<LightVolume>(Light(15, 0, 0, 0));
    for (auto& c : n.chunks) {
        c = std::make_unique<Chunk>();
        c->light = sky;
    }
    LightBrick brick;
    build_light_brick(n.input(w.models), brick);
    EXPECT_TRUE(brick.uniform);
    EXPECT_EQ(brick.value, Light(15, 0, 0, 0));
    n.chunks[0]->light = std::make_shared<LightVolume>(Light(14, 0, 0, 0));
    build_light_brick(n.input(w.models), brick);
    EXPECT_FALSE(brick.uniform);
    EXPECT_EQ(Light(brick.cells[LightBrick::index(-1, -1, -1)]), Light(14, 0, 0, 0));
    EXPECT_EQ(Light(brick.cells[LightBrick::index(0, -1, -1)]), Light(15, 0, 0, 0));
}

TEST(LightBrick, ThinWallsDoNotLeak) {
    MeshWorld w;
    const StateId stone = w("stone");
    Neighborhood n;
    for (auto& c : n.chunks) {
        c = std::make_unique<Chunk>(test::make_chunk([&](LocalPos p) { return p.x() == 8 ? stone : StateId::air; }));
        LightVolume light;
        for (u32 i = 0; i < kChunkVolume; ++i)
            light.set(LocalPos(i), LocalPos(i).x() < 8 ? Light(15, 0, 0, 0) : Light(0, 0, 0, 0));
        c->light = std::make_shared<LightVolume>(std::move(light));
    }
    LightBrick brick;
    build_light_brick(n.input(w.models), brick);
    EXPECT_EQ(Light(brick.cells[LightBrick::index(8, 5, 5)]).sky(), 0u);
}

TEST(TintGrid, OneBiomeIsUniform) {
    Neighborhood n;
    n.chunks[MeshInput::kCenter] = std::make_unique<Chunk>();
    MeshWorld w;
    std::vector<BiomeTint> tints(2);
    tints[0].grass = {10, 20, 30};
    const TintGrid g = build_tint_grid(n.input(w.models), tints);
    EXPECT_TRUE(g.uniform);
    EXPECT_EQ(g.grass[7], (std::array<u8, 4>{10, 20, 30, 255}));
    n.chunks[MeshInput::kCenter]->biomes.cells.fill(BiomeId(77)); // never named: entry 0
    EXPECT_EQ(build_tint_grid(n.input(w.models), tints), g);
    EXPECT_EQ(build_tint_grid(n.input(w.models), {}).grass[0], (std::array<u8, 4>{127, 178, 89, 255}));
}

TEST(TintGrid, NeighborsMeetInOneColor) {
    MeshWorld w;
    std::vector<BiomeTint> tints(6);
    Rng rng(5);
    for (BiomeTint& t : tints)
        t = {{u8(rng.next()), u8(rng.next()), u8(rng.next())},
             {u8(rng.next()), u8(rng.next()), u8(rng.next())},
             {u8(rng.next()), u8(rng.next()), u8(rng.next())}};
    std::map<std::pair<i32, i32>, std::unique_ptr<Chunk>> land;
    for (i32 z = -1; z <= 1; ++z)
        for (i32 x = -1; x <= 2; ++x) {
            auto c = std::make_unique<Chunk>();
            for (BiomeId& b : c->biomes.cells)
                b = BiomeId(rng.below(6));
            land[{x, z}] = std::move(c);
        }
    const auto input_at = [&](i32 x) {
        MeshInput in;
        in.models = &w.models;
        for (i32 dz = -1; dz <= 1; ++dz)
            for (i32 dx = -1; dx <= 1; ++dx)
                in.chunks[MeshInput::index(dx, 0, dz)] = land[{x + dx, dz}].get();
        return in;
    };
    const TintGrid a = build_tint_grid(input_at(0), tints), b = build_tint_grid(input_at(1), tints);
    EXPECT_FALSE(a.uniform);
    for (i32 z = -1; z <= 4; ++z)
        for (const i32 shared : {3, 4}) { // cells 3 and 4 of one are -1 and 0 of the other
            EXPECT_EQ(a.grass[TintGrid::index(shared, z)], b.grass[TintGrid::index(shared - 4, z)]);
            EXPECT_EQ(a.water[TintGrid::index(shared, z)], b.water[TintGrid::index(shared - 4, z)]);
        }
}

} // namespace
} // namespace vitrail
