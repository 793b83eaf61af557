// GenerationScheduler: brings the columns of one dimension that viewers want, nearest first and ahead of who moves,
// through store and generator, in small parts on a pool. It measures what each stage costs and hands out only what an
// action budget allows, so that frames and ticks keep their pace; what is left behind is dropped. How to use it, each
// tick:
//
//     scheduler.plan(viewers, [&](ColumnPos at) { return columns.contains(at); });
//     scheduler.pump();
//     while (auto column = scheduler.take()) ...   // as many as there is time for
//
// plan, pump, take, stop and stats are for one thread; workers run parts and hand out the next ones by themselves. On a
// pool of no threads everything happens inside `pump`, in the same order every time.
#pragma once

#include "base/clock.h"
#include "jobs/thread_pool.h"
#include "pipeline/chunk_source.h"

#include <array>
#include <functional>
#include <optional>
#include <span>

namespace vitrail {

// What the scheduler drives; any thread. ChunkSource's is made by make_column_work.
class ColumnWork {
public:
    virtual ~ColumnWork() = default;
    virtual Result<StoredColumn> read(ColumnPos at) = 0;
    // Parts that `finish` would have to run itself, in an order that works (TerrainGenerator::missing).
    virtual void missing(ColumnPos at, std::vector<TerrainTask>& out) = 0;
    virtual void run(TerrainTask part) = 0;
    virtual ColumnData finish(ColumnPos at, StoredColumn stored) = 0;
};
std::unique_ptr<ColumnWork> make_column_work(const ChunkSource& source, const DimensionInfo& dimension);

struct GenerationViewer {
    ColumnPos at;
    float look_x = 0, look_z = 0; // where it looks, of length 1; or 0
    float move_x = 0, move_z = 0; // columns a second
    float radius = 0;             // columns whose distance is at most this are wanted
    friend bool operator==(const GenerationViewer&, const GenerationViewer&) = default;
};

enum class GenerationStage : u8 { store, land, ground, lattice, caves, features, blocks, count };
inline constexpr std::size_t kGenerationStages = std::size_t(GenerationStage::count);
inline constexpr const char* kGenerationStageNames[] = {"store", "land",     "ground", "lattice",
                                                        "caves", "features", "blocks"};

struct GenerationOptions {
    u64 budget_us_a_second = 0;          // of worker time; 0: no bound
    u32 columns_most = 48;               // begun and not taken yet
    u32 jobs_most = 4;                   // in the pool
    u32 job_us = 500;                    // parts are joined to jobs of about this length; a single part may be longer
    std::function<u64()> clock = now_ns; // ns; fills the budget up
    std::function<u64()> cost_clock = thread_time_ns; // ns; what a part took
};

struct GenerationStats {
    struct Stage {
        u64 count = 0;
        double mean_ns = 0; // exponential, so that it follows the machine
        u64 total_ns = 0;
    };
    std::array<Stage, kGenerationStages> stages;
    u64 finished = 0;                     // columns taken
    u64 dropped = 0;                      // columns that were begun, and left behind
    u64 discarded = 0;                    // columns that were finished, and left behind
    u32 waiting = 0, begun = 0, jobs = 0; // columns not begun; columns begun, not taken; in the pool
    u64 spent_ns = 0;                     // worker time of all parts
    float budget_use = 0;                 // of the last second: 1 is all of it; 0 without a budget
    bool limited = false;
};

struct FinishedColumn {
    ColumnPos at;
    Result<ColumnData> column;
};

class GenerationScheduler {
public:
    // The pool must end before the scheduler, and before what `work` refers to.
    GenerationScheduler(ThreadPool& pool, std::shared_ptr<ColumnWork> work, GenerationOptions options = {});
    ~GenerationScheduler();

    // What is wanted from now on; what is not any more is dropped. held: columns the caller has. Cheap while viewers
    // stay in their column and look the same way.
    void plan(std::span<const GenerationViewer> viewers, const std::function<bool(ColumnPos)>& held);
    // The budget holds (from the start it does) or does not: while nobody moves yet, or nobody draws.
    void set_limited(bool limited);
    // Hands parts to the pool as far as budget and bounds allow.
    void pump();
    // A finished column that is still wanted; none: nothing is ready now.
    std::optional<FinishedColumn> take();
    // Columns wanted and not taken.
    std::size_t pending() const;
    // Wants nothing any more and starts nothing; what runs in the pool ends.
    void stop();

    GenerationStats stats() const;

private:
    struct Impl;
    std::shared_ptr<Impl> impl_;
};

// How soon a column is wanted: its distance in columns, less ahead of who moves and where he looks; smaller is sooner.
float generation_urgency(const GenerationViewer& viewer, ColumnPos at);

} // namespace vitrail
