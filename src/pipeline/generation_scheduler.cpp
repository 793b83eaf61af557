#include "pipeline/generation_scheduler.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <deque>
#include <limits>
#include <map>
#include <mutex>
#include <unordered_map>
#include <unordered_set>

namespace vitrail {

namespace {

// Until they are measured, ns.
constexpr double kFirstMeans[kGenerationStages] = {50e3, 10e3, 5e6, 30e3, 30e3, 60e3, 300e3};
constexpr double kMeanShare = 1.0 / 16;
constexpr double kBudgetKeptSeconds = 0.1; // of an idle time, so that a burst after it stays short
constexpr std::size_t kRecentMost = 1u << 14;

struct PartHash {
    std::size_t operator()(const TerrainTask& t) const { return mix64(std::hash<ColumnPos>()(t.at) + u64(t.stage)); }
};
GenerationStage stage_of(TerrainTask part) {
    return GenerationStage(u8(part.stage) + 1);
}
static_assert(GenerationStage(u8(TerrainStage::features) + 1) == GenerationStage::features);

using Flag = std::shared_ptr<std::atomic<bool>>;

// What one job holds several of: the store's answer for a column, a part of the terrain, a column's last stage.
struct Unit {
    GenerationStage stage{};
    TerrainTask part;    // of terrain
    ColumnPos at;        // of a column
    u64 column_id = 0;   // 0: a part
    StoredColumn stored; // into `blocks`
    Flag dropped;
    float urgency = 0;
    // What came of it.
    bool ran = false;
    u64 cost_ns = 0;
    std::vector<TerrainTask> missing;
    std::optional<Result<ColumnData>> column;
};

struct Part {
    std::vector<ColumnPos> waiters;
    Flag dropped = std::make_shared<std::atomic<bool>>(false);
};

struct WantedColumn {
    enum class State : u8 { waiting, begun, done } state = State::waiting;
    float urgency = 0;
    u64 id = 0;
    std::vector<TerrainTask> parts; // by stage
    std::size_t next = 0;
    u32 pending = 0; // parts of the running stage
    StoredColumn stored;
    Flag dropped;
    std::optional<Result<ColumnData>> result;
};

} // namespace

float generation_urgency(const GenerationViewer& viewer, ColumnPos at) {
    const float dx = float(i64(at.x) - viewer.at.x), dz = float(i64(at.z) - viewer.at.z);
    const float distance = std::sqrt(dx * dx + dz * dz);
    if (distance < 2) return distance;
    const float look = (viewer.look_x * dx + viewer.look_z * dz) / distance;
    const float speed = std::sqrt(viewer.move_x * viewer.move_x + viewer.move_z * viewer.move_z);
    const float move =
        speed > 0.05f ? (viewer.move_x * dx + viewer.move_z * dz) / (distance * speed) * std::min(speed, 1.0f) : 0;
    return distance * (1.6f - 0.2f * look - 0.4f * move);
}

struct GenerationScheduler::Impl : std::enable_shared_from_this<Impl> {
    ThreadPool& pool;
    std::shared_ptr<ColumnWork> work;
    const GenerationOptions options;

    mutable std::mutex mutex;
    std::vector<GenerationViewer> viewers;
    bool planned = false;
    std::unordered_map<ColumnPos, WantedColumn> columns; // all that are wanted and not taken
    std::vector<std::pair<float, ColumnPos>> queue;      // not begun, the most urgent last
    std::multimap<float, Unit> ready;
    std::unordered_map<TerrainTask, Part, PartHash> parts; // ready or in a job
    std::unordered_set<TerrainTask, PartHash> recent;      // run lately: in the generator's caches
    std::deque<ColumnPos> done;
    u64 next_id = 1;
    u32 begun = 0, jobs = 0;
    bool pumping = false, stopped = false, limited = true;
    double allowance_ns = 0;
    u64 filled_at = 0, window_at = 0, window_spent = 0;
    GenerationStats stats;

    Impl(ThreadPool& p, std::shared_ptr<ColumnWork> w, GenerationOptions o)
        : pool(p)
        , work(std::move(w))
        , options(std::move(o)) {
        for (std::size_t i = 0; i < kGenerationStages; ++i)
            stats.stages[i].mean_ns = kFirstMeans[i];
        filled_at = window_at = options.clock();
        allowance_ns = budget_ns() * kBudgetKeptSeconds;
    }

    double budget_ns() const { return double(options.budget_us_a_second) * 1000; } // a second
    bool has_budget() const { return limited && options.budget_us_a_second > 0; }

    void fill_budget() {
        const u64 now = options.clock();
        const double seconds = double(now - filled_at) * 1e-9;
        filled_at = now;
        allowance_ns = std::min(allowance_ns + seconds * budget_ns(), budget_ns() * kBudgetKeptSeconds);
        if (const double window = double(now - window_at) * 1e-9; window >= 1) {
            stats.budget_use = has_budget() ? float(double(window_spent) / (budget_ns() * window)) : 0;
            window_at = now, window_spent = 0;
        }
    }

