// RangeAllocator: best-fit ranges of one growing line of units (quads in a buffer), neighbors joined when freed, so
// that nothing ever has to be moved. Plain arithmetic: no OpenGL here.
#pragma once

#include "base/types.h"

#include <map>
#include <optional>
#include <set>
#include <utility>

namespace vitrail::gfx {

class RangeAllocator {
public:
    explicit RangeAllocator(u32 capacity = 0) { grow(capacity); }
    // Offset of `count` units in a row; nullopt where no free range is long enough (grow, then ask again). count > 0.
    std::optional<u32> allocate(u32 count);
    // Exactly what allocate gave out.
    void free(u32 offset, u32 count);
    // Adds units at the end; capacity never shrinks.
    void grow(u32 capacity);
    u32 capacity() const { return capacity_; }
    u32 used() const { return used_; }
    u32 largest_free() const { return by_size_.empty() ? 0 : by_size_.rbegin()->first; }
    u32 free_ranges() const { return u32(by_offset_.size()); }

private:
    void add_free(u32 offset, u32 count);
    void remove_free(u32 offset, u32 count);
    std::map<u32, u32> by_offset_;          // free ranges: offset -> count
    std::set<std::pair<u32, u32>> by_size_; // (count, offset)
    u32 capacity_ = 0, used_ = 0;
};

} // namespace vitrail::gfx
