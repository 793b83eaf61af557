#include "jobs/thread_pool.h"

#include <atomic>
#include <gtest/gtest.h>
#include <mutex>
#include <vector>

using namespace vitrail;

TEST(ThreadPool, ParallelForVisitsEachIndexOnce) {
    for (unsigned threads : {0u, 1u, 3u}) {
        ThreadPool pool(threads);
        for (u32 count : {0u, 1u, 2u, 1000u}) {
            std::vector<std::atomic<int>> seen(count);
            pool.parallel_for(count, [&](u32 i) { ++seen[i]; });
            for (auto& s : seen)
                EXPECT_EQ(s.load(), 1);
        }
    }
}

TEST(ThreadPool, SmallerPriorityRunsFirst) {
    ThreadPool pool(1);
    std::mutex gate;
    std::vector<int> order;
    gate.lock();
    pool.submit([&] { std::lock_guard wait(gate); }); // holds the one worker while the queue fills
    for (int p : {5, 1, 3, 1})
        pool.submit([&order, p] { order.push_back(p); }, p);
    gate.unlock();
    pool.wait_idle();
    EXPECT_EQ(order, (std::vector<int>{1, 1, 3, 5}));
}

TEST(ThreadPool, DestructorDropsWhatWaits) {
    std::atomic<int> ran{0};
    {
        ThreadPool pool(1);
        for (int i = 0; i < 100; ++i)
            pool.submit([&] { ++ran; });
    }
    EXPECT_LE(ran.load(), 100);
}

TEST(ThreadPool, TheTwinRunsInTheCaller) {
    ThreadPool pool(0);
    int ran = 0;
    pool.submit([&] { ++ran; });
    EXPECT_EQ(ran, 1);
    pool.wait_idle();
}
