#include "jobs/thread_pool.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <limits>
#include <mutex>
#include <queue>
#include <thread>
#include <vector>

namespace vitrail {

namespace {
struct Entry {
    i64 priority;
    u64 order;
    std::function<void()> task;
    bool operator<(const Entry& other) const { // std::priority_queue pops the largest
        return priority != other.priority ? priority > other.priority : order > other.order;
    }
};
} // namespace

struct ThreadPool::State {
    mutable std::mutex mutex;
    std::condition_variable wake, idle;
    std::priority_queue<Entry> queue;
    u64 next_order = 0;
    u32 running = 0;
    bool stop = false;
    std::vector<std::thread> workers;

    void work() {
        std::unique_lock lock(mutex);
        for (;;) {
            wake.wait(lock, [&] { return stop || !queue.empty(); });
            if (stop) return;
            auto task = std::move(const_cast<Entry&>(queue.top()).task);
            queue.pop();
            ++running;
            lock.unlock();
            task();
            task = nullptr; // captured snapshots go before we report idle
            lock.lock();
            if (--running == 0 && queue.empty()) idle.notify_all();
        }
    }
};

ThreadPool::ThreadPool(unsigned threads)
    : state_(std::make_unique<State>()) {
    for (unsigned i = 0; i < threads; ++i)
        state_->workers.emplace_back([s = state_.get()] { s->work(); });
}

ThreadPool::~ThreadPool() {
    {
        std::lock_guard lock(state_->mutex);
        state_->stop = true;
    }
    state_->wake.notify_all();
    for (auto& worker : state_->workers)
        worker.join();
}

void ThreadPool::submit(std::function<void()> task, i64 priority) {
    if (state_->workers.empty()) return task();
    {
        std::lock_guard lock(state_->mutex);
        state_->queue.push({priority, state_->next_order++, std::move(task)});
    }
    state_->wake.notify_one();
}

void ThreadPool::parallel_for(u32 count, const std::function<void(u32)>& body) {
    struct Shared {
        std::atomic<u32> next{0}, done{0};
        std::mutex mutex;
        std::condition_variable finished;
    };
    auto shared = std::make_shared<Shared>();
    // The body outlives every helper that touches it: helpers that start late find next >= count and leave.
    auto run = [shared, count, &body] {
        u32 mine = 0;
        for (u32 i; (i = shared->next.fetch_add(1)) < count; ++mine)
            body(i);
        if (mine && shared->done.fetch_add(mine) + mine == count) {
            std::lock_guard lock(shared->mutex);
            shared->finished.notify_all();
        }
    };
    const u32 helpers = std::min<u32>(threads(), count > 0 ? count - 1 : 0);
    for (u32 i = 0; i < helpers; ++i)
        submit(run, std::numeric_limits<i64>::min());
    run();
    std::unique_lock lock(shared->mutex);
    shared->finished.wait(lock, [&] { return count == 0 || shared->done.load() == count; });
}

void ThreadPool::wait_idle() {
    std::unique_lock lock(state_->mutex);
    state_->idle.wait(lock, [&] { return state_->queue.empty() && state_->running == 0; });
}

unsigned ThreadPool::threads() const {
    return unsigned(state_->workers.size());
}

u64 ThreadPool::waiting() const {
    std::lock_guard lock(state_->mutex);
    return state_->queue.size();
}

unsigned default_worker_count() {
    return std::max(1u, std::thread::hardware_concurrency() - 1);
}

} // namespace vitrail
