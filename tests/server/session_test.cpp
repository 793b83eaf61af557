// What a server makes of clients that speak badly, lie or vanish.
#include "base/rng.h"
#include "net/body_codec.h"
#include "server/play_fixture.h"

#include <csignal>
#include <sys/wait.h>

namespace vitrail {
namespace {

// A client that says exactly what a test wants.
struct RawClient {
    explicit RawClient(Play& play_)
        : play(play_) {
        auto [near_end, far_end] = net::make_loopback();
        transport = std::move(near_end);
        play.server->connect(std::move(far_end));
    }
    template <class M>
    void say(const M& message, net::Channel channel = net::Channel::control) {
        (void)transport->send(channel, net::encode_message(message));
    }
    void greet(const std::string& name = "raw") { say(net::Hello{net::kProtocolVersion, name, 3, 0}); }
    void tick(int count = 1) {
        for (; count > 0; --count) {
            play.server->tick_once();
            transport->poll([&](net::Channel, ByteView bytes) {
                auto message = net::decode_server_message(bytes);
                ASSERT_TRUE(message) << message.error().message;
                if (auto* goodbye = std::get_if<net::Goodbye>(&*message)) reason = goodbye->reason;
                if (auto* body = std::get_if<net::BodyState>(&*message)) last = *body;
                if (auto* result = std::get_if<net::EditResult>(&*message); result && result->outcome != net::EditOutcome::kept)
                    results.push_back(*result);
                welcomed |= std::holds_alternative<net::Welcome>(*message);
            });
        }
    }
    Play& play;
    std::unique_ptr<net::Transport> transport;
    bool welcomed = false;
    std::string reason;
    net::BodyState last;
    std::vector<net::EditResult> results;
};

TEST(Session, GreetingsAreChecked) {
    Play play;
    auto refused = [&](const net::Hello& hello) {
        RawClient client(play);
        client.say(hello);
        client.tick();
        EXPECT_FALSE(client.welcomed);
        EXPECT_FALSE(client.transport->open());
        EXPECT_TRUE(play.world().sessions.empty());
        return client.reason;
    };
    EXPECT_NE(refused({99, "ann", 3, 0}).find("protocol"), std::string::npos);
    EXPECT_NE(refused({net::kProtocolVersion, "", 3, 0}).find("name"), std::string::npos);
    EXPECT_NE(refused({net::kProtocolVersion, "../../etc", 3, 0}).find("name"), std::string::npos);
    RawClient first(play);
    first.greet("ann");
    first.tick();
    EXPECT_TRUE(first.welcomed);
    RawClient second(play);
    second.greet("ann");
    second.tick();
    EXPECT_NE(second.reason.find("playing already"), std::string::npos);
    RawClient silent(play);
    silent.tick(250);
    EXPECT_FALSE(silent.transport->open());
    RawClient rude(play);
    rude.say(net::Say{"first!"});
    rude.tick();
    EXPECT_NE(rude.reason.find("greeting"), std::string::npos);
    first.tick();
    EXPECT_TRUE(first.transport->open());
}

TEST(Session, BadMessagesEndOnlyTheirOwnSession) {
    Play play;
    auto& ann = play.join("ann");
    Rng rng(12);
    for (int round = 0; round < 300; ++round) {
        RawClient client(play);
        if (rng.below(4)) client.greet();
        for (u32 n = rng.below(6); n > 0; --n) {
            Bytes bytes(rng.below(60));
            for (u8& b : bytes)
                b = u8(rng.next());
            if (!bytes.empty() && rng.below(2)) bytes[0] = u8(1 + rng.below(9));
            (void)client.transport->send(net::Channel(rng.below(3)), std::move(bytes));
        }
        play.tick();
        if (rng.below(2)) client.transport->close();
        play.tick();
    }
    EXPECT_FALSE(ann.lost()) << ann.lost_reason();
    ASSERT_TRUE(ann.break_block({1, 63, 0}, Face::up, {0.5f, 1, 0.5f}));
    play.tick(2);
    EXPECT_EQ(play.block({1, 63, 0}), "minecraft:air");
}

TEST(Session, RandomRequestsFromAGuestDoNoHarm) {
    Play play;
    Rng rng(31);
    auto coordinate = [&]() -> i32 {
        return rng.below(4)   ? i32(rng.below(40)) - 20
               : rng.below(2) ? i32(rng.next())
               : rng.below(2) ? 0x7fffffff
                              : i32(0x80000000);
    };
    for (int round = 0; round < 100; ++round) {
        RawClient client(play);
        client.greet();
        client.tick();
        for (int i = 0; i < 20 && client.reason.empty(); ++i) {
            net::EditRequest request;
            request.sequence = u32(i + 1);
            request.kind = net::EditKind(rng.below(3));
            request.at = {coordinate(), rng.below(3) ? 60 + i32(rng.below(8)) : coordinate(), coordinate()};
            request.face = u8(rng.below(6));
            request.hit_x = rng.unit() * 1e9f, request.hit_y = -rng.unit(), request.hit_z = rng.unit();
            const char* names[] = {"minecraft:stone",    "minecraft:air", "vitrail:hidden", "", "[[[",
                                   "minecraft:oak_door", "x:y[z=1]"};
            request.held = names[rng.below(7)];
            request.yaw = rng.unit() * 1e30f, request.pitch = -1e30f;
            client.say(request);
            net::MoveCommands commands;
            for (u32 n = 0; n < 3; ++n)
                commands.commands.push_back({u32(i) * 3 + n + 1, u32(rng.next()), rng.unit() * 1e20f, rng.unit() * 7});
            client.say(commands, net::Channel::motion);
            client.say(net::SectionAck{rng.below(3) ? 0 : rng.next()});
            client.say(net::SetView{1 + rng.below(5)});
            client.tick();
        }
        client.say(net::Leave{});
        client.tick();
    }
    EXPECT_TRUE(play.world().sessions.empty());
    for (u32 id = 0; id < play.world().states().size(); ++id) {
        // Nobody may make the world remember states that content does not have.
        const std::string name = play.world().states().info(StateId(id)).state.name;
        EXPECT_NE(name, "x:y");
    }
}

TEST(Session, NobodyMovesFasterThanTime) {
    Play play;
    RawClient client(play);
    client.greet();
    client.tick();
    const WorldPos start = play.session("raw").body.feet.at;
    u32 number = 0;
    for (int tick = 0; tick < 40; ++tick) { // 2 seconds, 200 steps a tick asked for
        net::MoveCommands commands;
        for (u32 n = 0; n < 200; ++n) {
            MoveCommand c;
            c.number = ++number, c.forward = 1, c.sprint = true;
            commands.commands.push_back(net::wire_command(c));
        }
        client.say(commands, net::Channel::motion);
        // The server hears as many as it has room for; the client would repeat the rest.
        client.tick();
        number = play.session("raw").last_heard_command;
    }
    const WorldPos end = play.session("raw").body.feet.at;
    const double way = std::hypot(double(end.x - start.x), double(end.z - start.z)) / double(kFixedOne);
    EXPECT_LE(play.session("raw").last_command, 40 * 3 + 30u);
    EXPECT_LT(way, 5.612 * 2.6);
    EXPECT_GT(way, 5.612 * 1.5);
    RawClient gap(play);
    gap.greet("gap");
    gap.tick();
    gap.say(net::MoveCommands{{{5, 0, 0, 0}}}, net::Channel::motion);
    gap.tick();
    EXPECT_NE(gap.reason.find("gap"), std::string::npos);
}

TEST(Session, RequestsAreJudged) {
    Play play("", [](Dimension& d) {
        const StateId bedrock = *d.states().intern_with_defaults(*parse_block_state("minecraft:bedrock"));
        apply(d, {{{{1, 63, 1}, bedrock}}});
    });
    RawClient client(play);
    client.greet();
    client.tick(10);
    u32 sequence = 0;
    auto ask = [&](net::EditKind kind, BlockPos at, const std::string& held = "", const std::string& target = "") {
        net::EditRequest request;
        request.sequence = ++sequence, request.kind = kind, request.at = net::to_wire(at), request.face = u8(Face::up);
        request.hit_x = request.hit_z = 0.5f, request.hit_y = 1, request.held = held, request.target = target;
        client.say(request);
        client.results.clear();
        client.tick();
        EXPECT_EQ(client.results.size(), 1u);
        return client.results.empty()                                    ? "no answer"
               : client.results[0].outcome == net::EditOutcome::accepted ? "accepted"
                                                                         : client.results[0].reason;
    };
    const auto dig = net::EditKind::break_block, build = net::EditKind::place_block;
    EXPECT_EQ(ask(dig, {30, 63, 0}), "too far away");
    EXPECT_EQ(ask(dig, {1 << 30, 63, 0}), "too far away");
    EXPECT_EQ(ask(dig, {0, 5000, 0}), "the world ends here");
    EXPECT_EQ(ask(dig, {1, 62, 0}), "this block cannot be seen");
    EXPECT_EQ(ask(dig, {1, 63, 0}, "", "minecraft:dirt"), "the block has changed");
    EXPECT_NE(ask(dig, {1, 63, 1}).find("cannot be broken"), std::string::npos);
    EXPECT_EQ(ask(dig, {1, 63, 0}, "", "minecraft:stone"), "accepted");
    EXPECT_NE(ask(dig, {1, 63, 0}), "accepted");                      // air by now
    EXPECT_NE(ask(build, {0, 63, 0}, "minecraft:stone"), "accepted"); // into the player
    EXPECT_NE(ask(build, {2, 63, 0}, "vitrail:hidden"), "accepted");
    EXPECT_NE(ask(build, {2, 63, 0}, "minecraft:air"), "accepted");
    EXPECT_NE(ask(build, {2, 63, 0}, "x:y[z=1]"), "accepted");
    EXPECT_EQ(ask(build, {2, 63, 0}, "minecraft:stone"), "accepted");
    EXPECT_EQ(ask(net::EditKind(9), {2, 63, 1}).find("accepted"), std::string::npos);
}

TEST(Session, AClientThatDoesNotReadIsDropped) {
    Play play("endless");
    auto [near_end, far_end] = net::make_loopback({.queue_bytes_most = 200000, .clock = {}});
    play.server->connect(std::move(far_end));
    (void)near_end->send(net::Channel::control, net::encode_message(net::Hello{net::kProtocolVersion, "deaf", 4, 0}));
    for (int i = 0; i < 400 && near_end->open(); ++i)
        play.server->tick_once();
    EXPECT_FALSE(near_end->open());
    EXPECT_TRUE(play.world().sessions.empty());
}

// How long a day takes is the world's: set at a start, kept, told to clients.
TEST(Session, DaysTakeWhatTheWorldSays) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("vitrail-day-" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    server::ServerOptions options;
    options.folder = folder.string(), options.seed = 7, options.threads = 0, options.generator = "";
    const auto ticks_in = [&](std::optional<u32> minutes, u32 server_ticks) -> u64 {
        options.day_minutes = minutes;
        auto server = server::Server::open(options, base_content());
        EXPECT_TRUE(server) << (server ? "" : server.error().message);
        if (!server) return ~u64(0);
        const u64 before = (*server)->world().level.time_ticks;
        for (u32 i = 0; i < server_ticks; ++i)
            (*server)->tick_once();
        const u64 passed = (*server)->world().level.time_ticks - before;
        EXPECT_TRUE((*server)->stop());
        return passed;
    };
    EXPECT_EQ(ticks_in({}, 60), 60u);
    EXPECT_EQ(ticks_in(1, 60), 1200u);
    EXPECT_EQ(ticks_in({}, 30), 600u) << "kept";
    EXPECT_EQ(ticks_in(1440, 144), 2u);
    EXPECT_EQ(ticks_in(0, 60), 0u);
    EXPECT_EQ(ticks_in({}, 60), 0u) << "0 is kept too";
    options.day_minutes = 1441;
    const auto refused = server::Server::open(options, base_content());
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::invalid_argument);
    std::filesystem::remove_all(folder);
}

TEST(Session, ClientsSeeTheSunWhereTheServerHasIt) {
    Play play;
    play.world().level.time_ticks = 5 * 24000 + 11000;
    play.world().level.day_minutes = 0;
    auto& client = play.join("alice");
    EXPECT_EQ(client.day_ticks(), 5 * 24000 + 11000);
    EXPECT_EQ(client.time_of_day(), 11000);
    play.world().level.day_minutes = 20;
    play.tick(200); // ten seconds at once: far off, so it counts when it is heard
    EXPECT_NEAR(client.day_ticks(), double(play.world().level.time_ticks), 101);
    EXPECT_GE(client.day_ticks(), 5 * 24000 + 11090);
}

// Where players may, they move and stop the time of day, for all of them.
TEST(Session, PlayersMoveAndStopTimeWhereTheyMay) {
    Play play;
    auto &alice = play.join("alice"), &bob = play.join("bob");
    play.world().level.time_ticks = 5000;
    alice.set_time(500, true);
    play.tick(3);
    EXPECT_LT(play.world().level.time_ticks, 5010u) << "refused";
    EXPECT_FALSE(play.world().time_paused);
    EXPECT_FALSE(alice.take_notices().empty());

    play.world().options.players_set_time = true;
    play.world().level.time_ticks = 5000;
    alice.set_time(500, true);
    play.tick(40);
    EXPECT_LE(play.world().level.time_ticks, 5502u);
    EXPECT_GE(play.world().level.time_ticks, 5500u);
    const u64 stopped = play.world().level.time_ticks;
    EXPECT_EQ(bob.day_ticks(), double(stopped)) << "all see it";
    bob.set_time(-20000, true); // not before the beginning
    play.tick(5);
    EXPECT_EQ(play.world().level.time_ticks, 0u);
    EXPECT_EQ(play.world().level.day_minutes, kUsualDayMinutes) << "stopping is not kept";
    bob.set_time(0, false);
    play.tick(40);
    EXPECT_GE(play.world().level.time_ticks, 35u);
    for (int i = 0; i < 100; ++i) // a flood counts a few times a tick
        alice.set_time(24000, false);
    play.tick(2);
    EXPECT_LE(play.world().level.time_ticks, 24000u * 20);
}

// Of a world whose generator is gone nothing may be made anew, nor may it be lost.
TEST(Session, AWorldOfAnUnknownGeneratorIsRefusedAndLeftAsItIs) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("vitrail-old-" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    server::ServerOptions options;
    options.folder = folder.string(), options.seed = 7, options.threads = 0;
    {
        auto server = server::Server::open(options, base_content());
        ASSERT_TRUE(server) << server.error().message;
        EXPECT_EQ((*server)->world().dimensions.at(DimensionId::overworld).dimension.info().max_y, kTerrainMaxY);
        (*server)->world().level.generator = "hills";
        ASSERT_TRUE((*server)->stop());
    }
    for (const bool read_only : {false, true}) {
        options.read_only = read_only;
        const auto refused = server::Server::open(options, base_content());
        ASSERT_FALSE(refused);
        EXPECT_EQ(refused.error().code, ErrorCode::unsupported);
        EXPECT_NE(refused.error().message.find("'hills'"), std::string::npos) << refused.error().message;
    }
    {
        auto records = WorldRecords::open(folder.string(), base_content().registry);
        ASSERT_TRUE(records);
        auto level = (*records)->load_level();
        ASSERT_TRUE(level && *level);
        EXPECT_EQ((*level)->generator, "hills");
        EXPECT_EQ((*level)->seed, 7u);
    }
    std::filesystem::remove_all(folder);
    options.read_only = false, options.generator = "hills"; // nor is a new one made
    EXPECT_FALSE(server::Server::open(options, base_content()));
    std::filesystem::remove_all(folder);
}

// A process that is killed the moment an edit is told to be kept.
TEST(Session, WhatWasToldToBeKeptSurvivesAKilledProcess) {
    for (int round = 0; round < 3; ++round) {
        int pipe_ends[2];
        ASSERT_EQ(::pipe(pipe_ends), 0);
        const std::filesystem::path folder =
            std::filesystem::temp_directory_path() /
            ("vitrail-kill-" + std::to_string(::getpid()) + "-" + std::to_string(round));
        std::filesystem::remove_all(folder);
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            server::ServerOptions options;
            options.folder = folder.string(), options.seed = 7, options.threads = 0, options.save_group_ms = 20;
            auto server = server::Server::open(options, base_content());
            if (!server) ::_exit(1);
            auto [near_end, far_end] = net::make_loopback();
            (*server)->connect(std::move(far_end));
            replica::Replica ann(std::move(near_end), {"ann", 2, base_content().registry});
            u32 sequence = 0;
            for (int i = 0; i < 4000; ++i) {
                (*server)->tick_once();
                if (!ann.poll()) ::_exit(2);
                if (!ann.joined()) continue;
                const BlockPos feet = block_of(ann.body().feet.at);
                const BlockPos at{feet.x + 1, feet.y - 1, feet.z};
                if (sequence == 0 && ann.has_section(chunk_of(at)) && i > 100) {
                    server::edit_world((*server)->world(), (*server)->world().dimensions.at(DimensionId::overworld),
                                       {{{{at.x, at.y + 1, at.z}, StateId::air}}});
                    (*server)->tick_once();
                    ann.poll();
                    auto sent = ann.break_block(at, Face::up, {0.5f, 1, 0.5f});
                    if (!sent) ::_exit(3);
                    sequence = *sent;
                }
                for (const auto& answer : ann.take_answers()) {
                    if (answer.outcome == net::EditOutcome::refused) ::_exit(4);
                    if (answer.outcome != net::EditOutcome::kept) continue;
                    const i32 place[3] = {at.x, at.y, at.z};
                    if (::write(pipe_ends[1], place, sizeof place) != sizeof place) ::_exit(5);
                    for (;;)
                        (*server)->tick_once(); // until killed
                }
                if (sequence) ::usleep(1000);
            }
            ::_exit(6);
        }
        ::close(pipe_ends[1]);
        i32 place[3] = {};
        const auto got = ::read(pipe_ends[0], place, sizeof place);
        ::close(pipe_ends[0]);
        ::kill(child, SIGKILL);
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_EQ(got, ssize_t(sizeof place)) << "the child ended with status " << WEXITSTATUS(status);
        auto records = WorldRecords::open(folder.string(), base_content().registry);
        ASSERT_TRUE(records) << records.error().message;
        const BlockPos at{place[0], place[1], place[2]};
        auto chunk = (*records)->load_chunk(DimensionId::overworld, chunk_of(at));
        ASSERT_TRUE(chunk && *chunk);
        EXPECT_EQ((*chunk)->blocks.get(local_of(at)), StateId::air);
        EXPECT_TRUE(*(*records)->load_player("ann"));
        records->reset();
        std::filesystem::remove_all(folder);
    }
}

