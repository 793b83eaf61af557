// BiomeTable: a world's own numbering of biomes by name, kept by the store and sent to clients like the state table.
// Ids are given in order of first use and never change. Thread-safe.
#pragma once

#include "base/result.h"
#include "voxel/chunk.h"

#include <mutex>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace vitrail {

class BiomeTable {
public:
    static constexpr u32 kCapacity = 65536;
    // Id 0 "vitrail:none" exists from the start.
    BiomeTable() { (void)intern("vitrail:none"); }

    // Errors: limit, beyond kCapacity.
    Result<BiomeId> intern(std::string_view name) {
        std::lock_guard lock(mutex_);
        const auto found = index_.find(std::string(name));
        if (found != index_.end()) return BiomeId(found->second);
        if (names_.size() >= kCapacity) return fail(ErrorCode::limit, "more than 65536 biomes in one world");
        index_.emplace(name, u32(names_.size()));
        names_.emplace_back(name);
        return BiomeId(names_.size() - 1);
    }
    u32 size() const {
        std::lock_guard lock(mutex_);
        return u32(names_.size());
    }
    std::string name(BiomeId id) const { // "vitrail:none" for an id never given
        std::lock_guard lock(mutex_);
        return names_[u32(id) < names_.size() ? u32(id) : 0];
    }
    std::vector<std::string> names() const {
        std::lock_guard lock(mutex_);
        return names_;
    }

private:
    mutable std::mutex mutex_;
    std::vector<std::string> names_;
    std::unordered_map<std::string, u32> index_;
};

} // namespace vitrail
