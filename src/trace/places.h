// Places in an array, lent by size: what is given back is lent again to who wants just as much. For arrays whose pieces
// have few different sizes.
#pragma once

#include "base/types.h"

#include <map>
#include <vector>

namespace vitrail::trace {

class Places {
public:
    // Places before `first` are never lent.
    explicit Places(u32 first = 0)
        : first_(first)
        , end_(first) {}
    // First entry of `size` > 0 entries; the array must reach end() afterwards.
    u32 take(u32 size) {
        used_ += size;
        std::vector<u32>& free = free_[size];
        if (free.empty()) {
            end_ += size;
            return end_ - size;
        }
        const u32 at = free.back();
        free.pop_back();
        return at;
    }
    void give(u32 at, u32 size) {
        used_ -= size;
        free_[size].push_back(at);
    }
    u32 end() const { return end_; }
    u64 used() const { return used_; } // entries that are lent
    void clear() { *this = Places(first_); }

private:
    u32 first_, end_;
    u64 used_ = 0;
    std::map<u32, std::vector<u32>> free_; // by size
};

} // namespace vitrail::trace