    void measure(GenerationStage stage, u64 ns) {
        auto& s = stats.stages[std::size_t(stage)];
        s.mean_ns = s.count == 0 ? double(ns) : s.mean_ns + (double(ns) - s.mean_ns) * kMeanShare;
        ++s.count;
        s.total_ns += ns;
        stats.spent_ns += ns, window_spent += ns;
    }

    // --- wanting ---

    void want(ColumnPos at, float urgency) {
        auto [entry, fresh] = columns.try_emplace(at);
        WantedColumn& column = entry->second;
        column.urgency = urgency;
        if (fresh) column.id = next_id++;
        if (column.state == WantedColumn::State::waiting) queue.emplace_back(urgency, at);
    }

    // Takes a column out; parts that nobody else waits for are dropped with it.
    void forget(std::unordered_map<ColumnPos, WantedColumn>::iterator it) {
        WantedColumn& column = it->second;
        const ColumnPos at = it->first;
        if (column.state != WantedColumn::State::waiting) {
            --begun;
            ++(column.state == WantedColumn::State::done ? stats.discarded : stats.dropped);
            if (column.dropped) column.dropped->store(true);
            // Every part of the stage that runs; parts of later stages are nowhere yet.
            for (std::size_t i = 0; i < column.next; ++i) {
                const auto part = parts.find(column.parts[i]);
                if (part == parts.end()) continue;
                std::erase(part->second.waiters, at);
                if (part->second.waiters.empty()) part->second.dropped->store(true);
            }
        }
        columns.erase(it);
    }

    void plan(std::span<const GenerationViewer> now, const std::function<bool(ColumnPos)>& held) {
        std::unordered_map<ColumnPos, float> wanted;
        for (const GenerationViewer& v : now) {
            const i32 reach = i32(std::floor(v.radius));
            for (i32 dz = -reach; dz <= reach; ++dz)
                for (i32 dx = -reach; dx <= reach; ++dx) {
                    if (float(dx * dx + dz * dz) > v.radius * v.radius) continue;
                    const ColumnPos at{i32(u32(v.at.x) + u32(dx)), i32(u32(v.at.z) + u32(dz))};
                    if (!in_world(ChunkPos{at.x, 0, at.z}) || held(at)) continue;
                    const float urgency = generation_urgency(v, at);
                    const auto [entry, fresh] = wanted.try_emplace(at, urgency);
                    if (!fresh) entry->second = std::min(entry->second, urgency);
                }
        }
        for (auto it = columns.begin(); it != columns.end();) {
            const auto next = std::next(it);
            if (!wanted.contains(it->first)) forget(it);
            it = next;
        }
        std::erase_if(done, [&](ColumnPos at) { return !wanted.contains(at); });
        queue.clear();
        for (const auto& [at, urgency] : wanted)
            want(at, urgency);
        // Equal ones by place, so that the order is the same on every machine.
        std::sort(queue.begin(), queue.end(), [](const auto& a, const auto& b) {
            return a.first != b.first         ? a.first > b.first
                   : a.second.z != b.second.z ? a.second.z > b.second.z
                                              : a.second.x > b.second.x;
        });
        sort_ready_again();
    }

    void sort_ready_again() {
        std::multimap<float, Unit> sorted;
        for (auto& [old, unit] : ready) {
            float urgency = std::numeric_limits<float>::max();
            if (unit.column_id) {
                const auto column = columns.find(unit.at);
                if (column == columns.end() || column->second.id != unit.column_id) continue;
                urgency = column->second.urgency;
            } else {
                const auto part = parts.find(unit.part);
                if (part->second.waiters.empty()) {
                    parts.erase(part);
                    continue;
                }
                for (ColumnPos at : part->second.waiters)
                    urgency = std::min(urgency, columns.at(at).urgency);
            }
            unit.urgency = urgency;
            sorted.emplace(urgency, std::move(unit));
        }
        ready.swap(sorted);
    }

    // --- working ---

    void begin_column() {
        const ColumnPos at = queue.back().second;
        queue.pop_back();
        WantedColumn& column = columns.at(at);
        column.state = WantedColumn::State::begun;
        column.dropped = std::make_shared<std::atomic<bool>>(false);
        ++begun;
        make_ready(GenerationStage::store, at, column);
    }

    void make_ready(GenerationStage stage, ColumnPos at, WantedColumn& column) {
        Unit unit;
        unit.stage = stage, unit.at = at, unit.column_id = column.id, unit.urgency = column.urgency;
        unit.stored = std::move(column.stored);
        unit.dropped = column.dropped;
        ready.emplace(column.urgency, std::move(unit));
    }

