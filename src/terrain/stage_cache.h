// StageCache: results of terrain stages by (stage, column), made once, kept up to a bound of bytes, the least recently
// used dropped first. A result in use stays alive through its shared_ptr.
#pragma once

#include "voxel/coords.h"

#include <condition_variable>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <unordered_map>

namespace vitrail {

struct StageKey {
    u32 stage = 0;
    ColumnPos at;
    friend constexpr bool operator==(const StageKey&, const StageKey&) = default;
};
struct StageKeyHash {
    std::size_t operator()(const StageKey& k) const {
        return mix64((u64(u32(k.at.x)) << 32 | u32(k.at.z)) + k.stage * 0x9e3779b97f4a7c15ull);
    }
};

class StageCache {
public:
    struct Made {
        std::shared_ptr<const void> value;
        u64 bytes = 0;
    };
    struct Stats {
        u64 bytes = 0, hits = 0, misses = 0, dropped = 0;
    };

    explicit StageCache(u64 bytes_most)
        : bytes_most_(bytes_most) {}

    // The kept result, or what `make` returns; while one thread makes it others wait. `make` may ask for other keys, as
    // long as stages only ever ask for lower ones.
    std::shared_ptr<const void> get(const StageKey& key, const std::function<Made()>& make);
    // Null where it is not kept (or not made yet).
    std::shared_ptr<const void> peek(const StageKey& key) const;
    bool has(const StageKey& key) const;
    Stats stats() const;
    void clear();

private:
    struct Entry {
        std::shared_ptr<const void> value; // null while it is made
        u64 bytes = 0;
        std::list<StageKey>::iterator place;
    };
    void drop_locked();

    const u64 bytes_most_;
    mutable std::mutex mutex_;
    std::condition_variable made_;
    std::unordered_map<StageKey, Entry, StageKeyHash> entries_;
    std::list<StageKey> order_; // most recently used first; only made ones
    Stats stats_;
};

} // namespace vitrail
