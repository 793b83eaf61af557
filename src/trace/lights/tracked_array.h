// An array that remembers which pages of it changed, so that a copy in a device's memory is kept up to date by sending
// those alone.
#pragma once

#include "base/types.h"

#include <algorithm>
#include <vector>

namespace vitrail::trace {

struct ArrayRange {
    u32 first = 0, count = 0;
};

template <class T>
class TrackedArray {
public:
    static constexpr u32 kPage = 64;
    u32 size() const { return u32(items_.size()); }
    const T* data() const { return items_.data(); }
    const T& operator[](u32 i) const { return items_[i]; }
    T& edit(u32 i) {
        touched_[i / kPage] = 1;
        return items_[i];
    }
    void resize(u32 size) {
        const u32 before = this->size();
        items_.resize(size);
        touched_.resize((size + kPage - 1) / kPage, 1);
        if (before < size && before % kPage) touched_[before / kPage] = 1;
    }
    void assign(u32 size, T value) {
        items_.assign(size, value);
        touched_.assign((size + kPage - 1) / kPage, 1);
    }
    // Entries that changed since the last call, in order, whole pages.
    std::vector<ArrayRange> take_changes() {
        std::vector<ArrayRange> out;
        for (u32 page = 0; page < touched_.size(); ++page) {
            if (!touched_[page]) continue;
            touched_[page] = 0;
            const u32 first = page * kPage, count = std::min(kPage, size() - first);
            if (!out.empty() && out.back().first + out.back().count == first)
                out.back().count += count;
            else
                out.push_back({first, count});
        }
        return out;
    }

private:
    std::vector<T> items_;
    std::vector<u8> touched_;
};

} // namespace vitrail::trace
