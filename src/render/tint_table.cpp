#include "render/tint_table.h"

#include <algorithm>
#include <epoxy/gl.h>

namespace vitrail::render {

std::size_t TintTable::HashWords::operator()(const Words& words) const {
    u64 h = 0;
    for (u32 w : words)
        h = hash_combine(h, w);
    return std::size_t(h);
}

TintTable::TintTable() {
    reserve(64);
    TintGrid plain;
    const BiomeTint tint;
    for (u32 i = 0; i < 36; ++i) {
        plain.grass[i] = {tint.grass[0], tint.grass[1], tint.grass[2], 255};
        plain.foliage[i] = {tint.foliage[0], tint.foliage[1], tint.foliage[2], 255};
        plain.water[i] = {tint.water[0], tint.water[1], tint.water[2], 255};
    }
    add(plain);
}

void TintTable::reserve(u32 slots) {
    if (slots <= capacity_) return;
    gfx::grow_buffer(buffer_, u64(slots) * kWords * 4, u64(capacity_) * kWords * 4);
    capacity_ = slots;
}

u32 TintTable::add(const TintGrid& grid) {
    Words words;
    for (u32 i = 0; i < 36; ++i) {
        std::memcpy(&words[i], grid.grass[i].data(), 4);
        std::memcpy(&words[36 + i], grid.foliage[i].data(), 4);
        std::memcpy(&words[72 + i], grid.water[i].data(), 4);
    }
    const auto found = by_content_.find(words);
    if (found != by_content_.end()) {
        ++found->second.users;
        return found->second.slot;
    }
    u32 slot = next_;
    if (!free_.empty()) {
        slot = free_.back();
        free_.pop_back();
    } else {
        if (next_ >= 65535) return 0;
        if (++next_ > capacity_) reserve(capacity_ * 2);
    }
    const auto at = by_content_.emplace(words, Entry{slot, 1}).first;
    content_of_[slot] = &at->first;
    glNamedBufferSubData(buffer_.name(), GLintptr(u64(slot) * kWords * 4), kWords * 4, words.data());
    return slot;
}

void TintTable::free(u32 slot) {
    if (slot == 0) return;
    const auto content = content_of_.find(slot);
    const auto entry = by_content_.find(*content->second);
    if (--entry->second.users > 0) return;
    content_of_.erase(content);
    by_content_.erase(entry);
    free_.push_back(slot);
}

} // namespace vitrail::render
