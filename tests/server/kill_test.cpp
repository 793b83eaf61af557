// A server that is killed at any moment while edits are being acknowledged: all that was told to be kept is there.
#include "base/rng.h"
#include "server/play_fixture.h"

#include <csignal>
#include <cstdlib>
#include <deque>
#include <filesystem>
#include <gtest/gtest.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

using namespace vitrail;

namespace {

constexpr i32 kReachOut = 2; // the square of ground that is dug: 24 blocks around the feet

struct Dug {
    i32 x, y, z;
};

// In the child: digs one block after the other and says on the pipe which are kept; then ticks until killed.
[[noreturn]] void dig_until_killed(const std::string& folder, int pipe) {
    server::ServerOptions options;
    options.folder = folder, options.seed = 7, options.threads = 0, options.save_group_ms = 5;
    auto server = server::Server::open(options, base_content());
    if (!server) ::_exit(1);
    auto [near_end, far_end] = net::make_loopback();
    (*server)->connect(std::move(far_end));
    replica::Replica ann(std::move(near_end), {"ann", 2, base_content().registry});
    std::deque<std::pair<u32, Dug>> asked;
    std::deque<BlockPos> to_dig;
    bool ready = false;
    for (u32 i = 0;; ++i) {
        if (i > 20000 && !ready) ::_exit(6);
        (*server)->tick_once();
        if (!ann.poll()) ::_exit(2);
        const BlockPos feet = block_of(ann.body().feet.at);
        if (!ready && ann.joined() && i > 100 && ann.has_section(chunk_of({feet.x, feet.y - 1, feet.z}))) {
            auto& world = (*server)->world();
            const auto stone = world.records->states().intern_with_defaults(BlockState{"minecraft:stone", {}});
            if (!stone) ::_exit(7);
            EditBatch flat;
            for (i32 z = -kReachOut; z <= kReachOut; ++z)
                for (i32 x = -kReachOut; x <= kReachOut; ++x) {
                    const BlockPos at{feet.x + x, feet.y - 1, feet.z + z};
                    flat.edits.push_back({at, *stone});
                    for (i32 up = 1; up <= 3; ++up)
                        flat.edits.push_back({{at.x, at.y + up, at.z}, StateId::air});
                    if (x != 0 || z != 0) to_dig.push_back(at);
                }
            server::edit_world(world, world.dimensions.at(DimensionId::overworld), flat);
            for (int settle = 0; settle < 5; ++settle)
                (*server)->tick_once(), (void)ann.poll();
            ready = true;
        }
        if (ready && !to_dig.empty() && i % 3 == 0) {
            const BlockPos at = to_dig.front();
            to_dig.pop_front();
            const auto sent = ann.break_block(at, Face::up, {0.5f, 1, 0.5f});
            if (!sent) ::_exit(3);
            asked.push_back({*sent, {at.x, at.y, at.z}});
        }
        for (const auto& answer : ann.take_answers()) {
            if (answer.outcome == net::EditOutcome::refused) ::_exit(4);
            if (answer.outcome != net::EditOutcome::kept) continue;
            for (; !asked.empty() && asked.front().first <= answer.sequence; asked.pop_front())
                if (::write(pipe, &asked.front().second, sizeof(Dug)) != ssize_t(sizeof(Dug))) ::_exit(5);
        }
        if (ready) ::usleep(500);
    }
}

void kill_again_and_again(u32 rounds) {
    Rng rng(99);
    u64 kept = 0;
    for (u32 round = 0; round < rounds; ++round) {
        const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                             ("vitrail-dig-" + std::to_string(::getpid()) + "-" + std::to_string(round));
        std::filesystem::remove_all(folder);
        int ends[2];
        ASSERT_EQ(::pipe(ends), 0);
        const pid_t child = ::fork();
        ASSERT_GE(child, 0);
        if (child == 0) dig_until_killed(folder.string(), ends[1]);
        ::close(ends[1]);
        std::vector<Dug> told(1);
        const auto first = ::read(ends[0], told.data(), sizeof(Dug));
        ::usleep(u32(rng.next() % 40000));
        ::kill(child, SIGKILL);
        for (Dug more{}; ::read(ends[0], &more, sizeof more) == ssize_t(sizeof more);)
            told.push_back(more);
        ::close(ends[0]);
        int status = 0;
        ::waitpid(child, &status, 0);
        ASSERT_EQ(first, ssize_t(sizeof(Dug))) << "the child ended with status " << WEXITSTATUS(status);
        kept += told.size();
        auto records = WorldRecords::open(folder.string(), base_content().registry);
        ASSERT_TRUE(records) << records.error().message;
        for (const Dug& at : told) {
            const BlockPos p{at.x, at.y, at.z};
            const auto chunk = (*records)->load_chunk(DimensionId::overworld, chunk_of(p));
            ASSERT_TRUE(chunk && *chunk);
            EXPECT_EQ((*chunk)->blocks.get(local_of(p)), StateId::air) << "round " << round << ": a kept edit is lost";
        }
        EXPECT_TRUE((*records)->damage().empty());
        records->reset();
        std::filesystem::remove_all(folder);
    }
    EXPECT_GT(kept, rounds);
    std::printf("%llu edits were told to be kept in %u rounds, all are there\n", static_cast<unsigned long long>(kept), rounds);
}

} // namespace

TEST(Kill, AllThatWasToldToBeKeptIsThere) { kill_again_and_again(2); }

TEST(Kill, AllThatWasToldToBeKeptIsThereLong) {
    if (!std::getenv("VITRAIL_LONG")) GTEST_SKIP() << "set VITRAIL_LONG";
    kill_again_and_again(50);
}
