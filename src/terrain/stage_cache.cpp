#include "terrain/stage_cache.h"

namespace vitrail {

std::shared_ptr<const void> StageCache::get(const StageKey& key, const std::function<Made()>& make) {
    std::unique_lock lock(mutex_);
    for (;;) {
        const auto found = entries_.find(key);
        if (found == entries_.end()) break;
        if (found->second.value) {
            ++stats_.hits;
            order_.splice(order_.begin(), order_, found->second.place);
            return found->second.value;
        }
        made_.wait(lock);
    }
    ++stats_.misses;
    entries_.try_emplace(key);
    lock.unlock();
    Made made = make();
    lock.lock();
    Entry& entry = entries_[key];
    entry.value = made.value;
    entry.bytes = made.bytes;
    order_.push_front(key);
    entry.place = order_.begin();
    stats_.bytes += made.bytes;
    drop_locked();
    made_.notify_all();
    return made.value;
}

std::shared_ptr<const void> StageCache::peek(const StageKey& key) const {
    std::lock_guard lock(mutex_);
    const auto found = entries_.find(key);
    return found == entries_.end() ? nullptr : found->second.value;
}

bool StageCache::has(const StageKey& key) const {
    return peek(key) != nullptr;
}

StageCache::Stats StageCache::stats() const {
    std::lock_guard lock(mutex_);
    return stats_;
}

void StageCache::clear() {
    std::lock_guard lock(mutex_);
    for (const StageKey& key : order_) {
        stats_.bytes -= entries_[key].bytes;
        entries_.erase(key);
    }
    order_.clear();
}

void StageCache::drop_locked() {
    while (stats_.bytes > bytes_most_ && order_.size() > 1) {
        const auto found = entries_.find(order_.back());
        stats_.bytes -= found->second.bytes;
        ++stats_.dropped;
        entries_.erase(found);
        order_.pop_back();
    }
}

} // namespace vitrail