    // The parts of the column's next stage; its last stage where none is left.
    void advance(ColumnPos at, WantedColumn& column) {
        while (column.pending == 0 && column.next < column.parts.size()) {
            const TerrainStage stage = column.parts[column.next].stage;
            for (; column.next < column.parts.size() && column.parts[column.next].stage == stage; ++column.next) {
                const TerrainTask task = column.parts[column.next];
                if (recent.contains(task)) continue;
                const auto [entry, fresh] = parts.try_emplace(task);
                auto& waiters = entry->second.waiters;
                if (std::find(waiters.begin(), waiters.end(), at) != waiters.end()) continue; // listed twice
                waiters.push_back(at);
                ++column.pending;
                entry->second.dropped->store(false);
                if (!fresh) continue; // waits or runs already
                Unit unit;
                unit.stage = stage_of(task), unit.part = task, unit.urgency = column.urgency;
                unit.dropped = entry->second.dropped;
                ready.emplace(column.urgency, std::move(unit));
            }
        }
        if (column.pending == 0) make_ready(GenerationStage::blocks, at, column);
    }

    void finish_part(Unit& unit) {
        const auto entry = parts.find(unit.part);
        if (entry == parts.end()) return;
        if (!unit.ran) {
            if (!entry->second.waiters.empty()) { // wanted again after it had been passed over
                entry->second.dropped->store(false);
                Unit again;
                again.stage = unit.stage, again.part = unit.part, again.urgency = unit.urgency;
                again.dropped = entry->second.dropped;
                ready.emplace(unit.urgency, std::move(again));
            } else {
                parts.erase(entry);
            }
            return;
        }
        measure(unit.stage, unit.cost_ns);
        if (recent.size() >= kRecentMost) recent.clear();
        recent.insert(unit.part);
        const std::vector<ColumnPos> waiters = std::move(entry->second.waiters);
        parts.erase(entry);
        for (ColumnPos at : waiters) {
            WantedColumn& column = columns.at(at); // who is forgotten is no waiter
            if (--column.pending == 0) advance(at, column);
        }
    }

    void finish_column(Unit& unit) {
        if (unit.ran) measure(unit.stage, unit.cost_ns);
        const auto found = columns.find(unit.at);
        if (found == columns.end() || found->second.id != unit.column_id) return; // left behind
        WantedColumn& column = found->second;
        if (unit.column) {
            column.result = std::move(unit.column);
            column.state = WantedColumn::State::done;
            done.push_back(unit.at);
            return;
        }
        column.stored = std::move(unit.stored);
        for (u8 stage = 0; stage < u8(TerrainStage::count); ++stage)
            for (const TerrainTask part : unit.missing)
                if (u8(part.stage) == stage) column.parts.push_back(part);
        advance(unit.at, column);
    }

    // In a worker, without the lock.
    void run(Unit& unit) {
        if (unit.dropped->load()) return;
        unit.ran = true;
        const u64 start = options.cost_clock();
        if (!unit.column_id) {
            work->run(unit.part);
        } else if (unit.stage == GenerationStage::store) {
            auto stored = work->read(unit.at);
            if (!stored) {
                unit.column = Result<ColumnData>(tl::unexpected(std::move(stored).error()));
            } else if (stored->whole) {
                unit.column = work->finish(unit.at, std::move(*stored));
            } else {
                unit.stored = std::move(*stored);
                work->missing(unit.at, unit.missing);
            }
        } else {
            unit.column = work->finish(unit.at, std::move(unit.stored));
        }
        unit.cost_ns = options.cost_clock() - start;
    }

    struct Job {
        std::vector<Unit> units;
        double estimate_ns = 0;
    };

    // The next job, most urgent units first; empty where nothing may be begun now.
    Job next_job() {
        Job job;
        if (stopped || jobs >= options.jobs_most) return job;
        fill_budget();
        if (has_budget() && allowance_ns <= 0) return job;
        // One that is more urgent than all that waits, as after a turn, is not to wait behind it.
        while (!queue.empty() && begun < options.columns_most && (ready.empty() || queue.back().first < ready.begin()->first))
            begin_column();
        while (!ready.empty()) {
            const auto first = ready.begin();
            Unit& unit = first->second;
            const double mean = stats.stages[std::size_t(unit.stage)].mean_ns;
            if (!job.units.empty() && job.estimate_ns + mean > double(options.job_us) * 1000) break;
            // A part that everybody left: nothing to run.
            if (unit.dropped->load()) {
                if (!unit.column_id) parts.erase(unit.part);
                ready.erase(first);
                continue;
            }
            job.estimate_ns += mean;
            job.units.push_back(std::move(unit));
            ready.erase(first);
        }
        return job;
    }

