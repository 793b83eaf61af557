#include "meshing/mesh_world.h"
#include "meshing/reference_mesher.h"

#include <gtest/gtest.h>

namespace vitrail {
namespace {

using namespace render;
using test::MeshWorld;
using test::Neighborhood;

// Every vector width that this machine has gives the reference's unit faces and one and the same list of quads.
void expect_exact(const MeshInput& input, const std::string& what) {
    const test::UnitFaces expected = test::reference_mesh(input);
    std::vector<Quad> first;
    for (const char* path : {"portable", "avx2", "avx512"}) {
        if (!force_mesher_path(path)) continue;
        MeshScratch scratch;
        SectionMesh mesh;
        mesh_section(input, mesh, scratch);
        const test::UnitFaces got = test::unit_faces(mesh, *input.models);
        ASSERT_EQ(got.error, "") << what << ", " << path;
        ASSERT_EQ(got.cubes.size(), expected.cubes.size()) << what << ", " << path;
        for (const auto& [key, look] : expected.cubes) {
            const auto found = got.cubes.find(key);
            ASSERT_TRUE(found != got.cubes.end()) << what << ", " << path << ": pass " << std::get<0>(key) << " face "
                                                  << std::get<1>(key) << " cell " << std::get<2>(key);
            ASSERT_EQ(found->second.first, look.first)
                << what << ", " << path << ": look, face " << std::get<1>(key) << " cell " << std::get<2>(key);
            ASSERT_EQ(found->second.second, look.second)
                << what << ", " << path << ": occlusion, face " << std::get<1>(key) << " cell " << std::get<2>(key);
        }
        ASSERT_EQ(got.models, expected.models) << what << ", " << path;
        ASSERT_EQ(got.slopes, expected.slopes) << what << ", " << path;
        if (first.empty()) first = mesh.quads;
        ASSERT_EQ(first, mesh.quads) << what << ", " << path;
    }
    force_mesher_path("");
}

std::vector<StateId> every_kind(MeshWorld& w) {
    std::vector<StateId> out{StateId::air};
    for (const char* text : {"stone",
                             "dirt",
                             "grass_block",
                             "sand",
                             "coal_ore",
                             "oak_log[axis=x]",
                             "oak_log[axis=y]",
                             "oak_log[axis=z]",
                             "oak_leaves[distance=1]",
                             "oak_leaves[distance=2]",
                             "birch_leaves",
                             "glass",
                             "red_stained_glass",
                             "ice",
                             "water[level=0]",
                             "water[level=3]",
                             "water[level=8]",
                             "lava[level=0]",
                             "oak_slab[type=bottom]",
                             "oak_slab[type=bottom,waterlogged=true]",
                             "oak_slab[type=double]",
                             "oak_stairs[facing=east,half=top]",
                             "oak_fence[north=true]",
                             "torch",
                             "fern",
                             "mod:unknown_thing",
                             "mod:other[a=b]"})
        out.push_back(w(text));
    return out;
}

Neighborhood random_neighborhood(const std::vector<StateId>& states, Rng& rng, bool some_absent, u32 air_percent) {
    Neighborhood n;
    for (u32 i = 0; i < 27; ++i) {
        if (some_absent && i != MeshInput::kCenter && rng.below(4) == 0) continue;
        if (i != MeshInput::kCenter && rng.below(4) == 0) {
            n.chunks[i] = std::make_unique<Chunk>();
            n.chunks[i]->blocks = BlockStorage(states[rng.below(u32(states.size()))]);
            continue;
        }
        // A few states or all, so that every number of bits a cell turns up.
        const u32 kinds = 1 + rng.below(rng.below(2) ? 4 : u32(states.size()) - 1);
        std::vector<StateId> chosen;
        for (u32 k = 0; k < kinds; ++k)
            chosen.push_back(states[rng.below(u32(states.size()))]);
        n.chunks[i] = std::make_unique<Chunk>(test::make_chunk(
            [&](LocalPos) { return rng.below(100) < air_percent ? StateId::air : chosen[rng.below(kinds)]; }));
    }
    return n;
}

TEST(Mesher, EqualsTheReferenceOnRandomChunks) {
    MeshWorld w;
    std::vector<StateId> states = every_kind(w);
    Rng rng(1);
    for (u32 round = 0; round < 40; ++round) {
        const Neighborhood n = random_neighborhood(states, rng, round % 2 == 1, round % 5 * 20);
        MeshInput input = n.input(w.models);
        input.absent_is_opaque = round % 4 < 2;
        input.ambient_occlusion = round % 8 != 7;
        expect_exact(input, "round " + std::to_string(round));
    }
}

TEST(Mesher, EqualsTheReferenceOnBlobs) { // larger areas of one look, so that much merges
    MeshWorld w;
    const std::vector<StateId> states = every_kind(w);
    Rng rng(2);
    for (u32 round = 0; round < 20; ++round) {
        Neighborhood n;
        for (u32 i = 0; i < 27; ++i) {
            std::array<StateId, kChunkVolume> cells;
            cells.fill(rng.below(2) ? StateId::air : states[1 + rng.below(5)]);
            for (u32 b = 0; b < 14; ++b) {
                const i32 x0 = i32(rng.below(16)), y0 = i32(rng.below(16)), z0 = i32(rng.below(16));
                const i32 x1 = x0 + i32(rng.below(9)), y1 = y0 + i32(rng.below(9)), z1 = z0 + i32(rng.below(9));
                const StateId fill = states[rng.below(u32(states.size()))];
                for (i32 y = y0; y <= std::min(y1, 15); ++y)
                    for (i32 z = z0; z <= std::min(z1, 15); ++z)
                        for (i32 x = x0; x <= std::min(x1, 15); ++x)
                            cells[LocalPos(x, y, z).index] = fill;
            }
            n.chunks[i] = std::make_unique<Chunk>();
            n.chunks[i]->blocks = BlockStorage::from_states(cells);
        }
        expect_exact(n.input(w.models), "round " + std::to_string(round));
    }
}

TEST(Mesher, HiddenBlocksShowTheirNearestKnownNeighbor) {
    MeshWorld w;
    std::vector<StateId> states{StateId::air, StateId::hidden, StateId::hidden, StateId::hidden,
                                w("stone"),   w("dirt"),       w("oak_leaves")};
    Rng rng(3);
    for (u32 round = 0; round < 10; ++round) {
        const Neighborhood n = random_neighborhood(states, rng, round % 2 == 1, 10);
        expect_exact(n.input(w.models), "round " + std::to_string(round));
    }
    // All hidden, one cell dug out beside: only what the section next to it knows tells the look.
    Neighborhood n;
    n.chunks[MeshInput::kCenter] = std::make_unique<Chunk>();
    n.chunks[MeshInput::kCenter]->blocks = BlockStorage(StateId::hidden);
    n.chunks[MeshInput::index(1, 0, 0)] =
        std::make_unique<Chunk>(test::make_chunk([&](LocalPos p) { return p.x() == 0 ? StateId::air : states[5]; }));
    expect_exact(n.input(w.models), "all hidden");
}

TEST(Mesher, ManyStatesInOneSection) { // more than 256: two bytes a cell
    MeshWorld w;
    std::vector<StateId> states = every_kind(w);
    for (u32 i = 0; i < 600; ++i)
        states.push_back(w(("mod:thing_" + std::to_string(i)).c_str()));
    Rng rng(4);
    for (u32 round = 0; round < 4; ++round) {
        Neighborhood n;
        for (u32 i = 0; i < 27; ++i)
            n.chunks[i] = std::make_unique<Chunk>(test::make_chunk(
                [&](LocalPos) { return rng.below(3) ? StateId::air : states[rng.below(u32(states.size()))]; }));
        expect_exact(n.input(w.models), "round " + std::to_string(round));
    }
}

struct Count {
    std::size_t quads;
    std::array<u32, SectionMesh::kGroups> groups;
};
Count count_quads(MeshWorld& w, const std::function<StateId(LocalPos)>& state_of, bool absent_is_opaque = false) {
    Neighborhood n;
    n.chunks[MeshInput::kCenter] = std::make_unique<Chunk>(test::make_chunk(state_of));
    MeshInput input = n.input(w.models);
    input.absent_is_opaque = absent_is_opaque;
    MeshScratch scratch;
    SectionMesh mesh;
    mesh_section(input, mesh, scratch);
    Count out{mesh.quads.size(), {}};
    for (u32 g = 0; g < SectionMesh::kGroups; ++g)
        out.groups[g] = mesh.first[g + 1] - mesh.first[g];
    return out;
}

TEST(Mesher, MergesAsMuchAsItMay) {
    MeshWorld w;
    const StateId stone = w("stone"), grass = w("grass_block"), dirt = w("dirt"), water = w("water[level=0]"),
                  leaves = w("oak_leaves");
    EXPECT_EQ(count_quads(w, [&](LocalPos) { return stone; }).quads, 6u);
    EXPECT_EQ(count_quads(
                  w, [&](LocalPos) { return stone; }, true)
                  .quads,
              0u);
    EXPECT_EQ(count_quads(w, [&](LocalPos p) { return p.y() == 7 ? stone : StateId::air; }).quads, 6u);
    // Grass and dirt look alike from below only.
    const Count mixed = count_quads(w, [&](LocalPos p) {
        return p.y() != 7 ? StateId::air : (p.x() + p.z()) % 2 ? grass : dirt;
    });
    EXPECT_EQ(mixed.groups[2], 1u);
    EXPECT_EQ(mixed.groups[3], 256u);
    // A lake is six quads, its surface one of them.
    const Count lake = count_quads(w, [&](LocalPos p) { return p.y() < 7 ? water : StateId::air; });
    EXPECT_EQ(lake.groups[SectionMesh::group(QuadPass::translucent, 3)], 1u);
    EXPECT_EQ(lake.groups[SectionMesh::group(QuadPass::translucent, 2)], 1u);
    EXPECT_EQ(lake.groups[SectionMesh::group(QuadPass::translucent, 0)], 1u); // full cells; the top row is lowered
    EXPECT_EQ(lake.groups[SectionMesh::group(QuadPass::translucent, 6)], 64u);
    EXPECT_EQ(count_quads(w, [&](LocalPos) { return leaves; }).quads, 6u);
    EXPECT_EQ(count_quads(w, [&](LocalPos p) { return (p.x() + p.y() + p.z()) % 2 ? stone : StateId::air; }).quads,
              2048u * 6);
}

TEST(Mesher, AbsentNeighborsHideFacesOrNot) {
    MeshWorld w;
    const StateId stone = w("stone");
    const auto half = [&](LocalPos p) { return p.y() < 8 ? stone : StateId::air; };
    EXPECT_EQ(count_quads(w, half, true).quads, 1u);
    EXPECT_EQ(count_quads(w, half, false).quads, 6u);
}

TEST(Mesher, EmptyAndBuriedSectionsDrawNothing) {
    MeshWorld w;
    const StateId stone = w("stone");
    Neighborhood n;
    for (auto& c : n.chunks) {
        c = std::make_unique<Chunk>();
        c->blocks = BlockStorage(stone);
    }
    MeshInput input = n.input(w.models);
    EXPECT_TRUE(draws_nothing(input));
    MeshScratch scratch;
    SectionMesh mesh;
    mesh.quads.resize(5); // old content goes
    mesh_section(input, mesh, scratch);
    EXPECT_TRUE(mesh.empty());
    EXPECT_EQ(mesh.first[SectionMesh::kGroups], 0u);
    n.chunks[MeshInput::index(0, 1, 0)]->blocks.set({3, 0, 3}, StateId::air);
    EXPECT_FALSE(draws_nothing(input));
    mesh_section(input, mesh, scratch);
    EXPECT_EQ(mesh.quads.size(), 1u);
    n.chunks[MeshInput::kCenter]->blocks = BlockStorage(StateId::air);
    EXPECT_TRUE(draws_nothing(input));
}

TEST(Mesher, RandomLong) {
    if (!std::getenv("VITRAIL_LONG")) GTEST_SKIP() << "set VITRAIL_LONG";
    MeshWorld w;
    const std::vector<StateId> states = every_kind(w);
    Rng rng(5);
    for (u32 round = 0; round < 2000; ++round)
        expect_exact(random_neighborhood(states, rng, rng.below(2) == 0, rng.below(100)).input(w.models),
                     std::to_string(round));
}

} // namespace
} // namespace vitrail