// The real thing: its own thread and workers, in real time.
TEST(Session, TheServersThreadServesSeveralClientsAtOnce) {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / ("vitrail-threads-" + std::to_string(::getpid()));
    std::filesystem::remove_all(folder);
    server::ServerOptions options;
    options.folder = folder.string(), options.seed = 3, options.threads = 2;
    auto server = server::Server::open(options, base_content());
    ASSERT_TRUE(server) << server.error().message;
    (*server)->start();
    auto play_as = [&](const std::string& name) {
        auto [near_end, far_end] = net::make_loopback();
        (*server)->connect(std::move(far_end));
        replica::Replica client(std::move(near_end), {name, 3, base_content().registry});
        bool sent = false, kept = false;
        for (int i = 0; i < 3000 && !kept && client.poll(); ++i) {
            ::usleep(5000);
            if (!client.joined()) continue;
            client.move({}, 0.005f);
            const BlockPos feet = block_of(client.body().feet.at);
            const BlockPos ground{feet.x, feet.y - 1, feet.z};
            if (!sent && client.body().on_ground && client.has_section(chunk_of(ground)))
                sent = client.break_block(ground, Face::up, {0.5f, 1, 0.5f}).has_value();
            for (const auto& answer : client.take_answers())
                kept |= answer.outcome != net::EditOutcome::accepted;
        }
        EXPECT_TRUE(sent) << client.lost_reason();
        EXPECT_TRUE(kept) << client.lost_reason();
    };
    std::thread ann([&] { play_as("ann"); }), bob([&] { play_as("bob"); });
    ann.join();
    bob.join();
    EXPECT_GT((*server)->stats().ticks, 2u);
    EXPECT_TRUE((*server)->stop());
    server::ServerOptions nowhere;
    nowhere.folder = "/proc/no/such";
    EXPECT_FALSE(server::Server::open(nowhere, base_content()));
    server->reset();
    std::filesystem::remove_all(folder);
}

} // namespace
} // namespace vitrail
