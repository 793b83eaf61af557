// What was acknowledged survives: a killed process, torn and lost writes, a full disk.
#include "base/log.h"
#include "store/keys.h"
#include "store/maintenance.h"
#include "store/save_queue.h"
#include "tests/store/crash_vfs.h"
#include "tests/store/temp_folder.h"
#include "tests/store/world_fixture.h"

#include <chrono>
#include <csignal>
#include <fstream>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <thread>

namespace vitrail {

using namespace vitrail::testing;

static bool long_run() {
    return std::getenv("VITRAIL_LONG") != nullptr;
}

static Bytes number_bytes(u64 n) {
    ByteWriter w;
    w.put_u64(n);
    return w.take();
}

// Batch n touches a chunk of its own, one that others share, a column, a player, a script's number and a new block
// state.
static SaveBatch numbered_batch(WorldRecords& world, u32 n) {
    const StateId state = state_named(world.states(), "test:block_" + std::to_string(n % 500));
    auto own = std::make_shared<Chunk>(*random_chunk(n, 2));
    own->blocks.set(LocalPos(n & 4095), state);
    own->blocks.compact();
    own->revision = n;
    SaveBatch batch;
    batch.chunks.push_back({DimensionId(0), {i32(n), 0, 0}, own});
    batch.chunks.push_back({DimensionId(1), {0, 0, 0}, own});
    ColumnRecord column;
    column.stage = n;
    batch.columns.push_back({DimensionId(1), {0, 0}, column});
    PlayerRecord player;
    player.name = "walker";
    player.at.at.x = i64(n) * kFixedOne;
    batch.players.push_back(player);
    batch.scripts.push_back({"last", number_bytes(n)});
    return batch;
}

// All batches up to the newest are there, whole; gives the newest, 0 where there is none.
static u32 check_batches(WorldRecords& world) {
    const auto last = world.load_script("last");
    EXPECT_TRUE(last);
    if (!last || !*last) return 0;
    const u32 n = u32(ByteReader(**last).get_u64());
    const auto shared = world.load_chunk(DimensionId(1), {0, 0, 0});
    EXPECT_TRUE(shared && *shared && (*shared)->revision == n) << n;
    const auto column = world.load_column(DimensionId(1), {0, 0});
    EXPECT_TRUE(column && *column && (*column)->stage == n) << n;
    const auto player = world.load_player("walker");
    EXPECT_TRUE(player && *player && (*player)->at.at.x == i64(n) * kFixedOne) << n;
    for (u32 i = 1; i <= n; ++i) {
        const auto own = world.load_chunk(DimensionId(0), {i32(i), 0, 0});
        EXPECT_TRUE(own && *own && (*own)->revision == i) << i << " of " << n;
        if (!own || !*own) continue;
        const StateId id = (*own)->blocks.get(LocalPos(i & 4095));
        EXPECT_EQ(world.states().info(id).state.name, "test:block_" + std::to_string(i % 500));
    }
    EXPECT_TRUE(world.damage().empty());
    return n;
}

// In the child: saves batches until it is killed, and says on the pipe which are kept.
[[noreturn]] static void save_until_killed(const std::string& folder, u32 first, int pipe, bool queued) {
    auto opened = WorldRecords::open(folder, empty_registry(), {.create = true});
    if (!opened) ::_exit(3);
    WorldRecords& world = **opened;
    auto tell = [pipe](u32 n) {
        if (::write(pipe, &n, sizeof n) != sizeof n) ::_exit(4);
    };
    if (!queued) {
        for (u32 n = first;; ++n) {
            if (!world.save(numbered_batch(world, n))) ::_exit(5);
            tell(n);
        }
    }
    SaveQueue queue(world, {.group_ms = 5, .pending_bytes_most = 1 << 20});
    for (u32 n = first;; ++n)
        queue.submit(numbered_batch(world, n), [=] { tell(n); });
}

static void kill_again_and_again(u32 kills) {
    TempFolder folder;
    Rng rng{u64(::getpid())};
    u32 kept = 0;
    for (u32 k = 0; k < kills && !::testing::Test::HasFailure(); ++k) {
        int ends[2];
        ASSERT_EQ(::pipe(ends), 0);
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) {
            ::close(ends[0]);
            save_until_killed(folder.path(), kept + 1, ends[1], k & 1);
        }
        ::close(ends[1]);
        // Sometimes while the world is being made or opened, else in the midst of work: after so many batches and a
        // moment more.
        u32 told = kept, n = 0;
        if (k % 3)
            for (u32 more = 1 + rng.below(20); more > 0 && ::read(ends[0], &n, sizeof n) == sizeof n; --more)
                told = n;
        std::this_thread::sleep_for(std::chrono::microseconds(rng.below(5000)));
        ::kill(child, SIGKILL);
        while (::read(ends[0], &n, sizeof n) == sizeof n)
            told = n;
        ::close(ends[0]);
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_TRUE(WIFSIGNALED(status)) << "the child ended by itself with " << WEXITSTATUS(status);
        auto world = open_world(folder.path());
        ASSERT_TRUE(world) << "after kill " << k;
        ASSERT_TRUE(world->store().check());
        const u32 now = check_batches(*world);
        ASSERT_GE(now, told) << "an acknowledged batch is lost after kill " << k;
        kept = now;
    }
    EXPECT_GT(kept, kills) << "the children got something done";
    const auto report = verify_world(folder.path());
    ASSERT_TRUE(report) << report.error().message;
    EXPECT_TRUE(report->sound());
}

