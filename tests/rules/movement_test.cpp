#include "rules/movement.h"

#include "rules/collision.h"
#include "rules_world.h"

#include <cmath>
#include <gtest/gtest.h>

namespace vitrail {
namespace {

constexpr float kPi = 3.14159265f;

MoveCommand forward(float yaw = 0) {
    MoveCommand c;
    c.forward = 1;
    c.yaw = yaw;
    return c;
}

BodyState body_at(const RulesWorld& world, double x, double y, double z) {
    BodyState body;
    body.feet.at = world.position(x, y, z);
    return body;
}

BodyState run(RulesWorld& world, BodyState body, MoveCommand command, int steps) {
    for (int i = 0; i < steps; ++i) {
        body = step(world.dimension(), body, command);
        command.toggle_flying = false;
    }
    return body;
}

bool is_free(RulesWorld& world, const BodyState& body) {
    return body_fits(world.dimension(), body.feet.at, height_of(body));
}

class Flat : public testing::Test {
protected:
    Flat() {
        world.open(-32, -16, -32, 31, 31, 31);
        world.fill(-32, -1, -32, 31, -1, 31, "stone");
    }
    RulesWorld world;
};

TEST_F(Flat, SpeedsAreTheKnownOnes) {
    BodyState body = run(world, body_at(world, 0.5, 0, -20), {}, 5);
    EXPECT_TRUE(body.on_ground);
    EXPECT_EQ(world.y_of(body.feet.at), 0);
    const auto speed = [&](MoveCommand command) {
        BodyState b = run(world, body_at(world, 0.5, 0, -25), command, 60);
        const double z = world.z_of(b.feet.at);
        b = run(world, b, command, 60);
        return world.z_of(b.feet.at) - z;
    };
    EXPECT_NEAR(speed(forward()), 4.317, 0.01);
    MoveCommand sprint = forward();
    sprint.sprint = true;
    EXPECT_NEAR(speed(sprint), 5.612, 0.01);
    MoveCommand sneak = forward();
    sneak.sneak = true;
    EXPECT_NEAR(speed(sneak), 1.295, 0.01);
}

TEST_F(Flat, YawTurnsClockwiseFromSouth) {
    const struct {
        float yaw;
        double x, z;
    } cases[] = {{0, 0, 1}, {kPi / 2, -1, 0}, {kPi, 0, -1}, {-kPi / 2, 1, 0}, {kPi * 2.25f, -0.7071, 0.7071}};
    for (const auto& c : cases) {
        const BodyState body = run(world, body_at(world, 0.5, 0, 0.5), forward(c.yaw), 60);
        const double dx = world.x_of(body.feet.at) - 0.5, dz = world.z_of(body.feet.at) - 0.5,
                     length = std::hypot(dx, dz);
        EXPECT_NEAR(dx / length, c.x, 1e-3);
        EXPECT_NEAR(dz / length, c.z, 1e-3);
    }
    MoveCommand right;
    right.strafe = 1;
    const BodyState body = run(world, body_at(world, 0.5, 0, 0.5), right, 60);
    EXPECT_LT(world.x_of(body.feet.at), -2); // facing south, west is to the right
}

TEST_F(Flat, JumpRisesABlockAndAQuarter) {
    MoveCommand jump;
    jump.jump = true;
    BodyState body = run(world, body_at(world, 0.5, 0, 0.5), {}, 3);
    double top = 0;
    for (int i = 0; i < 40; ++i) {
        body = step(world.dimension(), body, jump);
        top = std::max(top, world.y_of(body.feet.at));
        jump.jump = false;
    }
    EXPECT_NEAR(top, 1.25, 0.03);
    EXPECT_TRUE(body.on_ground);
}

TEST_F(Flat, JumpsOntoBlocksNotOntoFences) {
    MoveCommand jump = forward();
    jump.jump = true;
    world.fill(-3, 0, 3, 3, 0, 12, "stone");
    BodyState body = run(world, body_at(world, 0.5, 0, 0.5), jump, 80);
    EXPECT_GT(world.z_of(body.feet.at), 4);
    EXPECT_GT(world.y_of(body.feet.at), 0.99);
    world.fill(-3, 0, 3, 3, 0, 12, "air");
    world.fill(-3, 0, 3, 3, 0, 3, "fence[east=true,west=true]");
    body = run(world, body_at(world, 0.5, 0, 0.5), jump, 200);
    EXPECT_LT(world.z_of(body.feet.at), 3.4);
}

TEST_F(Flat, WalksUpStairsAndSlabsAndStopsAtBlocks) {
    for (int i = 0; i < 6; ++i)
        world.fill(-2, i, 2 + i, 2, i, 2 + i, "stairs[facing=south]");
    BodyState body = run(world, body_at(world, 0.5, 0, 0.5), forward(), 120);
    EXPECT_GT(world.y_of(body.feet.at), 5.4);
    world.fill(5, 0, 2, 8, 0, 2, "slab");
    world.fill(5, 0, 3, 8, 0, 12, "stone");
    body = run(world, body_at(world, 6.5, 0, 0.5), forward(), 100);
    EXPECT_EQ(world.y_of(body.feet.at), 1);
    world.fill(-12, 0, 4, -8, 0, 4, "stone");
    body = run(world, body_at(world, -9.5, 0, 0.5), forward(), 100);
    EXPECT_NEAR(world.z_of(body.feet.at), 4 - 0.3, 1e-6);
    EXPECT_EQ(world.y_of(body.feet.at), 0);
    EXPECT_EQ(body.velocity.z, 0);
    // A low ceiling over the slab: no room to step up.
    world.fill(-22, 0, 4, -18, 0, 4, "slab");
    world.fill(-22, 2, 0, -18, 2, 8, "stone");
    body = run(world, body_at(world, -19.5, 0, 2.5), forward(), 100);
    EXPECT_NEAR(world.z_of(body.feet.at), 4 - 0.3, 1e-6);
}

TEST_F(Flat, FastFallsDoNotTunnel) {
    world.open(-16, 0, -16, 15, 1500, 15);
    for (const double height : {20.0, 300.0, 1400.0}) {
        const BodyState body = run(world, body_at(world, 0.5, height, 0.5), {}, 60 * 40);
        EXPECT_EQ(world.y_of(body.feet.at), 0);
        EXPECT_TRUE(body.on_ground);
    }
    // 100 km/h and far more, through a carpet's thickness.
    world.fill(-3, 20, -3, 3, 20, 3, "carpet");
    for (const float speed : {27.8f, 300.0f, 1000.0f, 1e9f, INFINITY, NAN}) {
        BodyState body = body_at(world, 0.5, 30 + 0.1234, 0.5);
        body.velocity.y = -speed;
        body = run(world, body, {}, 120);
        EXPECT_EQ(world.y_of(body.feet.at), 20 + 1.0 / 16) << speed;
    }
}

TEST_F(Flat, SneakingNeverFallsOff) {
    world.fill(-4, 5, -4, 4, 5, 4, "stone");
    world.set(2, 5, 2, "air");
    world.set(2, 5, 3, "slab");
    Rng rng(5);
    for (int round = 0; round < 60; ++round) {
        BodyState body = run(world, body_at(world, 0.5, 6, 0.5), {}, 2);
        MoveCommand command;
        command.sneak = true;
        for (int i = 0; i < 400; ++i) {
            if (i % 25 == 0) {
                command.yaw = rng.unit() * 7;
                command.forward = i8(rng.below(3)) - 1;
                command.strafe = i8(rng.below(3)) - 1;
            }
            body = step(world.dimension(), body, command);
            ASSERT_GE(world.y_of(body.feet.at), 5.5);
        }
    }
    BodyState body = run(world, body_at(world, 0.5, 6, 0.5), forward(), 120);
    EXPECT_EQ(world.y_of(body.feet.at), 0); // who walks falls
}

TEST_F(Flat, SneakingStaysLowUnderALowCeiling) {
    world.fill(-3, 1, 2, 3, 1, 6, "slab[type=top]"); // one and a half blocks of room
    MoveCommand sneak = forward();
    sneak.sneak = true;
    BodyState body = run(world, body_at(world, 0.5, 0, 0.5), sneak, 180);
    EXPECT_GT(world.z_of(body.feet.at), 3);
    body = run(world, body, {}, 10);
    EXPECT_TRUE(body.sneaking);
    EXPECT_TRUE(is_free(world, body));
    body = run(world, body, forward(kPi), 60);
    body = run(world, body, forward(kPi), 400);
    EXPECT_FALSE(body.sneaking);
    body = run(world, body_at(world, 0.5, 0, 0.5), forward(), 100);
    EXPECT_NEAR(world.z_of(body.feet.at), 2 - 0.3, 1e-6);
}

TEST_F(Flat, Flies) {
    MoveCommand command;
    command.toggle_flying = true;
    command.jump = true;
    BodyState body = run(world, body_at(world, 0.5, 0, 0.5), command, 60);
    EXPECT_TRUE(body.flying);
    const double y = world.y_of(body.feet.at);
    EXPECT_GT(y, 5);
    command = {};
    body = run(world, body, command, 120);
    EXPECT_GT(world.y_of(body.feet.at), y - 0.1);
    const double hover = world.y_of(body.feet.at);
    body = run(world, body, command, 60);
    EXPECT_NEAR(world.y_of(body.feet.at), hover, 1e-3);
    command = forward();
    body = run(world, body, command, 60);
    const double z = world.z_of(body.feet.at);
    body = run(world, body, command, 30);
    EXPECT_NEAR((world.z_of(body.feet.at) - z) * 2, 10.92, 0.1);
    command = {};
    command.sneak = true;
    body = run(world, body, command, 400);
    EXPECT_FALSE(body.flying); // landed
    EXPECT_EQ(world.y_of(body.feet.at), 0);
}

TEST_F(Flat, SwimsFloatsAndClimbsOut) {
    world.fill(-6, -10, -6, 6, -1, 6, "water");
    world.fill(-6, -10, -6, 6, -10, 6, "stone");
    BodyState body = run(world, body_at(world, 0.5, -5, 0.5), {}, 600);
    EXPECT_EQ(world.y_of(body.feet.at), -9); // sinks slowly
    MoveCommand up;
    up.jump = true;
    body = run(world, body, up, 300);
    EXPECT_GT(world.y_of(body.feet.at), -2.0);
    EXPECT_LT(world.y_of(body.feet.at), 0.5);
    MoveCommand out = forward();
    out.jump = true;
    body = run(world, body, out, 400);
    EXPECT_GT(world.z_of(body.feet.at), 7);
    EXPECT_GE(world.y_of(body.feet.at), 0);
    // Falling into water is soft.
    BodyState fall = body_at(world, 0.5, 20, 0.5);
    fall = run(world, fall, {}, 120);
    EXPECT_GT(fall.velocity.y, -6);
    EXPECT_TRUE(fall.in_liquid);
}

TEST_F(Flat, ClimbsLadders) {
    world.fill(0, 0, 1, 0, 12, 1, "stone");
    world.fill(0, 0, 0, 0, 12, 0, "ladder[facing=north]");
    BodyState body = run(world, body_at(world, 0.5, 0, 0.3), forward(), 240);
    EXPECT_GT(world.y_of(body.feet.at), 5);
    MoveCommand hold;
    hold.sneak = true;
    body = body_at(world, 0.5, 5, 0.3);
    body = run(world, body, hold, 60);
    const double y = world.y_of(body.feet.at);
    EXPECT_NEAR(run(world, body, hold, 60).feet.at.y, body.feet.at.y, 0);
    body = run(world, body, {}, 60); // slides down no faster than this
    EXPECT_GE(world.y_of(body.feet.at), y - 3.1);
    EXPECT_TRUE(body.climbing);
}

TEST_F(Flat, WebsHold) {
    world.fill(-1, 0, 3, 1, 1, 5, "cobweb");
    BodyState body = run(world, body_at(world, 0.5, 0, 0.5), forward(), 240);
    EXPECT_LT(world.z_of(body.feet.at), 5);
    EXPECT_TRUE(is_free(world, body));
}

TEST(Movement, AbsentChunksHoldAndAreWalls) {
    RulesWorld world;
    world.open(0, 0, 0, 15, 15, 15);
    BodyState body = run(world, body_at(world, 8.5, 5, 8.5), {}, 300);
    EXPECT_EQ(world.y_of(body.feet.at), 0); // the chunk below is not there yet
    body = run(world, body_at(world, 8.5, 0, 8.5), forward(), 300);
    EXPECT_NEAR(world.z_of(body.feet.at), 16 - 0.3, 1e-6);
    body = run(world, body_at(world, 100, 50, 100), forward(), 60); // in the middle of nowhere
    EXPECT_EQ(body.feet.at, world.position(100, 50, 100));
    EXPECT_EQ(body.velocity, Vec3{});
    // Above the heights of a column the sky is open though no chunk is there.
    for (i32 x = -1; x <= 1; ++x)
        for (i32 z = -1; z <= 1; ++z) {
            ColumnHeights heights;
            heights.above.fill(16);
            world.dimension().put_heights({x, z}, heights);
        }
    body = run(world, body_at(world, 8.5, 60, 8.5), {}, 600);
    EXPECT_EQ(world.y_of(body.feet.at), 0);
}

TEST(Movement, HiddenBlocksAreSolid) {
    RulesWorld world;
    world.fill(0, 0, 0, 15, 0, 15, "vitrail:hidden");
    const BodyState body = run(world, body_at(world, 8.5, 5, 8.5), {}, 300);
    EXPECT_EQ(world.y_of(body.feet.at), 1);
}

TEST(Movement, TheEdgeOfTheWorldIsAWall) {
    RulesWorld world({kWorldEdge - 16, 0, kWorldEdge - 16});
    world.fill(0, 0, 0, 15, 0, 15, "stone");
    BodyState body = run(world, body_at(world, 8.5, 1, 8.5), forward(), 300);
    EXPECT_NEAR(world.z_of(body.feet.at), 16 - 0.3, 1e-6);
    body.velocity = {1000, 1000, 1000};
    body = run(world, body, forward(-kPi / 2), 300);
    EXPECT_NEAR(world.x_of(body.feet.at), 16 - 0.3, 1e-6);
    // A body put beyond comes back in.
    body.feet.at = {INT64_MAX, world.position(0, 1, 0).y, INT64_MAX};
    body = run(world, body, {}, 5);
    EXPECT_TRUE(is_free(world, body));
}

TEST(Movement, BlocksPutIntoABodyPushItOut) {
    RulesWorld world;
    world.open(0, 0, 0, 15, 15, 15);
    world.fill(0, 0, 0, 15, 0, 15, "stone");
    BodyState body = run(world, body_at(world, 8.5, 1, 8.5), {}, 5);
    world.set(8, 1, 8, "stone");
    body = run(world, body, {}, 5);
    EXPECT_TRUE(is_free(world, body));
    EXPECT_GE(world.y_of(body.feet.at), 1);
    world.fill(0, 1, 0, 15, 12, 15, "stone"); // buried: stays
    const BodyState buried = run(world, body, forward(), 60);
    EXPECT_EQ(buried.feet.at, body.feet.at);
}

const char* random_block(Rng& rng) {
    static const char* names[] = {"stone",
                                  "stone",
                                  "slab",
                                  "slab[type=top]",
                                  "stairs[facing=east]",
                                  "stairs[facing=north,shape=inner_left]",
                                  "stairs[facing=west,half=top]",
                                  "fence[east=true,west=true]",
                                  "wall[north=tall,south=low]",
                                  "water",
                                  "ladder[facing=east]",
                                  "door[facing=south]",
                                  "trapdoor[half=bottom]",
                                  "carpet",
                                  "glass_pane[north=true]",
                                  "cobweb",
                                  "chest",
                                  "snow[layers=5]"};
    return names[rng.below(std::size(names))];
}

void random_world(RulesWorld& world, Rng& rng, i32 radius, u32 one_in) {
    world.open(-16, -16, -16, 15, 15, 15);
    EditBatch batch;
    for (i32 y = -radius; y <= radius; ++y)
        for (i32 z = -radius; z <= radius; ++z)
            for (i32 x = -radius; x <= radius; ++x) {
                const bool shell = std::abs(x) == radius || std::abs(y) == radius || std::abs(z) == radius;
                if (shell || rng.below(one_in) == 0)
                    batch.edits.push_back({world.at(x, y, z), world.id(shell ? "stone" : random_block(rng))});
            }
    apply(world.dimension(), batch);
}

MoveCommand random_command(Rng& rng) {
    MoveCommand c;
    c.forward = i8(rng.below(3)) - 1;
    c.strafe = i8(rng.below(3)) - 1;
    c.jump = rng.below(3) == 0;
    c.sneak = rng.below(6) == 0;
    c.sprint = rng.below(3) == 0;
    c.toggle_flying = rng.below(40) == 0;
    c.yaw = rng.unit() * 20 - 10;
    return c;
}

// Random worlds, random commands, now and then a kick: never inside a box, never out of the shell.
TEST(Movement, NeverInsideABox) {
    for (u64 seed = 1; seed <= 30; ++seed) {
        Rng rng(seed);
        RulesWorld world;
        random_world(world, rng, 7, 4 + rng.below(8));
        BodyState body;
        int tries = 0;
        do
            body = body_at(world, rng.unit() * 10 - 5, rng.unit() * 10 - 5, rng.unit() * 10 - 5);
        while (!is_free(world, body) && ++tries < 300);
        if (!is_free(world, body)) continue;
        MoveCommand command;
        for (int i = 0; i < 600; ++i) {
            if (i % 7 == 0) command = random_command(rng);
            if (rng.below(50) == 0)
                body.velocity = {rng.unit() * 2000 - 1000, rng.unit() * 2000 - 1000, rng.unit() * 2000 - 1000};
            body = step(world.dimension(), body, command);
            ASSERT_TRUE(is_free(world, body)) << "seed " << seed << " step " << i;
            for (const double v : {world.x_of(body.feet.at), world.y_of(body.feet.at), world.z_of(body.feet.at)})
                ASSERT_LT(std::abs(v), 7.0);
        }
    }
}

TEST(Movement, TheSameTrajectoryEverywhere) {
    constexpr i32 far = 2147483647 / 16 * 16 - 1008 - 512; // near +-(2^31 - 1000), on a chunk's corner
    for (u64 seed = 1; seed <= 6; ++seed) {
        std::vector<WorldPos> paths[3];
        Vec3 speeds[3];
        int k = 0;
        for (const BlockPos origin : {BlockPos{0, 0, 0}, BlockPos{far, -far, far}, BlockPos{-far, far, -far}}) {
            Rng rng(seed);
            RulesWorld world(origin);
            random_world(world, rng, 7, 9);
            BodyState body;
            do
                body = body_at(world, rng.unit() * 8 - 4, rng.unit() * 8 - 4, rng.unit() * 8 - 4);
            while (!is_free(world, body));
            const WorldPos corner = corner_of(origin);
            for (int i = 0; i < 400; ++i) {
                body = step(world.dimension(), body, random_command(rng));
                paths[k].push_back({body.feet.at.x - corner.x, body.feet.at.y - corner.y, body.feet.at.z - corner.z});
            }
            speeds[k++] = body.velocity;
        }
        for (int other = 1; other < 3; ++other) {
            EXPECT_EQ(paths[other], paths[0]);
            EXPECT_EQ(speeds[other], speeds[0]);
        }
    }
}

// A sweep against moving by tiny steps until something is touched.
TEST(Movement, SweepAgainstMicroSteps) {
    Rng rng(9);
    int blocked = 0;
    for (int round = 0; round < 400; ++round) {
        RulesWorld world;
        random_world(world, rng, 5, 6);
        BodyState body;
        int tries = 0;
        do
            body = body_at(world, rng.unit() * 6 - 3, rng.unit() * 6 - 3, rng.unit() * 6 - 3);
        while (!is_free(world, body) && ++tries < 100);
        if (!is_free(world, body)) continue;
        const FixedBox box = body_box(body.feet.at, kBodyHeight);
        const int axis = int(rng.below(3));
        constexpr i64 micro = kFixedOne / 256;
        const i64 by = (i64(rng.below(2048)) - 1024) * micro;
        FixedBox region = box;
        region.min[axis] += std::min<i64>(by, 0);
        region.max[axis] += std::max<i64>(by, 0);
        std::vector<FixedBox> boxes;
        gather_boxes(world.dimension(), region, boxes);
        const i64 gone = sweep(box, axis, by, boxes);
        i64 crawled = 0;
        const i64 piece = by < 0 ? -micro : micro;
        while (crawled != by) {
            WorldPos feet = body.feet.at;
            (axis == 0 ? feet.x : axis == 1 ? feet.y : feet.z) += crawled + piece;
            if (!body_fits(world.dimension(), feet, kBodyHeight)) break;
            crawled += piece;
        }
        EXPECT_LT(std::abs(gone - crawled), micro);
        EXPECT_LE(std::abs(crawled), std::abs(gone));
        blocked += gone != by;
    }
    EXPECT_GT(blocked, 100);
}

TEST(Movement, CommandsSurviveTheirCodec) {
    Rng rng(2);
    for (int i = 0; i < 200; ++i) {
        MoveCommand c = random_command(rng);
        c.number = u32(rng.next());
        const auto back = decode_fields<MoveCommand>(encode_fields(c));
        ASSERT_TRUE(back);
        EXPECT_EQ(*back, c);
    }
    MoveCommand wild;
    wild.forward = 100;
    EXPECT_FALSE(decode_fields<MoveCommand>(encode_fields(wild)));
}

} // namespace
} // namespace vitrail
