// Layers, water, caves and rules of one column against the rules as they are written in
// kernel/{strata,fill,rule}_kernel.h, block by block; and the same bits from every vector set and from one thread a
// block column.
#include "fill_world.h"

#include "terrain/kernel/fill_kernel.h"

namespace vitrail::testing {
namespace {

using One = ScalarLanes;

i32 ceil_level(double v) {
    return i32(std::ceil(std::clamp(v, 0.0, 384.0)));
}

// Noise at every fourth block, linear in between.
float coarse(const TerrainTables& t, u32 noise, ColumnPos at, i32 i, i32 level) {
    const Noise n = t.noise[noise];
    const i32 x = i & 15, z = i >> 4;
    const auto sample = [&](i32 px, i32 pz) {
        const Spot<One> p{i32(u32(at.x) << 4), i32(u32(at.z) << 4), float(px), float(level < 0 ? 0 : level), float(pz)};
        return level < 0 ? fractal2<One>(&t.octave[n.first], n.octaves, p)
                         : fractal3<One>(&t.octave[n.first], n.octaves, p);
    };
    const i32 x0 = x & ~3, z0 = z & ~3;
    const float fx = float(x & 3) / 4, fz = float(z & 3) / 4;
    const float a0 = sample(x0, z0), a1 = sample(x0, z0 + 4), b0 = sample(x0 + 4, z0), b1 = sample(x0 + 4, z0 + 4);
    const float a = a0 + (a1 - a0) * fz, b = b0 + (b1 - b0) * fz;
    return a + (b - a) * fx;
}

std::vector<double> biome_shares(const TerrainTables& t, const GroundTile& g, i32 i) {
    std::vector<double> w(t.biomes, 1);
    double sum = 0;
    for (u32 b = 0; b < t.biomes; ++b) {
        for (u32 a = 0; a < t.attributes; ++a) {
            const double v = double(g.attribute[a][i]);
            if (t.biome[b].wants[a] > 0) w[b] *= v;
            if (t.biome[b].wants[a] < 0) w[b] *= 1 - v;
        }
        sum += w[b];
    }
    for (double& v : w)
        v /= sum;
    return w;
}

struct Bound {
    double begin;
    Block block;
    bool loose = false;
};

// Layers of one block column bottom up, in double precision.
std::vector<Bound> layers_of(const TerrainTables& t, const GroundTile& g, ColumnPos at, i32 i) {
    const std::vector<double> shares = biome_shares(t, g, i);
    double loose = 0, hung = 0, stacked = 0;
    for (u32 l = 0; l < t.loose; ++l)
        loose += double(g.loose[l][i]);
    std::vector<double> thick(t.strata);
    for (u32 s = 0; s < t.strata; ++s) {
        double weight = 0;
        for (u32 b = 0; b < t.biomes; ++b)
            weight += shares[b] * double(t.biome[b].strata[s]);
        const StratumRow& row = t.stratum[s];
        const double f = double(coarse(t, row.noise, at, i, -1));
        thick[s] = std::max(0.0, double(row.thickness) + double(row.amplitude) * f) * weight;
        if (row.block == t.remainder) continue;
        (row.hung ? hung : stacked) += thick[s];
    }
    const double rock = double(g.top[i]) - loose, base = std::max(0.0, rock - hung);
    std::vector<Bound> out;
    double y = 0;
    for (u32 s = 0; s < t.strata; ++s) {
        if (t.stratum[s].hung) continue;
        out.push_back({std::min(y, base), t.stratum[s].block});
        y += t.stratum[s].block == t.remainder ? std::max(0.0, base - stacked) : thick[s];
    }
    y = rock - hung;
    for (u32 s = 0; s < t.strata; ++s) {
        if (!t.stratum[s].hung) continue;
        out.push_back({std::max(0.0, y), t.stratum[s].block});
        y += thick[s];
    }
    for (u32 l = 0; l < t.loose; ++l) {
        out.push_back({y, t.loose_layer[l].block, true});
        y += double(g.loose[l][i]);
    }
    return out;
}

class FillTest : public ::testing::Test {
protected:
    void run(ColumnPos at, Isa isa = best_isa()) {
        tile = std::make_unique<BlockTile>();
        std::fill(std::begin(tile->block), std::end(tile->block), Block(201)); // every block must be written
        terrain_stages(isa).fill(*terrain.tables, at, *ground, *caves, *tile);
    }
    void draw_world() {
        ground = random_ground(*terrain.tables, random);
        caves = random_caves(*terrain.tables, *ground, random);
    }
    Block at(i32 i, i32 y) const { return tile->block[i | y << 8]; }

