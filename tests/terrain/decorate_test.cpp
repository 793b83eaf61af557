// Decorators: the chance their rows state, in all quadrants; support, room and biome of each; nothing replaced, nothing
// cut; the same bits from every vector set and from one thread a block column.
#include "fill_world.h"

#include "terrain/kernel/decorate_kernel.h"

#include <array>

namespace vitrail::testing {
namespace {

TerrainDescription decorated_description() {
    TerrainDescription d = fill_description();
    for (auto& biome : d.biomes)
        biome.rules.clear();
    for (auto& biome : d.cave_biomes)
        biome.rules.clear();
    using Row = TerrainDescription::Decorator;
    d.decorators = {
        Row{"t:meadow", "surface", "t:grass", "", .2f, {"loose"}},
        Row{"t:meadow", "surface", "t:tall_low", "t:tall_high", .08f, {"loose"}},
        Row{"t:mesa", "surface", "t:bush", "", .02f, {"ground"}},
        Row{"t:meadow", "surface", "t:lily", "", .005f, {"loose"}},
        Row{"t:meadow", "surface", "t:on_rock", "", .3f, {"minecraft:andesite"}},
        Row{"t:meadow", "sea_floor", "t:seagrass", "", .2f, {"ground"}},
        Row{"t:meadow", "sea_floor", "t:kelp_low", "t:kelp_high", .04f, {"ground"}},
        Row{"t:odd", "surface", "t:all_low", "t:all_high", 1, {"ground"}},
        Row{"t:lush", "cave_floor", "t:moss", "", .15f, {"ground"}},
        Row{"t:lush", "cave_floor", "t:fern_low", "t:fern_high", .1f, {"ground"}},
        Row{"t:lush", "cave_floor", "t:on_lava", "", .4f, {"minecraft:lava"}},
        Row{"t:lush", "cave_ceiling", "t:vine", "", .25f, {"ground"}},
        Row{"t:forest", "cave_floor", "t:roots", "", .06f, {"ground"}},
        Row{"t:forest", "cave_ceiling", "t:drop_high", "t:drop_low", .09f, {"ground"}},
    };
    return d;
}

// Columns of one biome all over the world, `count` in each quadrant.
std::vector<ColumnPos> spread(i32 count, Random& random) {
    std::vector<ColumnPos> out;
    for (i32 i = 0; i < 4 * count; ++i) {
        const i32 x = i32(random() % 1'800'000) + 1, z = i32(random() % 1'800'000) + 1;
        out.push_back({i & 1 ? -x : x, i & 2 ? -z : z});
    }
    return out;
}

class DecorateTest : public ::testing::Test {
protected:
    Block block(const std::string& name) const { return block_of(terrain, name); }
    bool open_block(Block b) const { return b == kAir || b == kWater; }

    // Flat, of the biome with these attributes, its top at `top`.
    void flat_world(float wet, float hot, float top) {
        ground = std::make_unique<GroundTile>();
        caves = std::make_unique<CaveTile>();
        *ground = GroundTile{};
        *caves = CaveTile{};
        for (i32 i = 0; i < kColumnCells; ++i) {
            ground->attribute[0][i] = wet;
            ground->attribute[1][i] = hot;
            ground->loose[1][i] = 4;
            ground->land[i] = ground->top[i] = top;
            ground->rock[i] = top - 4;
        }
    }
    // open blocks from..to-1 in all block columns
    void dig(i32 from, i32 to) {
        for (i32 i = 0; i < kColumnCells; ++i)
            for (i32 y = from; y < to; ++y)
                caves->open[y >> 5][i] |= 1u << (y & 31);
    }
    void cave_attributes(float shallow, float deep, float odd) {
        for (i32 i = 0; i < kColumnCells; ++i) {
            caves->offset[0][i] = shallow;
            caves->offset[1][i] = deep;
            caves->offset[2][i] = odd;
        }
    }
    void fill(ColumnPos at) {
        tile = std::make_unique<BlockTile>();
        terrain_stages(best_isa()).fill(*terrain.tables, at, *ground, *caves, *tile);
    }
    void decorate(ColumnPos at, Isa isa = best_isa()) {
        terrain_stages(isa).decorate(*terrain.tables, at, *ground, *caves, *tile);
    }
    std::array<i64, 256> counts() const {
        std::array<i64, 256> n{};
        for (i32 i = kColumnCells; i < tile->top << 8; ++i)
            ++n[tile->block[i]];
        return n;
    }
    i64 count(const char* name) const { return counts()[block(name)]; }