TEST(Crash, KilledProcessLosesNothingAcknowledged) {
    kill_again_and_again(20);
}

TEST(Crash, KilledProcessLong) {
    if (!long_run()) GTEST_SKIP() << "VITRAIL_LONG is not set";
    for (int i = 0; i < 5; ++i)
        kill_again_and_again(100);
}

// One life and death in the file layer. Gives how many acknowledged batches are lost.
static u32 tear_once(u64 seed, const char* synchronous) {
    TempFolder folder, after;
    Rng rng(seed);
    CrashVfs& vfs = CrashVfs::instance();
    vfs.reset();
    // Few pages between checkpoints, so that these are torn too.
    const OpenOptions options{
        .create = true, .vfs = CrashVfs::kName, .synchronous = synchronous, .checkpoint_pages = 4 + rng.below(40)};
    vfs.crash_after(rng.below(rng.below(2) ? 60 : 500));
    u32 kept = 0;
    {
        auto world = WorldRecords::open(folder.path(), empty_registry(), options);
        for (u32 n = 1; world && n < 200; ++n) {
            if (!(*world)->save(numbered_batch(**world, n))) break;
            kept = n;
            if (rng.below(20) == 0)
                world = WorldRecords::open((world->reset(), folder.path()), empty_registry(), options);
        }
    }
    EXPECT_TRUE(vfs.crashed() || kept == 199);
    vfs.crash_image(after.path(), rng);
    vfs.reset();
    auto world = open_world(after.path());
    if (!world) return 0;
    const auto sound = world->store().check();
    EXPECT_TRUE(sound) << sound.error().message;
    const u32 now = check_batches(*world);
    EXPECT_LE(now, kept + 1);
    const auto more = world->save(numbered_batch(*world, now + 1));
    EXPECT_TRUE(more) << more.error().message;
    EXPECT_EQ(check_batches(*world), now + 1);
    return kept > now ? kept - now : 0;
}

TEST(Crash, TornWritesLoseNothingAcknowledged) {
    for (u64 seed = 1; seed <= 60 && !HasFailure(); ++seed)
        EXPECT_EQ(tear_once(seed, "FULL"), 0u) << "seed " << seed;
}

TEST(Crash, TheTearingItselfWouldBeNoticed) {
    // Without a sync a commit, worlds still open, but the newest batches go: so the test above can fail.
    u32 lost = 0;
    for (u64 seed = 1; seed <= 20 && !HasFailure(); ++seed)
        lost += tear_once(seed, "NORMAL");
    EXPECT_GT(lost, 0u);
}

TEST(Crash, TornWritesLong) {
    if (!long_run()) GTEST_SKIP() << "VITRAIL_LONG is not set";
    for (u64 seed = 1000; seed < 3000 && !HasFailure(); ++seed)
        EXPECT_EQ(tear_once(seed, "FULL"), 0u) << "seed " << seed;
}

TEST(Crash, FullDiskLosesNothingAndTheStoreGoesOn) {
    TempFolder folder;
    CrashVfs& vfs = CrashVfs::instance();
    vfs.reset();
    {
        auto world = open_world(folder.path(), {.create = true, .vfs = CrashVfs::kName, .checkpoint_pages = 20});
        u32 n = 1;
        ASSERT_TRUE(world->save(numbered_batch(*world, n)));
        vfs.set_budget(600000);
        Result<> outcome;
        while ((outcome = world->save(numbered_batch(*world, n + 1))))
            ASSERT_LT(++n, 2000u);
        EXPECT_EQ(outcome.error().code, ErrorCode::io);
        EXPECT_NE(outcome.error().message.find("the disk is full"), std::string::npos) << outcome.error().message;
        EXPECT_NE(outcome.error().message.find(folder.path()), std::string::npos);
        EXPECT_EQ(check_batches(*world), n);
        EXPECT_FALSE(world->save(numbered_batch(*world, n + 1)));
        EXPECT_EQ(check_batches(*world), n) << "what could not be saved changed nothing";
        vfs.set_budget(~u64(0));
        ASSERT_TRUE(world->save(numbered_batch(*world, n + 1)));
        EXPECT_EQ(check_batches(*world), n + 1);
        EXPECT_TRUE(world->store().check());
    }
    EXPECT_GT(vfs.refused(), 0u);
    vfs.reset();
    EXPECT_TRUE(verify_world(folder.path())->sound());
}

