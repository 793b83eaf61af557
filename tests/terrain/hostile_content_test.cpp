// Whatever content says and compile_terrain takes, the stages make land of it: no crash, the same bits for every vector
// set and for one lane, heights inside the world, blocks that exist.
#include "terrain/compile/compile.h"
#include "terrain/cpu/stages.h"
#include "terrain/generator.h"
#include "terrain/kernel/cave_kernel.h"
#include "terrain/kernel/fill_kernel.h"
#include "terrain/kernel/land_kernel.h"
#include "tests/terrain/random_description.h"
#include "tests/terrain/world_area.h"

#include <cmath>
#include <cstring>
#include <gtest/gtest.h>

namespace vitrail {
namespace {

// All that stages make of one column and of the columns that it reads; features beyond the nearest ring are left out.
struct Column {
    static constexpr i32 kSide = 3, kLands = kSide + 2 * kGroundReach, kPoints = kSide + 1;
    LandTile land[kLands * kLands];
    GroundTile ground[kSide * kSide];
    LatticeTile lattice[kPoints * kPoints];
    CaveTile caves[kSide * kSide];
    FeatureTile features[kSide * kSide], none;
    BlockTile filled, blocks;
    BiomeTile biomes;

    Column(const TerrainTables& t, const TerrainStages& s, ColumnPos at) {
        std::memset(static_cast<void*>(this), 0xc5, sizeof *this); // what a stage leaves unset would differ elsewhere
        none.placements = none.primitives = 0;
        const ColumnPos first{at.x - 1, at.z - 1};
        const LandTile* lands[kLands * kLands];
        for (i32 i = 0; i < kLands * kLands; ++i) {
            s.land(t, {first.x - kGroundReach + i % kLands, first.z - kGroundReach + i / kLands}, land[i]);
            lands[i] = &land[i];
        }
        s.ground(t, first, kSide, kSide, lands, ground);
        for (i32 i = 0; i < kPoints * kPoints; ++i)
            s.lattice(t, {first.x + i % kPoints, first.z + i / kPoints}, lattice[i]);
        const FeatureTile* around[49];
        std::fill(std::begin(around), std::end(around), &none);
        for (i32 i = 0; i < kSide * kSide; ++i) {
            const ColumnPos here{first.x + i % kSide, first.z + i / kSide};
            const LatticeTile* own = lattice + i / kSide * kPoints + i % kSide;
            const LatticeTile* const four[4] = {own, own + 1, own + kPoints, own + kPoints + 1};
            s.caves(t, here, ground[i], four, caves[i]);
            s.features(t, here, ground[i], caves[i], features[i]);
            around[(i / kSide + 2) * 7 + i % kSide + 2] = &features[i];
        }
        s.fill(t, at, ground[4], caves[4], filled);
        blocks = filled;
        s.draw(t, at, around, blocks);
        s.decorate(t, at, ground[4], caves[4], blocks);
        s.biomes(t, ground[4], caves[4], biomes);
    }
};

constexpr ColumnPos kPlaces[] = {{0, 0}, {-1, 7}, {kEdgeColumns - 9, -kEdgeColumns + 9}, {12345, -54321}};

void expect_sane(const Column& c, const CompiledTerrain& made) {
    const TerrainTables& t = *made.tables;
    for (i32 i = 0; i < kColumnCells; ++i) {
        const GroundTile& g = c.ground[4];
        ASSERT_TRUE(g.land[i] >= 1 && g.land[i] <= 384) << g.land[i];
        ASSERT_TRUE(g.top[i] >= 1 && g.top[i] <= 384) << g.top[i];
        for (u32 a = 0; a < t.attributes; ++a)
            ASSERT_TRUE(g.attribute[a][i] >= 0 && g.attribute[a][i] <= 1);
        ASSERT_EQ(c.blocks.block[i], kBedrock);
    }
    ASSERT_TRUE(c.blocks.top >= 0 && c.blocks.top <= kTerrainMaxY);
    for (i32 i = 0; i < kTerrainHeight * kColumnCells; ++i) {
        ASSERT_LT(c.blocks.block[i], made.block_names.size());
        if (i >> 8 >= c.blocks.top) {
            ASSERT_EQ(c.blocks.block[i], kAir);
        }
    }
    for (const u8 biome : c.biomes.biome)
        ASSERT_LT(biome, made.biome_names.size());
}

// Offsets of cave attributes may be no number, whose bits nobody reads.
bool same_numbers(const float* a, const float* b, i32 count) {
    for (i32 i = 0; i < count; ++i)
        if (!(a[i] == b[i] || (std::isnan(a[i]) && std::isnan(b[i])))) return false;
    return true;
}

void expect_same(const Column& a, const Column& b, const TerrainTables& t) {
    EXPECT_EQ(std::memcmp(a.land, b.land, sizeof a.land), 0) << "land";
    EXPECT_EQ(std::memcmp(a.ground, b.ground, sizeof a.ground), 0) << "ground";
    EXPECT_EQ(std::memcmp(a.lattice, b.lattice, sizeof a.lattice), 0) << "lattice";
    for (i32 i = 0; i < Column::kSide * Column::kSide; ++i) {
        EXPECT_EQ(std::memcmp(a.caves[i].open, b.caves[i].open, sizeof a.caves[i].open), 0) << "caves";
        for (u32 k = 0; k < t.cave_attributes; ++k)
            EXPECT_TRUE(same_numbers(a.caves[i].offset[k], b.caves[i].offset[k], kColumnCells)) << "cave attributes";
    }
    EXPECT_EQ(std::memcmp(a.filled.block, b.filled.block, sizeof a.filled.block), 0) << "fill";
    EXPECT_EQ(std::memcmp(a.blocks.block, b.blocks.block, sizeof a.blocks.block), 0) << "draw, decorate";
    EXPECT_EQ(a.blocks.top, b.blocks.top);
    EXPECT_EQ(std::memcmp(a.biomes.biome, b.biomes.biome, sizeof a.biomes.biome), 0) << "biomes";
}

// As a GPU's threads do it; under a sanitizer this also finds numbers that do not fit.
void expect_same_alone(const Column& c, const TerrainTables& t, ColumnPos at) {
    using L = ScalarLanes;
    auto land = std::make_unique<LandTile>();
    auto caves = std::make_unique<CaveTile>();
    auto filled = std::make_unique<BlockTile>();
    const LatticeTile* own_lattice = c.lattice + Column::kPoints + 1;
    const LatticeTile* const four[4] = {own_lattice, own_lattice + 1, own_lattice + Column::kPoints,
                                        own_lattice + Column::kPoints + 1};
    const LandTile& own = c.land[(kGroundReach + 1) * Column::kLands + kGroundReach + 1];
    for (i32 i = 0; i < kColumnCells; i += 3) {
        land_row<L>(t, thread_row(at, i), *land);
        ASSERT_EQ(std::memcmp(&land->height[i], &own.height[i], sizeof(float)), 0);
        cave_row<L>(t, c.ground[4], four, thread_row(at, i), ~u64(0), *caves);
        for (i32 word = 0; word < kTerrainHeight / 32; ++word)
            ASSERT_EQ(caves->open[word][i], c.caves[4].open[word][i]);
        fill_row<L>(t, thread_row(at, i), c.ground[4], c.caves[4], nullptr, nullptr, kTerrainHeight, *filled);
        for (i32 y = 0; y < kTerrainHeight; ++y)
            ASSERT_EQ(filled->block[y << 8 | i], c.filled.block[y << 8 | i]) << "y " << y << " column " << i;
    }
}

TEST(HostileContent, AnyDescriptionThatCompilesMakesLand) {
    const u32 rounds = long_statistics() ? 400 : kSanitized ? 4 : 12;
    u32 made_land = 0;
    for (u32 round = 0; round < rounds; ++round) {
        SCOPED_TRACE(fmt::format("round {}", round));
        const TerrainDescription d = RandomDescription(round + 1).make();
        const auto made = compile_terrain(d, round);
        if (!made) { // too many parts in all; everything else is within its limits
            EXPECT_EQ(made.error().code, ErrorCode::limit) << made.error().message;
            continue;
        }
        ++made_land;
        const ColumnPos at = kPlaces[round % std::size(kPlaces)];
        const auto best = std::make_unique<Column>(*made->tables, terrain_stages(best_isa()), at);
        expect_sane(*best, *made);
        const auto portable = std::make_unique<Column>(*made->tables, terrain_stages(Isa::portable), at);
        expect_same(*best, *portable, *made->tables);
        expect_same_alone(*best, *made->tables, at);
        if (testing::Test::HasFatalFailure()) return;
    }
    EXPECT_GE(made_land, rounds / 2);
}

// Counts drawn from 10 down to 3 would be any number at all.
TEST(HostileContent, RangesOfShapesBeginBelowTheirEnd) {
    TerrainDescription d = base_terrain();
    for (auto& f : d.features)
        if (f.shape == "cypress") f.numbers = {{"branches_least", 10.0f}, {"branches_most", 3.0f}};
    const auto made = compile_terrain(d, 1);
    ASSERT_FALSE(made);
    EXPECT_NE(made.error().message.find("branches_least is 10; expected 3 to 3"), std::string::npos)
        << made.error().message;
}

TEST(HostileContent, HundredsOfRowsAreToldTheirLimit) {
    TerrainDescription d = base_terrain();
    while (d.layers.size() < 200'000)
        d.layers.push_back(d.layers[d.layers.size() % 20]);
    const auto made = compile_terrain(d, 1);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::limit) << made.error().message;
}

// Where plants take every block there is still a place, found without making half the world.
TEST(HostileContent, SpawnInAThicketIsAboveIt) {
    TerrainDescription d = base_terrain();
    d.decorators.clear();
    for (const auto& biome : d.biomes)
        d.decorators.push_back({.biome = biome.name,
                                .place = "surface",
                                .block = "minecraft:fern",
                                .upper = "minecraft:fern",
                                .chance = 1,
                                .on = {"ground"}});
    auto made = TerrainGenerator::create(d, 1);
    ASSERT_TRUE(made) << made.error().message;
    const BlockPos feet = spawn_point(**made);
    const auto tile = (*made)->blocks(column_of(chunk_of(feet)));
    for (i32 y = feet.y; y < kTerrainMaxY; ++y)
        ASSERT_EQ(tile->block[y << 8 | (feet.z & 15) << 4 | (feet.x & 15)], kAir);
    EXPECT_LT((*made)->cache_stats().misses, 60'000u);
}

} // namespace
} // namespace vitrail