    void run_job(Job& job) {
        for (Unit& unit : job.units)
            run(unit);
        std::lock_guard lock(mutex);
        --jobs;
        allowance_ns += job.estimate_ns;
        for (Unit& unit : job.units) {
            allowance_ns -= double(unit.cost_ns);
            if (unit.column_id)
                finish_column(unit);
            else
                finish_part(unit);
        }
    }

    // Hands out jobs until nothing may be begun. One thread at a time; who comes meanwhile leaves it to that one, which
    // looks again before it ends.
    void pump() {
        std::unique_lock lock(mutex);
        if (pumping) return;
        pumping = true;
        for (;;) {
            auto job = std::make_shared<Job>(next_job());
            if (job->units.empty()) {
                if (!ready.empty() || queue.empty() || begun >= options.columns_most || jobs >= options.jobs_most ||
                    stopped || (has_budget() && allowance_ns <= 0))
                    break;
                continue; // only units that had been left came up
            }
            ++jobs;
            allowance_ns -= job->estimate_ns;
            const i64 priority = i64(job->units.front().urgency * 16);
            lock.unlock();
            pool.submit(
                [self = shared_from_this(), job] {
                    self->run_job(*job);
                    self->pump();
                },
                priority);
            lock.lock();
        }
        pumping = false;
    }
};

GenerationScheduler::GenerationScheduler(ThreadPool& pool, std::shared_ptr<ColumnWork> work, GenerationOptions options)
    : impl_(std::make_shared<Impl>(pool, std::move(work), std::move(options))) {}

GenerationScheduler::~GenerationScheduler() {
    stop();
}

void GenerationScheduler::plan(std::span<const GenerationViewer> viewers, const std::function<bool(ColumnPos)>& held) {
    std::lock_guard lock(impl_->mutex);
    if (impl_->stopped) return;
    if (impl_->planned && std::equal(viewers.begin(), viewers.end(), impl_->viewers.begin(), impl_->viewers.end()))
        return;
    impl_->viewers.assign(viewers.begin(), viewers.end());
    impl_->planned = true;
    impl_->plan(viewers, held);
}

void GenerationScheduler::set_limited(bool limited) {
    std::lock_guard lock(impl_->mutex);
    if (impl_->limited == limited) return;
    impl_->fill_budget();
    impl_->limited = limited;
    if (limited) impl_->allowance_ns = std::max(impl_->allowance_ns, 0.0); // what ran free is no debt
}

void GenerationScheduler::pump() {
    impl_->pump();
}

std::optional<FinishedColumn> GenerationScheduler::take() {
    std::lock_guard lock(impl_->mutex);
    if (impl_->done.empty()) return std::nullopt;
    const ColumnPos at = impl_->done.front();
    impl_->done.pop_front();
    const auto found = impl_->columns.find(at);
    FinishedColumn out{at, std::move(*found->second.result)};
    impl_->columns.erase(found);
    --impl_->begun;
    ++impl_->stats.finished;
    return out;
}

std::size_t GenerationScheduler::pending() const {
    std::lock_guard lock(impl_->mutex);
    return impl_->columns.size();
}

void GenerationScheduler::stop() {
    std::lock_guard lock(impl_->mutex);
    impl_->stopped = true;
    while (!impl_->columns.empty())
        impl_->forget(impl_->columns.begin());
    impl_->done.clear();
    impl_->queue.clear();
    impl_->ready.clear();
}

GenerationStats GenerationScheduler::stats() const {
    std::lock_guard lock(impl_->mutex);
    GenerationStats out = impl_->stats;
    out.waiting = u32(impl_->queue.size());
    out.begun = impl_->begun, out.jobs = impl_->jobs;
    out.limited = impl_->has_budget();
    return out;
}

namespace {

class SourceWork final : public ColumnWork {
public:
    SourceWork(const ChunkSource& source, DimensionInfo dimension)
        : source_(source)
        , dimension_(std::move(dimension)) {}
    Result<StoredColumn> read(ColumnPos at) override { return source_.read(dimension_, at); }
    void missing(ColumnPos at, std::vector<TerrainTask>& out) override {
        if (const auto* generator = source_.generator_of(dimension_); generator && source_.in_stages()) generator->missing(at, out);
    }
    void run(TerrainTask part) override {
        if (const auto* generator = source_.generator_of(dimension_)) generator->run(part);
    }
    ColumnData finish(ColumnPos at, StoredColumn stored) override {
        return source_.finish(dimension_, at, std::move(stored));
    }

private:
    const ChunkSource& source_;
    DimensionInfo dimension_;
};

} // namespace

std::unique_ptr<ColumnWork> make_column_work(const ChunkSource& source, const DimensionInfo& dimension) {
    return std::make_unique<SourceWork>(source, dimension);
}

} // namespace vitrail
