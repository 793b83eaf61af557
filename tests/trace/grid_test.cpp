// The grid kept by edits, chunks that come and go, and moves of the window equals one that is built at once.
#include "grid_world.h"

#include <functional>
#include <gtest/gtest.h>

namespace vitrail::trace {
namespace {

// Skips against their definition: the side of the largest empty cube.
void expect_right_skips(Grid& grid) {
    const GridView g = grid.view();
    const i32 nx = 4 << g.bits_x, ny = 4 << g.bits_y, nz = 4 << g.bits_z;
    const auto chunk_of_brick = [&](i32 x, i32 y, i32 z) {
        return slot_of(g, {g.first.x + (x >> 2), g.first.y + (y >> 2), g.first.z + (z >> 2)});
    };
    const auto bit = [](i32 x, i32 y, i32 z) { return u32(x & 3) | u32(z & 3) << 2 | u32(y & 3) << 4; };
    const auto stops = [&](i32 x, i32 y, i32 z) {
        if (x < 0 || x >= nx || y < 0 || y >= ny || z < 0 || z >= nz) return false;
        return bool(g.chunks[chunk_of_brick(x, y, z)].bricks[0] >> bit(x, y, z) & 1);
    };
    for (i32 y = 0; y < ny; ++y)
        for (i32 z = 0; z < nz; ++z)
            for (i32 x = 0; x < nx; ++x) {
                const u32 chunk = chunk_of_brick(x, y, z),
                          word = g.skips[skip_index(g, {g.first.x * 4 + x, g.first.y * 4 + y, g.first.z * 4 + z})];
                if (stops(x, y, z)) {
                    const u32 at = g.chunks[chunk].masks[0] * 64 + bit(x, y, z);
                    const bool plain = g.masks[at] == g.masks[g.chunks[chunk].opaque * 64 + bit(x, y, z)];
                    ASSERT_EQ(word, kBrickStops | (plain ? kBrickPlain : 0) | at);
                    continue;
                }
                for (u32 octant = 0; octant < 8; ++octant) {
                    const i32 sx = octant & 1 ? 1 : -1, sy = octant & 2 ? 1 : -1, sz = octant & 4 ? 1 : -1;
                    // Shells of growing distance.
                    i32 n = 1;
                    for (bool empty = true; n < i32(kSkipMost); ++n) {
                        for (i32 a = 0; a <= n && empty; ++a)
                            for (i32 b = 0; b <= n && empty; ++b)
                                empty = !stops(x + sx * n, y + sy * a, z + sz * b) &&
                                        !stops(x + sx * a, y + sy * n, z + sz * b) &&
                                        !stops(x + sx * a, y + sy * b, z + sz * n);
                        if (!empty) break;
                    }
                    ASSERT_EQ(brick_skip(word, octant), u32(n)) << x << ' ' << y << ' ' << z << ' ' << octant;
                }
            }
    // What holds anything.
    IVec3 least{1 << 30, 1 << 30, 1 << 30}, most{-(1 << 30), -(1 << 30), -(1 << 30)};
    for (i32 y = 0; y < ny / 4; ++y)
        for (i32 z = 0; z < nz / 4; ++z)
            for (i32 x = 0; x < nx / 4; ++x)
                if (g.chunks[chunk_of_brick(x * 4, y * 4, z * 4)].bricks[0]) {
                    const IVec3 c{g.first.x + x, g.first.y + y, g.first.z + z};
                    least = {std::min(least.x, c.x), std::min(least.y, c.y), std::min(least.z, c.z)};
                    most = {std::max(most.x, c.x + 1), std::max(most.y, c.y + 1), std::max(most.z, c.z + 1)};
                }
    if (most.x < least.x) {
        EXPECT_EQ(g.extent_x, 0u);
        return;
    }
    EXPECT_EQ(g.least, least);
    EXPECT_EQ((IVec3{i32(g.extent_x), i32(g.extent_y), i32(g.extent_z)}),
              (IVec3{most.x - least.x, most.y - least.y, most.z - least.z}));
}

enum class Water : u8 { other, full, level };

// Whether rays in water have to look into a cell, from states alone.
Water water_at(const std::vector<StateRecord>& states, IVec3 at, const std::function<u32(IVec3)>& state) {
    const auto of = [&](i32 x, i32 y, i32 z) -> const StateRecord& {
        return states[state({at.x + x, at.y + y, at.z + z})];
    };
    if (of(0, 0, 0).kind != CellKind::liquid || of(0, 0, 0).medium != 1) return Water::other;
    if (of(0, 1, 0).medium == 1) return Water::full;
    for (i32 i = 0; i < 9; ++i) {
        const StateRecord &beside = of(i % 3 - 1, 0, i / 3 - 1), &above = of(i % 3 - 1, 1, i / 3 - 1);
        if (beside.medium == 1 && (beside.liquid_height != 227 || above.medium == 1)) return Water::other;
    }
    // So its surface is flat.
    const scene::LiquidSlope h = scene::liquid_slope([&](i32 dx, i32 dz) {
        const StateRecord& r = of(dx, 0, dz);
        return r.medium != 1               ? scene::kLiquidNone
               : of(dx, 1, dz).medium == 1 ? scene::kLiquidUnderLiquid
                                           : i32(r.liquid_height) + 1;
    });
    for (const i32 corner : {h.h00, h.h01, h.h10, h.h11})
        EXPECT_EQ(corner, 228);
    return Water::level;
}

// What the grid must say of every cell of its window, from states alone.
void expect_right(const GridWorld& world, Grid& grid, IVec3 corner, const std::function<u32(IVec3)>& state) {
    const GridView g = grid.view();
    ASSERT_EQ(g.first, (IVec3{corner.x >> 4, corner.y >> 4, corner.z >> 4}));
    ASSERT_EQ(g.water, 1u);
    ASSERT_EQ(g.water_top, 228u);
    const auto& states = world.content.states;
    for (i32 cy = 0; cy < 4; ++cy)
        for (i32 cz = 0; cz < 4; ++cz)
            for (i32 cx = 0; cx < 4; ++cx) {
                const IVec3 chunk{g.first.x + cx, g.first.y + cy, g.first.z + cz};
                const GridChunk& c = g.chunks[slot_of(g, chunk)];
                const u32 area_bit = u32(chunk.x & 3) | u32(chunk.z & 3) << 2 | u32(chunk.y & 3) << 4;
                u64 bricks[2] = {0, 0};
                u32 not_calm = 0, full = 0, level = 0; // layers that have such cells
                for (u32 cell = 0; cell < 4096; ++cell) {
                    const u32 x = cell & 15, z = cell >> 4 & 15, y = cell >> 8;
                    const IVec3 at{chunk.x * 16 + i32(x), chunk.y * 16 + i32(y), chunk.z * 16 + i32(z)};
                    const u32 is = state(at);
                    ASSERT_EQ(state_at(g, at), is);
                    const u32 brick = x / 4 | z / 4 << 2 | y / 4 << 4, bit = x % 4 | (z % 4) << 2 | (y % 4) << 4;
                    const Water water = water_at(states, at, state);
                    (water == Water::full ? full : water == Water::level ? level : not_calm) |= 1u << y;
                    const bool stops[2] = {states[is].kind != CellKind::empty, water == Water::other};
                    for (u32 set = 0; set < 2; ++set) {
                        ASSERT_EQ(g.masks[c.masks[set] * 64 + brick] >> bit & 1, u64(stops[set])) << set;
                        bricks[set] |= u64(stops[set]) << brick;
                    }
                    ASSERT_EQ(g.masks[c.opaque * 64 + brick] >> bit & 1, u64(states[is].kind == CellKind::cube));
                }
                ASSERT_EQ(c.layers, (full & ~not_calm) | (level & ~not_calm) << 16);
                for (u32 set = 0; set < 2; ++set)
                    ASSERT_EQ(c.bricks[set], bricks[set]);
                ASSERT_EQ(g.areas[area_slot_of(g, chunk)] >> area_bit & 1, u64(bricks[0] != 0));
            }
}

void expect_right(GridWorld& world) {
    expect_right(world, world.grid, world.corner(), [&](IVec3 p) { return world.state(p); });
}

TEST(Grid, BuiltAtOnce) {
    Rng rng(11);
    GridWorld world({4, -4, 8});
    world.scatter(rng, t_stone, 0.2, 4);
    world.scatter(rng, t_water, 0.2, 8);
    world.scatter(rng, t_sunken, 0.02);
    world.scatter(rng, t_flow, 0.004);
    ThreadPool pool(2);
    world.upload(&pool);
    expect_right(world);
    world.grid.refresh(&pool);
    expect_right_skips(world.grid);
}

TEST(Grid, EditsEqualARebuild) {
    Rng rng(12);
    GridWorld world({-4, 4, -8});
    world.scatter(rng, t_stone, 0.1, 16);
    world.scatter(rng, t_water, 0.2, 16);
    world.upload();
    for (u32 round = 0; round < 12; ++round) {
        EditBatch batch;
        ChangeSet changes;
        for (u32 i = 0; i < 60; ++i) {
            // Near one place, so that layers of neighboring chunks meet; and all states there are.
            const i32 x = i32(rng.below(20)), y = i32(rng.below(24)) + 12, z = i32(rng.below(20));
            const u32 state = rng.below(t_states);
            const BlockPos at{world.corner().x + x, world.corner().y + y, world.corner().z + z};
            batch.edits.push_back({at, StateId(state)});
            changes.blocks.push_back({at, StateId(world.at(x, y, z)), StateId(state)});
            world.at(x, y, z) = state;
        }
        if (round % 2)
            world.grid.apply(batch);
        else
            world.grid.apply(changes);
        if (round % 4 == 3) expect_right(world);
    }
    // A chunk goes, another comes again.
    const BlockStorage air;
    for (i32 i = 0; i < 4; ++i) {
        const i32 cx = i32(rng.below(2)), cy = i32(rng.below(3)), cz = i32(rng.below(2));
        world.grid.set_chunk(world.chunk_pos(cx, cy, cz), nullptr);
        for (u32 c = 0; c < 4096; ++c)
            world.at(cx * 16 + LocalPos(c).x(), cy * 16 + LocalPos(c).y(), cz * 16 + LocalPos(c).z()) = 0;
        expect_right(world);
        Chunk chunk;
        chunk.blocks = BlockStorage(StateId(t_water));
        world.grid.set_chunk(world.chunk_pos(cx, cy, cz), &chunk);
        for (u32 c = 0; c < 4096; ++c)
            world.at(cx * 16 + LocalPos(c).x(), cy * 16 + LocalPos(c).y(), cz * 16 + LocalPos(c).z()) = t_water;
        expect_right(world);
    }
}

// Water that comes, goes and flows at the corner where eight chunks meet, one block at a time.
TEST(Grid, LevelWaterFollowsEditsAcrossBorders) {
    Rng rng(18);
    GridWorld world({0, -4, 8});
    const auto at = [&](i32 x, i32 y, i32 z) {
        return BlockPos{world.corner().x + x, world.corner().y + y, world.corner().z + z};
    };
    for (const i32 top : {15, 16}) { // the surface's layer: a chunk's highest, and its lowest
        for (i32 z = 0; z < 64; ++z)
            for (i32 x = 0; x < 64; ++x)
                for (i32 y = 0; y < 64; ++y)
                    world.at(x, y, z) = y < 12 ? t_stone : y <= top ? t_water : t_air;
        world.upload();
        const GridView g = world.grid.view();
        ASSERT_EQ(g.chunks[slot_of(g, {g.first.x + 1, g.first.y + top / 16, g.first.z + 1})].layers >> 16,
                  1u << top % 16);
        expect_right(world);
        for (u32 i = 0; i < 12; ++i) {
            const i32 x = 15 + i32(rng.below(2)), y = top + i32(rng.below(2)), z = 15 + i32(rng.below(2));
            constexpr u32 kStates[] = {t_air, t_water, t_flow, t_sunken, t_stone};
            world.at(x, y, z) = kStates[rng.below(5)];
            world.grid.apply(EditBatch{{{at(x, y, z), StateId(world.at(x, y, z))}}});
            if (i % 2 == 0 || i > 8) expect_right(world);
        }
        // A chunk of the corner goes: where water was there is air.
        world.grid.set_chunk(world.chunk_pos(1, top / 16, 1), nullptr);
        for (u32 c = 0; c < 4096; ++c)
            world.at(16 + LocalPos(c).x(), top / 16 * 16 + LocalPos(c).y(), 16 + LocalPos(c).z()) = t_air;
        expect_right(world);
    }
}

// What is not up to date is not told.
TEST(Grid, WaterIsUnknownUntilRefreshed) {
    GridWorld world;
    for (i32 i = 0; i < 64 * 64 * 64; ++i)
        world.at(i % 64, i / 4096, i / 64 % 64) = i / 4096 < 20 ? t_water : t_air;
    world.upload();
    const Grid& grid = world.grid;
    EXPECT_EQ(grid.view().water, 0u);
    world.grid.refresh();
    EXPECT_EQ(grid.view().water, 1u);
    const IVec3 o = world.corner();
    world.grid.apply(EditBatch{{{{o.x + 5, o.y + 20, o.z + 5}, StateId(t_water)}}});
    EXPECT_EQ(grid.view().water, 0u);
    world.grid.refresh();
    EXPECT_EQ(grid.view().water, 1u);
    world.grid.apply(EditBatch{{{{o.x + 5, o.y + 20, o.z + 5}, StateId(t_water)}}}); // as it is
    EXPECT_EQ(grid.view().water, 1u);
}

// Bricks that fill and become empty, in windows of several sizes, at once and one by one, with moves between.
TEST(Grid, SkipsFollowEditsAndMoves) {
    Rng rng(16);
    const TestContent content;
    ThreadPool pool(1);
    for (const GridShape shape : {GridShape{2, 2, 2}, GridShape{2, 2, 3}}) {
        Grid grid(shape);
        grid.set_states(content.states, content.media);
        ChunkPos center{0, 0, 0};
        grid.center_on(center);
        Chunk air, stone;
        stone.blocks = BlockStorage(StateId(t_stone));
        const auto near = [&](i32 c, u32 reach) { return c + i32(rng.below(2 * reach + 1)) - i32(reach); };
        for (u32 step = 0; step < 6; ++step) {
            for (u32 i = 0; i < 6; ++i)
                grid.set_chunk({near(center.x, 4), near(center.y, 3), near(center.z, 6)}, rng.below(6) ? &air : &stone);
            if (step == 1) expect_right_skips(grid);
            for (u32 i = 0; i < 20; ++i) {
                const BlockPos at{near(center.x * 16, 40), near(center.y * 16, 40), near(center.z * 16, 40)};
                grid.apply(EditBatch{{{at, rng.below(3) ? StateId(t_stone) : StateId::air}}});
                if (i % 7 == 0) grid.view();
            }
            if (step % 2) expect_right_skips(grid);
            if (step % 2 == 0) continue;
            center = {near(center.x, 6), near(center.y, 3), near(center.z, 12)};
            grid.center_on(center);
            if (step > 3) grid.refresh(&pool);
            if (step > 3) expect_right_skips(grid);
        }
    }
}

TEST(Grid, MovesKeepWhatStaysAndDropTheRest) {
    Rng rng(13);
    GridWorld world;
    Grid grid({3, 3, 3});
    grid.set_states(world.content.states, world.content.media);
    grid.center_on({0, 0, 0});
    std::unordered_map<ChunkPos, StateId> held;
    ChunkPos center{0, 0, 0};
    u64 kept = 0;
    for (u32 step = 0; step < 60; ++step) {
        for (u32 i = 0; i < 40; ++i) {
            const auto near = [&](i32 c) { return c + i32(rng.below(9)) - 4; };
            const ChunkPos at{near(center.x), near(center.y), near(center.z)};
            Chunk chunk;
            const StateId state = StateId(rng.below(t_states));
            chunk.blocks = BlockStorage(state);
            grid.set_chunk(at, &chunk);
            if (grid.in_window(at)) held[at] = state;
        }
        center = {center.x + i32(rng.below(5)) - 2, center.y + i32(rng.below(9)) - 4,
                  center.z + i32(rng.below(10)) - 4};
        grid.center_on(center);
        std::erase_if(held, [&](const auto& h) { return !grid.in_window(h.first); });
        ASSERT_EQ(grid.chunk_count(), held.size());
        kept += held.size();
        const GridView g = grid.view();
        ASSERT_EQ(g.first.x % 4, 0);
        ASSERT_LE(std::abs(g.first.x + 4 - center.x), 2);
        for (i32 i = 0; i < 512; ++i) {
            const ChunkPos at{g.first.x + i % 8, g.first.y + i / 64, g.first.z + i / 8 % 8};
            const auto state_of = [&](ChunkPos c) {
                const auto it = held.find(c);
                return it == held.end() ? u32(0) : u32(it->second);
            };
            const u32 state = state_of(at);
            ASSERT_EQ(state_at(g, {at.x * 16 + 3, at.y * 16 + 15, at.z * 16 + 9}), state);
            const GridChunk& c = g.chunks[slot_of(g, {at.x, at.y, at.z})];
            for (i32 k = 0; k < 16; ++k) { // cells along its edges
                const IVec3 cell{at.x * 16 + (k & 1) * 15, at.y * 16 + (k & 2 ? 15 : 5 * (k >> 3)),
                                 at.z * 16 + (k >> 2 & 1) * 15};
                const Water water = water_at(world.content.states, cell, [&](IVec3 p) {
                    return state_of(chunk_of(BlockPos{p.x, p.y, p.z}));
                });
                ASSERT_EQ(is_calm(g, cell), water != Water::other);
            }
            ASSERT_EQ(c.bricks[0], state ? ~u64(0) : 0);
        }
    }
    EXPECT_GT(kept, 600u);
    grid.clear();
    ASSERT_EQ(grid.chunk_count(), 0u);
}

// A mirror that copies only what is told to be dirty holds the same bytes.
TEST(Grid, DirtyRangesSuffice) {
    Rng rng(14);
    GridWorld world;
    world.scatter(rng, t_stone, 0.3);
    world.upload();
    std::array<std::vector<std::byte>, kGridBuffers> mirror;
    const auto copy = [&] {
        world.grid.refresh();
        u64 bytes = 0;
        for (u32 b = 0; b < kGridBuffers; ++b) {
            const auto now = world.grid.buffer(GridBuffer(b));
            mirror[b].resize(now.size());
            for (const auto& r : world.grid.dirty(GridBuffer(b))) {
                std::copy(now.begin() + std::ptrdiff_t(r.begin), now.begin() + std::ptrdiff_t(r.end),
                          mirror[b].begin() + std::ptrdiff_t(r.begin));
                bytes += r.end - r.begin;
            }
            EXPECT_TRUE(std::equal(now.begin(), now.end(), mirror[b].begin(), mirror[b].end())) << b;
        }
        world.grid.clean();
        return bytes;
    };
    copy();
    u32 tints[kTintWords] = {};
    for (u32 round = 0; round < 50; ++round) {
        const BlockPos at{world.corner().x + i32(rng.below(64)), world.corner().y + i32(rng.below(64)),
                          world.corner().z + i32(rng.below(64))};
        world.grid.apply(EditBatch{{{at, StateId(rng.below(3))}}});
        EXPECT_LE(copy(), 45000u); // at most the indices of a chunk, where its palette grows, and skips around a brick
        if (round % 10 != 9) continue;
        tints[round] = round / 20;
        Chunk chunk;
        world.grid.set_chunk(chunk_of(at), round % 20 == 9 ? nullptr : &chunk, tints);
        copy();
    }
}

TEST(Grid, EqualTintsAreKeptOnce) {
    GridWorld world;
    std::vector<u32> green(kTintWords, 0xff00ff00), red(kTintWords, 0xff0000ff);
    Chunk chunk;
    for (i32 y = 0; y < 4; ++y)
        world.grid.set_chunk(world.chunk_pos(1, y, 1), &chunk, y == 3 ? red.data() : green.data());
    const GridView g = world.grid.view();
    const auto block = [&](i32 y) {
        const ChunkPos p = world.chunk_pos(1, y, 1);
        return world.grid.view().chunks[slot_of(g, {p.x, p.y, p.z})].tints;
    };
    EXPECT_EQ(block(0), block(1));
    EXPECT_NE(block(0), block(3));
    EXPECT_EQ(world.grid.view().tints[block(3) * kTintWords], 0xff0000ffu);
    for (i32 y = 0; y < 3; ++y)
        world.grid.set_chunk(world.chunk_pos(1, y, 1), &chunk, red.data());
    EXPECT_EQ(block(0), block(3));
    EXPECT_EQ(world.grid.view().tints[block(0) * kTintWords + 7], 0xff0000ffu);
}

TEST(Grid, StatesThatChangeRemakeTheMasks) {
    Rng rng(15);
    GridWorld world;
    world.scatter(rng, t_leaves, 0.3);
    world.upload();
    world.content.states[t_leaves].kind = CellKind::cube;
    world.grid.set_states(world.content.states, world.content.media);
    expect_right(world);
}

} // namespace
} // namespace vitrail::trace
