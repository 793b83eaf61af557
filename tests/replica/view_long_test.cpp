// The 12-chunk view of a terrain world: what server and replica take together.
#include "base/clock.h"
#include "server/play_fixture.h"

#include <cstdlib>
#include <fmt/format.h>

namespace vitrail {
namespace {

TEST(ViewLong, ServerAndReplicaOfTwelveChunksStayBelowHalfAGigabyte) {
    if (!std::getenv("VITRAIL_LONG")) GTEST_SKIP() << "VITRAIL_LONG is not set";
    const u64 before = resident_memory_bytes();
    Play play("endless");
    const u64 start = now_ns();
    float slowest = 0;
    auto& ann = play.join("ann", 12);
    slowest = play.server->stats().tick_ms_max;
    play.tick(20);
    const u64 after = resident_memory_bytes();
    u64 replica_bytes = 0;
    for (const auto& [at, chunk] : ann.dimension().chunks())
        replica_bytes +=
            sizeof(Chunk) + chunk->blocks.memory_bytes() + (chunk->light ? chunk->light->memory_bytes() : 0);
    const auto stats = play.server->stats();
    fmt::print(
        "{:.1f} s to load and send; resident {:.0f} MB more than before; server: {} columns, {} chunks, {:.1f} MB of "
        "blocks and light; replica: {} sections, at most {:.1f} MB; {} sections in {:.1f} MB sent; slowest tick {:.0f} "
        "ms\n",
        seconds_since(start), double(after - before) / 1e6, stats.columns, stats.chunks,
        double(stats.chunk_memory_bytes) / 1e6, ann.dimension().chunks().size(), double(replica_bytes) / 1e6,
        stats.sections_sent, double(stats.bytes_sent) / 1e6, slowest);
    EXPECT_LT(after - before, 400u << 20);
    expect_equal_surface(play, ann);
    // Walking on: memory stays bounded.
    for (int i = 0; i < 40; ++i) {
        play.session("ann").body.feet.at.x += 16 * kFixedOne;
        play.tick(8);
    }
    play.settle();
    play.tick(25);
    fmt::print("40 chunks further: resident {:.0f} MB more than before, {} columns\n",
               double(resident_memory_bytes() - before) / 1e6, play.server->stats().columns);
    EXPECT_LT(resident_memory_bytes() - before, 450u << 20);
}

} // namespace
} // namespace vitrail