    CompiledTerrain terrain = compiled(decorated_description(), 99);
    Random random{4321};
    std::unique_ptr<GroundTile> ground;
    std::unique_ptr<CaveTile> caves;
    std::unique_ptr<BlockTile> tile;
};

// Normal bounds of the binomial: with some hundred comparisons, 5 deviations are passed once in ten thousand runs, and
// the seed is fixed.
void expect_rate(i64 hits, i64 trials, double chance, const std::string& what) {
    const double deviation = std::sqrt(double(trials) * chance * (1 - chance));
    EXPECT_NEAR(double(hits), double(trials) * chance, 5 * deviation) << what;
}

struct Case {
    const char* block;
    double chance;
};

TEST_F(DecorateTest, RatesAreThoseOfTheRowsInAllQuadrants) {
    struct World {
        float wet, hot, top;
        std::vector<Case> rows;
    };
    const World worlds[] = {
        {1,
         1,
         140,
         {{"t:grass", .2},
          {"t:tall_low", .08},
          {"t:tall_high", .08},
          {"t:lily", .005},
          {"t:on_rock", 0},
          {"t:bush", 0},
          {"t:seagrass", 0}}},
        {1, 1, 110, {{"t:seagrass", .2}, {"t:kelp_low", .04}, {"t:kelp_high", .04}, {"t:grass", 0}, {"t:tall_low", 0}}},
        {1, 0, 140, {{"t:bush", .02}, {"t:grass", 0}}},
        {0, 0, 140, {{"t:all_low", 1}, {"t:all_high", 1}, {"t:grass", 0}}},
        {0, 1, 140, {{"t:bush", 0}, {"t:grass", 0}, {"t:all_low", 0}}},
        // Half meadow, half mesa
        {1, .5f, 140, {{"t:grass", .1}, {"t:bush", .01}}},
    };
    for (const World& world : worlds) {
        flat_world(world.wet, world.hot, world.top);
        std::vector<i64> hits(world.rows.size() * 4);
        const auto places = spread(500, random);
        fill(places[0]); // the same to decorators wherever it is
        const auto filled = std::move(tile);
        tile = std::make_unique<BlockTile>();
        for (std::size_t n = 0; n < places.size(); ++n) {
            *tile = *filled;
            decorate(places[n]);
            const auto set = counts();
            for (std::size_t r = 0; r < world.rows.size(); ++r)
                hits[r * 4 + (n & 3)] += set[block(world.rows[r].block)];
        }
        for (std::size_t r = 0; r < world.rows.size(); ++r)
            for (std::size_t q = 0; q < 4; ++q)
                expect_rate(hits[r * 4 + q], 500 * 256, world.rows[r].chance,
                            std::string(world.rows[r].block) + " quadrant " + std::to_string(q));
    }
}

// Two caves in each block column: one among the lush ones, one deep.
TEST_F(DecorateTest, CaveRatesAreThoseOfTheRowsInAllQuadrants) {
    const Case rows[] = {{"t:moss", .15},  {"t:fern_low", .1},   {"t:fern_high", .1}, {"t:on_lava", 0}, {"t:vine", .25},
                         {"t:roots", .06}, {"t:drop_high", .09}, {"t:drop_low", .09}, {"t:grass", .2}};
    flat_world(1, 1, 150);
    cave_attributes(0, 0, -5);
    dig(100, 110); // depth 40 to 50: lush
    dig(20, 25);   // depth 125 to 130: forest
    std::vector<i64> hits(std::size(rows) * 4);
    const auto places = spread(500, random);
    fill(places[0]);
    const auto filled = std::move(tile);
    tile = std::make_unique<BlockTile>();
    for (std::size_t n = 0; n < places.size(); ++n) {
        *tile = *filled;
        decorate(places[n]);
        const auto set = counts();
        for (std::size_t r = 0; r < std::size(rows); ++r)
            hits[r * 4 + (n & 3)] += set[block(rows[r].block)];
    }
    for (std::size_t r = 0; r < std::size(rows); ++r)
        for (std::size_t q = 0; q < 4; ++q)
            expect_rate(hits[r * 4 + q], 500 * 256, rows[r].chance,
                        std::string(rows[r].block) + " quadrant " + std::to_string(q));
}

// One tall cave, its floor in the forest and its ceiling in the lush caves.
TEST_F(DecorateTest, FloorAndCeilingAskForTheirOwnBiome) {
    flat_world(1, 1, 150);
    cave_attributes(0, 0, -5);
    dig(30, 110);
    fill({7, 7});
    decorate({7, 7});
    EXPECT_GT(count("t:roots"), 3);
    EXPECT_GT(count("t:vine"), 30);
    for (const char* none : {"t:moss", "t:fern_low", "t:drop_high"})
        EXPECT_EQ(count(none), 0) << none;
    // Hanging ones hang.
    for (i32 i = 0; i < kColumnCells; ++i) {
        EXPECT_NE(int(tile->block[i | 110 << 8]), int(block("t:vine")));
        for (i32 y = 31; y < 109; ++y)
            ASSERT_EQ(int(tile->block[i | y << 8]), int(kAir));
    }
}

// Random grounds and caves with blocks strewn in, as features leave them.
TEST_F(DecorateTest, AllHaveSupportAndRoomAndReplaceNothing) {
    const TerrainTables& t = *terrain.tables;
    i64 set = 0, tall = 0;
    for (int round = 0; round < 80; ++round) {
        ground = random_ground(t, random);
        caves = random_caves(t, *ground, random);
        const auto places = fill_places();
        const ColumnPos at = places[std::size_t(round) % places.size()];
        fill(at);
        for (int n = 0; n < 4000; ++n) {
            static constexpr Block kStrewn[] = {kLava, kWater, kBedrock, 4, 5, kAir};
            tile->block[random() % (kTerrainHeight * kColumnCells)] = kStrewn[random() % 6];
        }
        for (i32 i = 0; i < kColumnCells; i += 3) // trunks and roofs where plants would stand
            for (i32 y = i32(ground->top[i]); y < std::min(i32(ground->top[i]) + 3, kTerrainMaxY); ++y)
                if (random() % 3 == 0) tile->block[i | y << 8] = random() % 4 == 0 ? kLava : Block(4);
        tile->top = kTerrainMaxY;
        const auto before = std::make_unique<BlockTile>(*tile);
        decorate(at);
        for (i32 i = 0; i < kColumnCells; ++i)
            for (i32 y = 0; y < kTerrainHeight; ++y) {
                const Block was = before->block[i | y << 8], is = tile->block[i | y << 8];
                if (was == is) continue;
                ++set;
                const DecoratorRow* row = nullptr;
                bool upper = false;
                for (u32 r = 0; r < t.decorators; ++r)
                    if (t.decorator[r].block == is || t.decorator[r].upper == is) {
                        row = &t.decorator[r];
                        upper = row->upper == is;
                    }
                ASSERT_NE(row, nullptr) << int(is);
                ASSERT_EQ(int(was), int(row->place == DecoratorPlace::sea_floor ? kWater : kAir));
                const i32 step = row->place == DecoratorPlace::cave_ceiling ? -1 : 1;
                const Block on = tile->block[i | (y - step) << 8];
                if (upper) {
                    ++tall;
                    ASSERT_EQ(int(on), int(row->block));
                } else {
                    ASSERT_TRUE(row->on.has(on)) << int(on);
                    ASSERT_NE(int(on), int(kLava));
                    if (row->upper != kAir) {
                        ASSERT_EQ(int(tile->block[i | (y + step) << 8]), int(row->upper));
                    }
                }
                // On the surface, or where a cave began or ended
                const bool cave =
                    row->place == DecoratorPlace::cave_floor || row->place == DecoratorPlace::cave_ceiling;
                const i32 foot = upper ? y - step : y;
                if (cave) {
                    ASSERT_TRUE(is_open(*caves, i, foot));
                    ASSERT_FALSE(is_open(*caves, i, foot - step));
                } else {
                    ASSERT_EQ(foot, i32(std::ceil(ground->top[i])));
                }
            }
    }
    EXPECT_GT(set, 5000);
    EXPECT_GT(tall, 1000);
}

TEST_F(DecorateTest, TopCoversWhatWasSet) {
    flat_world(0, 0, 140);
    fill({1, 2});
    ASSERT_EQ(tile->top, 140);
    decorate({1, 2});
    EXPECT_EQ(tile->top, 142);
    // Land up to the last block: no room, and nothing beyond the tile.
    flat_world(0, 0, 383);
    fill({1, 2});
    decorate({1, 2});
    EXPECT_EQ(count("t:all_low"), 0);
    flat_world(0, 0, 384);
    fill({1, 2});
    decorate({1, 2});
    EXPECT_EQ(count("t:all_low"), 0);
}

TEST_F(DecorateTest, SameBitsFromEveryVectorSetAndFromSingleThreads) {
    const TerrainTables& t = *terrain.tables;
    const auto places = fill_places();
    for (std::size_t n = 0; n < 3 * places.size(); ++n) {
        ground = random_ground(t, random);
        caves = random_caves(t, *ground, random);
        const ColumnPos place = places[n % places.size()];
        fill(place);
        const auto before = std::make_unique<BlockTile>(*tile);
        decorate(place, Isa::portable);
        const auto want = std::move(tile);
        for (const Isa isa : isas()) {
            tile = std::make_unique<BlockTile>(*before);
            decorate(place, isa);
            ASSERT_EQ(tile->top, want->top);
            ASSERT_TRUE(std::equal(std::begin(tile->block), std::end(tile->block), want->block)) << int(isa);
        }
        auto threads = std::make_unique<BlockTile>(*before);
        DecoratorIndex index;
        make_decorator_index<ScalarLanes>(t, index);
        for (i32 i = 0; i < kColumnCells; ++i)
            threads->top = std::max(
                threads->top, decorate_row<ScalarLanes>(t, index, thread_row(place, i), *ground, *caves, *threads));
        ASSERT_EQ(threads->top, want->top);
        ASSERT_TRUE(std::equal(std::begin(threads->block), std::end(threads->block), want->block));
    }
}

} // namespace
} // namespace vitrail::testing