TEST(Crash, WorldCannotBeMadeOnAFullDiskButLater) {
    TempFolder folder;
    CrashVfs& vfs = CrashVfs::instance();
    vfs.reset();
    vfs.set_budget(10000);
    const auto refused = WorldRecords::open(folder.path(), empty_registry(), {.create = true, .vfs = CrashVfs::kName});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().code, ErrorCode::io) << refused.error().message;
    vfs.set_budget(~u64(0));
    EXPECT_TRUE(open_world(folder.path(), {.create = true, .vfs = CrashVfs::kName}));
    vfs.reset();
}

// Bytes of the file itself go bad, as on a failing disk: some chunks may be lost, with a word, but none comes back
// changed.
TEST(Crash, RottenFileGivesNoWrongChunk) {
    TempFolder folder;
    {
        auto world = open_world(folder.path());
        SaveBatch batch;
        for (i32 i = 0; i < 300; ++i)
            batch.chunks.push_back({DimensionId(0), {i, 0, 0}, random_chunk(u64(i), 2)});
        ASSERT_TRUE(world->save(batch));
    }
    std::ifstream in(folder / "world.sqlite", std::ios::binary);
    const std::string sound(std::istreambuf_iterator<char>(in), {});
    u32 refused = 0, lost = 0;
    set_log_level(LogLevel::none);
    for (u64 seed = 1; seed <= 60; ++seed) {
        TempFolder other;
        Rng rng(seed);
        std::string rotten = sound;
        for (u32 i = 1 + rng.below(rng.below(2) ? 3 : 200); i > 0; --i)
            rotten[rng.below(u32(rotten.size()))] = char(rng.next());
        if (rng.below(5) == 0) rotten.resize(rng.below(u32(rotten.size())));
        std::ofstream(other / "world.sqlite", std::ios::binary) << rotten;
        const auto report = verify_world(other.path());
        auto world = WorldRecords::open(other.path(), empty_registry(), {.synchronous = "OFF"});
        if (!world) {
            ++refused;
            EXPECT_FALSE(world.error().message.empty());
            continue;
        }
        u32 missing = 0;
        for (i32 i = 0; i < 300; ++i) {
            const auto chunk = (*world)->load_chunk(DimensionId(0), {i, 0, 0});
            if (chunk && *chunk) {
                EXPECT_TRUE(same_chunk(**chunk, *random_chunk(u64(i), 2))) << seed;
            } else {
                ++missing;
            }
        }
        if (missing > 0) {
            EXPECT_TRUE(report && !report->sound())
                << "seed " << seed << ": verify said nothing of " << missing << " lost chunks";
        }
        lost += missing;
    }
    set_log_level(LogLevel::info);
    EXPECT_GT(lost, 0u);
    EXPECT_LT(refused, 40u) << "most damage leaves a world that opens";
}

TEST(Crash, QueueKeepsWhatAFullDiskRefusesAndSaysSoOnce) {
    TempFolder folder;
    CrashVfs& vfs = CrashVfs::instance();
    vfs.reset();
    {
        auto world = open_world(folder.path(), {.create = true, .vfs = CrashVfs::kName});
        ASSERT_TRUE(world->save(numbered_batch(*world, 1)));
        std::mutex mutex;
        std::vector<bool> troubles;
        u32 kept = 1;
        SaveQueue queue(*world, {.group_ms = 1, .retry_ms = 5, .on_trouble = [&](const std::optional<Error>& e) {
                                     std::lock_guard lock(mutex);
                                     troubles.push_back(e.has_value());
                                 }});
        vfs.set_budget(0);
        for (u32 n = 2; n <= 30; ++n)
            queue.submit(numbered_batch(*world, n), [&kept, n] { kept = n; });
        const auto flushed = queue.flush();
        ASSERT_FALSE(flushed);
        EXPECT_EQ(flushed.error().code, ErrorCode::io);
        EXPECT_FALSE(queue.flush());
        EXPECT_EQ((*queue.load_chunk(DimensionId(1), {0, 0, 0}))->revision, 30u) << "reads see what is pending";
        vfs.set_budget(~u64(0));
        const auto again = queue.flush();
        EXPECT_TRUE(again) << again.error().message;
        EXPECT_EQ(kept, 30u);
        std::lock_guard lock(mutex);
        EXPECT_EQ(troubles, (std::vector<bool>{true, false})) << "told once, and once that it is over";
    }
    vfs.reset();
    auto world = open_world(folder.path());
    EXPECT_EQ(check_batches(*world), 30u);
}

} // namespace vitrail
