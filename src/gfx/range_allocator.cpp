#include "gfx/range_allocator.h"

#include "base/assert.h"

#include <iterator>

namespace vitrail::gfx {

void RangeAllocator::add_free(u32 offset, u32 count) {
    by_offset_.emplace(offset, count);
    by_size_.emplace(count, offset);
}

void RangeAllocator::remove_free(u32 offset, u32 count) {
    by_offset_.erase(offset);
    by_size_.erase({count, offset});
}

std::optional<u32> RangeAllocator::allocate(u32 count) {
    VX_ASSERT(count > 0);
    const auto best = by_size_.lower_bound({count, 0});
    if (best == by_size_.end()) return std::nullopt;
    const auto [size, offset] = *best;
    remove_free(offset, size);
    if (size > count) add_free(offset + count, size - count);
    used_ += count;
    return offset;
}

void RangeAllocator::free(u32 offset, u32 count) {
    VX_ASSERT(count > 0 && offset + count <= capacity_ && count <= used_);
    used_ -= count;
    const auto after = by_offset_.lower_bound(offset);
    if (after != by_offset_.end()) VX_ASSERT(after->first >= offset + count); // else freed twice
    if (after != by_offset_.begin()) {
        const auto [before_offset, before_count] = *std::prev(after);
        VX_ASSERT(before_offset + before_count <= offset);
        if (before_offset + before_count == offset) {
            remove_free(before_offset, before_count);
            offset = before_offset;
            count += before_count;
        }
    }
    const auto next = by_offset_.find(offset + count);
    if (next != by_offset_.end()) {
        const u32 next_count = next->second;
        remove_free(offset + count, next_count);
        count += next_count;
    }
    add_free(offset, count);
}

void RangeAllocator::grow(u32 capacity) {
    if (capacity <= capacity_) return;
    const u32 old = capacity_, added = capacity - capacity_;
    capacity_ = capacity;
    used_ += added;
    free(old, added);
}

} // namespace vitrail::gfx
