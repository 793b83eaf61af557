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
    std::vector<float> wall_ms, cpu_ms; // of the server's ticks; processor time tells what a busy machine hides
    void tick() {
        const u64 start = now_ns(), start_cpu = thread_time_ns();
        server->tick_once();
        wall_ms.push_back(float(now_ns() - start) * 1e-6f);
        cpu_ms.push_back(float(thread_time_ns() - start_cpu) * 1e-6f);
        ASSERT_TRUE(client->poll()) << client->lost_reason();
        (void)client->take_dirty();
    }
    // Ticks at 20 Hz times `pace` with a player who is moved from outside by `speed` along +x. Returns how many.
    u64 fly(i64 blocks, float speed, float pace, u64& late) {
        u64 ticks = 0;
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
            tick();
            ++ticks;
            if (pace > 0) {
                const auto due = begin + u64(double(ticks) * 1e9 / (server::kTicksASecond * pace));
                if (now_ns() < due) std::this_thread::sleep_for(std::chrono::nanoseconds(due - now_ns()));
            }
        }
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
    const char* way_text = std::getenv("VITRAIL_FLY_KM");
    const int kilometers = way_text ? std::atoi(way_text) : 20;
    u64 late = 0;
    std::vector<u64> memory, caches;
    flight.wall_ms.clear(), flight.cpu_ms.clear();
    u64 ticks = 0;
    for (int leg = 0; leg < kilometers; ++leg) {
        ticks += flight.fly(1000, kFullSpeed, pace, late);
        ASSERT_FALSE(testing::Test::HasFatalFailure());
        memory.push_back(resident_memory_bytes());
        caches.push_back(flight.server->stats().generator_cache.bytes);
    }
    std::sort(flight.wall_ms.begin(), flight.wall_ms.end());
    std::sort(flight.cpu_ms.begin(), flight.cpu_ms.end());
    const auto part = [](const std::vector<float>& of, std::size_t percent) {
        return of[(of.size() - 1) * percent / 100];
    };
    const auto stats = flight.server->stats();
    const auto& generation = stats.generation;
    fmt::print("{:.1f} s until all was there; {} km at {:.1f} blocks/s, {:g} times faster than time; {} of {} looks "
               "ahead found no column\n",
               loaded, kilometers, kFullSpeed, pace, late, ticks * 11);
    fmt::print("server tick ms, wall p50 {:.2f} p99 {:.2f} most {:.2f}; processor p50 {:.2f} p99 {:.2f} most {:.2f}\n",
               part(flight.wall_ms, 50), part(flight.wall_ms, 99), part(flight.wall_ms, 100), part(flight.cpu_ms, 50),
               part(flight.cpu_ms, 99), part(flight.cpu_ms, 100));
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
    if (kilometers > 5) {
        EXPECT_LT(memory.back(), memory[4] + (64u << 20)) << "memory grows with the way";
    }
    EXPECT_GT(generation.finished, u64(kilometers) * 1000 / 16 * 25);
}

} // namespace
} // namespace vitrail
