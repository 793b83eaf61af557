// Memory for pieces of few different sizes, in one array that a device mirrors.
#pragma once

#include "trace/places.h"

#include <cstring>
#include <span>
#include <vector>

namespace vitrail::trace {

// Byte ranges that changed since they were last asked for, so that a mirror copies just those. Ranges that are close
// become one. For pieces written whole, near each other; TrackedArray is for single entries all over an array.
class DirtyRanges {
public:
    struct Range {
        u64 begin = 0, end = 0; // bytes
    };
    void add(u64 begin, u64 end) {
        if (begin >= end) return;
        if (!ranges_.empty()) {
            Range& last = ranges_.back();
            if (begin <= last.end + kGap && end + kGap >= last.begin) {
                last.begin = begin < last.begin ? begin : last.begin;
                last.end = end > last.end ? end : last.end;
                return;
            }
        }
        if (ranges_.size() >= kMost) { // too many to be worth keeping apart
            Range& first = ranges_.front();
            for (const Range& r : ranges_) {
                first.begin = r.begin < first.begin ? r.begin : first.begin;
                first.end = r.end > first.end ? r.end : first.end;
            }
            ranges_.resize(1);
            add(begin, end);
            return;
        }
        ranges_.push_back({begin, end});
    }
    std::span<const Range> ranges() const { return ranges_; }
    void clear() { ranges_.clear(); }

private:
    static constexpr u64 kGap = 256;
    static constexpr std::size_t kMost = 4096;
    std::vector<Range> ranges_;
};

template <class T>
class Pool {
public:
    // First element of a piece of `size` elements; what it holds is undefined.
    u32 take(u32 size) {
        const u32 at = places_.take(size);
        if (data_.size() < places_.end()) data_.resize(places_.end());
        return at;
    }
    void give(u32 at, u32 size) { places_.give(at, size); }
    // Writes what differs and notes it.
    void write(u32 at, std::span<const T> values) {
        std::size_t first = 0, last = values.size();
        while (first < last && data_[at + first] == values[first])
            ++first;
        while (last > first && data_[at + last - 1] == values[last - 1])
            --last;
        if (first == last) return;
        std::memcpy(&data_[at + first], &values[first], (last - first) * sizeof(T));
        dirty.add((at + first) * sizeof(T), (at + last) * sizeof(T));
    }
    // Writes all: the piece is new and a mirror does not have it.
    void fill(u32 at, std::span<const T> values) {
        std::memcpy(&data_[at], values.data(), values.size_bytes());
        dirty.add(at * sizeof(T), (at + values.size()) * sizeof(T));
    }
    const T* data() const { return data_.data(); }
    const T& operator[](std::size_t i) const { return data_[i]; }
    u64 size() const { return data_.size(); } // elements, free ones too
    u64 used() const { return places_.used(); }
    u64 bytes() const { return data_.capacity() * sizeof(T); }
    void clear() {
        data_.clear(), places_.clear();
        dirty.clear();
    }

    DirtyRanges dirty;

private:
    std::vector<T> data_;
    Places places_;
};

} // namespace vitrail::trace
