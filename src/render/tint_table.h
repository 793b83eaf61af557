// Tint grids of sections in one buffer, equal ones stored once. A slot is 108 words: grass, foliage, water, 36 texels
// each. Slot 0 holds the plain colors.
#pragma once

#include "gfx/handles.h"
#include "render/meshing/light_brick.h"

#include <array>
#include <cstring>
#include <unordered_map>
#include <vector>

namespace vitrail::render {

class TintTable {
public:
    static constexpr u32 kWords = 108;
    TintTable();
    u32 add(const TintGrid& grid); // its slot; counts one user; 0 where the table is full
    void free(u32 slot);
    u32 buffer() const { return buffer_.name(); }
    u64 gpu_bytes() const { return buffer_.bytes; }
    u32 slots_used() const { return u32(by_content_.size()); }

private:
    using Words = std::array<u32, kWords>;
    struct HashWords {
        std::size_t operator()(const Words& w) const;
    };
    struct Entry {
        u32 slot = 0, users = 0;
    };
    void reserve(u32 slots);
    gfx::Buffer buffer_;
    u32 capacity_ = 0, next_ = 0;
    std::vector<u32> free_;
    std::unordered_map<Words, Entry, HashWords> by_content_;
    std::unordered_map<u32, const Words*> content_of_; // keys of by_content_ do not move
};

} // namespace vitrail::render
