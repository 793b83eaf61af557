#include "store/save_queue.h"

#include "base/clock.h"
#include "base/log.h"

#include <algorithm>
#include <chrono>
#include <fmt/format.h>

namespace vitrail {

namespace {

u64 bytes_of(const SaveBatch& batch) {
    u64 total = 512;
    for (const auto& c : batch.chunks) {
        total += 128;
        if (!c.chunk) continue;
        total += c.chunk->blocks.memory_bytes() + (c.chunk->light ? c.chunk->light->memory_bytes() : 0);
        for (const auto& e : c.chunk->block_entities)
            total += e.nbt.size();
        for (const auto& e : c.chunk->entities)
            total += e.size();
    }
    total += batch.columns.size() * sizeof(SaveBatch::ColumnSave);
    for (const auto& e : batch.entities)
        total += 64 + (e.data ? e.data->size() : 0);
    for (const auto& p : batch.players)
        total += sizeof p + p.extra.size();
    for (const auto& s : batch.scripts)
        total += 64 + s.key.size() + (s.value ? s.value->size() : 0);
    return total;
}

struct PlaceHash {
    std::size_t operator()(const Located<ChunkPos>& p) const {
        return hash_combine(std::hash<ChunkPos>()(p.at), u32(p.dimension));
    }
};

// What the last of several batches says of each thing; one write each.
void merge(SaveBatch& into, SaveBatch&& from) {
    if (from.level) into.level = std::move(from.level);
    auto append = [](auto& a, auto& b) { std::move(b.begin(), b.end(), std::back_inserter(a)); };
    append(into.dimensions, from.dimensions);
    append(into.chunks, from.chunks);
    append(into.columns, from.columns);
    append(into.entities, from.entities);
    append(into.players, from.players);
    append(into.scripts, from.scripts);
}

// Chunks are what is saved again and again; of each only the last stays. Later ones win by order for all the rest.
void drop_overwritten(std::vector<SaveBatch::ChunkSave>& chunks) {
    std::unordered_map<Located<ChunkPos>, std::size_t, PlaceHash> last;
    for (std::size_t i = 0; i < chunks.size(); ++i)
        last[{chunks[i].dimension, chunks[i].at}] = i;
    if (last.size() == chunks.size()) return;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < chunks.size(); ++i)
        if (last[{chunks[i].dimension, chunks[i].at}] == i) {
            if (kept != i) chunks[kept] = std::move(chunks[i]);
            ++kept;
        }
    chunks.resize(kept);
}

} // namespace

struct SaveQueue::State {
    struct Pending {
        SaveBatch batch;
        OnKept on_kept;
        u64 bytes = 0;
        u64 since_ns = 0;
    };

    State(WorldRecords& r, SaveQueueOptions o)
        : records(r)
        , options(std::move(o))
        , thread([this] { run(); }) {}

    void run();
    // Commits all of `group`, which stays pending until then. Holds no lock.
    Result<> keep(const std::deque<Pending>& group);

    WorldRecords& records;
    SaveQueueOptions options;
    mutable std::mutex mutex;
    std::condition_variable wake, changed;
    std::deque<Pending> waiting; // not yet in a group
    std::deque<Pending> writing; // the group being committed, or to be tried again
    u64 submitted = 0, kept = 0; // batches
    u64 bytes = 0;
    u64 attempts = 0; // finished commits, good or failed
    u32 flushers = 0;
    bool stop = false;
    std::optional<Error> trouble;
    std::thread thread; // last: it uses the rest
};

SaveQueue::SaveQueue(WorldRecords& records, SaveQueueOptions options)
    : state_(std::make_unique<State>(records, std::move(options))) {}

SaveQueue::~SaveQueue() {
    {
        std::lock_guard lock(state_->mutex);
        state_->stop = true;
    }
    state_->wake.notify_all();
    state_->thread.join();
}

Result<> SaveQueue::State::keep(const std::deque<Pending>& group) {
    SaveBatch all;
    for (const Pending& p : group)
        merge(all, SaveBatch(p.batch));
    drop_overwritten(all.chunks);
    return records.save(all);
}

void SaveQueue::State::run() {
    std::unique_lock lock(mutex);
    for (;;) {
        wake.wait(lock, [&] { return stop || !waiting.empty() || !writing.empty(); });
        if (waiting.empty() && writing.empty()) return;
        if (writing.empty()) {
            // Company shares one transaction; nobody waits longer for it than group_ms from his submission.
            const u64 due = waiting.front().since_ns + u64(options.group_ms) * 1000000;
            while (!stop && flushers == 0 && bytes < options.pending_bytes_most / 2 && now_ns() < due)
                wake.wait_for(lock, std::chrono::nanoseconds(due - std::min(due, now_ns())));
        }
        std::move(waiting.begin(), waiting.end(), std::back_inserter(writing));
        waiting.clear();
        lock.unlock();
        const Result<> outcome = keep(writing);
        const bool news = outcome ? trouble.has_value() : !trouble.has_value();
        if (outcome) {
            for (const Pending& p : writing)
                if (p.on_kept) p.on_kept();
        } else if (news) {
            log_error(fmt::format("{}; what is unsaved is kept in memory and tried again", outcome.error().message));
        }
        if (news && options.on_trouble)
            options.on_trouble(outcome ? std::nullopt : std::optional<Error>(outcome.error()));
        std::deque<Pending> done;
        lock.lock();
        ++attempts;
        if (outcome) {
            trouble.reset();
            for (const Pending& p : writing)
                bytes -= p.bytes;
            kept += writing.size();
            done.swap(writing);
        } else {
            trouble = outcome.error();
        }
        changed.notify_all();
        if (!outcome) {
            if (stop) {
                log_error(fmt::format("{} saves are lost: {}", writing.size() + waiting.size(), trouble->message));
                return;
            }
            wake.wait_for(lock, std::chrono::milliseconds(options.retry_ms), [&] { return stop || flushers > 0; });
        }
        lock.unlock();
        done.clear(); // chunks are freed outside of the lock
        lock.lock();
    }
}

