// ThreadPool: workers that take tasks by priority; `threads = 0` is the single-threaded twin, which runs each task
// inside `submit`, so that a test can step through one order. Tasks capture snapshots (shared_ptr<const ...>) and hold
// no locks.
#pragma once

#include "base/types.h"

#include <functional>
#include <memory>

namespace vitrail {

class ThreadPool {
public:
    // threads: number of workers; 0 runs tasks in the calling thread.
    explicit ThreadPool(unsigned threads);
    ~ThreadPool(); // finishes what runs, drops what waits
    ThreadPool(const ThreadPool&) = delete;
    ThreadPool& operator=(const ThreadPool&) = delete;

    // Smaller priority values run first; equal ones in order of submission. A task must not throw.
    void submit(std::function<void()> task, i64 priority = 0);
    // Calls body(i) for i in [0, count) on workers and the calling thread; returns when all are done.
    void parallel_for(u32 count, const std::function<void(u32)>& body);
    // Waits until no task waits or runs.
    void wait_idle();
    unsigned threads() const;
    u64 waiting() const;

private:
    struct State;
    std::unique_ptr<State> state_;
};

// One worker fewer than the machine has cores, at least 1.
unsigned default_worker_count();

} // namespace vitrail