    CompiledTerrain terrain = compiled(fill_description(), 77);
    Random random{12345};
    std::unique_ptr<GroundTile> ground;
    std::unique_ptr<CaveTile> caves;
    std::unique_ptr<BlockTile> tile;
};

TEST_F(FillTest, LayersWaterAndCavesLieWhereTheyShould) {
    TerrainTables& t = *terrain.tables;
    t.surface_rules = t.cave_rules = 0;
    i32 near_bound = 0, layered = 0;
    for (int round = 0; round < 60; ++round) {
        draw_world();
        const auto places = fill_places();
        const ColumnPos place = places[std::size_t(round) % places.size()];
        run(place);
        i32 highest = 0;
        for (i32 i = 0; i < kColumnCells; ++i) {
            const std::vector<Bound> layers = layers_of(t, *ground, place, i);
            const i32 top = ceil_level(double(ground->top[i]));
            const u32 x = (u32(place.x) << 4) + u32(i & 15), z = (u32(place.z) << 4) + u32(i >> 4);
            const double within = double(unit_of(random_next(clump_bits(t.pick_key, x, z), 0)));
            for (i32 y = 0; y < kTerrainHeight; ++y) {
                const Block got = at(i, y);
                if (got != kAir) highest = std::max(highest, y + 1);
                Block want = y < kTerrainSeaLevel ? kWater : kAir;
                bool vague = false;
                if (y < top) {
                    const double in_ground = std::min(1.0, double(ground->top[i]) - y);
                    for (const Bound& b : layers) {
                        const double asked = b.loose ? y + within * in_ground : y;
                        if (b.begin <= asked) want = b.block;
                        vague |= std::abs(b.begin - asked) < 1e-3;
                    }
                    ++layered;
                }
                if (y < top && is_open(*caves, i, y)) want = y < kTerrainLavaLevel ? kLava : kAir, vague = false;
                if (y == 0) want = kBedrock, vague = false;
                if (vague && got != want) {
                    ++near_bound; // between the same layers, but double and float disagree whose the block is
                    continue;
                }
                ASSERT_EQ(int(got), int(want)) << "round " << round << " block column " << i << " y " << y;
            }
        }
        EXPECT_LE(highest, tile->top);
        EXPECT_GE(tile->top, kTerrainSeaLevel);
    }
    EXPECT_GT(layered, 60 * 256 * 80);
    EXPECT_LT(near_bound, 40);
}

// A third of the way between two biomes a layer is as thick as its weights say.
TEST_F(FillTest, StrataHaveTheThicknessThatNoiseAndWeightsGive) {
    TerrainTables& t = *terrain.tables;
    t.surface_rules = t.cave_rules = 0;
    draw_world();
    for (i32 i = 0; i < kColumnCells; ++i) {
        ground->attribute[0][i] = 1;
        ground->attribute[1][i] = .25f; // a quarter meadow, three quarters mesa: stone weighs 1.75
        ground->top[i] = ground->rock[i] = ground->land[i] = 300;
        for (auto& loose : ground->loose)
            loose[i] = 0;
    }
    *caves = CaveTile{};
    const Block stone = block_of(terrain, "minecraft:stone"), tuff = block_of(terrain, "minecraft:tuff");
    double blocks_of_stone = 0, thick_of_stone = 0, blocks_of_tuff = 0, thick_of_tuff = 0;
    for (i32 n = 0; n < 40; ++n) {
        const ColumnPos place{n * 7, n * -5};
        run(place);
        for (i32 i = 0; i < kColumnCells; ++i) {
            for (i32 y = 0; y < 300; ++y) {
                blocks_of_stone += at(i, y) == stone;
                blocks_of_tuff += at(i, y) == tuff;
            }
            thick_of_stone += std::max(0.0, 10 + 30 * double(coarse(t, t.stratum[3].noise, place, i, -1))) * 1.75;
            thick_of_tuff += std::max(0.0, 6 + 24 * double(coarse(t, t.stratum[2].noise, place, i, -1))) * .25;
        }
    }
    // Of every column less than one block is rounded away, evenly.
    EXPECT_NEAR(blocks_of_stone / thick_of_stone, 1, .02);
    EXPECT_NEAR(blocks_of_tuff / thick_of_tuff, 1, .02);
    EXPECT_GT(blocks_of_stone, 100000);
    EXPECT_GT(blocks_of_tuff, 10000);
}

bool chosen(RandomKey key, float chance, ColumnPos at, i32 i, i32 y) {
    const u32 x = (u32(at.x) << 4) + u32(i & 15), z = (u32(at.z) << 4) + u32(i >> 4);
    return unit_of(random_bits(key, x, u32(y), z)) < chance;
}

// Rules, block by block, over the layers that a fill without rules laid.
void apply_rules(const TerrainTables& t, ColumnPos at, const GroundTile& g, const CaveTile& c, BlockTile& tile,
                 std::vector<i64>& surface_hits, std::vector<i64>& cave_hits) {
    for (i32 i = 0; i < kColumnCells; ++i) {
        const Row<One> row = thread_row(at, i);
        const u32 picked = surface_biome_row<One>(t, g, row);
        const i32 top = ceil_level(double(g.top[i]));
        float inputs[kInputs] = {};
        for (u32 a = 0; a < t.attributes; ++a)
            inputs[a] = g.attribute[a][i];
        inputs[kInputHeight] = g.land[i];
        for (u32 r = 0; r < t.surface_rules; ++r) {
            const SurfaceRuleRow& rule = t.surface_rule[r];
            if (rule.biome != picked) continue;
            const bool water = rule.from.has(kWater);
            const i32 surface = water ? std::max(top, kTerrainSeaLevel) : top;
            if (rule.depth == 1 && !water && top < kTerrainSeaLevel) continue;
            const Spot<One> spot = row.spot(0);
            const i32 above = rule.above.count ? ceil_level(double(run_program<One>(t, rule.above, spot, inputs))) : 0;
            const i32 below =
                rule.below.count ? ceil_level(double(run_program<One>(t, rule.below, spot, inputs))) : kTerrainMaxY;
            for (i32 y = 1; y < surface; ++y) {
                Block& block = tile.block[i | y << 8];
                if (y < above || y >= below || !rule.from.has(block)) continue;
                if (rule.depth > 0 && y < surface - rule.depth) continue;
                if (!chosen(rule.key, rule.chance, at, i, y)) continue;
                block = rule.to[rule.bands ? (y - above) % rule.bands : 0];
                ++surface_hits[r];
            }
        }
        for (i32 y = 1; y < top; ++y) {
            const u32 biome = cave_biome_at(t, g, c, at, i, y);
            for (u32 r = 0; r < t.cave_rules; ++r) {
                const CaveRuleRow& rule = t.cave_rule[r];
                Block& block = tile.block[i | y << 8];
                if (rule.biome != biome || !rule.from.has(block)) continue;
                if (rule.place != CavePlace::rock) {
                    bool near = false;
                    for (i32 n = 1; n <= rule.depth; ++n)
                        near |= is_open(c, i, rule.place == CavePlace::floor ? y + n : y - n);
                    if (!near || is_open(c, i, y)) continue;
                }
                if (rule.veins) {
                    const i32 level = y & ~3;
                    const float low = coarse(t, rule.vein, at, i, level), high = coarse(t, rule.vein, at, i, level + 4);
                    if (!(std::abs(low + (high - low) * (float(y & 3) / 4)) < rule.vein_width)) continue;
                }
                if (!chosen(rule.key, rule.chance, at, i, y)) continue;
                block = rule.to;
                ++cave_hits[r];
            }
        }
    }
}

TEST_F(FillTest, RulesChangeWhatTheySayAndNothingElse) {
    TerrainTables& t = *terrain.tables;
    const u32 surface_rules = t.surface_rules, cave_rules = t.cave_rules;
    std::vector<i64> surface_hits(surface_rules), cave_hits(cave_rules);
    for (int round = 0; round < 60; ++round) {
        draw_world();
        const auto places = fill_places();
        const ColumnPos place = places[std::size_t(round) % places.size()];
        t.surface_rules = t.cave_rules = 0;
        run(place);
        auto want = std::move(tile);
        t.surface_rules = surface_rules;
        t.cave_rules = cave_rules;
        apply_rules(t, place, *ground, *caves, *want, surface_hits, cave_hits);
        run(place);
        for (i32 n = 0; n < kTerrainHeight * kColumnCells; ++n)
            ASSERT_EQ(int(tile->block[n]), int(want->block[n]))
                << "round " << round << " block column " << (n & 255) << " y " << (n >> 8);
    }
    // The comparison means little where nothing happened.
    for (u32 r = 0; r < surface_rules; ++r)
        if (t.surface_rule[r].to[0] != block_of(terrain, "t:never")) {
            EXPECT_GT(surface_hits[r], 300) << "surface rule " << r;
        }
    for (u32 r = 0; r < cave_rules; ++r)
        EXPECT_GT(cave_hits[r], 300) << "cave rule " << r;
}

TEST_F(FillTest, GrassStaysOutOfTheWater) {
    const Block grass = block_of(terrain, "minecraft:grass_block");
    i32 seen = 0;
    for (int round = 0; round < 100; ++round) {
        draw_world();
        run({round, -round});
        for (i32 i = 0; i < kColumnCells; ++i)
            for (i32 y = 1; y < kTerrainHeight - 1; ++y)
                if (at(i, y) == grass) {
                    ++seen;
                    ASSERT_EQ(int(at(i, y + 1)), int(kAir));
                }
    }
    EXPECT_GT(seen, 500);
}

TEST_F(FillTest, SameBitsFromEveryVectorSetAndFromSingleThreads) {
    const TerrainTables& t = *terrain.tables;
    const auto places = fill_places();
    for (std::size_t n = 0; n < 3 * places.size(); ++n) {
        draw_world();
        const ColumnPos place = places[n % places.size()];
        run(place, Isa::portable);
        const auto want = std::move(tile);
        for (const Isa isa : isas()) {
            run(place, isa);
            ASSERT_EQ(tile->top, want->top);
            ASSERT_TRUE(std::equal(std::begin(tile->block), std::end(tile->block), want->block)) << int(isa);
        }
        BlockTile threads;
        for (i32 i = 0; i < kColumnCells; ++i)
            fill_row<One>(t, thread_row(place, i), *ground, *caves, nullptr, nullptr, kTerrainHeight, threads);
        for (i32 b = 0; b < kTerrainHeight * kColumnCells; ++b)
            ASSERT_EQ(int(threads.block[b]), int(want->block[b])) << "block column " << (b & 255) << " y " << (b >> 8);
    }
}

// Strata of only what takes the remainder, nothing loose, no rules: still a solid ground.
TEST_F(FillTest, LittleContentFillsTheGroundToo) {
    TerrainDescription d;
    d.fields = {{"a", "F(.01)"}};
    d.attributes = {{"a", "a", -.1f, .1f}};
    d.layers = {{"stone", "minecraft:stone", 5}};
    d.biomes.resize(1);
    d.biomes[0].name = "t:plain";
    d.biomes[0].wants = ".";
    d.biomes[0].height = "130";
    terrain = compiled(d, 1);
    draw_world();
    run({3, 4});
    for (i32 i = 0; i < kColumnCells; ++i)
        for (i32 y = 1; y < ceil_level(double(ground->top[i])); ++y)
            if (!is_open(*caves, i, y)) {
                ASSERT_EQ(int(at(i, y)), int(block_of(terrain, "minecraft:stone")));
            }
}

} // namespace
} // namespace vitrail::testing
