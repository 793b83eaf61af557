// The scheduler with work that costs simulated time: order, budget, bounds, dropping, completeness.
#include "pipeline/generation_scheduler.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <mutex>
#include <set>
#include <thread>

namespace vitrail {
namespace {

struct TaskLess {
    bool operator()(const TerrainTask& a, const TerrainTask& b) const {
        return std::tuple(a.stage, a.at.x, a.at.z) < std::tuple(b.stage, b.at.x, b.at.z);
    }
};

// Land of the column and its neighbors, a zone of 4 x 4 columns, features of the column; costs by stage.
struct FakeWork final : ColumnWork {
    std::atomic<u64> time_ns{0}, wall_ns{0};
    std::array<u64, kGenerationStages> cost_us{20, 30, 4000, 40, 50, 60, 400};
    std::mutex mutex;
    std::set<TerrainTask, TaskLess> ran;
    std::vector<ColumnPos> begun, finished;
    std::set<std::pair<i32, i32>> stored; // whole in the store
    std::set<std::pair<i32, i32>> broken;
    u32 part_runs = 0;
    std::function<void()> on_part;

    void spend(GenerationStage stage) { time_ns += cost_us[std::size_t(stage)] * 1000; }
    static ColumnPos zone(ColumnPos at) { return {at.x & ~3, at.z & ~3}; }
    Result<StoredColumn> read(ColumnPos at) override {
        spend(GenerationStage::store);
        std::lock_guard lock(mutex);
        begun.push_back(at);
        if (broken.contains({at.x, at.z})) return fail(ErrorCode::damaged, "broken");
        StoredColumn out;
        out.whole = stored.contains({at.x, at.z});
        return out;
    }
    void missing(ColumnPos at, std::vector<TerrainTask>& out) override {
        std::lock_guard lock(mutex);
        auto need = [&](TerrainTask t) {
            if (!ran.contains(t)) out.push_back(t);
        };
        for (i32 dz = -1; dz <= 1; ++dz)
            for (i32 dx = -1; dx <= 1; ++dx)
                need({TerrainStage::land, {at.x + dx, at.z + dz}});
        need({TerrainStage::ground, zone(at)});
        need({TerrainStage::features, at});
        need({TerrainStage::features, at}); // listed twice is run once
    }
    void run(TerrainTask part) override {
        if (on_part) on_part();
        spend(GenerationStage(u8(part.stage) + 1));
        std::lock_guard lock(mutex);
        ++part_runs;
        if (part.stage == TerrainStage::features) {
            EXPECT_TRUE(ran.contains({TerrainStage::ground, zone(part.at)})) << "a stage ran before what it needs";
            EXPECT_TRUE(ran.contains({TerrainStage::land, part.at}));
        }
        EXPECT_TRUE(ran.insert(part).second) << "a part ran twice";
    }
    ColumnData finish(ColumnPos at, StoredColumn column) override {
        spend(GenerationStage::blocks);
        std::lock_guard lock(mutex);
        EXPECT_TRUE(column.whole || ran.contains({TerrainStage::features, at}));
        finished.push_back(at);
        return {.at = at, .chunks = {}, .heights = {}, .made = true};
    }
};

struct SchedulerTest : testing::Test {
    std::shared_ptr<FakeWork> work = std::make_shared<FakeWork>();
    std::unique_ptr<ThreadPool> pool = std::make_unique<ThreadPool>(0);
    std::unique_ptr<GenerationScheduler> scheduler;
    std::map<std::pair<i32, i32>, bool> held; // true: it could be read
    std::vector<ColumnPos> order;

