#include "net/heights_codec.h"
#include "net/loopback.h"
#include "net/messages.h"
#include "net/registry_codec.h"

#include "base/rng.h"

#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>

namespace vitrail::net {
namespace {

std::string random_text(Rng& rng, u32 most) {
    std::string s(rng.below(most + 1), 'a');
    for (char& c : s)
        c = char('a' + rng.below(26));
    return s;
}

WireBody random_body(Rng& rng) {
    WireBody b;
    b.dimension = rng.below(3);
    b.at = {i64(rng.next()), i64(rng.next()), i64(rng.next())};
    b.vx = rng.unit(), b.vy = -rng.unit(), b.vz = -1;
    b.yaw = rng.unit() * 360, b.pitch = rng.unit() * 90;
    b.bits = u32(rng.next());
    return b;
}

WireChunkPos random_chunk(Rng& rng) {
    return {i32(rng.next()), i32(rng.next()), i32(rng.next())};
}

std::vector<WireChunkDelta> random_deltas(Rng& rng) {
    std::vector<WireChunkDelta> deltas(rng.below(4));
    for (WireChunkDelta& d : deltas) {
        d.at = random_chunk(rng), d.revision = rng.next();
        for (u32 i = rng.below(50); i > 0; --i)
            d.cells.push_back(u16(rng.below(4096))), d.values.push_back(rng.below(70000));
    }
    return deltas;
}

// One of each, filled at random: what the round-trip test and the fuzz corpus are made of.
std::vector<ServerMessage> server_messages(Rng& rng) {
    std::vector<ServerMessage> all;
    Welcome welcome;
    welcome.player = rng.below(100), welcome.body = random_body(rng), welcome.tick = rng.next();
    welcome.dimensions = {{0, "minecraft:overworld", -64, 320, true}, {1, random_text(rng, 20), 0, 128, false}};
    welcome.time_of_day = rng.below(24000), welcome.day = rng.below(9999), welcome.day_minutes = rng.below(1441),
    welcome.content_hash = rng.next(), welcome.view_distance = 12;
    welcome.hotbar = {"a", random_text(rng, 30)}, welcome.hotbar_selected = rng.below(9), welcome.seed = rng.next();
    all.emplace_back(welcome);
    all.emplace_back(RegistryData{Bytes(rng.below(300), 7)});
    all.emplace_back(StateTexts{rng.below(100), {random_text(rng, 40), random_text(rng, 40)}});
    all.emplace_back(BiomeTexts{rng.below(100), {random_text(rng, 40)}});
    all.emplace_back(
        Sections{0, {{random_chunk(rng), rng.next(), Bytes(rng.below(500), 3)}, {random_chunk(rng), 1, {}}}});
    all.emplace_back(AirSections{1, {random_chunk(rng), random_chunk(rng)}});
    all.emplace_back(SectionsGone{1, {random_chunk(rng)}});
    all.emplace_back(HeightsOfColumns{0, {{1, -2, Bytes(20, 1)}}});
    all.emplace_back(BlockChanges{0, random_deltas(rng)});
    all.emplace_back(LightChanges{0, random_deltas(rng)});
    all.emplace_back(EditResult{rng.below(1000), EditOutcome::kept, random_text(rng, 100)});
    all.emplace_back(BodyState{rng.below(1000), random_body(rng)});
    all.emplace_back(TimeOfDay{rng.next(), rng.below(24000), u32(rng.next()), rng.below(1441)});
    all.emplace_back(Notice{random_text(rng, 30), random_text(rng, 200)});
    all.emplace_back(Goodbye{random_text(rng, 200)});
    return all;
}

std::vector<ClientMessage> client_messages(Rng& rng) {
    std::vector<ClientMessage> all;
    all.emplace_back(Hello{kProtocolVersion, random_text(rng, 31), 1 + rng.below(32), rng.next()});
    MoveCommands commands;
    for (u32 i = rng.below(20); i > 0; --i)
        commands.commands.push_back({i, u32(rng.next()), rng.unit(), -rng.unit()});
    all.emplace_back(commands);
    all.emplace_back(EditRequest{rng.below(99),
                                 EditKind::place_block,
                                 {1, -2, i32(rng.next())},
                                 u8(rng.below(6)),
                                 0.5f,
                                 1,
                                 0,
                                 random_text(rng, 50),
                                 random_text(rng, 50),
                                 90,
                                 -45,
                                 rng.below(1000)});
    all.emplace_back(SetView{1 + rng.below(32)});
    all.emplace_back(SectionAck{rng.next()});
    all.emplace_back(Leave{});
    all.emplace_back(Say{random_text(rng, 200)});
    all.emplace_back(Hotbar{{"x", random_text(rng, 20)}, rng.below(9)});
    AskSections asked{rng.below(3), {}};
    for (u32 i = rng.below(9); i > 0; --i)
        asked.at.push_back({i32(rng.next()), i32(rng.next()), i32(rng.next())});
    all.emplace_back(std::move(asked));
    all.emplace_back(SetTime{i32(rng.next()), rng.below(2) == 1});
    return all;
}

TEST(Messages, EveryOneComesBackAsItWas) {
    Rng rng(5);
    for (int round = 0; round < 50; ++round) {
        const auto server = server_messages(rng);
        ASSERT_EQ(server.size(), std::variant_size_v<ServerMessage>);
        for (std::size_t i = 0; i < server.size(); ++i) {
            ASSERT_EQ(server[i].index(), i);
            const Bytes bytes = encode_any(server[i]);
            auto back = decode_server_message(bytes);
            ASSERT_TRUE(back) << message_name(MessageType(bytes[0])) << ": " << back.error().message;
            EXPECT_EQ(back->index(), i);
            EXPECT_EQ(encode_any(*back), bytes);
        }
        const auto client = client_messages(rng);
        ASSERT_EQ(client.size(), std::variant_size_v<ClientMessage>);
        for (std::size_t i = 0; i < client.size(); ++i) {
            const Bytes bytes = encode_any(client[i]);
            auto back = decode_client_message(bytes);
            ASSERT_TRUE(back) << message_name(MessageType(bytes[0])) << ": " << back.error().message;
            EXPECT_EQ(encode_any(*back), bytes);
        }
    }
}

TEST(Messages, DamageIsRefusedOrReadsAsSomethingWithinBounds) {
    Rng rng(6);
    for (int round = 0; round < 2000; ++round) {
        const auto all = server_messages(rng);
        Bytes bytes = encode_any(all[rng.below(u32(all.size()))]);
        for (u32 k = 1 + rng.below(4); k > 0 && !bytes.empty(); --k) {
            if (rng.below(4) == 0) bytes.resize(rng.below(u32(bytes.size())) + 1);
            bytes[rng.below(u32(bytes.size()))] = u8(rng.next());
        }
        if (auto back = decode_server_message(bytes)) {
            const Bytes again = encode_any(*back);
            ASSERT_TRUE(decode_server_message(again));
        }
    }
}

TEST(Messages, BoundsAreChecked) {
    EXPECT_FALSE(decode_client_message({}));
    EXPECT_EQ(decode_client_message(Bytes{200}).error().code, ErrorCode::unsupported);
    // A server's message is none of a client's.
    EXPECT_FALSE(decode_client_message(encode_message(Goodbye{"x"})));
    EXPECT_FALSE(decode_client_message(encode_message(Hello{1, std::string(33, 'a'), 8, 0})));
    EXPECT_FALSE(decode_client_message(encode_message(SetView{33})));
    EXPECT_FALSE(decode_client_message(encode_message(SetView{0})));
    AskSections asked;
    asked.at.resize(kMostSectionsAsked);
    EXPECT_TRUE(decode_client_message(encode_message(asked)));
    asked.at.resize(kMostSectionsAsked + 1);
    EXPECT_FALSE(decode_client_message(encode_message(asked)));
    MoveCommands many;
    many.commands.resize(kMostCommandsABatch + 1);
    EXPECT_FALSE(decode_client_message(encode_message(many)));
    EditRequest request;
    request.face = 6;
    EXPECT_FALSE(decode_client_message(encode_message(request)));
    request.face = 5, request.hit_x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(decode_client_message(encode_message(request)));
    BlockChanges changes;
    changes.chunks.push_back({{}, 1, {4096}, {1}});
    EXPECT_FALSE(decode_server_message(encode_message(changes)));
    changes.chunks[0] = {{}, 1, {1, 2}, {1}};
    EXPECT_FALSE(decode_server_message(encode_message(changes)));
}

// VITRAIL_WRITE_CORPUS=FOLDER writes one file a message for fuzz/corpus/net_messages_fuzz.
TEST(Messages, WriteFuzzCorpus) {
    const char* folder = std::getenv("VITRAIL_WRITE_CORPUS");
    if (!folder) GTEST_SKIP() << "VITRAIL_WRITE_CORPUS is not set";
    Rng rng(11);
    auto write = [&](const Bytes& bytes) {
        std::ofstream(std::string(folder) + "/" + message_name(MessageType(bytes[0])), std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
    };
    for (const auto& m : server_messages(rng))
        write(encode_any(m));
    for (const auto& m : client_messages(rng))
        write(encode_any(m));
}

TEST(Heights, PackAndUnpack) {
    Rng rng(9);
    for (int round = 0; round < 300; ++round) {
        ColumnHeights h;
        const u32 kind = rng.below(4);
        for (i32& y : h.above)
            y = kind == 0      ? 63
                : kind == 1    ? 60 + i32(rng.below(3))
                : kind == 2    ? i32(rng.next())
                : rng.below(2) ? -64
                               : 319;
        const Bytes bytes = pack_heights(h);
        auto back = unpack_heights(bytes);
        ASSERT_TRUE(back);
        EXPECT_EQ(back->above, h.above);
        Bytes cut(bytes.begin(), bytes.end() - 1);
        EXPECT_FALSE(unpack_heights(cut));
        if (kind == 0) {
            EXPECT_LE(bytes.size(), 6u);
        }
    }
}

TEST(Registry, TravelsWhole) {
    BlockRegistry registry;
    BlockDef def;
    def.name = "minecraft:oak_stairs";
    def.properties = {{"facing", {"north", "south"}, "north"}, {"half", {"top", "bottom"}, "bottom"}};
    def.look.shape = ShapeKind::stairs;
    def.look.textures = {"oak_planks"};
    def.look.boxes = {{0, 0, 0, 16, 8, 16, "side"}};
    def.look.light = {15, 3, 1};
    def.look.hardness = -1;
    BlockVariant variant{{{"half", "top"}}, def.look};
    variant.look.opacity = 3;
    variant.look.optics = OpticsKind::dielectric;
    variant.look.ior = 2.3f;
    variant.look.absorption = {0.5f, 0, 4};
    def.variants.push_back(variant);
    const BlockId id = registry.add_block(def);
    registry.add_texture({"oak_planks", 4});
    BiomeDef biome;
    biome.name = "minecraft:desert", biome.grass = {1, 2, 3};
    registry.add_biome(biome);
    registry.hotbar = {"minecraft:oak_stairs"};
    const Bytes bytes = encode_registry(registry);
    auto back = decode_registry(bytes);
    ASSERT_TRUE(back);
    EXPECT_EQ((*back)->find_block("minecraft:oak_stairs"), id);
    const BlockDef& got = (*back)->blocks()[u32(id)];
    EXPECT_EQ(got.variants.size(), 1u);
    EXPECT_EQ(got.variants[0].look.opacity, 3);
    EXPECT_EQ(got.variants[0].look.optics, OpticsKind::dielectric);
    EXPECT_EQ(got.variants[0].look.ior, 2.3f);
    EXPECT_EQ(got.variants[0].look.absorption, variant.look.absorption);
    EXPECT_EQ(got.look.optics, OpticsKind::automatic);
    EXPECT_EQ(got.look.ior, 0);
    EXPECT_EQ(got.look.light, def.look.light);
    EXPECT_EQ((*back)->biome_named("minecraft:desert").grass, biome.grass);
    EXPECT_EQ(encode_registry(**back), bytes);
    EXPECT_EQ(registry_hash(**back), registry_hash(registry));
    Rng rng(3);
    for (int round = 0; round < 500; ++round) {
        Bytes bad = bytes;
        bad[rng.below(u32(bad.size()))] = u8(rng.next());
        (void)decode_registry(bad);
    }
}

TEST(Loopback, KeepsOrderBoundsAndClosing) {
    auto [client, server] = make_loopback({.queue_bytes_most = 100, .clock = {}});
    EXPECT_TRUE(client->send(Channel::world, Bytes(40, 1)));
    EXPECT_TRUE(client->send(Channel::control, Bytes(40, 2)));
    EXPECT_EQ(client->send(Channel::world, Bytes(40, 3)).error().code, ErrorCode::limit);
    EXPECT_EQ(client->queued_bytes(), 80u);
    std::vector<int> seen;
    server->poll([&](Channel, ByteView b) { seen.push_back(b[0]); }, 1);
    server->poll([&](Channel, ByteView b) { seen.push_back(b[0]); });
    EXPECT_EQ(seen, (std::vector<int>{1, 2}));
    ASSERT_TRUE(client->send(Channel::world, Bytes(1, 9)));
    client->close();
    EXPECT_FALSE(server->open());
    server->poll([&](Channel, ByteView b) { seen.push_back(b[0]); });
    EXPECT_EQ(seen.back(), 9);
    EXPECT_EQ(server->send(Channel::world, Bytes(1, 1)).error().code, ErrorCode::io);
}

TEST(Loopback, DelaysAndLosesOnlyWhatMayBeLost) {
    u64 now = 0;
    auto [client, server] = make_loopback({.latency_ns = 50, .loss = 0.5f, .clock = [&] { return now; }});
    for (int i = 0; i < 200; ++i) {
        ASSERT_TRUE(client->send(Channel::world, Bytes(1, 0)));
        ASSERT_TRUE(client->send(Channel::motion, Bytes(1, 1)));
    }
    u32 count[2] = {};
    auto take = [&] { server->poll([&](Channel, ByteView b) { ++count[b[0]]; }); };
    take();
    EXPECT_EQ(count[0] + count[1], 0u);
    now = 50;
    take();
    EXPECT_EQ(count[0], 200u);
    EXPECT_GT(count[1], 50u);
    EXPECT_LT(count[1], 150u);
}

} // namespace
} // namespace vitrail::net
