// What a client asks for comes first, and nothing comes that it may not know.
#include "base/rng.h"
#include "bench/voxel/sample_maze.h"
#include "math/mat.h"
#include "server/play_fixture.h"
#include "voxel/ray_walk.h"

#include <set>

namespace vitrail {
namespace {

using Place = std::tuple<i32, i32, i32>;
Place place(ChunkPos p) {
    return {p.x, p.y, p.z};
}

// A maze in the rock below a flat world, far below where players join.
struct Maze {
    static constexpr i32 kRadius = 6, kBottom = -4;
    static constexpr IVec3 kSize{2 * kRadius + 1, 6, 2 * kRadius + 1};
    bench::SampleMaze rock{kSize};
    Play play;

    explicit Maze(u64 seed = 1)
        : play(
              "", [this, seed](Dimension& dimension) { carve(dimension, seed); }, kRadius) {}

    BlockPos outside(BlockPos p) const { return {p.x - kRadius * 16, p.y + kBottom * 16, p.z - kRadius * 16}; }
    BlockPos inside(BlockPos p) const { return {p.x + kRadius * 16, p.y - kBottom * 16, p.z + kRadius * 16}; }
    void carve(Dimension& dimension, u64 seed) {
        Rng rng(seed);
        rock.carve_maze(rng, 60);
        // A long hall through the middle.
        rock.carve({20, 60, 92}, {190, 70, 102});
        const StateId stone = dimension.chunks().begin()->second->blocks.get(LocalPos());
        rock.each_section([&](ChunkPos at) {
            Chunk chunk;
            std::vector<StateId> cells(kChunkVolume);
            for (u32 i = 0; i < u32(kChunkVolume); ++i)
                cells[i] = rock.rock(block_at(at, LocalPos(i))) ? stone : StateId::air;
            chunk.blocks = BlockStorage::from_states(std::span<const StateId, kChunkVolume>(cells));
            dimension.put({at.x - kRadius, at.y + kBottom, at.z - kRadius},
                          std::make_shared<const Chunk>(std::move(chunk)));
        });
    }
    // Puts the player's eye into the hall.
    void enter(const std::string& name, BlockPos in_maze) {
        auto& session = play.session(name);
        session.body.flying = true;
        session.body.feet.at = corner_of(outside({in_maze.x, in_maze.y - 1, in_maze.z}));
        session.body.velocity = {};
        session.tell_body = true;
    }
    // Sections that rays from the eye meet within 80 blocks.
    std::set<Place> seen_from(WorldPos eye) const {
        std::set<Place> seen;
        Rng rng(9);
        for (u32 i = 0; i < 20000; ++i) {
            Vec3 d{rng.unit() * 2 - 1, rng.unit() * 2 - 1, rng.unit() * 2 - 1};
            if (i % 2) d = view_from(eye, outside(rock.open_block(rng, 20))).v;
            for (RayWalk walk(eye, d, 80); walk.valid(); walk.step()) {
                const BlockPos at = inside(walk.cell());
                if (!rock.inside(at)) break;
                seen.insert(place(chunk_of(walk.cell())));
                if (rock.rock(at)) break;
            }
        }
        return seen;
    }
};

const BlockPos kHall{30, 66, 97};

replica::Gaze gaze(const replica::Replica& replica, float yaw) {
    return {eye_of(replica.body()), look_direction(yaw, 0), 0.8f};
}

// Ticks until the client holds all that rays see from the hall, and what it holds then besides.
struct Arrival {
    int ticks = 0;
    std::size_t hidden = 0;
};

Arrival arrive(bool asks, float turn) {
    Maze maze;
    auto& ann = maze.play.join("ann", 6);
    maze.enter("ann", kHall);
    maze.play.world().options.bytes_a_tick_most = 300; // a few sections
    maze.play.tick();
    const std::set<Place> seen = maze.seen_from(eye_of(ann.body()));
    EXPECT_GT(seen.size(), 8u);
    std::set<Place> before;
    for (const auto& [at, chunk] : ann.dimension().chunks())
        before.insert(place(at));
    Arrival out;
    float yaw = 0;
    for (; out.ticks < 600; ++out.ticks) {
        bool all = true;
        for (const auto& [x, y, z] : seen)
            all &= ann.has_section({x, y, z});
        if (all) break;
        if (asks) ann.ask_for_sections(gaze(ann, yaw += turn));
        maze.play.tick();
    }
    for (const auto& [at, chunk] : ann.dimension().chunks())
        out.hidden += !before.contains(place(at)) && !seen.contains(place(at));
    return out;
}

TEST(SectionAsks, WhatIsSeenComesBeforeWhatIsHidden) {
    const Arrival asking = arrive(true, 0), silent = arrive(false, 0);
    EXPECT_LT(asking.ticks * 2, silent.ticks);
    EXPECT_LT(asking.hidden * 2, silent.hidden);
    EXPECT_LT(silent.ticks, 600) << "who never asks gets everything too";
}

TEST(SectionAsks, TurningFastChangesTheOrderAlone) {
    const Arrival turning = arrive(true, 1.7f), silent = arrive(false, 0);
    EXPECT_LT(turning.ticks * 2, silent.ticks);
}

TEST(SectionAsks, InThePictureFirstThenAroundNearestFirst) {
    Maze maze;
    auto& ann = maze.play.join("ann", 6);
    maze.enter("ann", {100, 66, 97});
    maze.play.world().options.bytes_a_tick_most = 1;
    maze.play.tick(3);
    replica::SectionAsks asks;
    for (const float yaw : {0.0f, 1.5f, 3.0f, -1.5f}) {
        const replica::Gaze look = gaze(ann, yaw);
        const auto missing = asks.missing(ann.dimension(), look, 6, 1000);
        ASSERT_GT(missing.size(), 3u);
        bool aside = false;
        i64 last = 0;
        const ChunkPos eye = chunk_of(block_of(look.eye));
        for (ChunkPos at : missing) {
            EXPECT_FALSE(ann.has_section(at));
            const BlockPos o = origin_of(at);
            const Vec3 to = view_from(look.eye, BlockPos{o.x + 8, o.y + 8, o.z + 8}).v;
            const bool behind = dot(to, look.forward) < -14 && length(to) > 20;
            const bool ahead = dot(to, look.forward) > 0.9f * length(to);
            const i64 x = at.x - eye.x, y = at.y - eye.y, z = at.z - eye.z, d = x * x + y * y + z * z;
            EXPECT_FALSE(ahead && aside) << "ahead, yet after others";
            if (behind && !aside) aside = true, last = 0;
            if (!behind && !ahead) continue;
            EXPECT_LE(last, d);
            last = d;
        }
        EXPECT_LE(asks.missing(ann.dimension(), look, 6, 2).size(), 2u);
    }
    EXPECT_FALSE(asks.stale(gaze(ann, -1.5f)));
    EXPECT_TRUE(asks.stale(gaze(ann, 1.5f)));
}

// In the open nothing is missing once all is here, and nothing more is asked.
TEST(SectionAsks, EndsWhenEverythingSeenIsHere) {
    Maze maze;
    auto& ann = maze.play.join("ann", 5);
    auto& bob = maze.play.join("bob", 4);
    maze.enter("bob", kHall);
    for (int i = 0; i < 100; ++i) {
        ann.ask_for_sections(gaze(ann, float(i)));
        bob.ask_for_sections(gaze(bob, float(i)));
        maze.play.tick();
        ::usleep(200);
    }
    maze.play.settle();
    replica::SectionAsks asks;
    EXPECT_TRUE(asks.missing(ann.dimension(), gaze(ann, 0), 5, 1000).empty());
    replica::SectionAsks bobs;
    EXPECT_TRUE(bobs.missing(bob.dimension(), gaze(bob, 0), 4, 1000).empty());
}

TEST(SectionAsks, WhatMayNotBeKnownIsNotSentHoweverOftenAsked) {
    Maze maze;
    maze.play.join("ann", 4);
    auto [near_end, far_end] = net::make_loopback({});
    maze.play.server->connect(std::move(far_end));
    const auto say = [&near = near_end](const auto& message) {
        (void)near->send(net::Channel::control, net::encode_message(message));
    };
    say(net::Hello{net::kProtocolVersion, "eve", 4, 0});
    maze.play.settle();
    Rng rng(2);
    const u64 sent = maze.play.world().stats.sections_sent;
    std::set<Place> held;
    for (const auto& [at, section] : maze.play.session("eve").held)
        held.insert(place(at));
    for (int round = 0; round < 30; ++round) {
        for (int k = 0; k < 40; ++k) {
            net::AskSections asked{round % 3 == 2 ? 77u : 0u, {}};
            for (u32 i = 0; i < net::kMostSectionsAsked; ++i) {
                const auto any = [&] { return round % 2 ? i32(rng.next()) : i32(rng.below(9)) - 4; };
                asked.at.push_back({any(), any(), any()});
            }
            say(asked);
        }
        maze.play.tick();
        near_end->poll([](net::Channel, ByteView) {}, 1000);
        const auto& eve = maze.play.session("eve");
        EXPECT_FALSE(eve.gone);
        EXPECT_LE(eve.asked.size(), net::kMostSectionsAsked);
        for (ChunkPos at : eve.asked) { // what is kept lies in range
            EXPECT_LE(std::abs(at.x), 6 + 4);
            EXPECT_LE(std::abs(at.z), 6 + 4);
        }
    }
    // The maze is closed to a player on the ground: nothing of it came.
    EXPECT_EQ(maze.play.world().stats.sections_sent, sent);
    for (const auto& [at, section] : maze.play.session("eve").held)
        EXPECT_TRUE(held.contains(place(at)));
    // More than a message may hold ends the session of who sent it, no other.
    net::AskSections many;
    many.at.resize(net::kMostSectionsAsked + 1);
    say(many);
    maze.play.tick(2);
    EXPECT_EQ(maze.play.world().sessions.size(), 1u);
    EXPECT_TRUE(maze.play.clients[0]->joined() && !maze.play.clients[0]->lost());
}

} // namespace
} // namespace vitrail