    void make(GenerationOptions options = {}) {
        options.clock = [w = work] { return w->wall_ns.load(); };
        options.cost_clock = [w = work] { return w->time_ns.load(); };
        scheduler = std::make_unique<GenerationScheduler>(*pool, work, options);
    }
    void plan(std::vector<GenerationViewer> viewers) {
        scheduler->plan(viewers, [&](ColumnPos at) { return held.contains({at.x, at.z}); });
    }
    std::size_t take_all() {
        std::size_t count = 0;
        while (auto column = scheduler->take()) {
            ++count;
            order.push_back(column->at);
            EXPECT_TRUE(held.emplace(std::pair(column->at.x, column->at.z), column->column.has_value()).second)
                << "taken twice";
        }
        return count;
    }
    // A tick of 50 ms.
    void tick() {
        work->wall_ns += 50'000'000;
        scheduler->pump();
        take_all();
    }
    void finish_all() {
        for (int i = 0; i < 100000 && scheduler->pending() > 0; ++i)
            tick();
        EXPECT_EQ(scheduler->pending(), 0u) << "some columns never come";
    }
    void TearDown() override {
        if (scheduler) scheduler->stop();
        pool.reset(); // before the scheduler and the work
        scheduler.reset();
    }
};

float distance(ColumnPos a, ColumnPos b) {
    return std::hypot(float(a.x - b.x), float(a.z - b.z));
}

TEST_F(SchedulerTest, EverythingWantedArrivesOnceNearestFirst) {
    make({.columns_most = 1});
    const GenerationViewer viewer{.at = {100, -50}, .radius = 6.5f};
    plan({viewer});
    finish_all();
    std::size_t inside = 0;
    for (i32 z = -7; z <= 7; ++z)
        for (i32 x = -7; x <= 7; ++x) {
            const bool wanted = float(x * x + z * z) <= 6.5f * 6.5f;
            inside += wanted;
            EXPECT_EQ(held.contains({100 + x, -50 + z}), wanted) << x << " " << z;
        }
    EXPECT_EQ(order.size(), inside);
    for (std::size_t i = 1; i < order.size(); ++i)
        EXPECT_GE(distance(order[i], viewer.at) + 1e-4f, distance(order[i - 1], viewer.at));
    EXPECT_EQ(scheduler->stats().finished, inside);
}

TEST_F(SchedulerTest, TheWayAheadComesBeforeTheWayBehind) {
    make({.columns_most = 1});
    plan({{.at = {0, 0}, .look_x = 1, .move_x = 2, .radius = 8}});
    finish_all();
    const auto place = [&](ColumnPos at) { return std::find(order.begin(), order.end(), at) - order.begin(); };
    EXPECT_LT(place({6, 0}), place({-6, 0}));
    EXPECT_LT(place({8, 0}), place({-5, 0}));
    EXPECT_LT(place({8, 0}), place({0, 8}));
    EXPECT_LT(place({-2, 0}), place({8, 0})); // but what is near is not forgotten
    EXPECT_EQ(generation_urgency({.at = {0, 0}, .look_z = 1, .radius = 8}, {0, 5}) <
                  generation_urgency({.at = {0, 0}, .look_z = 1, .radius = 8}, {0, -5}),
              true);
}

TEST_F(SchedulerTest, TheBudgetIsKeptWhateverStagesCost) {
    for (u64 zone_us : {500, 4000, 60000}) {
        work = std::make_shared<FakeWork>();
        work->cost_us[std::size_t(GenerationStage::ground)] = zone_us;
        held.clear();
        scheduler.reset();
        make({.budget_us_a_second = 100'000});
        plan({{.at = {0, 0}, .radius = 60}});
        const int seconds = 20;
        for (int i = 0; i < 20 * seconds; ++i)
            tick();
        const double spent = double(work->time_ns) * 1e-9, allowed = 0.1 * seconds;
        ASSERT_GT(scheduler->pending(), 0u) << "too little work to tell";
        // One part may run over, and what idle time left is a tenth of a second's.
        EXPECT_LT(spent, allowed + 0.02 + double(zone_us) * 1e-6);
        EXPECT_GT(spent, allowed * 0.9) << "it dawdles";
        EXPECT_NEAR(scheduler->stats().budget_use, 1, 0.7);
        EXPECT_NEAR(scheduler->stats().stages[std::size_t(GenerationStage::ground)].mean_ns, double(zone_us) * 1000, 1);
        EXPECT_EQ(scheduler->stats().spent_ns, work->time_ns);
    }
}

TEST_F(SchedulerTest, NoBudgetHoldsBeforeAnybodyMoves) {
    make({.budget_us_a_second = 1000, .columns_most = 10000});
    scheduler->set_limited(false);
    plan({{.at = {0, 0}, .radius = 8}});
    tick();
    EXPECT_EQ(scheduler->pending(), 0u);
    // What ran free is no debt; from now on it holds.
    scheduler->set_limited(true);
    const u64 before = work->time_ns;
    held.clear();
    plan({{.at = {1000, 0}, .radius = 8}});
    for (int i = 0; i < 40; ++i)
        tick();
    EXPECT_GT(work->time_ns, before);
    EXPECT_LT(work->time_ns - before, 2'000'000 + 5'000'000u); // 2 s of 1 ms each, and one part over
}

TEST_F(SchedulerTest, AChangeOfCostIsFollowed) {
    make({.budget_us_a_second = 200'000});
    plan({{.at = {0, 0}, .radius = 30}});
    for (int i = 0; i < 100; ++i)
        tick();
    work->cost_us[std::size_t(GenerationStage::blocks)] = 5000;
    for (int i = 0; i < 60; ++i)
        tick();
    const u64 before = work->time_ns;
    for (int i = 0; i < 100; ++i)
        tick();
    EXPECT_LT(double(work->time_ns - before) * 1e-9, 5 * 0.2 + 0.03);
    EXPECT_GT(scheduler->stats().stages[std::size_t(GenerationStage::blocks)].mean_ns, 4e6);
}

TEST_F(SchedulerTest, InFlightIsBounded) {
    pool = std::make_unique<ThreadPool>(2);
    u32 most_jobs = 0, most_begun = 0;
    make({.columns_most = 5, .jobs_most = 3});
    plan({{.at = {0, 0}, .radius = 6}});
    for (int i = 0; i < 100000 && scheduler->pending() > 0; ++i) {
        scheduler->pump();
        const auto stats = scheduler->stats();
        most_jobs = std::max(most_jobs, stats.jobs), most_begun = std::max(most_begun, stats.begun);
        if (i % 3 == 0) take_all();
        std::this_thread::yield();
    }
    EXPECT_EQ(scheduler->pending(), 0u);
    EXPECT_LE(most_jobs, 3u);
    EXPECT_LE(most_begun, 5u);
    EXPECT_GE(most_begun, 2u);
}

TEST_F(SchedulerTest, WhatIsLeftBehindIsDroppedAndNoPartOfItRuns) {
    make({.budget_us_a_second = 2000, .columns_most = 30});
    plan({{.at = {0, 0}, .radius = 10}});
    for (int i = 0; i < 5; ++i)
        tick();
    ASSERT_GT(scheduler->stats().begun, 0u);
    const u32 parts = work->part_runs;
    const std::size_t begun = work->begun.size();
    plan({});
    EXPECT_EQ(scheduler->pending(), 0u);
    for (int i = 0; i < 200; ++i)
        tick();
    EXPECT_EQ(work->part_runs, parts);
    EXPECT_EQ(work->begun.size(), begun);
    EXPECT_GT(scheduler->stats().dropped, 0u);
    EXPECT_EQ(scheduler->stats().begun, 0u);
    // Wanted again, it comes again.
    plan({{.at = {0, 0}, .radius = 3}});
    for (int i = 0; i < 4000 && scheduler->pending() > 0; ++i)
        tick();
    EXPECT_EQ(scheduler->pending(), 0u);
    EXPECT_TRUE(held.contains({0, 0}));
}

TEST_F(SchedulerTest, FinishedColumnsThatNobodyWantsAreDiscarded) {
    make({.columns_most = 4});
    plan({{.at = {0, 0}, .radius = 4}});
    work->wall_ns += 50'000'000;
    scheduler->pump(); // four are done and not taken
    plan({{.at = {100, 0}, .radius = 1}});
    EXPECT_EQ(scheduler->stats().discarded, 4u);
    finish_all();
    EXPECT_FALSE(held.contains({0, 0}));
    EXPECT_TRUE(held.contains({100, 0}));
}

TEST_F(SchedulerTest, NearOnesDoNotStarveFarOnesNorOneViewerTheOther) {
    make({.budget_us_a_second = 50'000});
    // Somebody walks to and fro, wanting new land near him all the time; somebody else stands far away.
    int ticks = 0;
    for (; ticks < 6000; ++ticks) {
        const i32 walk = ticks / 20;
        plan({{.at = {walk, 0}, .move_x = 1, .radius = 3}, {.at = {0, 5000}, .radius = 4}});
        tick();
        bool all = true;
        for (i32 x = -2; x <= 2; ++x)
            all &= held.contains({x, 5000});
        if (all) break;
    }
    EXPECT_LT(ticks, 6000);
}

TEST_F(SchedulerTest, StoredColumnsComeWithoutAnyTerrainAndBrokenOnesAsErrors) {
    for (i32 z = -3; z <= 3; ++z)
        for (i32 x = -3; x <= 3; ++x)
            work->stored.insert({x, z});
    work->broken = {{1, 1}};
    make();
    plan({{.at = {0, 0}, .radius = 3}});
    finish_all();
    EXPECT_EQ(work->part_runs, 0u);
    EXPECT_FALSE(held.at({1, 1}));
    EXPECT_TRUE(held.at({1, 2}));
}

TEST_F(SchedulerTest, WithoutThreadsTheOrderIsAlwaysTheSame) {
    std::vector<ColumnPos> first;
    for (int round = 0; round < 3; ++round) {
        work = std::make_shared<FakeWork>();
        held.clear(), order.clear();
        make({.columns_most = 2});
        for (int i = 0; i < 60; ++i) {
            plan({{.at = {i / 4, i / 7}, .look_x = 1, .radius = 5}});
            tick();
        }
        finish_all();
        if (round == 0)
            first = order;
        else
            EXPECT_EQ(order, first);
        scheduler.reset();
    }
}

TEST_F(SchedulerTest, AtTheEdgeOfTheWorldOnlyWhatExistsIsWanted) {
    make();
    const i32 edge = kWorldEdge / kChunkSize;
    plan({{.at = {edge - 1, -edge}, .radius = 3}});
    finish_all();
    for (const auto& [at, good] : held)
        EXPECT_TRUE(in_world(ChunkPos{at.first, 0, at.second}));
    EXPECT_TRUE(held.contains({edge - 1, -edge}));
}

// Many threads, viewers that jump about: nothing is lost, run twice or left over.
TEST_F(SchedulerTest, JumpingViewersOnManyThreads) {
    pool = std::make_unique<ThreadPool>(4);
    work->on_part = [] { std::this_thread::yield(); };
    make({.columns_most = 20, .jobs_most = 8, .job_us = 100});
    u32 seed = 1;
    for (int i = 0; i < 400; ++i) {
        seed = seed * 1664525 + 1013904223;
        plan({{.at = {i32(seed >> 28), i32(seed >> 24 & 15)}, .look_x = 1, .radius = 5},
              {.at = {40, i / 8}, .radius = 3}});
        scheduler->pump();
        std::this_thread::yield();
        take_all();
    }
    for (int i = 0; i < 1000000 && scheduler->pending() > 0; ++i) {
        scheduler->pump();
        take_all();
        std::this_thread::yield();
    }
    EXPECT_EQ(scheduler->pending(), 0u);
    for (i32 x = 37; x <= 43; ++x)
        for (i32 z = 47; z <= 51; ++z)
            if (distance({x, z}, {40, 49}) <= 3) {
                EXPECT_TRUE(held.contains({x, z})) << x << " " << z;
            }
    pool->wait_idle();
    EXPECT_EQ(scheduler->stats().jobs, 0u);
}

} // namespace
} // namespace vitrail
