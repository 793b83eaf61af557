// Server and replica together, over loopback, ticked by hand.
#include "base/rng.h"
#include "server/play_fixture.h"

#include <set>

namespace vitrail {
namespace {

const Vec3 kMiddle{0.5f, 0.5f, 0.5f};

TEST(Play, AClientJoinsAndSeesTheSurfaceOfTheWorld) {
    Play play;
    auto& ann = play.join("ann");
    EXPECT_EQ(ann.dimension().info().name, "minecraft:overworld");
    EXPECT_EQ(seen(ann, {0, 63, 0}), "minecraft:stone");
    EXPECT_EQ(seen(ann, {0, 62, 0}), "vitrail:hidden");
    EXPECT_EQ(seen(ann, {0, 64, 0}), "minecraft:air");
    EXPECT_FALSE(ann.has_section({0, 1, 0})); // solid rock, never reached
    expect_equal_surface(play, ann);
    EXPECT_EQ(ann.dimension().light_at({0, 64, 0}).sky(), 15u);
    EXPECT_FALSE(ann.take_dirty().empty());
    EXPECT_TRUE(ann.take_dirty().empty());
}

TEST(Play, ContentThatIsKnownIsNotSentAgain) {
    Play play;
    auto& stranger = play.join("stranger");
    auto& friendly = play.join("friendly", 3, {}, true);
    EXPECT_GT(stranger.stats().bytes, friendly.stats().bytes + 10000);
    EXPECT_EQ(friendly.registry().get(), base_content().registry.get());
    EXPECT_NE(stranger.registry().get(), base_content().registry.get());
    EXPECT_EQ(stranger.registry()->blocks().size(), base_content().registry->blocks().size());
    expect_equal_surface(play, friendly);
}

TEST(Play, EndlessLandIsTheSameOnBothSidesAndNothingHiddenIsTold) {
    Play play("endless");
    auto& ann = play.join("ann", 4);
    expect_equal_surface(play, ann);
    // Ground truth: a state told in place of a hidden one would show as a difference above; count that some were
    // hidden.
    u64 hidden = 0;
    std::set<std::string> kinds; // of rock that nobody sees yet
    for (const auto& [at, chunk] : ann.dimension().chunks()) {
        const ChunkPtr truth = play.dimension().dimension.find(at);
        if (!truth) continue;
        for (u32 i = 0; i < u32(kChunkVolume); ++i) {
            if (chunk->blocks.get(LocalPos(i)) != StateId::hidden) continue;
            ++hidden;
            kinds.insert(play.world().states().info(truth->blocks.get(LocalPos(i))).state.name);
        }
    }
    EXPECT_GT(hidden, 10000u);
    EXPECT_GT(kinds.size(), 5u);
}

TEST(Play, BlocksBreakAndLayBareWhatWasHidden) {
    Play play;
    auto& ann = play.join("ann");
    const BlockPos at{1, 63, 0};
    auto sequence = ann.break_block(at, Face::up, {0.5f, 1, 0.5f});
    ASSERT_TRUE(sequence) << sequence.error().message;
    // Predicted at once; what lies below is guessed.
    EXPECT_EQ(seen(ann, at), "minecraft:air");
    EXPECT_EQ(seen(ann, {1, 62, 0}), "minecraft:stone");
    EXPECT_EQ(play.block(at), "minecraft:stone");
    play.tick();
    EXPECT_EQ(play.block(at), "minecraft:air");
    const auto answers = ann.take_answers();
    ASSERT_FALSE(answers.empty());
    EXPECT_EQ(answers[0].outcome, net::EditOutcome::accepted);
    EXPECT_EQ(ann.stats().pending_edits, 0u);
    expect_equal_surface(play, ann);
}

TEST(Play, OnlySectionsThatChangeAreDirty) {
    Play play;
    auto& ann = play.join("ann");
    (void)ann.take_dirty();
    // In the middle of a section's top: no neighbor's mesh differs but for the light above.
    ASSERT_TRUE(ann.place_block({3, 63, 3}, Face::up, {0.5f, 1, 0.5f}, "minecraft:glass"));
    play.tick(2);
    u32 meshed = 0;
    bool own = false, below = false;
    for (const auto& d : ann.take_dirty()) {
        meshed += (d.what & (replica::kBlocksChanged | replica::kBorderBlocks)) != 0;
        own |= d.at == ChunkPos{0, 4, 0} && (d.what & replica::kBlocksChanged);
        below |= d.at == ChunkPos{0, 3, 0} && (d.what & replica::kBorderBlocks);
    }
    EXPECT_TRUE(own);
    EXPECT_TRUE(below);
    EXPECT_EQ(meshed, 2u);
    play.tick(2);
    EXPECT_TRUE(ann.take_dirty().empty());
}

TEST(Play, GuessesGiveWayToTheTruth) {
    Play play("", [](Dimension& d) {
        const StateId ore = *d.states().intern_with_defaults(*parse_block_state("minecraft:gold_ore"));
        apply(d, {{{{1, 62, 0}, ore}}});
    });
    auto& ann = play.join("ann");
    EXPECT_EQ(seen(ann, {1, 62, 0}), "vitrail:hidden");
    ASSERT_TRUE(ann.break_block({1, 63, 0}, Face::up, {0.5f, 1, 0.5f}));
    EXPECT_EQ(seen(ann, {1, 62, 0}), "minecraft:stone");
    play.tick();
    EXPECT_EQ(seen(ann, {1, 62, 0}), "minecraft:gold_ore");
}

TEST(Play, BlocksArePlacedAndLampsShine) {
    Play play;
    auto& ann = play.join("ann");
    auto sequence = ann.place_block({2, 63, 0}, Face::up, {0.5f, 1, 0.5f}, "minecraft:glowstone");
    ASSERT_TRUE(sequence) << sequence.error().message;
    EXPECT_EQ(seen(ann, {2, 64, 0}), "minecraft:glowstone");
    EXPECT_GT(ann.dimension().light_at({3, 64, 0}).red(), 0u);
    play.tick();
    EXPECT_EQ(play.block({2, 64, 0}), "minecraft:glowstone");
    EXPECT_EQ(seen(ann, {2, 63, 0}), "vitrail:hidden"); // walled in by the lamp
    expect_equal_surface(play, ann);
}

TEST(Play, WhatIsRefusedIsTakenBack) {
    Play play;
    auto& ann = play.join("ann", 4);
    // What the client's own rules refuse is not even asked.
    EXPECT_EQ(ann.place_block({20, 63, 0}, Face::up, {0.5f, 1, 0.5f}, "minecraft:glowstone").error().message,
              "too far away");
    EXPECT_FALSE(ann.place_block({0, 63, 0}, Face::up, {0.5f, 1, 0.5f}, "minecraft:stone")); // into its own body
    EXPECT_FALSE(ann.break_block({1, 64, 0}, Face::up, kMiddle));                            // air
    EXPECT_FALSE(ann.break_block({1, 62, 0}, Face::up, kMiddle));                            // not known
    EXPECT_FALSE(ann.place_block({1, 63, 0}, Face::up, kMiddle, "no:such_block"));
    EXPECT_EQ(ann.stats().pending_edits, 0u);
    // A block that changed meanwhile: the server knows better.
    const BlockPos at{1, 63, 1};
    server::edit_world(play.world(), play.dimension(), {{{at, play.state("minecraft:dirt")}}});
    ASSERT_TRUE(ann.break_block(at, Face::up, {0.5f, 1, 0.5f}));
    EXPECT_EQ(seen(ann, at), "minecraft:air");
    play.tick(2);
    EXPECT_EQ(seen(ann, at), "minecraft:dirt");
    const auto answers = ann.take_answers();
    ASSERT_EQ(answers.size(), 1u);
    EXPECT_EQ(answers[0].outcome, net::EditOutcome::refused);
    EXPECT_FALSE(answers[0].reason.empty());
    expect_equal_surface(play, ann);
}

TEST(Play, NobodyBuildsIntoAnotherPlayer) {
    Play play;
    auto& ann = play.join("ann");
    play.join("bob");
    play.session("bob").body.feet.at = corner_of({2, 64, 0});
    play.session("bob").body.feet.at.x += kFixedOne / 2;
    // Ann's replica does not know where bob stands.
    ASSERT_TRUE(ann.place_block({2, 63, 0}, Face::up, {0.5f, 1, 0.5f}, "minecraft:stone"));
    EXPECT_EQ(seen(ann, {2, 64, 0}), "minecraft:stone");
    play.tick(2);
    EXPECT_EQ(play.block({2, 64, 0}), "minecraft:air");
    EXPECT_EQ(seen(ann, {2, 64, 0}), "minecraft:air");
    expect_equal_surface(play, ann);
}

TEST(Play, BlocksOfTwoPartsAndThingsThatHangGoTogether) {
    Play play;
    auto& ann = play.join("ann");
    ASSERT_TRUE(ann.place_block({2, 63, 0}, Face::up, {0.5f, 1, 0.5f}, "minecraft:oak_door"));
    play.tick(2);
    EXPECT_EQ(play.block({2, 65, 0}), "minecraft:oak_door");
    ASSERT_TRUE(ann.break_block({2, 63, 0}, Face::west, kMiddle)); // what it stands on
    EXPECT_EQ(seen(ann, {2, 65, 0}), "minecraft:air");
    play.tick(2);
    EXPECT_EQ(play.block({2, 65, 0}), "minecraft:air");
    expect_equal_surface(play, ann);
}

TEST(Play, ManyPredictionsUnderWaySettleToTheServersWorld) {
    u64 now = 0;
    Play play;
    net::LoopbackOptions slow{.latency_ns = 100000000, .clock = [&] { return now; }};
    auto [near_end, far_end] = net::make_loopback(slow);
    play.server->connect(std::move(far_end));
    play.clients.push_back(
        std::make_unique<replica::Replica>(std::move(near_end), replica::ReplicaOptions{"ann", 3, nullptr}));
    auto& ann = *play.clients.back();
    auto tick = [&] { now += 50000000, play.tick(); };
    for (int i = 0; i < 40; ++i)
        tick();
    play.settle();
    for (int i = 0; i < 10; ++i)
        tick();
    ASSERT_TRUE(ann.joined());
    Rng rng(4);
    u32 sent = 0;
    for (int i = 0; i < 60; ++i) {
        const BlockPos at{i32(rng.below(7)) - 3, 63, i32(rng.below(7)) - 3};
        if (i % 5 == 0) // someone else's edits between
            server::edit_world(play.world(), play.dimension(),
                               {{{{i32(rng.below(7)) - 3, 63, i32(rng.below(7)) - 3}, play.state("minecraft:torch")}}});
        const bool place = rng.below(3) > 0;
        auto sequence = place ? ann.place_block(at, Face::up, {0.5f, 1, 0.5f}, "minecraft:glowstone")
                              : ann.break_block(at, Face::up, {0.5f, 1, 0.5f});
        sent += sequence.has_value();
        if (rng.below(2)) tick();
    }
    EXPECT_GT(sent, 10u);
    for (int i = 0; i < 20; ++i)
        tick();
    EXPECT_EQ(ann.stats().pending_edits, 0u);
    EXPECT_FALSE(ann.lost()) << ann.lost_reason();
    expect_equal_surface(play, ann);
}

TEST(Play, ACaveThatNothingOpensIsNotToldUntilSomeoneDigsIntoIt) {
    Play play("", [](Dimension& d) {
        EditBatch cave;
        for (i32 y = 53; y <= 58; ++y)
            for (i32 z = 1; z < 6; ++z)
                for (i32 x = 1; x < 6; ++x)
                    cave.edits.push_back({{x, y - 16, z}, StateId::air});
        apply(d, cave);
    });
    auto& ann = play.join("ann");
    EXPECT_FALSE(ann.has_section({0, 2, 0}));
    EXPECT_EQ(seen(ann, {3, 62, 3}), "vitrail:hidden");
    // Someone digs a shaft from below to just under the ground.
    EditBatch shaft;
    for (i32 y = 42; y <= 62; ++y)
        shaft.edits.push_back({{3, y, 3}, StateId::air});
    server::edit_world(play.world(), play.dimension(), shaft);
    play.tick(3);
    EXPECT_FALSE(ann.has_section({0, 2, 0}));
    ASSERT_TRUE(ann.break_block({3, 63, 3}, Face::up, {0.5f, 1, 0.5f}));
    play.tick(3);
    EXPECT_EQ(seen(ann, {3, 62, 3}), "minecraft:air");
    EXPECT_TRUE(ann.has_section({0, 2, 0}));
    EXPECT_EQ(seen(ann, {3, 40, 3}), "minecraft:air");
    EXPECT_EQ(seen(ann, {3, 36, 3}), "minecraft:stone");
    expect_equal_surface(play, ann);
}

TEST(Play, TwoClientsSeeEachOthersEdits) {
    Play play;
    auto& ann = play.join("ann");
    auto& bob = play.join("bob");
    ASSERT_TRUE(ann.place_block({1, 63, 0}, Face::up, {0.5f, 1, 0.5f}, "minecraft:oak_planks"));
    play.tick(2);
    EXPECT_EQ(seen(bob, {1, 64, 0}), "minecraft:oak_planks");
    (void)bob.take_dirty();
    ASSERT_TRUE(bob.break_block({1, 64, 0}, Face::up, {0.5f, 1, 0.5f}));
    play.tick(2);
    EXPECT_EQ(seen(ann, {1, 64, 0}), "minecraft:air");
    expect_equal_surface(play, ann);
    expect_equal_surface(play, bob);
    ann.say("hello");
    play.tick(2);
    const auto notices = bob.take_notices();
    ASSERT_EQ(notices.size(), 1u);
    EXPECT_EQ(notices[0].from, "ann");
}

TEST(Play, EditsAndPlayersAreStillThereAfterARestart) {
    Play play("endless");
    auto& ann = play.join("ann", 3);
    const WorldPos stood = play.session("ann").body.feet.at;
    const BlockPos feet = block_of(stood);
    const BlockPos at{feet.x + 1, feet.y - 1, feet.z};
    server::edit_world(play.world(), play.dimension(), {{{at, play.state("minecraft:gold_block")}}});
    play.session("ann").body.feet.at.x += 3 * kFixedOne;
    play.session("ann").body.yaw = 1.25f;
    ann.set_hotbar({"minecraft:dirt"}, 0);
    play.tick(2);
    u64 before = 0, after = 0;
    auto hash = [&](u64& h) {
        for (i32 y = -4; y < 20; ++y)
            if (const ChunkPtr c = play.dimension().dimension.find({chunk_of(at).x, y, chunk_of(at).z}))
                for (u32 i = 0; i < 4096 && !c->blocks.uniform(); ++i)
                    h = hash_combine(h, u64(c->blocks.get(LocalPos(i))));
    };
    hash(before);
    play.restart();
    auto& again = play.join("ann", 3);
    EXPECT_EQ(play.block(at), "minecraft:gold_block");
    hash(after);
    EXPECT_EQ(before, after);
    EXPECT_EQ(again.hotbar(), std::vector<std::string>{"minecraft:dirt"});
    EXPECT_EQ(play.session("ann").body.feet.at.x, stood.x + 3 * kFixedOne);
    EXPECT_NEAR(play.session("ann").body.yaw, 1.25f, 1e-5f);
    expect_equal_surface(play, again);
}

TEST(Play, WalkingLoadsAheadAndLetsGoBehind) {
    Play play("endless");
    auto& ann = play.join("ann", 3);
    const std::size_t columns = play.dimension().columns.size();
    const ColumnPos start = column_of(chunk_of(block_of(ann.body().feet.at)));
    ASSERT_NE(ann.dimension().heights(start), nullptr);
    const ColumnHeights heights = *ann.dimension().heights(start);
    for (int i = 0; i < 10; ++i) {
        play.session("ann").body.feet.at.x += 16 * kFixedOne;
        play.tick(4);
    }
    play.settle();
    play.tick(25);
    EXPECT_LT(play.dimension().columns.size(), columns * 3);
    EXPECT_LT(ann.dimension().chunks().size(), std::size_t(11 * 11 * 24));
    expect_equal_surface(play, ann);
    for (i32 dx = -3; dx <= 3; ++dx)
        EXPECT_EQ(ann.dimension().heights({start.x + dx, start.z}), nullptr) << "memory must not grow with the way";
    EXPECT_NE(ann.dimension().heights({start.x + 10, start.z}), nullptr);
    for (int i = 0; i < 10; ++i) {
        play.session("ann").body.feet.at.x -= 16 * kFixedOne;
        play.tick(4);
    }
    play.settle();
    ASSERT_NE(ann.dimension().heights(start), nullptr) << "told again";
    EXPECT_EQ(ann.dimension().heights(start)->above, heights.above);
    expect_equal_surface(play, ann);
}

} // namespace
} // namespace vitrail
