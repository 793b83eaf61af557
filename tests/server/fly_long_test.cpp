// Flying 20 km at full speed through new land, in real time: the server's tick, memory, and whether land is there
// before the player is.
#include "base/clock.h"
#include "pipeline/new_world.h"
#include "server/play_fixture.h"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fmt/format.h>
#include <thread>

namespace vitrail {
namespace {

constexpr float kFullSpeed = 2 * kFlySpeed; // sprinting, blocks a second
constexpr i64 kWay = 20000;                 // blocks

struct Flight {
    std::unique_ptr<server::Server> server;
    std::unique_ptr<replica::Replica> client;
    std::filesystem::path folder;

    Flight(u32 view_distance, unsigned threads) {
        folder = std::filesystem::temp_directory_path() / ("vitrail-fly-" + std::to_string(::getpid()));
        std::filesystem::remove_all(folder);
        server::ServerOptions options;
        options.folder = folder.string(), options.seed = 11, options.threads = threads;
        auto opened = server::Server::open(options, base_content());
        if (!opened) throw std::runtime_error(opened.error().message);
        server = std::move(*opened);
        auto [near_end, far_end] = net::make_loopback();
        server->connect(std::move(far_end));
        client = std::make_unique<replica::Replica>(
            std::move(near_end), replica::ReplicaOptions{"ann", view_distance, base_content().registry});
    }
    ~Flight() {
        client.reset();
        server.reset();
        std::filesystem::remove_all(folder);
    }
    server::Session& session() { return *server->world().sessions.at(0); }
    server::ServerDimension& dimension() { return server->world().dimensions.at(DimensionId::overworld); }
    void tick() {
        server->tick_once();
        ASSERT_TRUE(client->poll()) << client->lost_reason();
        (void)client->take_dirty();
    }
    // Ticks at 20 Hz with a player who is moved from outside by `speed` along +x; the longest ticks, sorted, in ms.
    std::vector<float> fly(i64 blocks, float speed, float pace, u64& late) {
        std::vector<float> ticks;
        const i64 step = i64(double(speed) / server::kTicksASecond * double(kFixedOne));
        const u64 begin = now_ns();
        for (i64 way = 0; way < blocks * kFixedOne; way += step) {
            auto& body = session().body;
            body.feet.at.x += step;
            body.feet.at.y = corner_of({0, 330, 0}).y;
            body.flying = true, body.velocity = {};
            body.yaw = -1.5707963f; // +x
            session().tell_body = true;
            const ColumnPos here = column_of(chunk_of(block_of(body.feet.at)));
            // All around the player must be there, up to five sixths of what he sees ahead.
            const i32 ahead = i32(session().view_distance) * 5 / 6;
            for (i32 x = 0; x <= ahead; ++x)
                late += !server::ready(dimension(), {here.x + x, here.z});
            const u64 start = now_ns();
            tick();
            ticks.push_back(float(seconds_since(start) * 1000));
            if (pace > 0) {
                const auto due = begin + u64(double(ticks.size()) * 1e9 / (server::kTicksASecond * pace));
                if (now_ns() < due) std::this_thread::sleep_for(std::chrono::nanoseconds(due - now_ns()));
            }
        }
        std::sort(ticks.begin(), ticks.end());
        return ticks;
    }
};

TEST(FlyLong, TwentyKilometersOfNewLandAtFullSpeed) {
    if (!std::getenv("VITRAIL_LONG")) GTEST_SKIP() << "VITRAIL_LONG is not set";
    Flight flight(12, 1);
    const u64 start = now_ns();
    flight.tick();
    while (!flight.server->stats().idle) {
        flight.tick();
        ASSERT_LT(seconds_since(start), 120.0);
    }
    const double loaded = seconds_since(start);
    // Faster than time: 4 ticks in the time of one, so that 20 km take about 4 minutes. The budget is of real seconds,
    // so what is shown is 4 times the speed.
    const char* pace_text = std::getenv("VITRAIL_FLY_PACE");
    const float pace = pace_text ? float(std::atof(pace_text)) : 4;
    u64 late = 0;
    std::vector<u64> memory, caches;
    std::vector<float> ticks;
    for (int leg = 0; leg < 20; ++leg) {
        const auto some = flight.fly(kWay / 20, kFullSpeed, pace, late);
        ASSERT_FALSE(testing::Test::HasFatalFailure());
        ticks.insert(ticks.end(), some.begin(), some.end());
        memory.push_back(resident_memory_bytes());
        caches.push_back(flight.server->stats().generator_cache.bytes);
    }
    std::sort(ticks.begin(), ticks.end());
    const auto stats = flight.server->stats();
    const auto& generation = stats.generation;
    fmt::print("{:.1f} s until all was there; {} km at {:.1f} blocks/s ({:.0f} times real time: {:.1f}); tick p50 "
               "{:.2f} p99 {:.2f} most {:.2f} ms; "
               "{} of {} looks ahead found no column\n",
               loaded, kWay / 1000, kFullSpeed, pace, kFullSpeed * pace, ticks[ticks.size() / 2],
               ticks[ticks.size() * 99 / 100], ticks.back(), late, ticks.size() * 11);
    fmt::print("memory MB after each km:");
    for (u64 m : memory)
        fmt::print(" {}", m >> 20);
    fmt::print("\ncaches MB after each km:");
    for (u64 m : caches)
        fmt::print(" {}", m >> 20);
    fmt::print("\n{} columns finished, {} dropped, {} discarded, {:.1f} s of worker time in {:.1f} s\n",
               generation.finished, generation.dropped, generation.discarded, double(generation.spent_ns) * 1e-9,
               seconds_since(start));
    for (std::size_t s = 0; s < kGenerationStages; ++s)
        fmt::print("  {:9} {:8} parts, mean {:9.1f} us, {:7.2f} s\n", kGenerationStageNames[s],
                   generation.stages[s].count, generation.stages[s].mean_ns * 1e-3,
                   double(generation.stages[s].total_ns) * 1e-9);
    EXPECT_EQ(late, 0u);
    for (u64 bytes : caches)
        EXPECT_LE(bytes, TerrainGeneratorOptions{}.cache_bytes_most + (8u << 20));
    EXPECT_LT(memory.back(), memory[4] + (64u << 20)) << "memory grows with the way";
    EXPECT_GT(generation.finished, u64(kWay / 16 * 25));
}

} // namespace
} // namespace vitrail
