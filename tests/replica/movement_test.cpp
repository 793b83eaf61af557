// Predicted movement: the replica steps by the server's rules and is set right where it errs.
#include "base/rng.h"
#include "server/play_fixture.h"

namespace vitrail {
namespace {

struct Walk {
    Play play;
    u64 now = 0;
    replica::Replica* ann = nullptr;

    explicit Walk(u64 latency_ns = 0, float loss = 0) {
        net::LoopbackOptions link{.latency_ns = latency_ns, .loss = loss, .clock = [this] { return now; }};
        auto [near_end, far_end] = net::make_loopback(link);
        play.server->connect(std::move(far_end));
        play.clients.push_back(
            std::make_unique<replica::Replica>(std::move(near_end), replica::ReplicaOptions{"ann", 3, nullptr}));
        ann = play.clients.back().get();
        for (int i = 0; i < 60; ++i)
            now += 50000000, play.tick();
        EXPECT_TRUE(ann->joined());
    }
    void run(const MoveCommand& input, int ticks) {
        for (int i = 0; i < ticks; ++i) {
            for (int frame = 0; frame < 5; ++frame)
                ann->move(input, 0.01f);
            now += 50000000;
            play.tick();
        }
    }
    WorldPos here() { return ann->body().feet.at; }
    WorldPos there() { return play.session("ann").body.feet.at; }
};

TEST(Movement, BothSidesAgreeWithoutCorrections) {
    Walk walk;
    const WorldPos start = walk.here();
    MoveCommand forward;
    forward.forward = 1, forward.yaw = 0.3f;
    walk.run(forward, 30);
    forward.jump = true;
    walk.run(forward, 30);
    walk.run({}, 20);
    EXPECT_EQ(walk.here(), walk.there());
    EXPECT_FALSE(walk.here() == start);
    EXPECT_EQ(walk.ann->stats().corrections, 0u);
    EXPECT_TRUE(walk.ann->body().on_ground);
}

TEST(Movement, LatencyAndLossCostNothingButTime) {
    Walk walk(120000000, 0.3f);
    const WorldPos start = walk.here();
    MoveCommand forward;
    forward.forward = 1;
    walk.run(forward, 40);
    const double ahead = double(walk.here().z - walk.there().z) / double(kFixedOne);
    EXPECT_GT(ahead, 0.3); // prediction runs before the server
    walk.run({}, 40);
    EXPECT_EQ(walk.here(), walk.there());
    EXPECT_FALSE(walk.here() == start);
    EXPECT_EQ(walk.ann->stats().corrections, 0u);
    EXPECT_FALSE(walk.ann->lost());
}

TEST(Movement, AServerThatKnowsBetterSetsTheReplicaRight) {
    Walk walk(60000000);
    MoveCommand forward;
    forward.forward = 1;
    walk.run(forward, 10);
    walk.play.session("ann").body.feet.at.y += 5 * kFixedOne; // a script throws the player up
    walk.run(forward, 10);
    EXPECT_GT(walk.ann->stats().corrections, 0u);
    walk.run({}, 60);
    EXPECT_EQ(walk.here(), walk.there());
}

TEST(Movement, FlyingTogglesOnce) {
    Walk walk;
    MoveCommand toggle;
    toggle.toggle_flying = true;
    walk.ann->move(toggle, 0.002f); // no step is due yet: the wish waits
    walk.run({}, 3);
    EXPECT_TRUE(walk.ann->body().flying);
    EXPECT_TRUE(walk.play.session("ann").body.flying);
    MoveCommand up;
    up.jump = true;
    walk.run(up, 20);
    EXPECT_GT(walk.there().y, 65 * kFixedOne);
    EXPECT_EQ(walk.here(), walk.there());
    walk.ann->move(toggle, 0.02f);
    walk.run({}, 60);
    EXPECT_FALSE(walk.ann->body().flying);
    EXPECT_EQ(walk.there().y, 64 * kFixedOne);
}

} // namespace
} // namespace vitrail