void SaveQueue::submit(SaveBatch batch, OnKept on_kept) {
    State& s = *state_;
    const u64 bytes = bytes_of(batch);
    std::unique_lock lock(s.mutex);
    // The writer itself (in an on_kept) must not wait for the writer.
    const bool may_wait = std::this_thread::get_id() != s.thread.get_id();
    if (may_wait && s.bytes > 0 && s.bytes + bytes > s.options.pending_bytes_most) {
        s.wake.notify_all();
        s.changed.wait(lock, [&] { return s.bytes == 0 || s.bytes + bytes <= s.options.pending_bytes_most; });
    }
    s.waiting.push_back({std::move(batch), std::move(on_kept), bytes, now_ns()});
    s.bytes += bytes;
    ++s.submitted;
    s.wake.notify_all();
}

Result<> SaveQueue::flush() {
    State& s = *state_;
    std::unique_lock lock(s.mutex);
    const u64 target = s.submitted;
    if (s.kept >= target) return {};
    ++s.flushers;
    s.wake.notify_all();
    // Of attempts that end from now on the first may have begun without our batches; the second has them.
    const u64 attempts = s.attempts;
    s.changed.wait(lock, [&] { return s.kept >= target || (s.trouble && s.attempts >= attempts + 2); });
    --s.flushers;
    if (s.kept >= target) return {};
    return tl::unexpected(*s.trouble);
}

u64 SaveQueue::pending_bytes() const {
    std::lock_guard lock(state_->mutex);
    return state_->bytes;
}

// The newest pending save that matches, newest first; null where none does. The lock is held.
template <class List, class Match>
static auto find_newest(const List& list, Match match) -> decltype(match(list.front().batch)) {
    for (auto p = list.rbegin(); p != list.rend(); ++p)
        if (auto found = match(p->batch)) return found;
    return nullptr;
}

Result<ChunkPtr> SaveQueue::load_chunk(DimensionId dimension, ChunkPos at) {
    {
        std::lock_guard lock(state_->mutex);
        auto match = [&](const SaveBatch& b) -> const SaveBatch::ChunkSave* {
            for (auto c = b.chunks.rbegin(); c != b.chunks.rend(); ++c)
                if (c->dimension == dimension && c->at == at) return &*c;
            return nullptr;
        };
        const auto* found = find_newest(state_->waiting, match);
        if (!found) found = find_newest(state_->writing, match);
        if (found) return found->chunk;
    }
    return state_->records.load_chunk(dimension, at);
}

Result<std::vector<WorldRecords::ColumnChunk>> SaveQueue::load_column_chunks(DimensionId dimension, ColumnPos at) {
    // Pending first: what is kept between the two looks is then in the store as well.
    std::map<i32, ChunkPtr> newest;
    {
        std::lock_guard lock(state_->mutex);
        for (const auto* list : {&state_->writing, &state_->waiting})
            for (const auto& p : *list)
                for (const auto& c : p.batch.chunks)
                    if (c.dimension == dimension && column_of(c.at) == at) newest[c.at.y] = c.chunk;
    }
    VX_TRY_ASSIGN(auto stored, state_->records.load_column_chunks(dimension, at));
    if (newest.empty()) return stored;
    for (auto& c : stored)
        newest.emplace(c.at.y, std::move(c.chunk));
    std::vector<WorldRecords::ColumnChunk> out;
    for (auto& [y, chunk] : newest)
        if (chunk) out.push_back({{at.x, y, at.z}, std::move(chunk)});
    return out;
}

Result<std::optional<ColumnRecord>> SaveQueue::load_column(DimensionId dimension, ColumnPos at) {
    {
        std::lock_guard lock(state_->mutex);
        auto match = [&](const SaveBatch& b) -> const SaveBatch::ColumnSave* {
            for (auto c = b.columns.rbegin(); c != b.columns.rend(); ++c)
                if (c->dimension == dimension && c->at == at) return &*c;
            return nullptr;
        };
        const auto* found = find_newest(state_->waiting, match);
        if (!found) found = find_newest(state_->writing, match);
        if (found) return found->column;
    }
    return state_->records.load_column(dimension, at);
}

} // namespace vitrail
