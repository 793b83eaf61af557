// Walk, dig, place, quit, start again, still there: through the server, the loopback and the replica, as in the game.
#include "client/local_game.h"

#include "base/clock.h"
#include "rules/pick.h"
#include "script/content_loader.h"

#include <chrono>
#include <filesystem>
#include <gtest/gtest.h>
#include <thread>
#include <unistd.h>

using namespace vitrail;
namespace fs = std::filesystem;

namespace {

struct GameTest : testing::Test {
    fs::path folder = fs::temp_directory_path() / ("vitrail_game_" + std::to_string(getpid()));
    Content content;
    std::unique_ptr<client::LocalGame> game;

    void SetUp() override {
        fs::remove_all(folder);
        const std::vector<fs::path> roots{fs::path(VITRAIL_SOURCE_DIR) / "content/base"};
        auto loaded = load_content(roots);
        ASSERT_TRUE(loaded) << loaded.error().message;
        content = *loaded;
    }
    void TearDown() override {
        game.reset();
        fs::remove_all(folder);
    }
    void start() {
        client::LocalGameOptions options;
        options.server.folder = folder.string();
        options.server.seed = 7;
        options.replica.view_distance = 3;
        auto opened = client::LocalGame::open(options, content);
        ASSERT_TRUE(opened) << opened.error().message;
        game = std::move(*opened);
        ASSERT_TRUE(game->wait_joined(60));
        until("the ground", [&] { return replica().has_section(chunk_of(block_of(replica().body().feet.at))) && replica().body().on_ground; });
    }
    replica::Replica& replica() { return game->replica(); }
    // Polls and stands still until `done`; fails after a long while.
    template <class F>
    void until(const char* what, F done, MoveCommand input = {}) {
        const u64 begin = now_ns();
        u64 last = begin;
        while (!done()) {
            ASSERT_TRUE(replica().poll()) << replica().lost_reason();
            // As much as has passed: the server lets nobody run ahead of time.
            const u64 now = now_ns();
            replica().move(input, float(now - last) * 1e-9f);
            last = now;
            (void)replica().take_dirty();
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
            ASSERT_LT(seconds_since(begin), 60.0) << "waited too long for " << what;
        }
    }
    void until_kept(u32 sequence) {
        bool kept = false;
        until("the edit to be kept", [&] {
            for (const auto& answer : replica().take_answers()) {
                EXPECT_NE(answer.outcome, net::EditOutcome::refused) << answer.reason;
                kept = kept || (answer.outcome == net::EditOutcome::kept && answer.sequence >= sequence);
            }
            return kept;
        });
    }
};

} // namespace

TEST_F(GameTest, WalkDigPlaceQuitStartAgainStillThere) {
    ASSERT_NO_FATAL_FAILURE(start());
    const WorldPos begin = replica().body().feet.at;
    MoveCommand forward;
    forward.forward = 1;
    until("the body to move", [&] {
        const Vec3 d = view_from(begin, replica().body().feet.at).v;
        return d.x * d.x + d.z * d.z > 0.5f;
    }, forward);
    until("the body to rest", [&] { return replica().body().on_ground; });

    // Dig beside the feet: the block that a look straight down and ahead meets.
    const auto down = pick_block(replica().dimension(), eye_of(replica().body()), normalized({0.35f, -1, 0.2f}), 5);
    ASSERT_TRUE(down);
    const BlockPos dug = down->block;
    const auto sequence = replica().break_block(dug, down->face, down->point);
    ASSERT_TRUE(sequence) << sequence.error().message;
    EXPECT_EQ(replica().dimension().state_at(dug), StateId::air) << "predicted at once";
    until_kept(*sequence);

    const auto floor = pick_block(replica().dimension(), eye_of(replica().body()), normalized({0.35f, -1, 0.2f}), 6);
    ASSERT_TRUE(floor);
    const auto placed = replica().place_block(floor->block, floor->face, floor->point, "minecraft:glowstone");
    ASSERT_TRUE(placed) << placed.error().message;
    until_kept(*placed);
    const BlockPos lamp = neighbor(floor->block, floor->face);
    EXPECT_EQ(replica().states()->info(replica().dimension().state_at(lamp)).state.name, "minecraft:glowstone");
    until("the body to rest", [&] { return replica().body().on_ground; });
    const WorldPos end = replica().body().feet.at;
    ASSERT_TRUE(game->stop());
    game.reset();

    ASSERT_NO_FATAL_FAILURE(start());
    EXPECT_EQ(replica().states()->info(replica().dimension().state_at(lamp)).state.name, "minecraft:glowstone");
    if (!(dug == lamp)) EXPECT_EQ(replica().dimension().state_at(dug), StateId::air);
    EXPECT_GE(replica().dimension().light_at({lamp.x, lamp.y + 1, lamp.z}).red(), 10u) << "its light is there too";
    const Vec3 off = view_from(end, replica().body().feet.at).v;
    EXPECT_LT(length(off), 0.05f) << "the player stands where he stood; off by " << off.x << " " << off.y << " " << off.z;
}
