// The fast light against a solver that repeats the model's one rule until nothing changes.
#include "light/relight.h"

#include "base/rng.h"
#include "world/state_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

namespace vitrail {
namespace {

struct World {
    std::shared_ptr<StateTable> states;
    std::vector<StateId>
        ids; // air, stone, glass-like, leaves 1, water 2, thick 5, white lamp, red torch, blue lamp, dim green
    static StateId define(BlockRegistry& registry, std::vector<std::string>& names, const char* name, u8 opacity,
                          std::array<u8, 3> light) {
        BlockDef def;
        def.name = name;
        def.look.opacity = opacity;
        def.look.light = light;
        def.look.shape = opacity == 15 ? ShapeKind::cube : ShapeKind::none;
        def.look.layer = opacity == 15 ? RenderLayer::solid : RenderLayer::translucent;
        registry.add_block(def);
        names.emplace_back(name);
        return {};
    }
    World() {
        auto registry = std::make_shared<BlockRegistry>();
        std::vector<std::string> names{"minecraft:air"};
        define(*registry, names, "test:stone", 15, {});
        define(*registry, names, "test:glass", 0, {});
        define(*registry, names, "test:leaves", 1, {});
        define(*registry, names, "test:water", 2, {});
        define(*registry, names, "test:thick", 5, {});
        define(*registry, names, "test:lamp", 15, {15, 15, 15});
        define(*registry, names, "test:torch", 0, {14, 9, 3});
        define(*registry, names, "test:blue", 1, {0, 2, 12});
        define(*registry, names, "test:dim", 0, {0, 4, 0});
        states = std::make_shared<StateTable>(registry);
        for (const auto& n : names)
            ids.push_back(*states->intern(*parse_block_state(n)));
    }
    enum { air, stone, glass, leaves, water, thick, lamp, torch, blue, dim, count };
};

World& world() {
    static World w;
    return w;
}

DimensionInfo small_info(bool sky = true) {
    DimensionInfo info;
    info.min_y = -32;
    info.max_y = 48;
    info.has_sky = sky;
    return info;
}

using Region = std::map<std::tuple<i32, i32, i32>, std::vector<u32>>; // spread light of each lit chunk

// Repeats the rule over all lit chunks, laid out in one box, until nothing changes.
Region brute_force(const Dimension& d) {
    ChunkPos lo{1 << 20, 1 << 20, 1 << 20}, hi{-(1 << 20), -(1 << 20), -(1 << 20)};
    for (const auto& [at, chunk] : d.chunks()) {
        lo = {std::min(lo.x, at.x), std::min(lo.y, at.y), std::min(lo.z, at.z)};
        hi = {std::max(hi.x, at.x), std::max(hi.y, at.y), std::max(hi.z, at.z)};
    }
    const i32 nx = (hi.x - lo.x + 1) * 16 + 2, ny = (hi.y - lo.y + 1) * 16 + 2, nz = (hi.z - lo.z + 1) * 16 + 2;
    const auto flat = [&](BlockPos p) {
        return std::size_t(((p.y - lo.y * 16 + 1) * nz + (p.z - lo.z * 16 + 1)) * nx + (p.x - lo.x * 16 + 1));
    };
    struct Cell {
        std::array<u8, 4> light{}, source{};
        u8 cost = 0; // 0: no cell
    };
    std::vector<Cell> cells(std::size_t(nx) * std::size_t(ny) * std::size_t(nz));
    const StateLight* lights = d.states().light_data();
    for (const auto& [at, chunk] : d.chunks()) {
        if (!chunk->light) continue;
        const ColumnHeights heights =
            d.heights(column_of(at)) ? *d.heights(column_of(at)) : compute_heights(d, column_of(at));
        for (u32 i = 0; i < kChunkVolume; ++i) {
            const BlockPos p = block_at(at, LocalPos(i));
            const StateLight s = lights[u32(chunk->blocks.get(LocalPos(i)))];
            Cell& c = cells[flat(p)];
            c.cost = std::max<u8>(1, s.opacity);
            c.source = {u8(d.info().has_sky && p.y >= heights.above[i & 255] ? 15 : 0), s.red, s.green, s.blue};
        }
    }
    const std::ptrdiff_t steps[6] = {-1, 1, -nx, nx, -std::ptrdiff_t(nx) * nz, std::ptrdiff_t(nx) * nz};
    for (bool changed = true; changed;) {
        changed = false;
        for (std::size_t i = 0; i < cells.size(); ++i) {
            Cell& c = cells[i];
            if (c.cost == 0) continue;
            for (u32 ch = 0; ch < 4; ++ch) {
                u8 want = c.source[ch];
                for (const std::ptrdiff_t step : steps) {
                    const u8 v = cells[i + std::size_t(step)].light[ch];
                    if (v > c.cost + want) want = u8(v - c.cost);
                }
                if (want == c.light[ch]) continue;
                c.light[ch] = want;
                changed = true;
            }
        }
    }
    Region out;
    for (const auto& [at, chunk] : d.chunks()) {
        if (!chunk->light) continue;
        auto& to = out[{at.x, at.y, at.z}];
        for (u32 i = 0; i < kChunkVolume; ++i) {
            const auto& l = cells[flat(block_at(at, LocalPos(i)))].light;
            to.push_back(u32(l[0]) | u32(l[1]) << 8 | u32(l[2]) << 16 | u32(l[3]) << 24);
        }
    }
    return out;
}

void expect_exact(const Dimension& d, const char* what) {
    const Region want = brute_force(d);
    for (const auto& [key, cells] : want) {
        const ChunkPtr chunk = d.find({std::get<0>(key), std::get<1>(key), std::get<2>(key)});
        for (u32 i = 0; i < kChunkVolume; ++i) {
            const Light l = chunk->light->get(LocalPos(i));
            const u32 packed = l.sky() | l.red() << 8 | l.green() << 16 | l.blue() << 24;
            ASSERT_EQ(packed, cells[i]) << what << ": chunk " << std::get<0>(key) << ' ' << std::get<1>(key) << ' '
                                        << std::get<2>(key) << " cell " << i;
        }
    }
}

// Rock with holes and things in it, thinner higher up.
std::shared_ptr<Chunk> random_chunk(Rng& rng, ChunkPos at) {
    auto chunk = std::make_shared<Chunk>();
    const World& w = world();
    const u32 kind = rng.below(6);
    const u32 solid = at.y > 0 ? 5 : kind == 0 ? 0 : kind == 1 ? 97 : kind == 2 ? 100 : 10 + rng.below(60);
    if (solid == 100) {
        chunk->blocks = BlockStorage(w.ids[World::stone]);
        return chunk;
    }
    std::vector<StateId> cells(kChunkVolume);
    for (auto& c : cells) {
        const u32 roll = rng.below(1000);
        if (rng.below(100) < solid)
            c = w.ids[World::stone];
        else if (roll < 4)
            c = w.ids[World::lamp + rng.below(4)];
        else if (roll < 60)
            c = w.ids[World::glass + rng.below(4)];
        else
            c = w.ids[World::air];
    }
    chunk->blocks = BlockStorage::from_states(std::span<const StateId, kChunkVolume>(cells));
    return chunk;
}

TEST(RelightChunks, OneColumnIsExact) {
    for (u64 seed = 1; seed <= 8; ++seed) {
        Rng rng(seed);
        Dimension d(small_info(seed % 4 != 0), world().states);
        std::vector<ChunkPos> all;
        for (i32 y = -2; y < 3; ++y) {
            if (rng.below(6) == 0) continue;
            d.put({0, y, 0}, random_chunk(rng, {0, y, 0}));
            all.push_back({0, y, 0});
        }
        const ChangeSet lit = relight_chunks(d, all);
        EXPECT_EQ(lit.light_chunks.size(), all.size());
        expect_exact(d, "column");
        if (HasFatalFailure()) return;
    }
}

TEST(RelightChunks, AnyOrderOfLoadingIsExact) {
    for (u64 seed = 1; seed <= 6; ++seed) {
        std::vector<std::pair<ChunkPos, std::shared_ptr<Chunk>>> made;
        Rng rng(seed * 77);
        for (i32 x = -1; x < 2; ++x)
            for (i32 z = -1; z < 1; ++z)
                for (i32 y = -2; y < 3; ++y)
                    if (rng.below(8) != 0) made.push_back({{x, y, z}, random_chunk(rng, {x, y, z})});
        for (u32 order = 0; order < 3; ++order) {
            Dimension d(small_info(), world().states);
            auto list = made;
            for (std::size_t i = list.size(); i > 1; --i)
                std::swap(list[i - 1], list[rng.below(u32(i))]);
            const std::size_t batch = order == 0 ? list.size() : order == 1 ? 1 : 5;
            for (std::size_t i = 0; i < list.size(); i += batch) {
                std::vector<ChunkPos> now;
                for (std::size_t k = i; k < std::min(i + batch, list.size()); ++k) {
                    d.put(list[k].first, list[k].second);
                    now.push_back(list[k].first);
                }
                for (const ChunkPos p : now)
                    d.put_heights(column_of(p), compute_heights(d, column_of(p)));
                relight_chunks(d, now);
            }
            expect_exact(d, "order");
            if (HasFatalFailure()) return;
        }
    }
}

TEST(RelightChunks, LightingAgainChangesNothing) {
    Rng rng(5);
    Dimension d(small_info(), world().states);
    std::vector<ChunkPos> all;
    for (i32 x = 0; x < 2; ++x)
        for (i32 y = -2; y < 3; ++y) {
            d.put({x, y, 0}, random_chunk(rng, {x, y, 0}));
            all.push_back({x, y, 0});
        }
    relight_chunks(d, all);
    for (const ChunkPos p : all)
        EXPECT_TRUE(relight_chunks(d, std::vector<ChunkPos>{p}).light_chunks.empty());
    EXPECT_TRUE(relight_chunks(d, all).light_chunks.empty());
    expect_exact(d, "again");
}

TEST(RelightChunks, AllAirAndAllRockAreUniform) {
    Dimension d(small_info(), world().states);
    auto rock = std::make_shared<Chunk>();
    rock->blocks = BlockStorage(world().ids[World::stone]);
    d.put({0, 1, 0}, std::make_shared<Chunk>());
    d.put({0, 0, 0}, rock);
    relight_chunks(d, std::vector<ChunkPos>{{0, 0, 0}, {0, 1, 0}});
    EXPECT_TRUE(d.find({0, 1, 0})->light->uniform());
    EXPECT_EQ(d.find({0, 1, 0})->light->get(LocalPos()), Light(15, 0, 0, 0));
    EXPECT_TRUE(d.find({0, 0, 0})->light->uniform());
    EXPECT_EQ(d.find({0, 0, 0})->light->get(LocalPos()), Light(0, 0, 0, 0));
}

class Edited : public ::testing::Test {
protected:
    Dimension d{small_info(), world().states};
    std::vector<ChunkPos> all;
    void fill(Rng& rng, i32 size) {
        for (i32 x = 0; x < size; ++x)
            for (i32 z = 0; z < size; ++z)
                for (i32 y = -2; y < 3; ++y) {
                    d.put({x, y, z}, random_chunk(rng, {x, y, z}));
                    all.push_back({x, y, z});
                }
        relight_chunks(d, all);
    }
    void empty(i32 size, World* = nullptr) {
        for (i32 x = -size; x < size; ++x)
            for (i32 z = -size; z < size; ++z)
                for (i32 y = -2; y < 3; ++y) {
                    auto chunk = std::make_shared<Chunk>();
                    if (y < 0) chunk->blocks = BlockStorage(world().ids[World::stone]);
                    d.put({x, y, z}, chunk);
                    all.push_back({x, y, z});
                }
        relight_chunks(d, all);
    }
    ChangeSet edit(std::vector<Edit> edits) {
        ChangeSet changes = apply(d, EditBatch{std::move(edits)});
        relight(d, changes);
        return changes;
    }
};

TEST_F(Edited, RandomBatchesAreExact) {
    for (u64 seed = 1; seed <= 3; ++seed) {
        Rng rng(seed * 991);
        d = Dimension(small_info(seed != 3), world().states);
        all.clear();
        fill(rng, 2);
        for (u32 round = 0; round < 14; ++round) {
            std::vector<Edit> edits;
            const u32 n = 1 + rng.below(round % 3 == 0 ? 400 : 12);
            const i32 cx = i32(rng.below(32)), cy = i32(rng.below(80)) - 32, cz = i32(rng.below(32));
            for (u32 i = 0; i < n; ++i) {
                // clustered, so that borders and each other are met; some columns whole
                const BlockPos p{(cx + i32(rng.below(5))) & 31, std::clamp(cy + i32(rng.below(9)) - 4, -32, 47),
                                 (cz + i32(rng.below(5))) & 31};
                edits.push_back({p, world().ids[rng.below(World::count)]});
            }
            edit(edits);
            expect_exact(d, "batch");
            if (HasFatalFailure()) return;
        }
    }
}

TEST_F(Edited, OneOfTwoLampsRemoved) {
    empty(1);
    const StateId torch = world().ids[World::torch], blue = world().ids[World::blue];
    edit({{{0, 4, 0}, torch}, {{5, 4, 0}, torch}, {{2, 6, 1}, blue}});
    expect_exact(d, "three lamps");
    EXPECT_EQ(d.light_at({1, 4, 0}), Light(15, 13, 8, 8)); // colors mix by channel
    edit({{{0, 4, 0}, StateId::air}});
    expect_exact(d, "one removed");
    EXPECT_EQ(d.light_at({0, 4, 0}).red(), 9u);
}

TEST_F(Edited, PlaceAndRemoveLeavesNoTrace) {
    empty(2);
    std::map<std::tuple<i32, i32, i32>, LightVolume> before;
    for (const ChunkPos p : all)
        before.emplace(std::tuple{p.x, p.y, p.z}, *d.find(p)->light);
    const ChangeSet placed = edit({{{1, 3, 1}, world().ids[World::lamp]}});
    EXPECT_FALSE(placed.light_chunks.empty());
    edit({{{1, 3, 1}, StateId::air}});
    for (const ChunkPos p : all) {
        EXPECT_EQ(*d.find(p)->light, before.at({p.x, p.y, p.z}));
        EXPECT_TRUE(d.find(p)->light->uniform()) << p.x << ' ' << p.y << ' ' << p.z;
    }
}

TEST_F(Edited, RoofAndHoleInIt) {
    empty(1);
    std::vector<Edit> roof;
    for (i32 x = -12; x < 12; ++x)
        for (i32 z = -12; z < 12; ++z)
            roof.push_back({{x, 20, z}, world().ids[World::stone]});
    edit(roof);
    expect_exact(d, "roof");
    EXPECT_LT(d.light_at({0, 5, 0}).sky(), 6u);
    edit({{{0, 20, 0}, StateId::air}});
    expect_exact(d, "hole");
    EXPECT_EQ(d.light_at({0, 0, 0}).sky(), 15u);
    edit({{{0, 20, 0}, world().ids[World::leaves]}});
    expect_exact(d, "leaves in the hole");
}

TEST_F(Edited, TunnelAcrossChunks) {
    empty(2);
    std::vector<Edit> tunnel;
    for (i32 x = -30; x < 30; ++x)
        for (i32 y = -20; y < -18; ++y)
            tunnel.push_back({{x, y, 0}, StateId::air});
    edit(tunnel);
    edit({{{0, -20, 0}, world().ids[World::torch]}});
    expect_exact(d, "lamp in a tunnel");
    EXPECT_EQ(d.light_at({13, -20, 0}).red(), 1u);
    edit({{{7, -20, 0}, world().ids[World::stone]}, {{7, -19, 0}, world().ids[World::stone]}});
    expect_exact(d, "wall in the tunnel");
    edit({{{0, -20, 0}, StateId::air}});
    expect_exact(d, "lamp gone");
    EXPECT_EQ(d.light_at({1, -20, 0}), Light());
}

// Light that went out through a chunk and back must go when its lamp is lost while that chunk is away.
TEST_F(Edited, UnloadingAndComingBackIsExact) {
    for (u64 seed = 1; seed <= 6; ++seed) {
        Rng rng(seed * 13);
        d = Dimension(small_info(), world().states);
        all.clear();
        fill(rng, 2);
        for (u32 round = 0; round < 6; ++round) {
            std::map<std::tuple<i32, i32, i32>, ChunkPtr> away;
            const i32 ax = i32(rng.below(2)), az = i32(rng.below(2));
            for (const ChunkPos p : all)
                if ((p.x == ax && p.z == az) || rng.below(8) == 0) {
                    away[{p.x, p.y, p.z}] = d.find(p);
                    d.erase(p);
                }
            std::vector<Edit> edits; // holes, walls and lamps by the borders
            for (u32 i = 0; i < 300; ++i)
                edits.push_back({{12 + i32(rng.below(8)), i32(rng.below(60)) - 30, 12 + i32(rng.below(8))},
                                 world().ids[rng.below(3) ? 0u : rng.below(World::count)]});
            edit(edits);
            std::vector<ChunkPos> back;
            for (const auto& [at, chunk] : away) {
                auto copy = std::make_shared<Chunk>(*chunk);
                copy->light = nullptr;
                back.push_back({std::get<0>(at), std::get<1>(at), std::get<2>(at)});
                d.put(back.back(), copy);
            }
            for (const ChunkPos p : all)
                d.put_heights(column_of(p), compute_heights(d, column_of(p)));
            relight_chunks(d, back);
            expect_exact(d, "back again");
            if (HasFatalFailure()) return;
        }
    }
}

TEST_F(Edited, ChangesThatLightDoesNotSeeAreFree) {
    empty(1);
    const ChangeSet c = edit({{{0, 5, 0}, world().ids[World::glass]}});
    EXPECT_EQ(c.blocks.size(), 1u);
    EXPECT_TRUE(c.light_chunks.empty());
}

// The same tests once more on the portable paths, in a process of its own because the choice is made once.
TEST(Portable, SameWithoutWideInstructions) {
    if (std::getenv("VITRAIL_PORTABLE")) GTEST_SKIP() << "this is that process";
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command =
        "VITRAIL_PORTABLE=1 '" + self + "' --gtest_filter='RelightChunks.*:Edited.Roof*' > /dev/null";
    EXPECT_EQ(std::system(command.c_str()), 0);
}

} // namespace
} // namespace vitrail
